"""Reading objects: geometry, colours, and the sentences for what cannot be read."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from legorize_addon.core.colours.difference import linear_from_srgb, srgb_from_linear
from legorize_addon.core.errors import MeshError
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.reading import images as read_images
from tests.blender.builders import (
    QUAD_UVS,
    TEXELS,
    Nodes,
    add_image,
    add_object,
    add_quad,
    colours_at,
    image_material,
    multiplied,
    read,
    read_with_remarks,
    texel_centres,
)


def volume(mesh: TriangleMesh) -> float:
    """Return the signed volume in cubic Blender units."""
    corners = mesh.vertices[mesh.faces] / 1000
    return float(np.linalg.det(corners).sum() / 6)


def cube(size: float = 2.0) -> bpy.types.Object:
    """Add a cube."""
    bpy.ops.mesh.primitive_cube_add(size=size)
    return bpy.context.object


def test_cube_is_read_in_mm_and_outward() -> None:
    """A cube of 2 units becomes 12 triangles of a box of 2 m whose volume is positive."""
    mesh = read(cube())
    assert len(mesh.faces) == 12
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), 2000)
    assert volume(mesh) == pytest.approx(8)


def test_unit_scale_of_the_scene_counts() -> None:
    """A scene in centimetres makes a unit 10 mm."""
    bpy.context.scene.unit_settings.scale_length = 0.01
    np.testing.assert_allclose(np.ptp(read(cube()).vertices, axis=0), 20, rtol=1e-6)


@pytest.mark.parametrize(
    "matrix",
    [
        Matrix.Scale(-1, 4, (1, 0, 0)),
        Matrix.Diagonal((2, -1, -3, 1)),
        Matrix.Shear("XY", 4, (0.7, 0.2)),
        Matrix.Translation((5, 6, 7)) @ Matrix.Rotation(1, 4, (1, 2, 3)) @ Matrix.Diagonal((-1, -1, -1, 1)),
    ],
)
def test_transforms_keep_the_triangles_outward(matrix: Matrix) -> None:
    """Under mirroring, shear and rotation the signed volume is the cube's times |determinant|."""
    obj = cube()
    # an object by itself cannot be sheared, a child can
    obj.parent, obj.matrix_parent_inverse = add_object(None, "parent"), matrix
    mesh = read(obj)
    assert volume(mesh) == pytest.approx(8 * abs(matrix.determinant()), rel=1e-5)


def test_mirrored_texture_is_mirrored_with_the_surface() -> None:
    """An object scaled by -1 along x shows its image reversed along x."""
    obj = add_quad(image_material(add_image()))
    obj.matrix_world = Matrix.Diagonal((-1, 1, 1, 1))
    points = texel_centres() * (-1, 1)
    np.testing.assert_array_equal(colours_at(read(obj), points), TEXELS.reshape(-1, 3))


def test_parents_and_modifiers_count() -> None:
    """A subdivided cube under a scaled and moved parent is read as it is seen, and stays as it was."""
    parent, child = add_object(None, "parent"), cube()
    parent.matrix_world = Matrix.Translation((10, 0, 0)) @ Matrix.Diagonal((3, 3, 3, 1))
    child.parent = parent
    child.modifiers.new("divide", "SUBSURF").subdivision_type = "SIMPLE"
    bpy.context.view_layer.update()
    mesh = read(child)
    assert len(mesh.faces) == 12 * 4
    np.testing.assert_allclose(mesh.vertices.mean(axis=0), (10_000, 0, 0), atol=1e-3)
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), 6000, rtol=1e-6)
    assert len(child.data.polygons) == 6


def test_concave_polygon_keeps_its_area() -> None:
    """An L of six corners in one face becomes four triangles that cover it exactly."""
    mesh = bpy.data.meshes.new("L")
    mesh.from_pydata([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)], [], [range(6)])
    found = read(add_object(mesh))
    edges = np.diff(found.vertices[found.faces][..., :2] / 1000, axis=1)
    areas = edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0]
    assert (areas > 0).all()
    assert areas.sum() / 2 == pytest.approx(3)


def test_several_objects_come_together() -> None:
    """Two objects are one mesh; a light among them is left out."""
    first, second = cube(), cube()
    second.location.x = 5
    bpy.ops.object.light_add()
    mesh = read(first, bpy.context.object, second)
    assert len(mesh.faces) == 24
    assert np.ptp(mesh.vertices[:, 0]) == pytest.approx(7000)


@pytest.mark.parametrize("kind", ["FONT", "SURFACE", "META", "CURVE"])
def test_other_shapes_are_read_as_meshes(kind: str) -> None:
    """Texts, surfaces, metaballs and curves with a bevel give faces."""
    if kind == "FONT":
        bpy.ops.object.text_add()
    elif kind == "SURFACE":
        bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    elif kind == "META":
        bpy.ops.object.metaball_add()
    else:
        bpy.ops.curve.primitive_bezier_circle_add()
        bpy.context.object.data.bevel_depth = 0.1
    obj = bpy.context.object
    mesh = read(obj)
    direct = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    direct.calc_loop_triangles()
    assert len(mesh.faces) == len(direct.loop_triangles) > 10


def test_collection_instances_are_read() -> None:
    """An empty that instances a collection gives the meshes in it at its own place."""
    collection = bpy.data.collections.new("inside")
    obj = cube()
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    empty = add_object(None, "empty")
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    empty.location = (0, 0, 4)
    mesh = read(empty)
    assert len(mesh.faces) == 12
    np.testing.assert_allclose(mesh.vertices.mean(axis=0), (0, 0, 4000), atol=1e-3)


def test_geometry_nodes_instances_are_read() -> None:
    """What geometry nodes instance is read with the material that they set, beside the object's own."""
    nodes = Nodes()
    nodes.shader.inputs["Base Color"].default_value = (1.0, 0.0, 0.0, 1.0)
    tree = bpy.data.node_groups.new("scatter", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "GeometryNodeMeshCube", "GeometryNodeSetMaterial", "GeometryNodeInstanceOnPoints")
    start, box, painted, instances = (tree.nodes.new(kind) for kind in kinds)
    joined, end = tree.nodes.new("GeometryNodeJoinGeometry"), tree.nodes.new("NodeGroupOutput")
    painted.inputs["Material"].default_value = nodes.material
    tree.links.new(box.outputs[0], painted.inputs[0])
    tree.links.new(painted.outputs[0], instances.inputs["Instance"])
    tree.links.new(start.outputs[0], instances.inputs["Points"])
    for output in (instances.outputs[0], start.outputs[0]):
        tree.links.new(output, joined.inputs[0])
    tree.links.new(joined.outputs[0], end.inputs[0])
    obj = add_quad(uvs=None)
    obj.modifiers.new("scatter", "NODES").node_group = tree
    mesh = read(obj)
    assert len(mesh.faces) == 2 + 4 * 12
    red = [image.tolist() == [[[255, 0, 0]]] for image in mesh.images]
    assert np.isin(mesh.face_image, np.flatnonzero(red)).sum() == 4 * 12


def test_image_lies_as_in_blender() -> None:
    """Each texel is found at its place: u to the right, v up, bytes as stored."""
    mesh = read(add_quad(image_material(add_image())))
    np.testing.assert_array_equal(mesh.images[0], TEXELS)
    np.testing.assert_array_equal(colours_at(mesh, texel_centres()), TEXELS.reshape(-1, 3))


@pytest.mark.parametrize("named", [True, False])
def test_the_uv_map_of_the_image_node_counts(named: bool) -> None:
    """The map that the UV Map node names is used, else the one that is active for render."""
    nodes = Nodes()
    texture, uv_map = nodes.add("TexImage", image=add_image()), nodes.add("UVMap", uv_map="second")
    if named:
        nodes.link(uv_map.outputs["UV"], texture.inputs["Vector"])
    obj = add_quad(nodes.colour(texture.outputs["Color"]))
    turned = np.array(QUAD_UVS[1:] + QUAD_UVS[:1], dtype=np.float32)
    obj.data.uv_layers.new(name="second").uv.foreach_set("vector", turned.ravel())
    mesh = read(obj)
    expected = turned if named else np.array(QUAD_UVS)
    np.testing.assert_allclose(mesh.uvs[0], expected[mesh.faces[0]])


@pytest.mark.parametrize(("wrap", "clamp"), [("REPEAT", False), ("EXTEND", True), ("CLIP", True), ("MIRROR", False)])
def test_wrap_modes(wrap: str, clamp: bool) -> None:
    """Outside the image it repeats, ends in its edge texels, or is mirrored, on all sides."""
    span = np.array([(-1, -1), (3, -1), (3, 3), (-1, 3)])
    mesh = read(add_quad(image_material(add_image(), extension=wrap), uvs=span.tolist()))
    width, height = TEXELS.shape[1], TEXELS.shape[0]
    column, row = np.arange(-width, 3 * width), np.arange(-height, 3 * height)
    if wrap == "MIRROR":
        column, row = (np.where(i % (2 * n) < n, i % n, n - 1 - i % n) for i, n in ((column, width), (row, height)))
    elif clamp:
        column, row = np.clip(column, 0, width - 1), np.clip(row, 0, height - 1)
    expected = TEXELS[np.ix_(row % height, column % width)]
    np.testing.assert_array_equal(colours_at(mesh, texel_centres(expected)), expected.reshape(-1, 3))
    assert mesh.image_clamp.tolist() == [clamp]


@pytest.mark.parametrize("kind", ["POINT", "TEXTURE", "VECTOR"])
def test_mapping_node(kind: str) -> None:
    """Location, rotation and scale of a Mapping node move the image coordinates by Blender's rules."""
    nodes = Nodes()
    coordinates, mapping = nodes.add("TexCoord"), nodes.add("Mapping")
    texture = nodes.add("TexImage", image=add_image())
    place, angle, scale = np.array((0.25, -0.5)), 0.6, np.array((2.0, 0.5))
    mapping.inputs["Location"].default_value[:2] = place
    mapping.inputs["Rotation"].default_value[2] = angle
    mapping.inputs["Scale"].default_value[:2] = scale
    mapping.vector_type = kind
    nodes.link(coordinates.outputs["UV"], mapping.inputs["Vector"])
    nodes.link(mapping.outputs["Vector"], texture.inputs["Vector"])
    mesh = read(add_quad(nodes.colour(texture.outputs["Color"])))
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    uv = np.array(QUAD_UVS, dtype=float)
    expected = {
        "POINT": (uv * scale) @ turn.T + place,
        "TEXTURE": ((uv - place) @ turn) / scale,
        "VECTOR": (uv * scale) @ turn.T,
    }[kind]
    np.testing.assert_allclose(mesh.uvs[0], expected[mesh.faces[0]], atol=1e-6)


def test_factor_multiplies_in_linear_light() -> None:
    """Image times colour is the product of their linear values, as glTF's base colour factor asks."""
    nodes, factor = Nodes(), (0.5, 0.25, 1.0)
    texture = nodes.add("TexImage", image=add_image())
    mesh = read(add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], (*factor, 1.0)))))
    np.testing.assert_array_equal(mesh.images[0], srgb_from_linear(linear_from_srgb(TEXELS) * np.float32(factor)))


def test_half_a_factor_is_half_way_to_one() -> None:
    """Multiplying with factor 0.5 is the mean of the plain and the multiplied colour, in linear light."""
    nodes = Nodes()
    texture = nodes.add("TexImage", image=add_image())
    mesh = read(add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], (0.0, 0.5, 1.0, 1.0), 0.5))))
    np.testing.assert_array_equal(mesh.images[0], srgb_from_linear(linear_from_srgb(TEXELS) * (0.5, 0.75, 1.0)))


def test_plain_colour_is_encoded() -> None:
    """Blender's linear base colour becomes sRGB bytes: 0.2140411 is the middle byte 127.5."""
    nodes = Nodes()
    nodes.shader.inputs["Base Color"].default_value = (1.0, 0.2140411, 0.0, 1.0)
    mesh = read(add_quad(nodes.material, uvs=None))
    assert mesh.images[0].shape == (1, 1, 3)
    np.testing.assert_allclose(mesh.images[0][0, 0], (255, 127.5, 0), atol=0.5)


def test_image_is_followed_through_groups_reroutes_and_shaders() -> None:
    """An image inside a group, behind a reroute, in a shader that is mixed with a transparent one is found."""
    group = bpy.data.node_groups.new("inside", "ShaderNodeTree")
    group.interface.new_socket("Picture", in_out="OUTPUT", socket_type="NodeSocketColor")
    group.interface.new_socket("Tint", in_out="INPUT", socket_type="NodeSocketColor")
    texture, reroute = group.nodes.new("ShaderNodeTexImage"), group.nodes.new("NodeReroute")
    texture.image = add_image()
    mix = group.nodes.new("ShaderNodeMixRGB")
    mix.blend_type, mix.inputs["Fac"].default_value = "MULTIPLY", 1.0
    inside, outside = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(texture.outputs["Color"], reroute.inputs[0])
    group.links.new(reroute.outputs[0], mix.inputs["Color1"])
    group.links.new(inside.outputs["Tint"], mix.inputs["Color2"])
    group.links.new(mix.outputs[0], outside.inputs["Picture"])
    nodes = Nodes()
    node, tint = nodes.add("Group", node_tree=group), nodes.add("RGB")
    tint.outputs[0].default_value = (1.0, 0.5, 0.25, 1.0)
    nodes.link(tint.outputs[0], node.inputs["Tint"])
    diffuse, clear, shaders = nodes.add("BsdfDiffuse"), nodes.add("BsdfTransparent"), nodes.add("MixShader")
    nodes.link(node.outputs["Picture"], diffuse.inputs["Color"])
    nodes.link(clear.outputs[0], shaders.inputs[1])
    nodes.link(diffuse.outputs[0], shaders.inputs[2])
    nodes.link(shaders.outputs[0], nodes.output.inputs["Surface"])
    mesh = read(add_quad(nodes.material))
    np.testing.assert_array_equal(mesh.images[0], srgb_from_linear(linear_from_srgb(TEXELS) * (1.0, 0.5, 0.25)))


def test_the_image_of_the_base_colour_counts() -> None:
    """Of several images the one that feeds the base colour is taken, not that of the roughness."""
    nodes = Nodes()
    other = nodes.add("TexImage", image=add_image(TEXELS[::-1].copy()))
    nodes.link(other.outputs["Color"], nodes.shader.inputs["Roughness"])
    mesh = read(add_quad(nodes.colour(nodes.add("TexImage", image=add_image()).outputs["Color"])))
    assert len(mesh.images) == 1
    np.testing.assert_array_equal(mesh.images[0], TEXELS)


def test_linear_images_are_encoded() -> None:
    """Values of a Non-Color byte image and of a float image are linear; float values are cut to [0, 1]."""
    values = np.array([[(0.5, 0.2158605, 7.0), (0.0, -1.0, np.nan)]])
    meshes = [read(add_quad(image_material(image))) for image in (add_image(data=True), add_image(values))]
    np.testing.assert_array_equal(meshes[0].images[0], srgb_from_linear(TEXELS / 255))
    np.testing.assert_array_equal(meshes[1].images[0], [[(188, 128, 255), (0, 0, 0)]])


def test_alpha_counts_only_where_it_is_linked() -> None:
    """The alpha of an image goes with its texels if it is linked, else all of the surface is seen."""
    alpha = np.array([[1.0, 1.0, 0.0], [0.4, 0.6, 1.0]])
    image, nodes = add_image(alpha=alpha), Nodes()
    texture = nodes.add("TexImage", image=image)
    nodes.link(texture.outputs["Alpha"], nodes.shader.inputs["Alpha"])
    cut, whole = read(add_quad(nodes.colour(texture.outputs["Color"]))), read(add_quad(image_material(image)))
    assert whole.opacities == ()
    for mesh in (cut, whole):
        np.testing.assert_array_equal(mesh.images[0], TEXELS)
    np.testing.assert_array_equal(cut.opacities[0], np.rint(alpha * 255))


def test_udim_tiles_are_images_of_their_own(tmp_path: Path) -> None:
    """Faces take the tile that their image coordinates lie in."""
    for number, texels in ((1001, TEXELS), (1012, TEXELS[::-1].copy())):
        image = add_image(texels)
        image.filepath_raw, image.file_format = str(tmp_path / f"tile.{number}.png"), "PNG"
        image.save()
    tiled = bpy.data.images.load(str(tmp_path / "tile.1001.png"))
    tiled.source, tiled.filepath = "TILED", str(tmp_path / "tile.<UDIM>.png")
    tiled.tiles.new(1012)
    material, before = image_material(tiled), len(bpy.data.images)
    first = add_quad(material)
    second = add_quad(material, uvs=np.add(QUAD_UVS, 1).tolist())
    np.testing.assert_array_equal(colours_at(read(first), texel_centres()), TEXELS.reshape(-1, 3))
    np.testing.assert_array_equal(colours_at(read(second), texel_centres()), TEXELS[::-1].reshape(-1, 3))
    assert len(bpy.data.images) == before


def test_huge_images_in_memory_are_halved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of an image with too many texels, in memory alone, every second one is taken; it keeps its size; that is told."""
    monkeypatch.setattr(read_images, "LARGEST_SIDE", 4)
    texels = np.repeat(np.repeat(TEXELS[:, :2], 4, axis=0), 4, axis=1)
    image = add_image(texels)
    mesh, remarks = read_with_remarks(add_quad(image_material(image)))
    np.testing.assert_array_equal(mesh.images[0], texels[::2, ::2])
    assert "1/2 of its size" in remarks[0]
    assert tuple(image.size) == (8, 8)
    assert len(bpy.data.images) == 1


def test_huge_image_files_are_halved_before_they_become_numbers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Blender reduces a copy of a large file, so that its texels are never numbers all at once; no copy stays."""
    monkeypatch.setattr(read_images, "LARGEST_SIDE", 4)
    texels = np.repeat(np.repeat(TEXELS[:, :2], 8, axis=0), 8, axis=1)
    written = add_image(texels)
    written.filepath_raw, written.file_format = str(tmp_path / "large.png"), "PNG"
    written.save()
    bpy.data.images.remove(written)
    image = bpy.data.images.load(str(tmp_path / "large.png"))
    sizes = []
    decoded = read_images._decoded
    monkeypatch.setattr(read_images, "_decoded", lambda each: (sizes.append(tuple(each.size)), decoded(each))[1])
    mesh, remarks = read_with_remarks(add_quad(image_material(image)))
    assert sizes == [(4, 4)]
    np.testing.assert_array_equal(mesh.images[0], texels[::4, ::4])
    assert "1/4 of its size" in remarks[0]
    assert tuple(image.size) == (16, 16)
    assert len(bpy.data.images) == 1


def test_images_beyond_the_memory_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """What does not fit in memory gives a sentence with the image and its size."""

    def full(*_: object) -> None:
        raise MemoryError

    monkeypatch.setattr(read_images, "_decoded", full)
    with pytest.raises(MeshError, match=r"'image' of 3 x 2 texels does not fit"):
        read(add_quad(image_material(add_image())))


def test_image_coordinates_that_are_no_numbers_are_told() -> None:
    """Faces with infinite coordinates take the average of the image, the others their texels; one sentence says it."""
    obj = add_quad(image_material(add_image()), uvs=[(0, 0), (1, 0), (1, 1), (0, np.inf)])
    mesh, remarks = read_with_remarks(obj)
    assert np.isfinite(mesh.uvs).all()
    shapes = sorted(mesh.images[row].shape for row in mesh.face_image)
    assert shapes == [(1, 1, 3), (2, 3, 3)]
    assert len(remarks) == 1
    assert remarks[0].startswith("1 triangle has image coordinates on 'image' that are not finite")


def lost_image(tmp_path: Path) -> bpy.types.Image:
    """Return an image whose file is not there."""
    image = bpy.data.images.new("lost", 4, 4)
    image.source, image.filepath = "FILE", str(tmp_path / "lost.png")
    return image


@pytest.mark.parametrize("missing", [True, False])
def test_missing_images_are_told_and_the_plain_colour_taken(tmp_path: Path, missing: bool) -> None:
    """An image that is not there costs its colour alone; the sentence names the material, and the file."""
    material = image_material(lost_image(tmp_path) if missing else None)
    material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.5, 0.1, 0.0, 1.0)
    mesh, remarks = read_with_remarks(add_quad(material))
    assert mesh.images[0].tolist() == [[srgb_from_linear(np.array([0.5, 0.1, 0.0])).tolist()]]
    [remark] = remarks
    assert "'paint'" in remark
    assert ("lost.png" if missing else "without an image") in remark


def test_a_missing_image_keeps_its_factor_and_hides_nothing(tmp_path: Path) -> None:
    """Where the image was multiplied by a colour that colour stays; where it decided what is seen, all is seen."""
    nodes = Nodes()
    texture = nodes.add("TexImage", image=lost_image(tmp_path))
    nodes.link(texture.outputs["Alpha"], nodes.shader.inputs["Alpha"])
    mesh, remarks = read_with_remarks(
        add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], (0.5, 0.75, 1.0, 1.0))))
    )
    assert mesh.images[0].tolist() == [[srgb_from_linear(np.array([0.5, 0.75, 1.0])).tolist()]]
    assert mesh.opacities == ()
    assert len(remarks) == 1


def test_painted_colours_that_a_material_hides_are_told() -> None:
    """A plain material over painted colours is taken as it is, with a remark; over one colour there is none."""
    obj = add_quad(Nodes().material)
    add_colours(obj, np.eye(4)[:, :3], "CORNER", "FLOAT_COLOR")
    _, remarks = read_with_remarks(obj)
    assert [remark for remark in remarks if "painted colours" in remark and "'paint'" in remark]
    even = add_quad(Nodes().material)
    add_colours(even, np.array([0.5, 1.0, 0.25]), "CORNER", "FLOAT_COLOR")
    read(even)


def test_black_attributes_are_told() -> None:
    """An attribute that is black all over makes its material black, and that is told."""
    nodes = Nodes()
    texture, attribute = nodes.add("TexImage", image=add_image()), nodes.add("VertexColor")
    obj = add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], attribute.outputs["Color"])))
    add_colours(obj, np.zeros(3), "CORNER", "FLOAT_COLOR")
    mesh, remarks = read_with_remarks(obj)
    assert not mesh.images[0].any()
    assert "black all over" in remarks[0]


def test_several_materials_and_empty_slots() -> None:
    """Every face takes its own slot's colour; an empty slot is grey; images that no face uses are not read."""
    mesh = bpy.data.meshes.new("two")
    mesh.from_pydata([(x, y, 0) for x in range(4) for y in range(2)], [], [(0, 2, 3, 1), (2, 4, 5, 3), (4, 6, 7, 5)])
    nodes = Nodes()
    nodes.shader.inputs["Base Color"].default_value = (1.0, 0.0, 0.0, 1.0)
    mesh.uv_layers.new(name="map")
    for material in (nodes.material, image_material(add_image()), None, image_material(None)):
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", [0, 1, 2])
    found = read(add_object(mesh))
    assert [image.shape for image in found.images] == [(1, 1, 3), TEXELS.shape, (1, 1, 3)]
    assert found.face_image.tolist() == [0, 0, 1, 1, 2, 2]
    assert found.images[0].tolist() == [[[255, 0, 0]]]
    assert np.ptp(found.images[2]) == 0


def add_colours(obj: bpy.types.Object, colours: np.ndarray, domain: str, kind: str) -> None:
    """Add a colour attribute of linear colours, active for render."""
    attribute = obj.data.color_attributes.new("paint", kind, domain)
    rgba = np.ones((len(attribute.data), 4), dtype=np.float32)
    rgba[:, :3] = colours
    attribute.data.foreach_set("color", rgba.ravel())


@pytest.mark.parametrize("kind", ["BYTE_COLOR", "FLOAT_COLOR"])
@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
@pytest.mark.parametrize("how", ["node", "attribute", "no material"])
def test_colour_attributes(domain: str, kind: str, how: str) -> None:
    """Colours of corners are met exactly at the corners and interpolated in linear light between them."""
    nodes, material = Nodes(), None
    if how == "node":
        material = nodes.colour(nodes.add("VertexColor").outputs["Color"])
    elif how == "attribute":
        material = nodes.colour(nodes.add("Attribute", attribute_name="paint").outputs["Color"])
    obj = add_quad(material, uvs=None)
    corners = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (0.0, 1.0, 0.0)])
    add_colours(obj, corners, domain, kind)
    mesh = read(obj)
    square = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=float)
    np.testing.assert_array_equal(colours_at(mesh, square), corners * 255)
    points = np.random.default_rng(1).random((200, 2))
    found = linear_from_srgb(colours_at(mesh, points).astype(np.uint8))
    np.testing.assert_allclose(found, np.column_stack([points, np.zeros(200)]), atol=0.6 / 63 + 0.005)


def test_equal_corners_share_a_texel() -> None:
    """Faces of one colour each take one texel a colour, whatever their number."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=20, y_subdivisions=20)
    obj = bpy.context.object
    faces = np.arange(len(obj.data.polygons)) % 3
    add_colours(obj, np.eye(3)[np.repeat(faces, 4)], "CORNER", "FLOAT_COLOR")
    mesh = read(obj)
    assert [image.shape for image in mesh.images] == [(2, 2, 3)]
    centres = mesh.uvs.mean(axis=1) * 2
    texels = mesh.images[0][centres[:, 1].astype(int), centres[:, 0].astype(int)]
    np.testing.assert_array_equal(texels, 255 * np.eye(3)[np.repeat(faces, 2)])


def test_one_coloured_attribute_multiplies_an_image() -> None:
    """The all-white or one-coloured attribute that exporters like to add is a factor of the image."""
    nodes = Nodes()
    texture, attribute = nodes.add("TexImage", image=add_image()), nodes.add("VertexColor")
    obj = add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], attribute.outputs["Color"])))
    add_colours(obj, np.array([0.5, 1.0, 0.25]), "CORNER", "FLOAT_COLOR")
    mesh = read(obj)
    np.testing.assert_array_equal(mesh.images[0], srgb_from_linear(linear_from_srgb(TEXELS) * (0.5, 1.0, 0.25)))


def test_missing_layers_are_remarked() -> None:
    """Without a UV map the image's average is taken; a missing attribute is white; both are said."""
    nodes = Nodes()
    material = nodes.colour(nodes.add("VertexColor", layer_name="lost").outputs["Color"])
    average, remark = read_with_remarks(add_quad(image_material(add_image()), uvs=None))
    white, other = read_with_remarks(add_quad(material))
    mean = srgb_from_linear(linear_from_srgb(TEXELS).mean(axis=(0, 1)))
    np.testing.assert_array_equal(average.images[0][0, 0], mean)
    assert white.images[0].tolist() == [[[255, 255, 255]]]
    assert "no UV map" in remark[0]
    assert "'lost'" in other[0]


def test_reading_changes_nothing() -> None:
    """Datablocks, image settings and meshes are the same afterwards."""
    image = add_image()
    obj = add_quad(image_material(image, extension="MIRROR"))
    obj.modifiers.new("divide", "SUBSURF")

    def state() -> tuple[object, ...]:
        blocks = [list(getattr(bpy.data, name).keys()) for name in ("objects", "meshes", "images", "materials")]
        return blocks, image.colorspace_settings.name, tuple(image.size), len(obj.data.polygons), image.is_dirty

    before = state()
    read(obj)
    assert state() == before


def test_nothing_to_read_is_refused() -> None:
    """No object, an empty, and a mesh without faces each give a sentence."""
    with pytest.raises(MeshError, match="nothing to build from"):
        read()
    with pytest.raises(MeshError, match="nothing to build from"):
        read(add_object(None, "empty"))
    with pytest.raises(MeshError, match="'bare' has no faces"):
        read(add_object(bpy.data.meshes.new("bare"), "bare"))


@pytest.mark.parametrize("scale", [(0, 0, 0), (1, 1, 0)])
def test_zero_scale_is_refused(scale: tuple[float, float, float]) -> None:
    """An object scaled to a point or a plane is named."""
    obj = cube()
    obj.scale = scale
    with pytest.raises(MeshError, match="'Cube' has a scale of zero"):
        read(obj)


def test_vertices_that_are_no_numbers_are_refused() -> None:
    """A single NaN is found."""
    obj = cube()
    obj.data.vertices[3].co.x = float("nan")
    with pytest.raises(MeshError, match="not finite numbers"):
        read(obj)


def nothing_in_size() -> bpy.types.Object:
    """Add a cube scaled to a point."""
    obj = cube()
    obj.scale = (0, 0, 0)
    return obj


def flattened() -> bpy.types.Object:
    """Add an empty that shows a collection squeezed to a plane."""
    collection = bpy.data.collections.new("inside")
    obj = cube()
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    empty = add_object(None, "empty")
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    empty.scale = (1, 1, 0)
    return empty


def turned_nowhere() -> bpy.types.Object:
    """Add a cube turned by not-a-number."""
    obj = cube()
    obj.rotation_euler.x = float("nan")
    return obj


def moved_nowhere() -> bpy.types.Object:
    """Add a cube at an infinite place."""
    obj = cube()
    obj.location.x = float("inf")
    return obj


def without_faces() -> bpy.types.Object:
    """Add an object of points."""
    mesh = bpy.data.meshes.new("Cube")
    mesh.from_pydata([(0, 0, 0), (9, 9, 9)], [(0, 1)], [])
    return add_object(mesh, "Cube")


def bad_vertex() -> bpy.types.Object:
    """Add a cube with a vertex that is infinite, as a file may hold it."""
    obj = cube()
    obj.data.vertices.foreach_set("co", np.full(24, np.inf, dtype=np.float32))
    return obj


def far_vertex() -> bpy.types.Object:
    """Add a cube with a vertex that was set to infinity, for which Blender takes the greatest number."""
    obj = cube()
    obj.data.vertices[0].co.y = float("inf")
    return obj


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (nothing_in_size, "a scale of zero"),
        (flattened, "a scale of zero"),
        (turned_nowhere, "a location, rotation or scale that is not finite"),
        (moved_nowhere, "a location, rotation or scale that is not finite"),
        (without_faces, "no faces"),
        (far_vertex, "vertices whose coordinates are not finite numbers"),
        (bad_vertex, "vertices whose coordinates are not finite numbers"),
    ],
)
def test_what_cannot_be_built_is_left_out(make: Callable[[], bpy.types.Object], words: str) -> None:
    """An object that cannot be built is left out beside one that can, with a remark, and refused by itself."""
    bad = make()
    bpy.context.view_layer.update()
    with pytest.raises(MeshError, match=rf"^The object 'Cube' has {words}: [^\n]*\.$"):
        read(bad)
    good = cube()
    good.name = "good"
    mesh, remarks = read_with_remarks(bad, good)
    assert len(mesh.faces) == 12
    np.testing.assert_allclose(np.ptp(mesh.vertices, axis=0), 2000)
    assert remarks == (f"The object 'Cube' has {words}: it was left out.",)


def test_many_that_are_left_out_are_one_sentence() -> None:
    """Objects with one fault share a sentence, which names the first of them."""
    bad = [nothing_in_size() for _ in range(5)]
    _, remarks = read_with_remarks(*bad, cube())
    names = "'Cube', 'Cube.001', 'Cube.002' and 2 more"
    assert remarks == (f"The objects {names} have a scale of zero: they were left out.",)


def test_one_instance_without_size() -> None:
    """Of the instances of one object those without size are left out, in one sentence."""
    faces = bpy.data.meshes.new("a face and a sliver")
    faces.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (7, 0, 0)], [], [(0, 1, 2), (3, 4, 5)])
    parent, child = add_object(faces, "parent"), cube(1)
    parent.instance_type, parent.use_instance_faces_scale = "FACES", True
    parent.show_instancer_for_viewport = False
    child.parent = parent
    bpy.context.view_layer.update()
    mesh, remarks = read_with_remarks(parent)
    assert len(mesh.faces) == 12
    assert remarks == ("The object 'Cube' has a scale of zero: it was left out.",)
