"""What Blender's own exporters write is never refused, and what its importers cannot read is refused before them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import TRIANGLES, box_document, ply, write_glb

bpy = pytest.importorskip("bpy", reason="needs Blender as a Python module")

from legorize_addon.reading.gltf_importer import readable_extensions  # noqa: E402
from legorize_addon.reading.importers import importers, load  # noqa: E402
from legorize_addon.reading.objects import read_rendered  # noqa: E402
from tests.blender.builders import add_image, image_material  # noqa: E402


@pytest.fixture
def scene(tmp_path: Path) -> None:
    """Put into an empty file what exporters write in several ways: colours, shape keys, bones, polygons, a texture."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.mesh.primitive_cylinder_add(vertices=5)
    cylinder = bpy.context.object
    cylinder.data.color_attributes.new("Col", "BYTE_COLOR", "CORNER")
    image = add_image(np.full((4, 4, 3), 200, dtype=np.uint8))
    image.filepath_raw, image.file_format = str(tmp_path / "paint.png"), "PNG"
    image.save()
    cylinder.data.materials.append(image_material(image))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=6, location=(3, 0, 0))
    ball = bpy.context.object
    ball.shape_key_add(name="Basis")
    ball.shape_key_add(name="bent").data[0].co.z += 0.5
    bpy.ops.object.armature_add()
    bones = bpy.context.object
    ball.vertex_groups.new(name="Bone").add(range(8), 1.0, "REPLACE")
    ball.modifiers.new("bones", "ARMATURE").object = bones
    bones.keyframe_insert("location", frame=1)


def gltf(**options: object) -> Callable[[str], object]:
    """Return an exporter of glTF."""
    return lambda path: bpy.ops.export_scene.gltf(filepath=path, **options)


EXPORTS = {
    "plain.blend": lambda path: bpy.ops.wm.save_as_mainfile(filepath=path, copy=True),
    "packed.blend": lambda path: bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, compress=True),
    "plain.glb": gltf(export_format="GLB"),
    "sparse.glb": gltf(export_format="GLB", export_try_sparse_sk=True, export_try_omit_sparse_sk=True),
    "webp.glb": gltf(export_format="GLB", export_image_format="WEBP"),
    "draco.glb": gltf(export_format="GLB", export_draco_mesh_compression_enable=True),
    "separate.gltf": gltf(export_format="GLTF_SEPARATE"),
    "plain.obj": lambda path: bpy.ops.wm.obj_export(filepath=path, path_mode="COPY"),
    "colours.obj": lambda path: bpy.ops.wm.obj_export(filepath=path, export_colors=True, export_materials=False),
    "plain.ply": lambda path: bpy.ops.wm.ply_export(filepath=path),
    "text.ply": lambda path: bpy.ops.wm.ply_export(filepath=path, ascii_format=True, export_normals=True),
    "plain.stl": lambda path: bpy.ops.wm.stl_export(filepath=path),
    "text.stl": lambda path: bpy.ops.wm.stl_export(filepath=path, ascii_format=True),
    "plain.fbx": lambda path: bpy.ops.export_scene.fbx(filepath=path, embed_textures=True, path_mode="COPY"),
}


@pytest.mark.parametrize("name", EXPORTS)
@pytest.mark.usefixtures("scene")
def test_exports_pass(name: str, tmp_path: Path) -> None:
    """Each kind and each way of writing it, without a remark."""
    EXPORTS[name](str(tmp_path / name))
    # whether or not this Blender has the library that packs and unpacks
    assert check_source(tmp_path / name, {*readable_extensions(), "KHR_draco_mesh_compression"}) == ()


@pytest.mark.parametrize("kind", ["glb", "obj", "ply", "stl", "stl_ascii"])
def test_exports_of_another_library_pass(kind: str, tmp_path: Path) -> None:
    """Files as trimesh writes them."""
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere(subdivisions=1)
    mesh.visual.vertex_colors = np.random.default_rng(0).integers(0, 255, (len(mesh.vertices), 4)).astype(np.uint8)
    path = tmp_path / f"ball.{kind.removesuffix('_ascii')}"
    mesh.export(path, file_type=kind)
    assert check_source(path, readable_extensions()) == ()


def test_every_kind_has_its_check(tmp_path: Path) -> None:
    """The kinds that are checked are those that can be imported."""
    with pytest.raises(MeshError) as caught:
        check_source(Path(__file__), ())
    models = str(caught.value).split("use one of ")[1].split(", or for a mosaic ")[0]
    assert set(models.split(", ")) == set(importers())


def test_extensions_are_those_of_the_importer() -> None:
    """Some are known to all versions, textures of the KTX kind to none."""
    assert {"KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"} <= readable_extensions()
    assert "KHR_texture_basisu" not in readable_extensions()


def test_lying_count_never_reaches_blender(tmp_path: Path) -> None:
    """It would end the program that runs this test."""
    path = tmp_path / "box.ply"
    path.write_bytes(ply("ascii", TRIANGLES.tolist()).replace(b"element vertex 8", b"element vertex 4000000000"))
    with pytest.raises(MeshError, match="incomplete or damaged"):
        load(path)


def test_incomplete_triangle_never_reaches_blender(tmp_path: Path) -> None:
    """As above, for Blender 4.5."""
    document = box_document()
    document["accessors"][1]["count"] = 1
    with pytest.raises(MeshError, match="not make whole faces"):
        load(write_glb(tmp_path / "box.glb", document))


def test_remark_of_a_loss(tmp_path: Path) -> None:
    """What the look at the file has found stands with what the import has."""
    path = tmp_path / "box.ply"
    path.write_bytes(ply("ascii", TRIANGLES.tolist(), ["comment TextureFile paint.png"]))
    loaded = load(path)
    assert len(loaded.objects) == 1
    [remark] = loaded.remarks
    assert "paint.png" in remark


def test_textures_that_cannot_be_read_are_told_once(tmp_path: Path) -> None:
    """One remark names the extension; the colour beside the texture is taken without another one."""
    document = box_document()
    document["meshes"][0]["primitives"][0]["material"] = 0
    document["materials"] = [
        {"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1], "baseColorTexture": {"index": 0}}}
    ]
    document["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
    document["images"] = [{"mimeType": "image/ktx2", "uri": "a.ktx2"}]
    document["extensionsUsed"] = ["KHR_texture_basisu"]
    document["accessors"].append({"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC2"})
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2
    (tmp_path / "a.ktx2").write_bytes(b"\xabKTX 20\xbb\r\n\x1a\n")
    objects, remarks, _ = load(write_glb(tmp_path / "box.glb", document))
    mesh, more = read_rendered(objects, bpy.context)
    [remark] = [*remarks, *more]
    assert "KHR_texture_basisu" in remark
    colours = {tuple(colour) for row in set(mesh.face_image.tolist()) for colour in mesh.images[row].reshape(-1, 3)}
    assert colours == {(255, 0, 0)}


def test_nodes_nested_very_deep_are_a_sentence(tmp_path: Path) -> None:
    """Three thousand nodes, one below the other, are more than the importer can follow: that is said, and the cure."""
    document = box_document()
    document["nodes"] = [*({"children": [number + 1]} for number in range(3000)), {"mesh": 0}]
    with pytest.raises(MeshError, match="nested deeper than Blender can read: flatten"):
        load(write_glb(tmp_path / "deep.glb", document))
