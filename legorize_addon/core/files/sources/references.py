"""Files that a file names: textures, buffers, material libraries."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from ...errors import MeshError


def beside(source: Path, name: str) -> Path | None:
    """Return where a file lies that another one names relative to itself; None if no file can have that name."""
    if "\0" in name:
        return None
    return source.parent / name.replace("\\", "/")


def check_regular(source: Path, names: Iterable[str]) -> None:
    """Refuse names of pipes, devices and folders: an importer would wait for their end for ever.

    Raises
    ------
    MeshError
        If something is there, but is no file.
    """
    for name in names:
        path = beside(source, name)
        if path is not None and _exists(path) and not path.is_file():
            raise MeshError(f"{source.name} names {name!r}, which is not a file: choose a file.")


def is_missing(source: Path, name: str) -> bool:
    """Return whether a file that another one names is not there, or cannot be opened."""
    path = beside(source, name)
    if path is None or not _exists(path):
        return True
    try:
        path.open("rb").close()
    except OSError:
        return True
    return False


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except OSError:
        # such as a name that is too long
        return False
