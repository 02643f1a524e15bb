"""The arrays of glTF files: whether they are in their buffers."""

from __future__ import annotations

from contextlib import nullcontext
from pathlib import Path
from typing import Any

import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.gltf_arrays import _check_accessor, _check_primitive
from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import changed, refusal, write_glb

Json = dict[str, Any]


CHANGES: list[tuple[str, Any, str]] = [
    ("accessors/0/count", 4_000_000_000, "needs"),
    ("accessors/0/count", 9, "needs 108 bytes"),
    ("accessors/0/count", -1, "not a whole number"),
    ("accessors/0/count", 8.5, "not a whole number"),
    ("accessors/0/count", 7, "names vertex 7, but there are 7"),
    ("accessors/0/type", "VEC9", "unknown type"),
    ("accessors/0/componentType", 5124, "unknown type"),
    ("accessors/0/byteOffset", 4, "needs 100 bytes"),
    ("accessors/0/bufferView", 2, "there are 2 'bufferViews'"),
    ("accessors/0/bufferView", -1, "there are 2 'bufferViews'"),
    ("accessors/1/componentType", 5126, "not whole numbers"),
    ("bufferViews/0/byteLength", 4_000_000_000, "ends at byte 4000000000"),
    ("bufferViews/1/byteOffset", 97, "ends at byte 241"),
    ("bufferViews/0/byteOffset", -4, "not a whole number"),
    ("bufferViews/0/byteStride", 0, "not a whole number"),
    ("bufferViews/0/byteStride", 13, "not a multiple of 4"),
    ("bufferViews/0/byteStride", 252, "needs"),
    ("bufferViews/0/buffer", 1, "there are 1 'buffers'"),
    ("buffers/0/byteLength", 1000, "should have 1000 bytes"),
    ("meshes/0/primitives/0/attributes/NORMAL", 1, "36 values of NORMAL"),
    ("accessors/1/count", 35, "35 corners"),
]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.glb"


@pytest.mark.parametrize(("place", "value", "words"), CHANGES)
def test_arrays(place: str, value: Any, words: str, path: Path) -> None:
    """An array that does not fit into its buffer, or to the other arrays."""
    assert words in refusal(write_glb(path, changed(place, value)))


SPARSE = {
    "count": 1,
    "indices": {"bufferView": 1, "componentType": 5125},
    "values": {"bufferView": 0},
}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({}, ""),
        ({"count": 9}, "9 indices"),
        ({"indices": {"bufferView": 1, "componentType": 5126}}, "of type 5126"),
        ({"indices": {"bufferView": 9, "componentType": 5125}}, "'bufferViews'"),
        ({"values": {"bufferView": 0, "byteOffset": 90}}, "needs 102 bytes"),
        ({"values": None}, "incomplete"),
        ({"values": 3}, "not an object"),
    ],
)
def test_sparse_array(change: Json, words: str, path: Path) -> None:
    """An array of which some elements are replaced, from arrays that have to be there, too."""
    path = write_glb(path, changed("accessors/0/sparse", SPARSE | change))
    assert words in refusal(path) if words else check_source(path, ()) == ()


def test_array_of_nothing(path: Path) -> None:
    """An array without data is all zeros, which are not made in millions for a small file."""
    document = changed("accessors/0", {"componentType": 5126, "count": 10**9, "type": "VEC3"})
    assert "should have 1000000000 elements" in refusal(write_glb(path, document))


MODES = {
    "points": (1, 2, 3, 4, 5, 6, 7),
    "lines": (2, 4, 6),
    "line loop": (2, 3, 4, 5, 6, 7),
    "line strip": (2, 3, 4, 5, 6, 7),
    "triangles": (3, 6),
    "triangle strip": (3, 4, 5, 6, 7),
    "triangle fan": (3, 4, 5, 6, 7),
}
"""Numbers of corners up to seven that a primitive may have, by its mode: glTF 2.0, section 3.7.2.1."""


@pytest.mark.parametrize("mode", range(7), ids=list(MODES))
def test_corners_of_a_primitive(mode: int, path: Path) -> None:
    """A primitive has as many corners as its mode makes whole faces or edges of, or none."""
    for corners in range(8):
        document = {"accessors": [{"count": corners}]}
        whole = corners in (0, *list(MODES.values())[mode])
        with nullcontext() if whole else pytest.raises(MeshError, match=f"{corners} corners"):
            _check_primitive(path, "here", {"attributes": {"POSITION": 0}, "mode": mode}, document, [])


BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
NUMBERS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
"""Bytes of a component and components of an element: glTF 2.0, section 3.6.2.2."""


@pytest.mark.parametrize("shape", NUMBERS)
@pytest.mark.parametrize("kind", BYTES)
def test_bytes_of_an_element(kind: int, shape: str, path: Path) -> None:
    """A view that is as long as two elements has room for them; one byte less has not."""
    accessor = {"componentType": kind, "type": shape, "count": 2, "bufferView": 0}
    needed = 2 * BYTES[kind] * NUMBERS[shape]
    _check_accessor(path, "here", accessor, [{"byteLength": needed}])
    with pytest.raises(MeshError, match=f"needs {needed} bytes"):
        _check_accessor(path, "here", accessor, [{"byteLength": needed - 1}])
