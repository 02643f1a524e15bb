"""One file, written as a whole or left as it was."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from ..errors import BuildError
from .paths import named, writable


@contextmanager
def replacing(path: str | Path, what: str = "file") -> Iterator[Path]:
    """Yield a path to write to, which becomes the file at the end if nothing failed.

    Parameters
    ----------
    path : str or pathlib.Path
        File to write or to replace. A link is followed. The rights of a file
        that is replaced stay; a new one has those that the user's files have.
    what : str, optional
        "file" or "picture", for the sentence.

    Yields
    ------
    pathlib.Path
        An empty file in the same folder. The same path always has the same
        one, so that what a killed program left is taken up again.

    Raises
    ------
    BuildError
        The file cannot be written there; this is found out before the work.
    """
    target = writable(path, what)
    partial = target.with_name(f".legorize-{sha256(target.name.encode()).hexdigest()[:16]}.part")
    named(str(partial), what, BuildError)
    try:
        with _sentence(path, what), partial.open("wb"):
            pass
        yield partial
        with _sentence(path, what):
            if target.exists():
                shutil.copymode(target, partial)
            os.replace(partial, target)
    finally:
        with _sentence(path, what):
            if os.path.lexists(partial):
                partial.unlink()


def write_whole(path: str | Path, text: str) -> None:
    """Write a text file in one piece.

    Parameters
    ----------
    path : str or pathlib.Path
        File to write or replace; a link is followed.
    text : str
        Content, with its own line ends.

    Raises
    ------
    BuildError
        The file cannot be written.
    """
    with replacing(path) as partial, _sentence(path, "file"):
        partial.write_text(text, encoding="utf-8", newline="")


@contextmanager
def _sentence(path: str | Path, what: str) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise BuildError(f"The {what} {path} cannot be written ({error.strerror}): choose another place.") from error
