"""Armatures and empties are hidden with the objects that hang on them, and come back with them."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.scene.builds import builds
from legorize_addon.scene.holders import holders
from legorize_addon.scene.state import state_of

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def rigged() -> tuple[bpy.types.Object, bpy.types.Object, bpy.types.Object]:
    """Return a selected cube, its armature and the empty on which that hangs."""
    empty = bpy.data.objects.new("place", None)
    bpy.context.scene.collection.objects.link(empty)
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    rig.parent = empty
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    cube.modifiers.new("rig", "ARMATURE").object = rig
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout = 6, "fast"
    return cube, rig, empty


def test_holders_are_what_holds_nothing_else(rigged) -> None:
    """A second mesh on the same empty keeps the empty; an armature of its own goes all the same."""
    cube, rig, empty = rigged
    scene = bpy.context.scene
    assert holders(scene, [cube]) == sorted([rig, empty], key=lambda each: each.name)
    assert holders(scene, []) == []
    other = bpy.data.objects.new("other", cube.data)
    scene.collection.objects.link(other)
    other.parent = empty
    assert holders(scene, [cube]) == [rig]
    assert len(holders(scene, [cube, other])) == 2


def test_they_are_hidden_and_come_back(rigged) -> None:
    """Hidden by a build, shown by its removal as they were; the cube alone is what is built again."""
    cube, rig, empty = rigged
    empty.hide_render = True
    assert bpy.ops.legorize.build() == {"FINISHED"}
    assert all(each.hide_viewport and each.hide_render for each in rigged)
    [build] = builds(bpy.context.scene)
    assert [entry.source for entry in state_of(build).sources] == [cube]
    assert bpy.ops.legorize.build() == {"FINISHED"}
    bpy.ops.legorize.clear()
    assert not any(each.hide_viewport for each in rigged)
    assert [each.hide_render for each in (cube, rig, empty)] == [False, False, True]


def test_they_come_back_after_the_model_was_deleted(rigged) -> None:
    """Deleted in Blender's own way, the button shows all of them again."""
    assert bpy.ops.legorize.build() == {"FINISHED"}
    [build] = builds(bpy.context.scene)
    bpy.data.batch_remove([*build.all_objects, *build.children, build])
    assert bpy.ops.legorize.show_originals() == {"FINISHED"}
    assert not any(each.hide_viewport or each.hide_render for each in rigged)
