"""Vertices without a finite place, which importers put at the origin: moved where they are recognised afterwards.

Nobody sees in Blender any more which vertex was where no vertex can be, and a
face that ends at the origin instead bends the model. So the importer gets a copy
of the file in which such vertices are farther away than anything is, and they are
taken out after it, with their faces.
"""

from __future__ import annotations

import base64
import json
import mmap
import os
import re
import struct
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import Any, Final, TypeAlias
from urllib.parse import quote

import numpy as np
from numpy.typing import NDArray

from .gltf import read_gltf
from .gltf_arrays import places
from .gltf_buffers import buffers
from .ply_header import read_header

Json: TypeAlias = dict[str, Any]

LOST: Final = 1e35
"""Coordinate of such vertices in the copy: a float, though no place."""

INFINITE: Final = 1e30
"""Numbers from here on stand for infinity, for which Blender sets the greatest float, 3.4e38."""

_SUSPECT: Final = re.compile(
    rb"^[ \t]*v[ \t][^\r\n]*?(?:n|i|#|e\+?[3-9]\d|e\+?\d{3}|\d{31})", re.MULTILINE | re.IGNORECASE
)
_VERTEX: Final = re.compile(rb"^[ \t]*v[ \t]+(\S+)[ \t]+(\S+)[ \t]+([^\s]+)", re.MULTILINE)
_LIBRARY: Final = re.compile(rb"^([ \t]*mtllib[ \t]+\"?)", re.MULTILINE)
_FACET: Final = re.compile(rb"facet\s.*?endfacet\s*", re.DOTALL | re.IGNORECASE)
_CORNER: Final = re.compile(rb"vertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)
_STL: Final = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
_STL_HEADER: Final = 84


def without_lost_places(source: Path, folder: Path) -> tuple[Path, tuple[str, ...]]:
    """Write a copy of a file whose vertices without a finite place are recognised after it was imported.

    Parameters
    ----------
    source : Path
        A file that was checked.
    folder : Path
        For the copy.

    Returns
    -------
    path : Path
        The file itself if there is no such vertex.
    remarks : tuple of str
        How many there are. Faces of .stl files have vertices of their own: in
        the copy such faces are missing.
    """
    writers: dict[str, Callable[[Path, Path], int]] = {
        ".glb": _gltf,
        ".gltf": _gltf,
        ".obj": _obj,
        ".ply": _ply,
        ".stl": _stl,
    }
    target = folder / source.name
    count = writers[source.suffix.lower()](source, target) if source.suffix.lower() in writers else 0
    if not count:
        return source, ()
    which = "1 vertex whose coordinates are" if count == 1 else f"{count} vertices whose coordinates are"
    at = "it" if count == 1 else "them"
    return target, (f"{source.name} has {which} not finite numbers: the faces at {at} were left out.",)


def is_lost(points: NDArray[np.floating]) -> NDArray[np.bool_]:
    """Return which points are no place, shape (n,) of (n, 3)."""
    # a comparison with no number is false
    lost: NDArray[np.bool_] = ~(np.abs(points) < INFINITE).all(axis=1)
    return lost


def _is_number(word: bytes) -> bool:
    try:
        return abs(float(word)) < INFINITE
    except ValueError:
        return False


def _obj(source: Path, target: Path) -> int:
    count = 0

    def moved(match: re.Match[bytes]) -> bytes:
        nonlocal count
        if all(map(_is_number, match.groups())):
            return match[0]
        count += 1
        return b"v %.0e 0 0" % LOST

    with source.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
        if _SUSPECT.search(data) is None:
            return 0
        copy = _VERTEX.sub(moved, data[:])
    if count:
        # material libraries are named relative to the file, or have its name
        parent = os.path.relpath(source.resolve().parent, target.resolve().parent).replace(os.sep, "/").encode()
        copy, libraries = _LIBRARY.subn(lambda match: match[1] + parent + b"/", copy)
        own = b"" if libraries else b"mtllib %b/%b.mtl\n" % (parent, os.fsencode(source.stem))
        target.write_bytes(own + copy)
    return count


def _stl(source: Path, target: Path) -> int:
    data = source.read_bytes()
    (count,) = struct.unpack_from("<I", data, 80) if len(data) >= _STL_HEADER else (0,)
    if len(data) != _STL_HEADER + count * _STL.itemsize:
        return _text_stl(data, target)
    rows = np.frombuffer(data, _STL, count, _STL_HEADER)
    lost = is_lost(rows["corners"].reshape(-1, 3)).reshape(-1, 3)
    kept = rows[~lost.any(axis=1)]
    if len(kept) < len(rows):
        target.write_bytes(data[:80] + struct.pack("<I", len(kept)) + kept.tobytes())
    return int(lost.sum())


def _text_stl(data: bytes, target: Path) -> int:
    count = 0

    def kept(match: re.Match[bytes]) -> bytes:
        nonlocal count
        lost = sum(not all(map(_is_number, corner)) for corner in _CORNER.findall(match[0]))
        count += lost
        return b"" if lost else match[0]

    copy = _FACET.sub(kept, data)
    if count:
        target.write_bytes(copy)
    return count


def _ply(source: Path, target: Path) -> int:
    data = bytearray(source.read_bytes())
    header = read_header(source, bytes(data))
    # only what comes first is where its header says, and that is what all writers do
    table = header.elements[0] if header.elements else None
    names = [] if table is None else [each.name for each in table.properties]
    if table is None or table.name != "vertex" or not {"x", "y", "z"} <= set(names) or not table.count:
        return 0
    if any(each.count_kind for each in table.properties):
        return 0
    if header.is_text:
        return _text_ply(bytes(data), header.end, table.count, [names.index(axis) for axis in "xyz"], target)
    kind = np.dtype([(f"{number}", each.kind) for number, each in enumerate(table.properties)])
    rows = np.frombuffer(data, kind, table.count, header.end)
    columns = [f"{names.index(axis)}" for axis in "xyz"]
    lost = is_lost(np.stack([rows[column] for column in columns], axis=1))
    if lost.any():
        rows[columns[0]][lost], rows[columns[1]][lost], rows[columns[2]][lost] = LOST, 0, 0
        target.write_bytes(data)
    return int(lost.sum())


def _text_ply(data: bytes, start: int, rows: int, columns: list[int], target: Path) -> int:
    count, left, lines = 0, rows, data[start:].splitlines(keepends=True)
    for number, line in enumerate(lines):
        if not left:
            break
        words = line.split()
        left -= bool(words)
        if len(words) > max(columns) and not all(_is_number(words[column]) for column in columns):
            count += 1
            for column, word in zip(columns, (b"%.0e" % LOST, b"0", b"0"), strict=True):
                words[column] = word
            lines[number] = b" ".join(words) + b"\n"
    if count:
        target.write_bytes(data[:start] + b"".join(lines))
    return count


def _gltf(source: Path, target: Path) -> int:
    document, binary = read_gltf(source)
    data = [None if each is None else memoryview(bytearray(each)) for each in buffers(source, document, binary)]
    count, changed = 0, set()
    for number, points in places(document, data):
        lost = is_lost(points)
        if lost.any():
            points[lost] = (LOST, 0, 0)
            count += int(lost.sum())
            changed.add(number)
    if count:
        _write_gltf(source, target, document, {number: bytes(data[number] or b"") for number in changed}, binary)
    return count


def _write_gltf(
    source: Path, target: Path, document: Json, changed: dict[int, bytes], binary: memoryview | None
) -> None:
    """Write a document with some of its buffers anew; others stay where they are."""
    for number, content in changed.items():
        row = document["buffers"][number]
        if "uri" in row:
            row["uri"] = f"data:application/octet-stream;base64,{base64.b64encode(content).decode()}"
        else:
            binary = memoryview(content)
    for row in (row for table in ("buffers", "images") for row in document.get(table, [])):
        if not str(row.get("uri", "data:")).startswith("data:"):
            row["uri"] = str(PurePosixPath(quote(source.resolve().parent.as_posix())) / row["uri"])
    text = json.dumps(document).encode()
    if binary is None:
        target.write_bytes(text)
        return
    text, content = text + b" " * (-len(text) % 4), bytes(binary) + b"\0" * (-len(binary) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(content), b"BIN\0") + content
    target.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
