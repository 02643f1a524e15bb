"""Duplicates of a model's root, as Shift-D and Alt-D make them, are models of their own."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.model.bricks import Role
from legorize_addon.scene.builds import builds, damage, layers_of, point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.duplicates import adopt_copies, is_bare_root, is_copied_root
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import state_of
from legorize_addon.ui import duplicates
from legorize_addon.ui.current import current_build
from legorize_addon.ui.session import SESSION
from legorize_addon.view.heat_map import show_heat_map
from legorize_addon.view.visibility import cut_away, show_layers, show_role
from tests.blender.bricks import assert_same, instances

pytestmark = pytest.mark.usefixtures("registered")


@pytest.fixture
def build(cube: bpy.types.Object) -> bpy.types.Collection:
    """Return a model of the cube, whose root is selected alone."""
    bpy.context.scene.legorize.settings.width = 5
    bpy.ops.legorize.build()
    return current_build(bpy.context.scene)


def seen() -> list[tuple]:
    """Return the part, colour and place of each brick that is shown, sorted."""
    bpy.context.view_layer.update()
    return sorted((mesh["legorize_mesh"], material, *np.round(m[:3, 3], 3)) for mesh, material, m in instances())


def duplicate(*, linked: bool = False, everything: bool = False) -> bpy.types.Object:
    """Copy what is selected, or all, and move the copied root; return it."""
    if everything:
        bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.duplicate(linked=linked)
    [root] = [each for each in bpy.context.selected_objects if is_copied_root(each)]
    bpy.context.view_layer.objects.active = root
    root.location.x += 50
    return root


@pytest.mark.parametrize("everything", [False, True])
@pytest.mark.parametrize("linked", [False, True])
def test_a_copied_root_is_a_whole_model(build, cube, linked: bool, everything: bool) -> None:
    """It has all bricks, moved; either one is changed and removed without a trace on the other."""
    bricks, before = read_bricks(build), seen()
    root = duplicate(linked=linked, everything=everything)
    [(original, copy)] = adopt_copies(bpy.context.scene)
    assert original == build
    assert builds(bpy.context.scene) == [build, copy]
    assert damage(copy) is None
    assert state_of(copy).root == root
    assert not set(build.all_objects) & set(copy.all_objects)
    assert [len(layer.objects) for layer in layers_of(copy)] == [len(layer.objects) for layer in layers_of(build)]
    assert_same(read_bricks(copy), bricks)
    assert_same(read_bricks(build), bricks)
    both = seen()
    assert len(both) == 2 * len(before)
    assert set(before) < set(both)
    assert np.ptp([row[2] for row in both]) > 50
    cut_away(copy, Section(axis="x", at=0.3))
    show_heat_map(copy, visible=True)
    assert set(before) < set(seen())
    show_heat_map(copy, visible=False)
    clear_build(bpy.context.scene, build)
    assert len(read_bricks(copy)) == len(bricks)
    cut_away(copy, Section())
    assert len(seen()) == len(before)
    clear_build(bpy.context.scene, copy)
    assert not cube.hide_viewport
    assert not bpy.data.collections


def paste(root: bpy.types.Object, path: Path, scene: bpy.types.Scene) -> bpy.types.Object:
    """Append a root from a file, as Ctrl-V does from the one that Ctrl-C has written; return it."""
    bpy.data.libraries.write(str(path), {root})
    with bpy.data.libraries.load(str(path)) as (there, here):
        here.objects = there.objects
    [pasted] = here.objects
    scene.collection.objects.link(pasted)
    return pasted


def test_a_pasted_root_is_a_whole_model(build, tmp_path: Path) -> None:
    """Ctrl-C and Ctrl-V give a model of its own; of two that are alike, the one that was copied, and only once."""
    scene, root = bpy.context.scene, state_of(build).root
    duplicate()
    [(_, other)] = adopt_copies(scene)
    show_layers(scene, other, 2)
    before = seen()
    pasted = paste(state_of(other).root, tmp_path / "buffer.blend", scene)
    assert is_bare_root(scene, pasted)
    [(original, copy)] = adopt_copies(scene)
    assert original == other
    assert state_of(copy).root == pasted
    assert state_of(copy).top_layer == 2
    assert pasted.users_collection[:] == (copy,)
    assert len(seen()) == len(before) + len([row for row in before if row[2] > 25])
    assert not is_bare_root(scene, pasted)
    assert not adopt_copies(scene)
    again = paste(pasted, tmp_path / "again.blend", scene)
    assert adopt_copies(scene)[0][0] == copy
    assert not is_bare_root(scene, again)
    assert not is_bare_root(scene, root)


def test_a_root_pasted_into_another_scene_is_a_model_there(build, tmp_path: Path) -> None:
    """It has all bricks, beside those of the first one, which goes its own way; nothing is left of either."""
    here, there = bpy.context.scene, bpy.data.scenes.new("there")
    before = read_bricks(build)
    pasted = paste(state_of(build).root, tmp_path / "buffer.blend", there)
    assert not adopt_copies(here)
    [(original, copy)] = adopt_copies(there)
    assert original == build
    assert builds(here) == [build]
    assert builds(there) == [copy]
    assert state_of(copy).root == pasted
    assert damage(copy) is None
    assert list(there.collection.children) == [copy]
    assert_same(read_bricks(copy), before)
    clear_build(here, build)
    assert damage(copy) is None
    assert_same(read_bricks(copy), before)
    clear_build(there, copy)
    assert not bpy.data.collections


def test_the_root_of_a_model_that_is_not_there_stays_bare(build, tmp_path: Path) -> None:
    """What was copied in another file has nothing to be made of; it is told by the panel, and left alone."""
    scene = bpy.context.scene
    pasted = paste(state_of(build).root, tmp_path / "buffer.blend", scene)
    clear_build(scene, build)
    assert not adopt_copies(scene)
    assert is_bare_root(scene, pasted)


def test_nothing_to_adopt(build) -> None:
    """A model itself is none, nor are copies of its layers; a second look finds nothing."""
    assert not adopt_copies(bpy.context.scene)
    thing = point_objects(build)[0].copy()
    layers_of(build)[0].objects.link(thing)
    assert not adopt_copies(bpy.context.scene)
    duplicate()
    assert len(adopt_copies(bpy.context.scene)) == 1
    assert not adopt_copies(bpy.context.scene)


def test_the_copy_looks_alike(build) -> None:
    """Layers, roles and what the user has hidden are as on the original; copies of copies as well."""
    scene = bpy.context.scene
    show_layers(scene, build, 2)
    show_role(build, Role.SHELL, visible=False)
    before, bricks = seen(), read_bricks(build)
    duplicate()
    [(_, copy)] = adopt_copies(scene)
    assert len(seen()) == 2 * len(before)
    assert state_of(copy).top_layer == 2
    show_role(copy, Role.SHELL, visible=True)
    assert not state_of(build).roles[Role.SHELL]
    duplicate()
    [(original, again)] = adopt_copies(scene)
    assert original == copy
    assert state_of(again).roles[Role.SHELL]
    for each in (copy, build):
        clear_build(scene, each)
    assert_same(read_bricks(again), bricks)


@pytest.mark.parametrize("kind", ["LINK_COPY", "FULL_COPY"])
def test_in_a_copied_scene(build, kind: str) -> None:
    """The copy is of the scene in which it was made; names that the user has changed are no matter."""
    first = bpy.context.scene
    for number, thing in enumerate(reversed(build.all_objects[:])):
        thing.name = f"mine {number}"
    bricks = read_bricks(build)
    bpy.ops.scene.new(type=kind)
    scene = bpy.context.scene
    [there] = builds(scene)
    bpy.ops.object.select_all(action="DESELECT")
    state_of(there).root.select_set(True)
    duplicate()
    [(_, copy)] = adopt_copies(scene)
    copy.name = "another name"
    assert_same(read_bricks(copy), bricks)
    assert copy in builds(scene)
    assert copy not in builds(first)
    clear_build(scene, copy)
    assert_same(read_bricks(there), bricks)
    assert_same(read_bricks(build), bricks)


def test_commands_find_the_copy(build, cube) -> None:
    """Update with other settings changes the copy alone, where it stands; the original keeps its own."""
    bricks = read_bricks(build)
    duplicate()
    assert bpy.ops.legorize.list_parts() == {"FINISHED"}
    copy = current_build(bpy.context.scene)
    assert copy != build
    assert state_of(copy).settings == state_of(build).settings
    bpy.context.scene.legorize.settings.width = 8
    assert bpy.ops.legorize.update() == {"FINISHED"}
    assert sorted(state_of(each).summary["studs_x"] for each in builds(bpy.context.scene)) == [5, 8]
    assert_same(read_bricks(build), bricks)
    updated = current_build(bpy.context.scene)
    assert state_of(updated).root.location.x > 40
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert builds(bpy.context.scene) == [build]
    assert cube.hide_viewport


def test_an_undo_can_go_on(build) -> None:
    """What is a copy again after an undo is left so, until a command needs it."""
    root = duplicate()
    duplicates._leave_copies()
    assert not duplicates.adopt(bpy.context, SESSION.left)
    assert builds(bpy.context.scene) == [build]
    assert duplicates.adopt(bpy.context)
    assert state_of(current_build(bpy.context.scene)).root == root
    duplicates._leave_copies()
    assert not SESSION.left
