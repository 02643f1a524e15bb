"""How much of a material is seen: alpha by every way that materials have for it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from tests.blender.builders import (
    TEXELS,
    Nodes,
    add_image,
    add_quad,
    image_material,
    multiplied,
    read,
    read_with_remarks,
)

ALPHA = np.array([[1.0, 0.2, 0.0], [0.4, 0.6, 1.0]])


def opacity(mesh: TriangleMesh) -> np.ndarray:
    """Return the alpha of the only image."""
    [found] = mesh.opacities or (None,)
    return np.full(mesh.images[0].shape[:2], 255) if found is None else found


def with_alpha(nodes: Nodes, output) -> bpy.types.Material:
    """Link an output to the alpha of the shader."""
    nodes.link(output, nodes.shader.inputs["Alpha"])
    return nodes.material


def set_input(node, name: str, value) -> None:
    """Set an input by its name."""
    node.inputs[name].default_value = value


def math(nodes: Nodes, operation: str, *operands):
    """Add a Math node; return its output."""
    node = nodes.add("Math", operation=operation)
    for socket, operand in zip(node.inputs, operands, strict=False):
        if isinstance(operand, float):
            socket.default_value = operand
        else:
            nodes.link(operand, socket)
    return node.outputs[0]


def test_constant_alpha() -> None:
    """A pane's alpha is a number at its shader; an opaque material says nothing."""
    nodes = Nodes()
    set_input(nodes.shader, "Alpha", 0.15)
    assert opacity(read(add_quad(nodes.material))).tolist() == [[38]]
    assert read(add_quad(Nodes().material)).opacities == ()


def test_masked_as_importers_do_it() -> None:
    """Alpha cut at a threshold by Math nodes, 1 - (alpha < cutoff), is 0 or 1 exactly."""
    nodes = Nodes()
    texture = nodes.add("TexImage", image=add_image(alpha=ALPHA))
    below = math(nodes, "LESS_THAN", texture.outputs["Alpha"], 0.5)
    with_alpha(nodes, math(nodes, "SUBTRACT", 1.0, below))
    mesh = read(add_quad(nodes.colour(texture.outputs["Color"])))
    np.testing.assert_array_equal(opacity(mesh), np.where(ALPHA < 0.5, 0, 255))
    np.testing.assert_array_equal(mesh.images[0], TEXELS)


def test_a_mask_of_its_own() -> None:
    """A second image, of another size, decides over the texels of the first, or over a plain colour."""
    mask = add_image(np.repeat(ALPHA, 2, axis=0)[..., None].repeat(3, axis=2), data=True)
    nodes = Nodes()
    with_alpha(nodes, nodes.add("TexImage", image=mask).outputs["Color"])
    plain = read(add_quad(nodes.material))
    np.testing.assert_allclose(opacity(plain), np.repeat(np.rint(ALPHA * 255), 2, axis=0), atol=1)
    assert (plain.images[0] == plain.images[0][0, 0]).all()
    mesh = read(add_quad(nodes.colour(nodes.add("TexImage", image=add_image()).outputs["Color"])))
    np.testing.assert_array_equal(mesh.images[0], TEXELS)
    np.testing.assert_allclose(opacity(mesh), np.rint(ALPHA * 255), atol=1)


@pytest.mark.parametrize(("share", "seen"), [(0.25, 64), (0.75, 191)])
def test_mixed_with_a_transparent_shader(share: float, seen: int) -> None:
    """What is mixed with a transparent shader is seen by its share, on either side."""
    for first in (True, False):
        nodes = Nodes()
        mix, clear = nodes.add("MixShader"), nodes.add("BsdfTransparent")
        mix.inputs[0].default_value = share if first else 1 - share
        sides = (clear, nodes.shader) if first else (nodes.shader, clear)
        for socket, side in zip(mix.inputs[1:], sides, strict=True):
            nodes.link(side.outputs[0], socket)
        nodes.link(mix.outputs[0], nodes.output.inputs["Surface"])
        assert opacity(read(add_quad(nodes.material))).tolist() == [[seen]]


def test_light_paths_count_as_the_camera_sees_them() -> None:
    """An image that only the camera sees, as importers build it for unlit materials, is opaque."""
    nodes = Nodes()
    mix, clear, light = nodes.add("MixShader"), nodes.add("BsdfTransparent"), nodes.add("LightPath")
    glow = nodes.add("Emission")
    nodes.link(nodes.add("TexImage", image=add_image()).outputs["Color"], glow.inputs["Color"])
    nodes.link(light.outputs["Is Camera Ray"], mix.inputs[0])
    nodes.link(clear.outputs[0], mix.inputs[1])
    nodes.link(glow.outputs[0], mix.inputs[2])
    nodes.link(mix.outputs[0], nodes.output.inputs["Surface"])
    mesh = read(add_quad(nodes.material))
    assert mesh.opacities == ()
    np.testing.assert_array_equal(mesh.images[0], TEXELS)


@pytest.mark.parametrize(("colour", "seen"), [((1, 1, 1, 1), 0), ((0.8, 0.1, 0.1, 1), 230), ((0, 0, 0, 1), 255)])
@pytest.mark.parametrize("kind", ["principled", "BsdfGlass", "BsdfRefraction", "BsdfTransparent"])
def test_glass_is_seen_by_its_colour(kind: str, colour, seen: int) -> None:
    """Clear glass is not seen, red glass is seen for what it holds back, and black glass is opaque."""
    nodes = Nodes()
    shader = nodes.shader if kind == "principled" else nodes.add(kind)
    if kind == "principled":
        set_input(shader, "Transmission Weight", 1.0)
    set_input(shader, "Base Color" if kind == "principled" else "Color", colour)
    nodes.link(shader.outputs[0], nodes.output.inputs["Surface"])
    np.testing.assert_allclose(opacity(read(add_quad(nodes.material))), [[seen]], atol=1)


def add_alphas(obj: bpy.types.Object, alphas: list[float]) -> None:
    """Give the corners of a quad a red attribute with alpha."""
    layer = obj.data.color_attributes.new("Col", "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", np.array([(1.0, 0, 0, alpha) for alpha in alphas], dtype=np.float32).ravel())


def test_alpha_of_corners_runs_over_the_face() -> None:
    """Corners of alpha 0 and 1 make a ramp over the face, in the colour of the attribute."""
    nodes = Nodes()
    attribute = nodes.add("VertexColor", layer_name="Col")
    with_alpha(nodes, attribute.outputs["Alpha"])
    obj = add_quad(nodes.colour(attribute.outputs["Color"]))
    add_alphas(obj, [0.0, 1.0, 1.0, 0.0])
    mesh = read(obj)
    assert {tuple(texel) for texel in mesh.images[0].reshape(-1, 3).tolist()} == {(255, 0, 0)}
    found = opacity(mesh)
    assert found.min() == 0
    assert found.max() == 255
    assert len(np.unique(found)) > 30


def test_even_alpha_of_corners_multiplies_that_of_an_image() -> None:
    """An attribute of alpha 1 all over, as exporters add it, leaves the alpha of the image as it is."""
    nodes = Nodes()
    texture, attribute = nodes.add("TexImage", image=add_image(alpha=ALPHA)), nodes.add("VertexColor", layer_name="Col")
    with_alpha(nodes, math(nodes, "MULTIPLY", texture.outputs["Alpha"], attribute.outputs["Alpha"]))
    obj = add_quad(nodes.colour(texture.outputs["Color"]))
    add_alphas(obj, [0.5, 0.5, 0.5, 0.5])
    np.testing.assert_allclose(opacity(read(obj)), ALPHA * 127.5, atol=0.6)


def test_what_must_be_baked_is_baked_with_its_alpha() -> None:
    """An image times colours that vary is baked, and its hidden texels stay hidden: black ones have no say."""
    texels, alpha = np.zeros((8, 8, 3), np.uint8), np.zeros((8, 8))
    texels[:, :4], alpha[:, :4] = 255, 1.0
    nodes = Nodes()
    texture, attribute = (
        nodes.add("TexImage", image=add_image(texels, alpha)),
        nodes.add("VertexColor", layer_name="Col"),
    )
    with_alpha(nodes, texture.outputs["Alpha"])
    obj = add_quad(nodes.colour(multiplied(nodes, texture.outputs["Color"], attribute.outputs["Color"])))
    layer = obj.data.color_attributes.new("Col", "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", np.array([(0, 0.2, 0, 1), (0, 0.8, 0, 1)] * 2, dtype=np.float32).ravel())
    mesh, remarks = read_with_remarks(obj)
    assert "baked" in remarks[0]
    [found] = mesh.opacities
    seen = mesh.images[0][found > 127]
    assert seen[:, 1].min() > 100
    assert seen[:, [0, 2]].max() == 0
    assert 0.2 < (found > 127).mean() < 0.6


def test_alpha_by_nodes_is_baked() -> None:
    """A mix with a transparent shader by a checker, which no image holds, is seen square for square."""
    nodes = Nodes()
    place, texture, mix = nodes.add("TexCoord"), nodes.add("TexChecker"), nodes.add("MixShader")
    set_input(texture, "Scale", 2.0)
    nodes.link(place.outputs["UV"], texture.inputs["Vector"])
    nodes.link(texture.outputs["Fac"], mix.inputs[0])
    nodes.link(nodes.add("BsdfTransparent").outputs[0], mix.inputs[1])
    nodes.link(nodes.shader.outputs[0], mix.inputs[2])
    nodes.link(mix.outputs[0], nodes.output.inputs["Surface"])
    set_input(nodes.shader, "Base Color", (0.8, 0.1, 0.1, 1))
    mesh, _ = read_with_remarks(add_quad(nodes.material))
    [found] = mesh.opacities
    centre = np.array([(x, y) for y in (0.25, 0.75) for x in (0.25, 0.75)])
    values = []
    for point in centre:
        for corners, uvs in zip(mesh.vertices[mesh.faces][..., :2] / 1000, mesh.uvs, strict=True):
            weights = np.linalg.solve(np.vstack([corners.T, np.ones(3)]), np.append(point, 1.0))
            if (weights > -1e-9).all():
                column, row = np.floor(weights @ uvs * found.shape[::-1]).astype(int)
                values.append(found[row, column] > 127)
                break
    assert values in ([True, False, False, True], [False, True, True, False])


def test_mirrored_images_mirror_their_alpha() -> None:
    """An image that is mirrored when it repeats takes its alpha with it."""
    nodes = Nodes()
    texture = nodes.add("TexImage", image=add_image(alpha=ALPHA), extension="MIRROR")
    with_alpha(nodes, texture.outputs["Alpha"])
    found = opacity(read(add_quad(nodes.colour(texture.outputs["Color"]))))
    np.testing.assert_array_equal(found[:, 3:], found[:, 2::-1])
    np.testing.assert_array_equal(found[2:], found[1::-1])


def test_alpha_that_is_not_linked_is_no_matter() -> None:
    """An image's alpha beside an opaque material hides nothing."""
    assert read(add_quad(image_material(add_image(alpha=ALPHA)))).opacities == ()
