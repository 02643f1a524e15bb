"""Vertices without a finite place, in files of every kind: counted, and recognised in the copy."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.files.sources.gltf import read_gltf
from legorize_addon.core.files.sources.lost_places import LOST, is_lost, without_lost_places
from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources import written
from tests.core.files.sources.written import CORNERS, TRIANGLES

KINDS = ("a.obj", "a.stl", "text.stl", "a.ply", "big.ply", "text.ply", "a.glb", "a.gltf")
FACES = TRIANGLES.tolist()


def write(folder: Path, name: str, value: float, lost: list[int]) -> Path:
    """Write the box with some of its corners at no place."""
    corners = CORNERS.copy()
    corners[lost, 1] = value
    path = folder / name
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(written, "CORNERS", corners)
        if path.suffix == ".gltf":
            document = written.box_document()
            document["buffers"] = [{"byteLength": 240, "uri": "box.bin"}]
            (folder / "box.bin").write_bytes(written.box_data())
            path.write_text(json.dumps(document), encoding="utf-8")
            return path
        forms = {"big.ply": "binary_big_endian", "text.ply": "ascii"}
        content = {
            ".obj": written.obj,
            ".stl": written.stl_text if name.startswith("text") else written.stl,
            ".ply": lambda: written.ply(forms.get(name, "binary_little_endian"), FACES),
            ".glb": lambda: written.glb(written.box_document(), written.box_data()),
        }[path.suffix]()
    path.write_bytes(content)
    return path


@pytest.mark.parametrize("name", KINDS)
def test_good_files_are_read_as_they_are(name: str, tmp_path: Path) -> None:
    """No copy, no remark."""
    (tmp_path / "copy").mkdir()
    path = write(tmp_path, name, 0.0, [])
    assert without_lost_places(path, tmp_path / "copy") == (path, ())
    assert not list((tmp_path / "copy").iterdir())


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 3e38])
@pytest.mark.parametrize("lost", [[7], [0, 3, 7]])
@pytest.mark.parametrize("name", KINDS)
def test_they_are_counted(name: str, lost: list[int], value: float, tmp_path: Path) -> None:
    """The copy can be read, and the remark says how many there are; corners of .stl files are those of each face."""
    (tmp_path / "copy").mkdir()
    path = write(tmp_path, name, value, lost)
    assert check_source(path, ()) == ()
    copy, (remark,) = without_lost_places(path, tmp_path / "copy")
    assert copy == tmp_path / "copy" / name
    count = np.isin(TRIANGLES, lost).sum() if path.suffix == ".stl" else len(lost)
    which = {1: "1 vertex whose"}.get(int(count), f"{count} vertices whose")
    at = "it" if count == 1 else "them"
    assert remark == f"{name} has {which} coordinates are not finite numbers: the faces at {at} were left out."
    assert check_source(copy, ()) == ()


def test_the_copy_has_the_others_where_they_were(tmp_path: Path) -> None:
    """In binary copies all other corners are the same bytes."""
    (tmp_path / "copy").mkdir()
    expected = CORNERS.copy()
    expected[[2, 5]] = (LOST, 0, 0)
    copy, _ = without_lost_places(write(tmp_path, "a.glb", np.nan, [2, 5]), tmp_path / "copy")
    np.testing.assert_array_equal(np.frombuffer(read_gltf(copy)[1] or b"", "<f4", 24).reshape(8, 3), expected)
    copy, _ = without_lost_places(write(tmp_path, "big.ply", np.nan, [2, 5]), tmp_path / "copy")
    start = copy.read_bytes().index(b"end_header\n") + 11
    np.testing.assert_array_equal(np.frombuffer(copy.read_bytes(), ">f4", 24, start).reshape(8, 3), expected)
    copy, _ = without_lost_places(write(tmp_path, "a.stl", np.nan, [2, 5]), tmp_path / "copy")
    kept = ~np.isin(TRIANGLES, [2, 5]).any(axis=1)
    assert struct.unpack_from("<I", copy.read_bytes(), 80) == (kept.sum(),)


@pytest.mark.parametrize("word", ["1.#IND", "-1.#INF", "nan(ind)", "-nan", "1e999", "1e+38", "1" + 38 * "0"])
def test_words_for_no_number_in_text(word: str, tmp_path: Path) -> None:
    """What other programs write for such numbers counts; a comment, a colour or a small exponent does not."""
    (tmp_path / "copy").mkdir()
    good = b"v 1e-38 2.5e+07 3 0.5 0.5 0.5 # no nan\nv 0 0 1\nv 0 1 0\nvn nan 0 0\nf 1 2 3\n"
    path = tmp_path / "a.obj"
    path.write_bytes(good)
    assert without_lost_places(path, tmp_path / "copy") == (path, ())
    path.write_bytes(good + f"v 1 {word} 2\nf 1 2 4\n".encode())
    copy, remarks = without_lost_places(path, tmp_path / "copy")
    assert len(remarks) == 1
    assert f"v {LOST:.0e} 0 0\nf 1 2 4\n".encode() in copy.read_bytes()
    assert good in copy.read_bytes()


@pytest.mark.parametrize("line", ["mtllib a b.mtl", 'mtllib "a b.mtl"', ""])
def test_a_copy_finds_its_materials(line: str, tmp_path: Path) -> None:
    """Material libraries are named from where the copy lies, the one with the file's own name included."""
    (tmp_path / "copy").mkdir()
    path = tmp_path / "a b.obj"
    (tmp_path / "a b.mtl").write_text("newmtl red\nKd 1 0 0\n")
    path.write_text(f"{line}\nv nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 2 3 4\n")
    copy, _ = without_lost_places(path, tmp_path / "copy")
    assert check_source(copy, ()) == ()


def test_lost_points() -> None:
    """One coordinate suffices, and no number is no place."""
    points = np.array([(0, 0, 1e29), (0, np.nan, 0), (np.inf, 0, 0), (0, 0, -LOST)])
    assert is_lost(points).tolist() == [False, True, True, True]
