"""Whether the arrays of a glTF file lie within its buffers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, TypeAlias

import numpy as np

from .damage import damaged

Json: TypeAlias = dict[str, Any]
Buffers: TypeAlias = Sequence[memoryview | None]

COMPRESSED: Final = ("EXT_meshopt_compression", "KHR_meshopt_compression")
"""Extensions that put other data in the place of a buffer view."""

DRACO: Final = "KHR_draco_mesh_compression"

_SIZES: Final = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
"""Bytes of a component, by the numbers of glTF."""

_INDEX: Final = {5121: "u1", 5123: "<u2", 5125: "<u4"}
"""Those that may be indices, as numpy calls them."""

_FLOAT: Final = 5126

_COMPONENTS: Final = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}

_CORNERS: Final = ((1, 1), (2, 2), (1, 2), (1, 2), (3, 3), (1, 3), (1, 3))
"""By the mode of a primitive: of what its number of corners is a multiple, and the least (glTF 2.0, section 3.7.2.1).

An incomplete triangle ends Blender 4.5.
"""

_TRIANGLES: Final = 4
"""The mode of a primitive that names none."""


def check_arrays(source: Path, document: Json, buffers: Buffers) -> None:
    """Refuse arrays that are not in their buffers, and indices of vertices that are not there.

    Raises
    ------
    MeshError
        What is wrong, and where.
    """
    views, accessors = document.get("bufferViews", []), document.get("accessors", [])
    for number, view in enumerate(views):
        _check_view(source, f"bufferViews/{number}", view, buffers)
    room = sum(len(data) for data in buffers if data is not None)
    packed = any(True for _ in _draco(document)) or any(_is_compressed(view) for view in views)
    for number, accessor in enumerate(accessors):
        place = f"accessors/{number}"
        _check_accessor(source, place, accessor, views)
        # of an array that is zero elsewhere each element stands beside others that are in the file
        if "bufferView" not in accessor and not packed and accessor["count"] > room:
            raise damaged(source, f"{place} should have {accessor['count']} elements, but there are {room} bytes")
    for place, primitive in _primitives(document):
        if DRACO not in primitive.get("extensions", {}):
            _check_primitive(source, place, primitive, document, buffers)


def places(document: Json, buffers: Buffers) -> Iterator[tuple[int, np.ndarray]]:
    """Yield the places of vertices, each array once: its buffer, and a view of that, (n, 3) float32.

    Left out are arrays that are compressed, or sparse.
    """
    accessors, views = document.get("accessors", []), document.get("bufferViews", [])
    numbers = {each.get("attributes", {}).get("POSITION") for _, each in _primitives(document)} - {None}
    for number in sorted(numbers):
        accessor = accessors[number]
        points = accessor["componentType"] == _FLOAT and accessor["type"] == "VEC3"
        rows = _rows(accessor, views, buffers, "<f4", 3) if points else None
        if rows is not None:
            yield views[accessor["bufferView"]]["buffer"], rows


def _rows(accessor: Json, views: list[Json], buffers: Buffers, kind: str, width: int) -> np.ndarray | None:
    """Return the rows of an array; None where they are compressed, or not all in one place."""
    if "bufferView" not in accessor or not accessor["count"] or "sparse" in accessor:
        return None
    view = views[accessor["bufferView"]]
    data = buffers[view["buffer"]]
    if data is None or _is_compressed(view):
        return None
    size = np.dtype(kind).itemsize
    start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
    return np.ndarray((accessor["count"], width), kind, data, start, (view.get("byteStride") or size * width, size))


def _draco(document: Json) -> Iterator[Json]:
    return (each for _, each in _primitives(document) if DRACO in each.get("extensions", {}))


def _is_compressed(view: Json) -> bool:
    return any(name in view.get("extensions", {}) for name in COMPRESSED)


def _whole(source: Path, place: str, part: Json, key: str, default: int | None = None, least: int = 0) -> int:
    """Return a whole number of a part of the document."""
    value = part.get(key, default)
    if not isinstance(value, int) or isinstance(value, bool) or value < least:
        raise damaged(source, f"{place}/{key} is {value!r}, not a whole number from {least}")
    return value


def _check_view(source: Path, place: str, view: Json, buffers: Buffers) -> None:
    buffer = buffers[_whole(source, place, view, "buffer")]
    end = _whole(source, place, view, "byteOffset", 0) + _whole(source, place, view, "byteLength")
    if _is_compressed(view):
        return
    if buffer is None:
        raise damaged(source, f"the data of buffers/{view['buffer']} are missing")
    if end > len(buffer):
        raise damaged(source, f"{place} ends at byte {end} of buffers/{view['buffer']}, which has {len(buffer)}")


def _check_accessor(source: Path, place: str, accessor: Json, views: list[Json]) -> None:
    kind, shape = accessor.get("componentType"), accessor.get("type")
    if not isinstance(kind, int) or kind not in _SIZES or not isinstance(shape, str) or shape not in _COMPONENTS:
        raise damaged(source, f"{place} has the unknown type {shape!r} of {kind!r}")
    count = _whole(source, place, accessor, "count")
    if "bufferView" in accessor:
        _check_room(source, place, accessor, views, count, _SIZES[kind], _COMPONENTS[shape])
    sparse = accessor.get("sparse")
    if sparse is None:
        return
    if not {"indices", "values"} <= sparse.keys():
        raise damaged(source, f"{place}/sparse is incomplete")
    few = _whole(source, f"{place}/sparse", sparse, "count")
    inner = sparse["indices"].get("componentType")
    if not isinstance(inner, int) or inner not in _INDEX or few > count:
        raise damaged(source, f"{place}/sparse has {few} indices of type {inner!r} for {count} elements")
    _check_room(source, f"{place}/sparse/indices", sparse["indices"], views, few, _SIZES[inner], 1)
    _check_room(source, f"{place}/sparse/values", sparse["values"], views, few, _SIZES[kind], _COMPONENTS[shape])


def _check_room(
    source: Path, place: str, part: Json, views: list[Json], count: int, size: int, components: int
) -> None:
    """Refuse an array that does not fit into its buffer view."""
    view = views[_whole(source, place, part, "bufferView")]
    stride = _whole(source, place, view, "byteStride", size * components, least=1)
    if stride % size:
        raise damaged(source, f"{place} has rows of {stride} bytes, not a multiple of {size}")
    end = _whole(source, place, part, "byteOffset", 0) + max(count - 1, 0) * stride + size * components * (count > 0)
    if end > view["byteLength"]:
        raise damaged(source, f"{place} needs {end} bytes, but its buffer view has {view['byteLength']}")


def _primitives(document: Json) -> Iterator[tuple[str, Json]]:
    for number, mesh in enumerate(document.get("meshes", [])):
        for row, primitive in enumerate(mesh.get("primitives", [])):
            yield f"meshes/{number}/primitives/{row}", primitive


def _check_primitive(source: Path, place: str, primitive: Json, document: Json, buffers: Buffers) -> None:
    """Refuse attributes of unequal length, and indices of vertices beyond them."""
    accessors, attributes = document.get("accessors", []), primitive.get("attributes")
    if attributes is None:
        raise damaged(source, f"{place} has no attributes")
    if "POSITION" not in attributes:
        return
    vertices = accessors[attributes["POSITION"]]["count"]
    for name, number in attributes.items():
        if accessors[number]["count"] != vertices:
            raise damaged(source, f"{place} has {vertices} vertices, but {accessors[number]['count']} values of {name}")
    corners = accessors[primitive["indices"]]["count"] if "indices" in primitive else vertices
    multiple, least = _CORNERS[primitive.get("mode", _TRIANGLES)]
    if corners % multiple or 0 < corners < least:
        raise damaged(source, f"{place} has {corners} corners, which do not make whole faces or edges")
    if "indices" in primitive:
        accessor = accessors[primitive["indices"]]
        largest = _largest_index(accessor, document.get("bufferViews", []), buffers)
        if accessor["componentType"] not in _INDEX or accessor["type"] != "SCALAR":
            raise damaged(source, f"{place} has indices that are not whole numbers")
        if largest >= vertices:
            raise damaged(source, f"{place} names vertex {largest}, but there are {vertices}, counted from 0")


def _largest_index(accessor: Json, views: list[Json], buffers: Buffers) -> int:
    """Return the largest of some indices; -1 where they are compressed, or all zero."""
    kind = _INDEX.get(accessor["componentType"])
    rows = None if kind is None else _rows(accessor, views, buffers, kind, 1)
    return -1 if rows is None else int(rows.max())
