"""Losses that Blender does not report, or only in printed lines, when it opens a file."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Final

import bpy

from ..core.errors import MeshError

_NAMES: Final = 5
"""Names of lost data that a remark lists."""

_IGNORED: Final = b"ignoring face"
"""What Blender's importer of .obj files prints of a face that it leaves out."""


def told_losses(source: Path, said: bytes) -> tuple[str, ...]:
    """Return a remark on each kind of loss in the file that has just been opened.

    Parameters
    ----------
    source : Path
        The file.
    said : bytes
        What the importer printed.

    Raises
    ------
    MeshError
        If an image is a pipe or a device, which would be read without end.
    """
    _check_images(source)
    return tuple(remark for found in (_ignored(source, said), _newer(source), _unlinked(source)) for remark in found)


def _ignored(source: Path, said: bytes) -> Iterator[str]:
    count = said.count(_IGNORED)
    if count:
        faces = "1 face that names" if count == 1 else f"{count} faces that name"
        yield f"Left out of {source.name}: {faces} a vertex, normal or image coordinate that does not exist."


def _newer(source: Path) -> Iterator[str]:
    """Yield a remark if a Blender file comes from a later version."""
    version = bpy.data.version[:2]
    if bpy.data.filepath and version > bpy.app.version[:2]:
        yield (
            f"{source.name} was saved by Blender {version[0]}.{version[1]}, which is newer than this one: what only "
            "the newer version knows is missing."
        )


def _unlinked(source: Path) -> Iterator[str]:
    """Yield a remark on each linked file that is missing or lacks data."""
    lost: dict[str, list[str]] = {}
    for block in bpy.data.user_map():
        if block.library is not None and block.is_missing:
            lost.setdefault(block.library.filepath, []).append(block.name)
    for library, names in sorted(lost.items()):
        shown = ", ".join(sorted(names)[:_NAMES]) + (" and others" if len(names) > _NAMES else "")
        there = Path(bpy.path.abspath(library)).is_file()
        what = f"no longer holds {shown}" if there else f"is missing, and {shown} with it"
        yield (
            f"The file {library} that {source.name} links to {what}: put it there, or make everything local and "
            "save again."
        )


def _check_images(source: Path) -> None:
    for image in bpy.data.images:
        path = Path(bpy.path.abspath(image.filepath, library=image.library))
        if image.filepath and not image.packed_file and path.exists() and not path.is_file() and not path.is_dir():
            raise MeshError(f"{source.name} names {image.filepath!r}, which is not a file: choose an image file.")
