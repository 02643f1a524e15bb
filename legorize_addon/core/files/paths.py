"""Paths that a user gives: unusable ones are refused in a sentence before any work."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Final

from ..errors import BuildError, LegorizeError, MeshError, SettingsError

LONGEST: Final = 1023
"""Bytes of the longest path that Blender keeps whole (FILE_MAX in its source, with the end of the string)."""


def named(path: str, what: str, error: type[LegorizeError] = SettingsError) -> Path:
    """Return a path as it was given, if it is one that Blender and all file systems can take.

    Parameters
    ----------
    path : str
        As typed.
    what : str
        What it names, "file" or "folder", for the sentence.
    error : type of LegorizeError, optional
        What to raise.

    Returns
    -------
    pathlib.Path

    Raises
    ------
    LegorizeError
        It is empty, is not UTF-8, has a NUL in it, or is too long for Blender.
    """
    if not path.strip():
        raise error(f"The {what} has no name: give it one.")
    if "\0" in path:
        raise error(f"The name of the {what} contains a NUL character: choose another one.")
    try:
        absolute = os.path.abspath(path).encode("utf-8")
    except UnicodeEncodeError as reason:
        shown = path.encode("utf-8", "backslashreplace").decode()
        raise error(f"The path of the {what} {shown} is not UTF-8, which Blender needs: rename it.") from reason
    except FileNotFoundError as reason:
        raise error("The working folder is no longer there: change to another one.") from reason
    if len(absolute) > LONGEST:
        raise error(f"The path of the {what} is longer than the {LONGEST} bytes that Blender takes: shorten it.")
    return Path(path)


def one_slash(absolute: str) -> Path:
    """Return a path without a second slash at its beginning, which would be the .blend file's folder for Blender."""
    return Path(f"/{absolute.lstrip('/')}" if os.name == "posix" else absolute)


def readable(path: Path) -> Path:
    """Return the absolute path of a file to read.

    Raises
    ------
    MeshError
        It is not there, is no ordinary file, or may not be read.
    """
    named(str(path), "file", MeshError)
    try:
        if path.is_dir():
            raise MeshError(f"{path} is a folder: name a file in it.")
        if path.exists() and not path.is_file():
            raise MeshError(f"{path} is a device or a pipe: save the model as a file first.")
        with path.open("rb"):
            return one_slash(os.path.abspath(path))
    except OSError as error:
        if error.errno in (errno.ENOENT, errno.ENOTDIR):
            raise MeshError(f"There is no file {path}: name one that exists.") from error
        raise MeshError(f"The file {path} cannot be read ({error.strerror}): check its name and rights.") from error


def writable(path: str | Path, what: str = "file") -> Path:
    """Return where to write a file: the absolute path behind all links.

    Parameters
    ----------
    path : str or pathlib.Path
        As chosen. A link is followed: what it points to is replaced, the link stays.
    what : str, optional
        "file" or "picture", for the sentence.

    Raises
    ------
    BuildError
        It cannot be a file: a folder or a device is there, or its name is none.
    """
    named(str(path), what, BuildError)
    try:
        target = one_slash(os.path.realpath(path))
        if target.is_symlink():
            raise OSError(errno.ELOOP, "it is a link that leads back to itself")
        if target.is_dir():
            raise IsADirectoryError(errno.EISDIR, "it is a folder")
        if target.exists() and not target.is_file():
            raise OSError(errno.EINVAL, "it is a device, a pipe or a socket")
    except OSError as error:
        raise BuildError(f"The {what} {path} cannot be written ({error.strerror}): choose another place.") from error
    named(str(target), what, BuildError)
    return target
