"""Small files of every kind, written byte by byte, for tests that damage them."""

from __future__ import annotations

import copy
import json
import re
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.preflight import check_source

CORNERS = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype="<f4")
TRIANGLES = np.array(
    [
        *((0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1)),
        *((2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)),
    ],
    dtype="<u4",
)


def box_document() -> dict[str, Any]:
    """Return the description of a box: positions, then indices in one buffer."""
    return copy.deepcopy(
        {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"children": [1]}, {"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0] * 3, "max": [1] * 3},
                {"bufferView": 1, "componentType": 5125, "count": 36, "type": "SCALAR"},
            ],
            "bufferViews": [
                {"buffer": 0, "byteOffset": 0, "byteLength": 96},
                {"buffer": 0, "byteOffset": 96, "byteLength": 144},
            ],
            "buffers": [{"byteLength": 240}],
        }
    )


def box_data() -> bytes:
    """Return the buffer of the box."""
    return CORNERS.tobytes() + TRIANGLES.tobytes()


def glb(document: dict[str, Any], data: bytes) -> bytes:
    """Return a .glb file."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    data += b"\0" * (-len(data) % 4)
    length = 12 + 8 + len(text) + 8 + len(data)
    head = struct.pack("<4sII", b"glTF", 2, length)
    return head + struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data


def write_glb(path: Path, document: dict[str, Any], data: bytes | None = None) -> Path:
    """Write a .glb file, by default with the data of the box."""
    path.write_bytes(glb(document, box_data() if data is None else data))
    return path


def ply_header(form: str, vertices: int, faces: int, extra: Sequence[str] = ()) -> bytes:
    """Return the header of a .ply file with positions and lists of corners."""
    lines = [
        *("ply", f"format {form} 1.0", *extra, f"element vertex {vertices}"),
        *(f"property float {axis}" for axis in "xyz"),
        *(f"element face {faces}", "property list uchar int vertex_indices", "end_header"),
    ]
    return ("\n".join(lines) + "\n").encode()


def ply(form: str, faces: Sequence[Sequence[int]], extra: Sequence[str] = ()) -> bytes:
    """Return a .ply file with the corners of the box."""
    head = ply_header(form, len(CORNERS), len(faces), extra)
    if form == "ascii":
        rows = [" ".join(f"{value:g}" for value in row) for row in CORNERS.tolist()]
        rows += [" ".join(map(str, (len(face), *face))) for face in faces]
        return head + ("\n".join(rows) + "\n").encode()
    order = "<" if "little" in form else ">"
    body = CORNERS.astype(order + "f4").tobytes()
    return head + body + b"".join(struct.pack(f"{order}B{len(face)}i", len(face), *face) for face in faces)


def stl() -> bytes:
    """Return the box as a binary .stl file."""
    rows = np.zeros(len(TRIANGLES), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("spare", "<u2")])
    rows["corners"] = CORNERS[TRIANGLES]
    return b"\0" * 80 + struct.pack("<I", len(rows)) + rows.tobytes()


def stl_text() -> bytes:
    """Return the box as a .stl file in text."""
    facets = [
        "facet normal 0 0 0\n outer loop\n"
        + "".join(f"  vertex {x:g} {y:g} {z:g}\n" for x, y, z in CORNERS[face].tolist())
        + " endloop\nendfacet\n"
        for face in TRIANGLES
    ]
    return ("solid box\n" + "".join(facets) + "endsolid box\n").encode()


def obj(faces: Sequence[Sequence[int]] = TRIANGLES.tolist(), head: str = "", use: str = "") -> bytes:
    """Return the box as an .obj file, counted from 0."""
    rows = [f"v {x:g} {y:g} {z:g}" for x, y, z in CORNERS.tolist()]
    rows += [use] if use else []
    rows += ["f " + " ".join(str(corner + 1) for corner in face) for face in faces]
    return (head + "\n".join(rows) + "\n").encode()


def refusal(path: Path, extensions: tuple[str, ...] = ()) -> str:
    """Return the one sentence with which a file is refused."""
    with pytest.raises(MeshError) as caught:
        check_source(path, extensions)
    sentence = str(caught.value)
    assert re.fullmatch(r"[^\n]+\.", sentence)
    return sentence


def changed(place: str, value: Any) -> dict[str, Any]:
    """Return the box's description with another value in one place."""
    document = part = box_document()
    *keys, last = (int(key) if key.isdigit() else key for key in place.split("/"))
    for key in keys:
        part = part[key]
    part[last] = value
    return document


def passed_or_refused(path: Path) -> None:
    """Check a file of any content: whatever is wrong with it ends in the one sentence."""
    try:
        check_source(path, ())
    except MeshError as error:
        sentence = str(error)
    else:
        return
    assert re.fullmatch(re.escape(path.name) + r" .+\.", sentence)
