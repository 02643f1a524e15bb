"""The arrays of glTF files: whether they are in their buffers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

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
