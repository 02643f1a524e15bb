"""The numbers by which the parts of a glTF file name each other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.core.files.sources.written import box_document, changed, passed_or_refused, refusal, write_glb

Json = dict[str, Any]


CHANGES: list[tuple[str, Any, str]] = [
    ("meshes/0/primitives/0/mode", 7, "not a kind of primitive"),
    ("meshes/0/primitives/0/indices", 9, "there are 2 'accessors'"),
    ("meshes/0/primitives/0/material", 0, "there are 0 'materials'"),
    ("meshes/0/primitives/0/attributes", [], "not an object"),
    ("meshes/0/primitives", 3, "not a list"),
    ("nodes/0/mesh", 1, "there are 1 'meshes'"),
    ("nodes/0/children", [7], "there are 2 'nodes'"),
    ("nodes/1/children", [0], "nodes/0 is below itself"),
    ("nodes/1/children", [1], "nodes/1 has two parents"),
    ("nodes/0/children", [1, 1], "nodes/1 has two parents"),
    ("nodes", {}, "not a list of objects"),
    ("scene", 1, "there are 1 'scenes'"),
    ("scenes/0/nodes", ["0"], "scenes/0/nodes/0 is '0'"),
    ("skins", [{"joints": [2]}], "there are 2 'nodes'"),
    ("textures", [{"source": 0}], "there are 0 'images'"),
    ("materials", [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}], "there are 0 'textures'"),
    ("extensionsRequired", 3, "not a list"),
]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.glb"


@pytest.mark.parametrize(("place", "value", "words"), CHANGES)
def test_numbers(place: str, value: Any, words: str, path: Path) -> None:
    """A number, an array or a name that does not fit to the rest."""
    assert words in refusal(write_glb(path, changed(place, value)))


places = st.sampled_from(
    [*(place for place, _, _ in CHANGES), "accessors", "bufferViews/0", "meshes/0", "asset", "nodes/0"]
)
values = st.recursive(
    st.none() | st.booleans() | st.integers(-2, 2**40) | st.floats(-9, 9) | st.text(max_size=3),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from(["bufferView", "count"]), inner, max_size=3)
    ),
    max_leaves=5,
)


@given(st.lists(st.tuples(places, values), max_size=3))
def test_anything_is_passed_or_refused(
    tmp_path_factory: pytest.TempPathFactory, changes: list[tuple[str, Any]]
) -> None:
    """No description leads to any other error than the one sentence."""
    document = box_document()
    for place, value in changes:
        part: Any = document
        *keys, last = (int(key) if key.isdigit() else key for key in place.split("/"))
        try:
            for key in keys:
                part = part[key]
            part[last] = value
        except (IndexError, KeyError, TypeError):
            continue
    passed_or_refused(write_glb(tmp_path_factory.getbasetemp() / "any.glb", document))
