"""Colours that an object or an instance gives its materials."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.colours.difference import srgb_from_linear
from legorize_addon.reading.object_values import _hashed, _scrambled
from tests.blender.builders import Nodes, add_object, add_quad, read, read_with_remarks

ORANGE = (1.0, 0.4, 0.05, 1.0)


def plain(mesh, face: int = 0) -> list[int]:
    """Return the colour of a face of one colour."""
    image = mesh.images[mesh.face_image[face]]
    assert image.shape == (1, 1, 3)
    return image[0, 0].tolist()


def encoded(colour) -> list[int]:
    """Return linear colours as sRGB bytes."""
    return srgb_from_linear(np.array(colour[:3])).tolist()


def object_info(output: str = "Color") -> tuple[Nodes, object]:
    """Return a material under construction and an output of its Object Info node."""
    nodes = Nodes()
    return nodes, nodes.add("ObjectInfo").outputs[output]


def test_objects_have_their_colour() -> None:
    """Two objects of one material have a colour each, without baking."""
    nodes, colour = object_info()
    material = nodes.colour(colour)
    for wanted in (ORANGE, (0.0, 0.3, 1.0, 1.0)):
        obj = add_quad(material)
        obj.color = wanted
        assert plain(read(obj)) == encoded(wanted)


def test_alpha_of_the_object_counts() -> None:
    """An object can be made clear by the alpha of its colour."""
    nodes, alpha = object_info("Alpha")
    nodes.link(alpha, nodes.shader.inputs["Alpha"])
    obj = add_quad(nodes.material)
    obj.color = (1, 1, 1, 0.2)
    assert read(obj).opacities[0].tolist() == [[51]]


def test_instances_have_the_colour_of_their_instancer() -> None:
    """A collection's instance shows in the colour of the empty that makes it."""
    nodes, colour = object_info()
    obj = add_quad(nodes.colour(colour))
    obj.color = ORANGE
    collection = bpy.data.collections.new("kept")
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    empty = bpy.data.objects.new("empty", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    empty.color = (0.0, 0.3, 1.0, 1.0)
    bpy.context.scene.collection.objects.link(empty)
    assert plain(read(empty)) == encoded(empty.color)


@pytest.mark.parametrize("name", ["paint", "color"])
def test_attributes_of_the_object(name: str) -> None:
    """An Attribute node of type Object reads a custom property, or one of Blender's own."""
    nodes = Nodes()
    attribute = nodes.add("Attribute", attribute_type="OBJECT", attribute_name=name)
    obj = add_quad(nodes.colour(attribute.outputs["Color"]))
    obj.color = obj["paint"] = ORANGE
    assert plain(read(obj)) == encoded(ORANGE)


@pytest.mark.skipif(bpy.app.version < (4, 5, 0), reason="older versions do not tell the attributes of instances")
@pytest.mark.parametrize("identity", [False, True])
def test_instances_have_attributes_of_their_own(identity: bool) -> None:
    """Geometry Nodes may give every instance a colour, whatever numbers they go by."""
    nodes = Nodes()
    attribute = nodes.add("Attribute", attribute_type="INSTANCER", attribute_name="tint")
    thing = add_quad(nodes.colour(attribute.outputs["Color"]))
    points = bpy.data.meshes.new("points")
    points.from_pydata([(0, 0, 0), (3, 0, 0), (6, 0, 0)], [], [])
    colours = np.array([(1, 0, 0, 1), (0, 1, 0, 1), (0, 0, 1, 1)], dtype=np.float32)
    points.attributes.new("tint", "FLOAT_COLOR", "POINT").data.foreach_set("color", colours.ravel())
    if identity:
        points.attributes.new("id", "INT", "POINT").data.foreach_set("value", [70, 5, 5])
    obj = add_object(points)
    tree = bpy.data.node_groups.new("scatter", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    place, info = tree.nodes.new("GeometryNodeInstanceOnPoints"), tree.nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = thing, True
    tree.links.new(start.outputs[0], place.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], place.inputs["Instance"])
    tree.links.new(place.outputs[0], end.inputs[0])
    obj.modifiers.new("scatter", "NODES").node_group = tree
    mesh = read(obj)
    middle = mesh.vertices[mesh.faces].mean(axis=1)[:, 0]
    for x, colour in zip((0, 3000, 6000), colours, strict=True):
        faces = np.flatnonzero((middle > x) & (middle < x + 1000))
        assert len(faces) == 2
        assert plain(mesh, faces[0]) == encoded(colour)


def test_what_has_no_attribute_is_black() -> None:
    """An attribute that nothing has is black, as in Blender's renderers."""
    nodes = Nodes()
    attribute = nodes.add("Attribute", attribute_type="INSTANCER", attribute_name="nothing")
    assert plain(read(add_quad(nodes.colour(attribute.outputs["Color"])))) == [0, 0, 0]


def test_random_numbers_choose_from_a_ramp() -> None:
    """A colour ramp over an object's random number is one of its colours, the one that Cycles shows."""
    nodes, random = object_info("Random")
    ramp = nodes.add("ValToRGB")
    nodes.link(random, ramp.inputs["Fac"])
    obj = add_quad(nodes.colour(ramp.outputs["Color"]))
    obj.name = "Suzanne"
    number = _scrambled(_hashed("Suzanne")) / 0xFFFFFFFF
    np.testing.assert_allclose(plain(read(obj)), encoded((number,) * 3), atol=1)


@pytest.mark.parametrize("name", ["Cube", "Suzanne.001", "Öl"])
def test_random_numbers_are_those_of_cycles(name: str) -> None:
    """The number made from an object's name is the one that Cycles bakes."""
    nodes, random = object_info("Random")
    glow, target = nodes.add("Emission"), nodes.add("TexImage")
    nodes.link(random, glow.inputs["Color"])
    nodes.link(glow.outputs[0], nodes.output.inputs["Surface"])
    target.image = bpy.data.images.new("target", 4, 4, float_buffer=True)
    nodes.tree.nodes.active = target
    obj = add_quad(nodes.material)
    obj.name = name
    scene, layer = bpy.context.scene, bpy.context.view_layer
    layer.objects.active = obj
    obj.select_set(True)
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    bpy.ops.object.bake(type="EMIT")
    assert target.image.pixels[0] == pytest.approx(_scrambled(_hashed(name)) / 0xFFFFFFFF, abs=1e-6)


def test_what_is_baked_has_the_values_of_its_object() -> None:
    """Nodes that must be baked get the colour of the object, not of the copy that is baked."""
    nodes, colour = object_info()
    mix, noise = nodes.add("MixRGB", blend_type="MULTIPLY"), nodes.add("TexNoise")
    mix.inputs["Fac"].default_value = 1.0
    bright = nodes.add("MixRGB")
    bright.inputs["Color1"].default_value, bright.inputs["Color2"].default_value = (0.9,) * 4, (1.0,) * 4
    nodes.link(noise.outputs["Fac"], bright.inputs["Fac"])
    nodes.link(bright.outputs["Color"], mix.inputs["Color1"])
    nodes.link(colour, mix.inputs["Color2"])
    obj = add_quad(nodes.colour(mix.outputs["Color"]))
    obj.color = ORANGE
    mesh, remarks = read_with_remarks(obj)
    assert "baked" in remarks[0]
    middle = np.floor(mesh.uvs.mean(axis=1) * mesh.images[0].shape[1::-1]).astype(int)
    found = mesh.images[0][middle[:, 1], middle[:, 0]].astype(int)
    assert (found[:, 0] > 235).all()
    assert (np.abs(found[:, 1] - encoded(ORANGE)[1]) < 15).all()
