"""glTF: the container, the description and its version."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import pytest

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import box_data, box_document, changed, glb, refusal, write_glb

Json = dict[str, Any]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.glb"


def test_container(path: Path) -> None:
    """The lengths that a .glb file tells of itself; bytes behind its end are none of it."""
    whole = glb(box_document(), box_data())
    for at, value, words in (
        (4, 1, "version 1"),
        (8, 99, "says 99 bytes"),
        (12, 2**32 - 1, "not complete JSON"),
        (16, 0, "not complete JSON"),
        (20 + struct.unpack_from("<I", whole, 12)[0], 2**31, "should have 2147483648 bytes"),
    ):
        path.write_bytes(whole[:at] + struct.pack("<I", value) + whole[at + 4 :])
        assert words in refusal(path)
    path.write_bytes(whole + b"more")
    assert "says" in refusal(path)


@pytest.mark.parametrize("text", [b"", b"{", b"[]", b"1", b"\xff", b"[" * 100_000, b'{"asset": 1}', b"{}"])
def test_description(text: bytes, tmp_path: Path) -> None:
    """What is not a JSON object of glTF 2.0."""
    (tmp_path / "box.gltf").write_bytes(text)
    refusal(tmp_path / "box.gltf")


def test_older_version(path: Path) -> None:
    """The version is named."""
    assert "version 1.0 of glTF" in refusal(write_glb(path, box_document() | {"asset": {"version": "1.0"}}))


def test_null_is_nothing(path: Path) -> None:
    """Some exporters write null for what is left out."""
    assert check_source(write_glb(path, changed("meshes/0/primitives/0/material", None)), ()) == ()
