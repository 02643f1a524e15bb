"""Looking at a file before Blender opens it: the check of its kind."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from ...errors import MeshError
from .blend import check_blend
from .fbx import check_fbx
from .gltf import check_gltf
from .pictures import PICTURES
from .ply import check_ply
from .stl import check_stl
from .wavefront import check_obj


def check_source(source: Path, extensions: Collection[str]) -> tuple[str, ...]:
    """Look at a file before it is imported.

    Parameters
    ----------
    source : Path
        A file of a kind that Blender imports, by its suffix.
    extensions : collection of str
        The glTF extensions that the importer can read.

    Returns
    -------
    tuple of str
        Remarks: one sentence each on what the importer will leave out.

    Raises
    ------
    MeshError
        If there is no such file, or it is certain that it cannot be read.
    """
    check_file(source)
    kind = source.suffix.lower()
    checks: dict[str, Callable[[Path], tuple[str, ...]]] = {
        ".blend": check_blend,
        ".fbx": check_fbx,
        ".glb": partial(check_gltf, extensions=extensions),
        ".gltf": partial(check_gltf, extensions=extensions),
        ".obj": check_obj,
        ".ply": check_ply,
        ".stl": check_stl,
    }
    if kind not in checks:
        raise MeshError(
            f"{source.name} is not a kind of file that can be read: use one of {', '.join(checks)}, or for a mosaic "
            f"{', '.join(PICTURES)}."
        )
    try:
        return checks[kind](source)
    except OSError as error:
        raise MeshError(f"{source.name} cannot be read ({error.strerror}): check its access rights.") from error


def check_file(source: Path) -> None:
    """Refuse what is no file with something in it."""
    if not source.exists():
        raise MeshError(f"There is no file {source}: name one that exists.")
    if not source.is_file():
        raise MeshError(f"{source} is not a file: name a file with a model.")
    try:
        str(source.resolve()).encode()
    except UnicodeEncodeError as error:
        raise MeshError(f"The name of {str(source)!a} is not UTF-8, which Blender needs: rename it.") from error
    if source.stat().st_size == 0:
        raise MeshError(f"{source.name} is empty: export it again.")


@contextmanager
def unchanged(source: Path) -> Iterator[None]:
    """Refuse a file that is written to while it is read, such as one that is still being copied."""
    before = _state(source)
    yield
    if _state(source) != before:
        raise MeshError(f"{source.name} has changed while it was read: wait until it is complete.")


def _state(source: Path) -> tuple[int, int] | None:
    """Return the length of a file and when it was last written to; None if it is not there."""
    try:
        found = source.stat()
    except OSError:
        return None
    return found.st_size, found.st_mtime_ns
