"""Files imported with their models at rest: without animation, in the poses of their nodes.

Importers give an object the action that comes first, which then overwrites the
node's own place. What glTF animates is taken out of a copy of the file before
it is imported; the importers of FBX can leave animation out by themselves, but
do not say whether there was any.
"""

from __future__ import annotations

import json
import mmap
import shutil
import struct
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any, Final
from urllib.parse import quote

ANIMATED: Final = (".glb", ".gltf", ".fbx")
"""Kinds of imported files that can hold animation."""

_GLB_HEADER: Final = struct.Struct("<4sII")
_CHUNK_HEADER: Final = struct.Struct("<I4s")

_FBX_CURVES: Final = (b"\x0eAnimationCurve", b"AnimationCurve:")
"""How the record of a curve begins in binary files, after the length of its name, and in files of text."""


def without_animation(source: Path, folder: Path) -> Path | None:
    """Write a copy of a glTF file without its animation.

    Parameters
    ----------
    source : pathlib.Path
        A .glb or .gltf file.
    folder : pathlib.Path
        For the copy, which names the other files of a .gltf by their absolute paths.

    Returns
    -------
    pathlib.Path or None
        None if there is no animation, or no glTF that could be read.

    References
    ----------
    glTF 2.0, sections 3.11 (animations) and 4.4 (the binary container).
    """
    if source.suffix.lower() == ".glb":
        return _glb_at_rest(source, folder / source.name)
    scene = _scene(source.read_bytes())
    if not _take_animation(scene):
        return None
    for entry in _beside(scene):
        # joined to a path that is absolute already, it stays that one
        entry["uri"] = str(PurePosixPath(quote(source.resolve().parent.as_posix())) / entry["uri"])
    (folder / source.name).write_text(json.dumps(scene), encoding="utf-8")
    return folder / source.name


def fbx_is_animated(source: Path) -> bool:
    """Return whether an FBX file has curves of animation."""
    if not source.stat().st_size:
        return False
    with source.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        return any(content.find(mark) >= 0 for mark in _FBX_CURVES)


def _glb_at_rest(source: Path, target: Path) -> Path | None:
    with source.open("rb") as file:
        start = file.read(_GLB_HEADER.size + _CHUNK_HEADER.size)
        if len(start) < _GLB_HEADER.size + _CHUNK_HEADER.size or not start.startswith(b"glTF"):
            return None
        length, kind = _CHUNK_HEADER.unpack_from(start, _GLB_HEADER.size)
        scene = _scene(file.read(length)) if kind == b"JSON" else {}
        if not _take_animation(scene):
            return None
        text = json.dumps(scene, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        _, version, whole = _GLB_HEADER.unpack_from(start)
        with target.open("wb") as copy:
            copy.write(_GLB_HEADER.pack(b"glTF", version, whole - length + len(text)))
            copy.write(_CHUNK_HEADER.pack(len(text), kind) + text)
            shutil.copyfileobj(file, copy)
    return target


def _scene(text: bytes) -> dict[str, Any]:
    """Return the scene of a glTF file; an empty one where the importer will say what is wrong."""
    try:
        scene = json.loads(text)
    except ValueError:
        return {}
    return scene if isinstance(scene, dict) else {}


def _beside(scene: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the entries that name a file beside the scene's own."""
    for kind in ("buffers", "images"):
        for entry in scene[kind] if isinstance(scene.get(kind), list) else ():
            if isinstance(entry, dict) and not str(entry.get("uri", "data:")).startswith("data:"):
                yield entry


def _take_animation(scene: dict[str, Any]) -> bool:
    """Take the animation out of a scene; return whether there was any."""
    return bool(scene.pop("animations", None))
