"""Baking colours that no image holds, in a scene that leaves no trace."""

from __future__ import annotations

import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.colours.difference import linear_from_srgb, srgb_from_linear
from legorize_addon.core.errors import MeshError
from legorize_addon.reading import bake
from tests.blender.builders import (
    TEXELS,
    Nodes,
    add_image,
    add_object,
    add_quad,
    colours_at,
    image_material,
    read_with_remarks,
    texel_centres,
)

RED, BLUE = (0.8, 0.1, 0.05, 1.0), (0.0, 0.1, 0.6, 1.0)
COLLECTIONS = ("scenes", "objects", "meshes", "materials", "images", "node_groups", "worlds", "collections")


def checker(nodes: Nodes, coordinates: str = "UV", scale: float = 4.0):
    """Add a checker of red and blue squares; return its colour."""
    place, texture = nodes.add("TexCoord"), nodes.add("TexChecker")
    texture.inputs["Scale"].default_value = scale
    texture.inputs["Color1"].default_value, texture.inputs["Color2"].default_value = RED, BLUE
    nodes.link(place.outputs[coordinates], texture.inputs["Vector"])
    return texture.outputs["Color"]


def checker_at(points: np.ndarray, level: int = 0, scale: float = 4.0) -> np.ndarray:
    """Return the sRGB bytes of the checker on its level in z: the first colour where the sum of the squares is odd."""
    odd = (np.floor(points * scale).sum(axis=-1) + level) % 2 == 1
    return srgb_from_linear(np.where(odd[:, None], RED[:3], BLUE[:3]))


def inner_points(squares: int = 4) -> np.ndarray:
    """Return points of the unit square that keep off the edges of the squares."""
    place = np.random.default_rng(3).random((400, 2))
    return (np.floor(place * squares) + 0.15 + 0.7 * (place * squares % 1)) / squares


def state() -> object:
    """Return what a user could miss or find too much."""
    scene, layer = bpy.context.scene, bpy.context.view_layer
    return (
        {name: sorted(getattr(bpy.data, name).keys()) for name in COLLECTIONS},
        (scene.name, scene.render.engine, scene.render.bake.margin, layer.objects.active),
        [obj.name for obj in bpy.context.selected_objects],
        [(node.name, node.select) for material in bpy.data.materials for node in material.node_tree.nodes],
        [len(material.node_tree.links) for material in bpy.data.materials],
    )


def test_checker_is_baked_where_it_is() -> None:
    """A checker by UV comes out square for square, with its exact colours; the remark says that it was baked."""
    nodes = Nodes()
    mesh, remarks = read_with_remarks(add_quad(nodes.colour(checker(nodes))))
    points = inner_points()
    np.testing.assert_allclose(colours_at(mesh, points), checker_at(points), atol=1)
    assert mesh.image_clamp.tolist() == [True]
    assert "baked" in remarks[0]


def test_generated_coordinates_span_the_object() -> None:
    """A checker by generated coordinates, the default of procedural textures, spans the object's box."""
    nodes = Nodes()
    obj = add_quad(nodes.colour(checker(nodes, "Generated")), uvs=None)
    obj.scale = (-3.0, 3.0, 3.0)
    points = inner_points()
    mesh, _ = read_with_remarks(obj)
    # the middle of a flat object is its coordinate 0.5, which Cycles puts into the square below
    np.testing.assert_allclose(colours_at(mesh, points * (-3, 3)), checker_at(points, level=1), atol=1)


def test_colour_ramp_follows_its_formula() -> None:
    """A ramp over the image's own brightness, which no product can say, has the ramp's colours."""
    nodes = Nodes()
    place, gradient, ramp = nodes.add("TexCoord"), nodes.add("TexGradient"), nodes.add("ValToRGB")
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = RED, BLUE
    nodes.link(place.outputs["UV"], gradient.inputs["Vector"])
    nodes.link(gradient.outputs["Color"], ramp.inputs["Fac"])
    mesh, _ = read_with_remarks(add_quad(nodes.colour(ramp.outputs["Color"])))
    points = inner_points()
    expected = np.array(RED[:3]) + points[:, :1] * np.subtract(BLUE[:3], RED[:3])
    found = linear_from_srgb(colours_at(mesh, points).astype(np.uint8))
    np.testing.assert_allclose(found, expected, atol=0.01)


def test_noise_on_a_sphere_has_many_colours() -> None:
    """Noise covers a sphere without a seam of unpainted texels: no colour but mixtures of the two."""
    nodes = Nodes()
    noise, mix = nodes.add("TexNoise"), nodes.add("MixRGB")
    mix.inputs["Color1"].default_value, mix.inputs["Color2"].default_value = RED, BLUE
    nodes.link(noise.outputs["Fac"], mix.inputs["Fac"])
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    obj = bpy.context.object
    obj.data.materials.append(nodes.colour(mix.outputs["Color"]))
    mesh, _ = read_with_remarks(obj)
    weights = np.random.default_rng(0).dirichlet(np.ones(3), size=20)
    places = np.einsum("kc,fcd->kfd", weights, mesh.uvs).reshape(-1, 2)
    texels = np.floor(places * mesh.images[0].shape[1::-1]).astype(int)
    colours = linear_from_srgb(mesh.images[0][texels[:, 1], texels[:, 0]])
    assert len(np.unique(colours, axis=0)) > 50
    # all colours lie on the line between the two
    share = (colours[:, 0] - BLUE[0]) / (RED[0] - BLUE[0])
    np.testing.assert_allclose(colours, np.array(BLUE[:3]) + share[:, None] * np.subtract(RED[:3], BLUE[:3]), atol=0.02)
    assert ((share > 0.1) & (share < 0.9)).all()


def test_mixed_shaders_mix_their_colours() -> None:
    """Two opaque shaders mixed by a checker, inside a group, give the two base colours; metal counts like any."""
    group = bpy.data.node_groups.new("inside", "ShaderNodeTree")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    group.interface.new_socket("Share", in_out="INPUT", socket_type="NodeSocketFloat")
    metal, dull, mix = (group.nodes.new("ShaderNode" + kind) for kind in ("BsdfPrincipled", "BsdfDiffuse", "MixShader"))
    metal.inputs["Base Color"].default_value, dull.inputs["Color"].default_value = BLUE, RED
    metal.inputs["Metallic"].default_value = 1.0
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(start.outputs["Share"], mix.inputs["Fac"])
    group.links.new(metal.outputs[0], mix.inputs[1])
    group.links.new(dull.outputs[0], mix.inputs[2])
    group.links.new(mix.outputs[0], end.inputs["Shader"])
    nodes = Nodes()
    texture, node = nodes.add("TexChecker"), nodes.add("Group", node_tree=group)
    texture.inputs["Scale"].default_value = 4.0
    nodes.link(nodes.add("TexCoord").outputs["UV"], texture.inputs["Vector"])
    nodes.link(texture.outputs["Fac"], node.inputs["Share"])
    nodes.link(node.outputs["Shader"], nodes.output.inputs["Surface"])
    before = state()
    mesh, _ = read_with_remarks(add_quad(nodes.material))
    points = inner_points()
    np.testing.assert_allclose(colours_at(mesh, points), checker_at(points), atol=1)
    assert len(state()[0]["node_groups"]) == len(before[0]["node_groups"])


def test_an_image_beside_a_procedural_material_stays_exact() -> None:
    """Only the slot that needs it is baked; the other keeps its image byte for byte."""
    nodes = Nodes()
    mesh = bpy.data.meshes.new("two")
    mesh.from_pydata([(x, y, 0) for x in range(3) for y in range(2)], [], [(0, 2, 3, 1), (2, 4, 5, 3)])
    mesh.uv_layers.new(name="map").uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1] * 2)
    mesh.materials.append(image_material(add_image()))
    mesh.materials.append(nodes.colour(checker(nodes)))
    mesh.polygons.foreach_set("material_index", [0, 1])
    found, _ = read_with_remarks(add_object(mesh))
    np.testing.assert_array_equal(colours_at(found, texel_centres()), TEXELS.reshape(-1, 3))
    points = inner_points()
    np.testing.assert_allclose(colours_at(found, np.add(points, (1, 0))), checker_at(points), atol=1)


def test_baking_leaves_no_trace() -> None:
    """Datablocks, selection, active object, engine and materials are the same afterwards."""
    nodes = Nodes()
    obj = add_quad(nodes.colour(checker(nodes)))
    bpy.ops.object.light_add()
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    before = state()
    read_with_remarks(obj)
    assert state() == before


@pytest.mark.parametrize("step", ["_unwrap", "_emit_colours", "_bake"])
def test_a_failure_leaves_no_trace(step: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever step fails, the error comes through and nothing temporary stays."""

    def fail(*_: object) -> None:
        raise MemoryError(step)

    nodes = Nodes()
    obj = add_quad(nodes.colour(checker(nodes)))
    before = state()
    monkeypatch.setattr(bake, step, fail)
    with pytest.raises(MemoryError, match=step):
        read_with_remarks(obj)
    assert state() == before


def test_missing_image_is_not_baked(tmp_path: Path) -> None:
    """An image file missing behind nodes is baked as a grey, not in pink, and told; that of a bump map is not."""
    image = bpy.data.images.new("lost", 4, 4)
    image.source, image.filepath = "FILE", str(tmp_path / "lost.png")
    for socket, told in (("Base Color", 1), ("Metallic", 0)):
        nodes = Nodes()
        ramp, texture = nodes.add("ValToRGB"), nodes.add("TexImage", image=image)
        nodes.colour(checker(nodes))
        nodes.link(texture.outputs["Color"], ramp.inputs["Fac"])
        nodes.link(ramp.outputs["Color"], nodes.shader.inputs[socket])
        mesh, remarks = read_with_remarks(add_quad(nodes.material))
        assert len([remark for remark in remarks if "lost.png" in remark]) == told
        grey = np.ptp(colours_at(mesh, inner_points()), axis=1).max() == 0
        assert grey == bool(told)


def test_missing_xatlas_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without xatlas a procedural material gives one sentence, and other materials are read."""
    monkeypatch.setitem(sys.modules, "xatlas", None)
    nodes = Nodes()
    procedural, plain = add_quad(nodes.colour(checker(nodes))), add_quad(image_material(add_image()))
    with pytest.raises(MeshError, match="xatlas is missing"):
        read_with_remarks(procedural)
    assert len(read_with_remarks(plain)[0].faces) == 2
