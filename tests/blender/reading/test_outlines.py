"""What an estimate needs of objects is what building reads, but for the colours."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.estimate import estimate
from legorize_addon.core.settings import Settings
from legorize_addon.reading import outlines, read_objects, read_outline

pytestmark = pytest.mark.usefixtures("addon")


def ball() -> bpy.types.Object:
    """Add a ball with an image, a modifier and a turn."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=12, ring_count=8, location=(1, 2, 3), rotation=(0.3, 0, 0))
    thing = bpy.context.object
    thing.modifiers.new("Subdivision", "SUBSURF").levels = 1
    material = bpy.data.materials.new("paint")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    picture = nodes.new("ShaderNodeTexImage")
    picture.image = bpy.data.images.new("picture", 32, 16)
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(picture.outputs["Color"], shader.inputs["Base Color"])
    thing.data.materials.append(material)
    return thing


def test_an_estimate_is_the_same_as_of_what_is_built() -> None:
    """Modifiers, turn and image size count; only the colours are missing."""
    thing = ball()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    bare, (mesh, _) = read_outline([thing], depsgraph), read_objects([thing], depsgraph)
    assert bare is not None
    assert np.allclose(np.ptp(bare.vertices, axis=0), np.ptp(mesh.vertices, axis=0))
    assert len(bare.faces) == len(mesh.faces)
    assert [image.shape for image in bare.images] == [image.shape for image in mesh.images]
    assert estimate(bare, Settings()) == estimate(mesh, Settings())


def test_instances_count() -> None:
    """Each instance of a mesh is a part of what is built."""
    thing = ball()
    group = bpy.data.collections.new("group")
    group.objects.link(thing)
    holder = bpy.data.objects.new("holder", None)
    holder.instance_type, holder.instance_collection = "COLLECTION", group
    bpy.context.scene.collection.objects.link(holder)
    bpy.context.view_layer.update()
    both = read_outline([thing, holder], bpy.context.evaluated_depsgraph_get())
    one = read_outline([thing], bpy.context.evaluated_depsgraph_get())
    assert len(both.faces) == 2 * len(one.faces)


def test_nothing_comes_of_what_is_hidden_or_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    """No estimate is better than a wrong one, or than a window that stands still."""
    thing = ball()
    assert read_outline([], bpy.context.evaluated_depsgraph_get()) is None
    monkeypatch.setattr(outlines, "MOST_CORNERS", 10)
    assert read_outline([thing], bpy.context.evaluated_depsgraph_get()) is None
    monkeypatch.undo()
    thing.hide_viewport = True
    bpy.context.view_layer.update()
    assert read_outline([thing], bpy.context.evaluated_depsgraph_get()) is None
