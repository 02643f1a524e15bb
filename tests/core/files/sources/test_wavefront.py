"""Wavefront OBJ: material files and textures that are missing, or no files."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import obj, refusal


def write(folder: Path, head: str, use: str, material: str | None = None, name: str = "paint.mtl") -> Path:
    """Write an .obj file, and a material file."""
    path = folder / "box.obj"
    path.write_bytes(obj(head=head, use=use))
    if material is not None:
        (folder / name).write_text(material)
    return path


def test_missing_material_file(tmp_path: Path) -> None:
    """One remark names the file, and the materials whose colours it holds."""
    path = write(tmp_path, "mtllib paint.mtl\nmtllib paint.mtl\n", "usemtl red\nusemtl blue")
    [remark] = check_source(path, ())
    assert "paint.mtl" in remark
    assert "blue, red" in remark


def test_material_file_of_bytes(tmp_path: Path) -> None:
    """A material file that holds no material tells as much."""
    path = write(tmp_path, "mtllib paint.mtl\n", "usemtl red")
    (tmp_path / "paint.mtl").write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0")
    [remark] = check_source(path, ())
    assert "red are in no material file" in remark


def test_materials_that_are_nowhere(tmp_path: Path) -> None:
    """Only those that no file defines are told, and no more than three by name."""
    use = "\n".join(f"usemtl m{number}" for number in range(6))
    path = write(tmp_path, 'mtllib "paint.mtl"\n', use, "newmtl m0\nnewmtl m1\n")
    [remark] = check_source(path, ())
    assert "m2, m3, m4 and others" in remark
    path = write(tmp_path, "", "usemtl red")
    [remark] = check_source(path, ())
    assert "names no material file" in remark


@pytest.mark.parametrize(
    ("head", "use", "name"),
    [
        ("mtllib paint.mtl\n", "usemtl red", "paint.mtl"),
        ("mtllib my paint.mtl\r\n", "usemtl red", "my paint.mtl"),
        # Blender takes the file with the name of the model, too
        ("mtllib other.mtl\n", "usemtl red", "box.mtl"),
        # nothing is lost with a file that nothing uses
        ("mtllib other.mtl\n", "", "paint.mtl"),
        ("", "", "paint.mtl"),
    ],
)
def test_nothing_lost_nothing_told(head: str, use: str, name: str, tmp_path: Path) -> None:
    """Material files that are there, however they are named."""
    assert check_source(write(tmp_path, head, use, "newmtl red\nKd 1 0 0\n", name), ()) == ()


@pytest.mark.skipif(os.name != "posix", reason="pipes with a name")
def test_textures_and_materials_that_are_no_files(tmp_path: Path) -> None:
    """Pipes and folders are refused wherever they are named."""
    path = write(tmp_path, "mtllib paint.mtl\n", "usemtl red", "newmtl red\n  map_Kd -s 1 1 1 paint.png\n")
    assert check_source(path, ()) == ()
    os.mkfifo(tmp_path / "paint.png")
    assert "'paint.png', which is not a file" in refusal(path)
    (tmp_path / "paint.mtl").unlink()
    (tmp_path / "paint.mtl").mkdir()
    assert "'paint.mtl', which is not a file" in refusal(path)


def test_other_encoding(tmp_path: Path) -> None:
    """Text in UTF-16 is no .obj file that Blender reads."""
    (tmp_path / "box.obj").write_bytes(obj().decode().encode("utf-16"))
    assert "not text in UTF-8" in refusal(tmp_path / "box.obj")
