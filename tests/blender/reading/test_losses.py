"""What Blender passes over when it opens a file is told, once and by name."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from legorize_addon.core.errors import MeshError
from tests.core.files.sources.written import box_document, obj, write_glb

bpy = pytest.importorskip("bpy", reason="needs Blender as a Python module")

from legorize_addon.reading import losses  # noqa: E402
from legorize_addon.reading.importers import load  # noqa: E402


def new_scene() -> None:
    """Begin with nothing."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def save(path: Path) -> Path:
    """Save the scene."""
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path


def linked(folder: Path, *, own: bool) -> Path:
    """Save a scene with cubes linked from another file, and perhaps a ball of its own."""
    new_scene()
    for number in range(7):
        bpy.ops.mesh.primitive_cube_add(location=(3 * number, 0, 0))
        bpy.context.object.name = f"part {number}"
    parts = save(folder / "parts.blend")
    new_scene()
    with bpy.data.libraries.load(str(parts), link=True) as (there, taken):
        taken.objects = there.objects
    for cube in taken.objects:
        bpy.context.collection.objects.link(cube)
    if own:
        bpy.ops.mesh.primitive_ico_sphere_add()
    return save(folder / "scene.blend")


def test_linked_file_that_is_there(tmp_path: Path) -> None:
    """Nothing is lost, nothing is told."""
    assert load(linked(tmp_path, own=True)).remarks == ()


def test_linked_file_that_is_missing(tmp_path: Path) -> None:
    """One remark names the file and what was in it; what is left is taken."""
    scene = linked(tmp_path, own=True)
    (tmp_path / "parts.blend").unlink()
    loaded = load(scene)
    [remark] = loaded.remarks
    assert "parts.blend that scene.blend links to is missing" in remark
    assert "part 0, part 1, part 2, part 3, part 4 and others" in remark
    assert [obj.name for obj in loaded.objects if obj.type == "MESH"] == ["Icosphere"]


def test_linked_objects_that_are_gone(tmp_path: Path) -> None:
    """The file may be there without what was taken from it."""
    scene = linked(tmp_path, own=True)
    new_scene()
    save(tmp_path / "parts.blend")
    [remark] = load(scene).remarks
    assert "no longer holds part 0" in remark


def test_nothing_but_linked_objects(tmp_path: Path) -> None:
    """Where nothing is left, the error is not that nothing was there."""
    scene = linked(tmp_path, own=False)
    (tmp_path / "parts.blend").unlink()
    with pytest.raises(MeshError, match="links to is missing"):
        load(scene)


def test_file_of_a_newer_blender(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Blender opens it as far as it can."""

    class OlderBlender:
        data = bpy.data
        path = bpy.path

        class app:  # noqa: N801 - as in bpy
            version = (4, 1, 0)

    new_scene()
    bpy.ops.mesh.primitive_cube_add()
    scene = save(tmp_path / "scene.blend")
    assert load(scene).remarks == ()
    monkeypatch.setattr(losses, "bpy", OlderBlender)
    [remark] = load(scene).remarks
    assert f"saved by Blender {bpy.app.version[0]}.{bpy.app.version[1]}, which is newer" in remark


@pytest.mark.parametrize(("rows", "words"), [(1, "1 face that names"), (3, "3 faces that name")])
def test_faces_without_vertices(rows: int, words: str, tmp_path: Path) -> None:
    """Faces of an .obj file that name what is not there are counted."""
    path = tmp_path / "box.obj"
    path.write_bytes(obj() + b"f 1 2 99\n" * rows)
    [remark] = load(path).remarks
    assert "box.obj" in remark
    assert words in remark


@pytest.mark.skipif(os.name != "posix", reason="pipes with a name")
def test_image_that_is_a_pipe(tmp_path: Path) -> None:
    """It is refused before its pixels are asked for."""
    new_scene()
    bpy.ops.mesh.primitive_cube_add()
    image = bpy.data.images.new("paint", 4, 4)
    image.filepath_raw, image.file_format = str(tmp_path / "paint.png"), "PNG"
    image.save()
    image.source = "FILE"
    image.use_fake_user = True
    scene = save(tmp_path / "scene.blend")
    assert load(scene).remarks == ()
    (tmp_path / "paint.png").unlink()
    os.mkfifo(tmp_path / "paint.png")
    with pytest.raises(MeshError, match=r"paint\.png', which is not a file"):
        load(scene)


def test_failure_of_an_importer_is_a_sentence(tmp_path: Path) -> None:
    """Neither the importer's traceback nor places on this disk are in it."""
    document = box_document()
    document["materials"] = [{"emissiveFactor": [1]}]
    document["meshes"][0]["primitives"][0]["material"] = 0
    with pytest.raises(MeshError) as caught:
        load(write_glb(tmp_path / "box.glb", document))
    assert "Traceback" not in str(caught.value)
    assert "(the importer has failed with " in str(caught.value)
    (tmp_path / "scene.blend").write_bytes(b"BLENDER-v405" + bytes(300))
    with pytest.raises(MeshError) as caught:
        load(tmp_path / "scene.blend")
    assert str(tmp_path) not in str(caught.value)
