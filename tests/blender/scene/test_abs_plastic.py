"""Bricks of one colour differ a little, always by the same; exporters and outlines find the plain colour."""

from __future__ import annotations

import json
from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.render.outlines import outlined
from legorize_addon.scene import HEAT_KEY, plastic, state_of
from legorize_addon.scene.abs_plastic import COAT, DULLNESS, IOR, ROUGHNESS, TINT
from legorize_addon.view.visibility import show_layers
from tests.blender.bricks import show, table

RED = 4
SIDE = 4
PIXELS = 8


def shader(material: bpy.types.Material) -> bpy.types.Node:
    """Return the shader of a material."""
    return next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")


def inputs(path: Path) -> dict[str, np.ndarray]:
    """Return what the shader gets in the middle of each brick, as seen from above: each (4, 4) float."""
    scene, [material] = bpy.context.scene, [each for each in bpy.data.materials if "legorize_colour" in each]
    tree, target = material.node_tree, shader(material)
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.get_output_node("ALL")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    found = {}
    for name in ("Base Color", "Roughness"):
        tree.links.new(target.inputs[name].links[0].from_socket, emission.inputs["Color"])
        scene.render.filepath = str(path / "seen.exr")
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = np.array(image.pixels[:]).reshape(SIDE * PIXELS, SIDE * PIXELS, 4)
        bpy.data.images.remove(image)
        found[name] = pixels[PIXELS // 2 :: PIXELS, PIXELS // 2 :: PIXELS, 0]
    tree.nodes.remove(emission)
    tree.links.new(target.outputs[0], output.inputs["Surface"])
    return found


@pytest.fixture
def above() -> None:
    """Show two layers of 4 x 4 bricks of one colour to a camera that looks straight down."""
    show(table([(0, x, y, z, 0, RED) for z in (0, 3) for x in range(SIDE) for y in range(SIDE)]))
    scene = bpy.context.scene
    bpy.ops.object.camera_add(location=(SIDE * 4, SIDE * 4, 100))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", SIDE * 8
    scene.render.engine, scene.cycles.samples = "CYCLES", 1
    scene.render.resolution_x = scene.render.resolution_y = SIDE * PIXELS
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.image_settings.exr_codec = "ZIP"
    scene.cycles.pixel_filter_type, scene.cycles.use_denoising = "BOX", False


@pytest.mark.usefixtures("above")
def test_bricks_differ_and_stay_as_they_are(tmp_path) -> None:
    """No two bricks are alike, none is far from its colour, and what is hidden changes none that is seen."""
    build = next(child for child in bpy.context.scene.collection.children if "Legorize" in child.name)
    seen = inputs(tmp_path)
    material = next(each for each in bpy.data.materials if "legorize_colour" in each)
    plain = {"Base Color": (material.diffuse_color[0], TINT), "Roughness": (ROUGHNESS, DULLNESS)}
    for name, (middle, reach) in plain.items():
        share = seen[name] / middle - 1
        assert len(np.unique(share.round(5))) == SIDE * SIDE
        assert reach / 2 < np.abs(share).max() < reach + 1e-3
    show_layers(bpy.context.scene, build, 1)
    lower = inputs(tmp_path)
    assert np.abs(lower["Base Color"] - seen["Base Color"]).max() > 0.01
    show_layers(bpy.context.scene, build, 2)
    again = inputs(tmp_path)
    for name in plain:
        np.testing.assert_allclose(again[name], seen[name], atol=1e-5)


def test_a_look_for_bricks_alone() -> None:
    """The colours of a heat map, which have a legend, are plain; all are ABS."""
    heat = plastic("Heat", (200, 0, 0), HEAT_KEY, 1)
    build = show(table([(0, 0, 0, 0, 0, RED)]))
    brick = state_of(build).parts.objects[0].material_slots[0].material
    for material in (heat, brick):
        assert shader(material).inputs["IOR"].default_value == pytest.approx(IOR)
        assert shader(material).inputs["Coat Weight"].default_value == pytest.approx(COAT)
        assert material.roughness == pytest.approx(ROUGHNESS)
    assert not shader(heat).inputs["Base Color"].is_linked
    assert shader(brick).inputs["Base Color"].is_linked


def test_exporters_find_the_colour(tmp_path) -> None:
    """A brick that is written as glTF has its plain colour and roughness."""
    build = show(table([(0, 0, 0, 0, 0, RED)]))
    variant = state_of(build).parts.objects[0]
    bpy.context.scene.collection.objects.link(variant)
    bpy.ops.object.select_all(action="DESELECT")
    variant.select_set(True)
    bpy.ops.export_scene.gltf(filepath=str(tmp_path / "brick.gltf"), export_format="GLTF_SEPARATE", use_selection=True)
    [material] = json.loads((tmp_path / "brick.gltf").read_text(encoding="utf-8"))["materials"]
    told = material["pbrMetallicRoughness"]
    colour = variant.material_slots[0].material.diffuse_color
    np.testing.assert_allclose(told["baseColorFactor"], colour, atol=1e-4)
    assert told["roughnessFactor"] == pytest.approx(ROUGHNESS, abs=1e-4)


def test_outlines_leave_the_colours_varied() -> None:
    """Lines are drawn over the varied colour, and give it back."""
    build = show(table([(0, 0, 0, 0, 0, RED)]))
    material = state_of(build).parts.objects[0].material_slots[0].material
    base = shader(material).inputs["Base Color"]
    before = base.links[0].from_socket
    with outlined([material], 1.0):
        line = base.links[0].from_node
        assert line != before.node
        assert before in [link.from_socket for socket in line.inputs for link in socket.links]
    assert base.links[0].from_socket == before
