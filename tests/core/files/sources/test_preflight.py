"""What is checked of every file, whatever its kind."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.preflight import check_source, unchanged
from tests.core.files.sources.written import TRIANGLES, box_data, box_document, glb, obj, ply, refusal, stl

FACES = TRIANGLES.tolist()
WHOLE = {
    ".glb": glb(box_document(), box_data()),
    ".obj": obj(),
    ".ply": ply("binary_little_endian", FACES),
    ".stl": stl(),
    ".fbx": b"Kaydara FBX Binary  \0\x1a\0",
    ".blend": b"BLENDER-v405",
}


@pytest.mark.parametrize("kind", WHOLE)
def test_whole_file_passes(kind: str, tmp_path: Path) -> None:
    """A file in order gives no remark."""
    path = tmp_path / f"whole{kind}"
    path.write_bytes(WHOLE[kind])
    assert check_source(path, ()) == ()


@pytest.mark.parametrize("kind", WHOLE)
def test_empty_file(kind: str, tmp_path: Path) -> None:
    """A file without a byte is refused."""
    path = tmp_path / f"empty{kind}"
    path.touch()
    assert "is empty" in refusal(path)


@pytest.mark.parametrize("kind", WHOLE)
def test_other_content(kind: str, tmp_path: Path) -> None:
    """A file that is of another kind than its name says is refused."""
    path = tmp_path / f"other{kind}"
    path.write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(200))
    refusal(path)


@pytest.mark.parametrize("kind", [".glb", ".ply", ".stl"])
def test_cut_off_anywhere(kind: str, tmp_path: Path) -> None:
    """A file that ends early is refused wherever that is."""
    path = tmp_path / f"short{kind}"
    for length in range(1, len(WHOLE[kind]), 7):
        path.write_bytes(WHOLE[kind][:length])
        assert "incomplete" in refusal(path)


def test_no_file_folder_and_unknown_kind(tmp_path: Path) -> None:
    """Each is called what it is."""
    assert "no file" in refusal(tmp_path / "nothing.obj")
    (tmp_path / "folder.obj").mkdir()
    assert "is not a file" in refusal(tmp_path / "folder.obj")
    (tmp_path / "mesh.txt").write_text("v 0 0 0")
    assert ".blend, .fbx, .glb, .gltf, .obj, .ply, .stl" in refusal(tmp_path / "mesh.txt")


@pytest.mark.skipif(os.name != "posix", reason="pipes with a name")
def test_pipe(tmp_path: Path) -> None:
    """A pipe as the model would be waited for without end."""
    os.mkfifo(tmp_path / "pipe.obj")
    assert "is not a file" in refusal(tmp_path / "pipe.obj")


@pytest.mark.skipif(os.name != "posix", reason="names of bytes")
def test_name_that_is_no_text(tmp_path: Path) -> None:
    """Blender wants names in UTF-8."""
    name = os.fsdecode(os.fsencode(tmp_path) + b"/model\xff.obj")
    try:
        Path(name).write_bytes(WHOLE[".obj"])
    except OSError:
        pytest.skip("this disk takes no such name")
    assert "UTF-8" in refusal(Path(name))


def test_file_that_grows(tmp_path: Path) -> None:
    """A file that is written to while it is read is refused; one that is only looked at is not."""
    path = tmp_path / "box.obj"
    path.write_bytes(WHOLE[".obj"])
    with unchanged(path):
        path.read_bytes()
    with pytest.raises(MeshError, match="has changed while it was read"), unchanged(path):
        path.write_bytes(WHOLE[".obj"] * 2)
    with pytest.raises(MeshError, match="has changed while it was read"), unchanged(path):
        path.unlink()
