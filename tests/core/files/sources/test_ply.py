"""PLY: the counts of the header, the lists, and the vertices that faces name."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import CORNERS, TRIANGLES, passed_or_refused, ply, ply_header, refusal

FORMS = ("ascii", "binary_little_endian", "binary_big_endian")
FACES = TRIANGLES.tolist()
MIXED = [(0, 1, 3, 2), *FACES[2:], (0, 1, 3, 7, 6)]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the file of a test lies."""
    return tmp_path / "box.ply"


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("faces", [FACES, MIXED, FACES * 40 + MIXED])
def test_whole_file_passes(form: str, faces: list[list[int]], path: Path) -> None:
    """Lists of one length and of several."""
    path.write_bytes(ply(form, faces))
    assert check_source(path, ()) == ()


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("count", [10**4, 10**6, 2**31 - 1, 4_000_000_000, 10**30])
def test_promised_points(form: str, count: int, path: Path) -> None:
    """A count of vertices that the data do not hold, be it a number that Blender's reader can read or not."""
    whole = ply(form, FACES)
    path.write_bytes(whole.replace(b"element vertex 8", f"element vertex {count}".encode()))
    assert "incomplete or damaged" in refusal(path)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("count", [13, 10**9])
def test_promised_faces(form: str, count: int, path: Path) -> None:
    """A count of faces that the data do not hold."""
    path.write_bytes(ply(form, FACES).replace(b"element face 12", f"element face {count}".encode()))
    assert f"says {count} rows of 'face'" in refusal(path)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("faces", [[*FACES, (0, 1, 8)], [*FACES, (0, -1, 2)], [*MIXED, (0, 1, 2**31 - 1)]])
def test_vertex_that_is_not_there(form: str, faces: list[list[int]], path: Path) -> None:
    """A face that names a vertex beyond the table, or before it."""
    path.write_bytes(ply(form, faces))
    assert "there are 8, counted from 0" in refusal(path)


@pytest.mark.parametrize("form", FORMS)
def test_only_list_of_a_face(form: str, path: Path) -> None:
    """Blender takes it for the corners, whatever it is called."""
    path.write_bytes(ply(form, [*FACES, (0, 1, 8)]).replace(b"vertex_indices", b"corners"))
    assert "names vertex 8" in refusal(path)


@pytest.mark.parametrize("form", FORMS[1:])
def test_length_of_a_list(form: str, path: Path) -> None:
    """A list that is longer than what is left of the file."""
    whole = bytearray(ply(form, FACES).replace(b"list uchar", b"list uint8"))
    whole[whole.index(b"end_header\n") + 11 + CORNERS.nbytes] = 255
    path.write_bytes(whole)
    assert "incomplete or damaged" in refusal(path)


@pytest.mark.parametrize("row", [b"3 0 1", b"3 0 1 x", b"3", b"x 0 1 2", b"3 0 1 2.5", b"-3 0 1 2"])
def test_row_of_text(row: bytes, path: Path) -> None:
    """A face with too few corners, or with one that is no number."""
    path.write_bytes(ply("ascii", FACES).replace(b"3 0 1 3", row))
    assert "incomplete or damaged" in refusal(path)


def test_long_line(path: Path) -> None:
    """A line longer than Blender's buffer ends the program."""
    path.write_bytes(ply("ascii", FACES).replace(b"0 0 1\n", b"0 0 1" + b" 0" * 40_000 + b"\n"))
    assert "longer than 65536 bytes" in refusal(path)


def test_carriage_returns_and_other_columns_pass(path: Path) -> None:
    """Lines as Windows writes them, columns beside the usual ones, several lists in a row."""
    extra = b"property uchar red\nelement face 1\nproperty uchar flags\nproperty list uchar float texcoord\n"
    head = ply_header("ascii", 3, 1).replace(b"element face 1\n", extra)
    body = b"0 0 0 9\n1 0 0 9\n0 1 0 9\n7 2 0.5 1e3 3 0 1 2\n"
    path.write_bytes((head + body).replace(b"\n", b"\r\n"))
    assert check_source(path, ()) == ()


def test_texture_is_told(path: Path) -> None:
    """Blender's reader takes no texture of a PLY file."""
    path.write_bytes(ply("ascii", FACES, ["comment TextureFile my paint.png"]))
    [remark] = check_source(path, ())
    assert "'my paint.png'" in remark
    assert "box.ply" in remark


@given(st.binary(max_size=60), st.integers(0, 400), st.sampled_from(FORMS))
def test_anything(tmp_path_factory: pytest.TempPathFactory, junk: bytes, at: int, form: str) -> None:
    """No damage leads to any other error than the one sentence."""
    whole = ply(form, MIXED)
    path = tmp_path_factory.getbasetemp() / "any.ply"
    path.write_bytes(whole[:at] + junk + whole[at + len(junk) :])
    passed_or_refused(path)


def test_many_faces_of_two_lengths(path: Path) -> None:
    """The rows of half a million faces are found by their lists, and a wrong one among them."""
    rng = np.random.default_rng(0)
    corners = np.where(rng.random(500_000) < 0.5, 3, 4)
    rows = np.repeat(corners, corners * 4 + 1)
    starts = np.cumsum(corners * 4 + 1) - (corners * 4 + 1)
    body = np.zeros(len(rows), dtype=np.uint8)
    body[starts] = corners
    path.write_bytes(ply_header("binary_little_endian", 8, len(corners)) + CORNERS.tobytes() + body.tobytes())
    assert check_source(path, ()) == ()
    body[starts[-1] + 1] = 8
    path.write_bytes(ply_header("binary_little_endian", 8, len(corners)) + CORNERS.tobytes() + body.tobytes())
    assert "names vertex 8" in refusal(path)
