"""The header of PLY files."""

from __future__ import annotations

from pathlib import Path

import pytest

from legorize_addon.core.files.sources.ply_header import Element, Property, read_header
from tests.core.files.sources.written import TRIANGLES, ply, refusal

FACES = TRIANGLES.tolist()


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.ply"


@pytest.mark.parametrize(
    ("line", "instead"),
    [
        (b"element vertex 8", b"element vertex -8"),
        (b"element vertex 8", b"element vertex many"),
        (b"element vertex 8", b"element vertex"),
        (b"property float x", b"property real x"),
        (b"property list uchar", b"property list float"),
        (b"format ascii 1.0", b"format unknown 1.0"),
        (b"end_header", b"end"),
        (b"ply\n", b"plx\n"),
    ],
)
def test_header(line: bytes, instead: bytes, path: Path) -> None:
    """Headers that Blender's reader would end the program over, or not understand."""
    path.write_bytes(ply("ascii", FACES).replace(line, instead))
    assert "incomplete or damaged" in refusal(path)


def test_tables_and_columns(path: Path) -> None:
    """What a header says, with the byte order of its numbers."""
    data = ply("binary_big_endian", FACES, ["comment TextureFile paint.png", "obj_info any words"])
    header = read_header(path, data)
    corners = [Property(axis, ">f4") for axis in "xyz"]
    faces = [Property("vertex_indices", ">i4", ">u1")]
    assert header.elements == [Element("vertex", 8, corners), Element("face", 12, faces)]
    assert header.textures == ["paint.png"]
    assert not header.is_text
    assert header.end == data.index(b"end_header") + 11
