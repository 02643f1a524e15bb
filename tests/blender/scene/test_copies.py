"""Copies of a brick model: each can be shown, changed and removed without a trace on the other."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.model.bricks import Role
from legorize_addon.scene.builds import builds, damage, layers_of, point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.duplicates import is_copied_root
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import state_of
from legorize_addon.ui.current import current_build
from legorize_addon.view.heat_map import show_heat_map
from legorize_addon.view.visibility import cut_away, show_role
from tests.blender.bricks import assert_same, content, instances, random_table, show
from tests.blender.copying import duplicate_collection

pytestmark = pytest.mark.usefixtures("registered")


@pytest.fixture
def build(cube: bpy.types.Object) -> bpy.types.Collection:
    """Return a model of the cube."""
    bpy.ops.legorize.build()
    return current_build(bpy.context.scene)


def seen() -> list[tuple]:
    """Return the part, colour and place of each brick that is shown, sorted."""
    return sorted((mesh["legorize_mesh"], material, *np.round(m[:3, 3], 3)) for mesh, material, m in instances())


@pytest.mark.parametrize("linked", [False, True])
@pytest.mark.parametrize("first", ["copy", "original"])
def test_each_is_removed_by_itself(build, cube, linked: bool, first: str) -> None:
    """Whichever goes first, the other is shown, read and changed as before; the last one takes everything along."""
    bricks, before = read_bricks(build), seen()
    copy = duplicate_collection(build, linked=linked)
    assert len(builds(bpy.context.scene)) == 2
    gone, left = (copy, build) if first == "copy" else (build, copy)
    clear_build(bpy.context.scene, gone)
    assert seen() == before
    assert damage(left) is None
    assert_same(read_bricks(left), bricks)
    assert cube.hide_viewport
    show_heat_map(left, visible=True)
    assert len(instances()) == len(before)
    show_heat_map(left, visible=False)
    assert seen() == before
    clear_build(bpy.context.scene, left)
    assert not cube.hide_viewport
    assert not instances()
    assert not [*bpy.data.node_groups, *bpy.data.materials]
    assert [mesh.name for mesh in bpy.data.meshes] == [cube.data.name]
    assert not bpy.data.collections


@pytest.mark.parametrize("linked", [False, True])
def test_each_is_changed_by_itself(build, linked: bool) -> None:
    """Heat map, detail, section, layers and roles of a copy leave the other one alone."""
    before = seen()
    copy = duplicate_collection(build, linked=linked)
    assert seen() == sorted(before * 2)
    for change in (
        lambda: show_heat_map(copy, visible=True),
        lambda: cut_away(copy, Section("x", 0.3)),
        lambda: show_role(copy, Role.SHELL, visible=False),
        lambda: setattr(bpy.context.scene.legorize, "detail", "low"),
    ):
        bpy.context.scene.legorize.build = copy
        change()
        copy.hide_viewport = True
        assert seen() == before
        copy.hide_viewport = False
    show_role(copy, Role.SHELL, visible=True)
    cut_away(copy, Section())
    build.hide_viewport = True
    assert {name.split()[0] for _, name, _ in instances()} == {"Heat"}
    assert {mesh["legorize_mesh"].split()[1] for mesh, _, _ in instances()} == {"low"}


def test_copy_of_a_heat_map(build) -> None:
    """A copy made while the map is on can be switched off by itself, and so can the original."""
    before = seen()
    show_heat_map(build, visible=True)
    copy = duplicate_collection(build)
    show_heat_map(copy, visible=False)
    heat = [name for _, name, _ in instances() if name.startswith("Heat")]
    assert len(heat) == len(before)
    show_heat_map(build, visible=False)
    assert seen() == sorted(before * 2)


@pytest.mark.parametrize("linked", [False, True])
def test_objects_copied_in_place(build, linked: bool) -> None:
    """Shift-D and Alt-D of all that a model shows: bricks are counted once, and the copy outlives the model."""
    bricks, before = read_bricks(build), seen()
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.duplicate(linked=linked)
    assert len(instances()) == 2 * len(before)
    assert_same(read_bricks(build), bricks)
    [copied_root] = [thing for thing in bpy.context.selected_objects if is_copied_root(thing)]
    copied_root.location.x += 50
    bpy.context.view_layer.update()
    with_copy = seen()
    clear_build(bpy.context.scene, build)
    bpy.context.view_layer.update()
    left = seen()
    assert len(left) == len(before)
    assert set(left) < set(with_copy)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    assert bpy.ops.legorize.build.poll() is False


def test_copied_layer_counts_once(build) -> None:
    """A layer that was copied with its objects is not read twice."""
    bricks = read_bricks(build)
    layer = layers_of(build)[0]
    for thing in list(layer.objects):
        copy = thing.copy()
        copy.data = thing.data.copy()
        layer.objects.link(copy)
    assert_same(read_bricks(build), bricks)


def test_model_comes_along_into_another_file(build, cube, tmp_path) -> None:
    """A model appended from another file is one, is removed by itself, and leaves the one that is there alone."""
    bricks, before = read_bricks(build), seen()
    path = str(tmp_path / "model.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    with bpy.data.libraries.load(path) as (_, into):
        into.collections = [build.name]
    [appended] = into.collections
    bpy.context.scene.collection.children.link(appended)
    bpy.context.view_layer.update()
    assert damage(appended) is None
    assert_same(read_bricks(appended), bricks)
    clear_build(bpy.context.scene, appended)
    assert seen() == before
    clear_build(bpy.context.scene, build)
    assert not instances()


def test_rebuilding_leaves_the_copy(build, cube) -> None:
    """Of two models of the same object the selected one is replaced, or the one that the panel shows."""
    copy = duplicate_collection(build)
    once = read_bricks(build)
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.scene.legorize.build = build
    bpy.context.scene.legorize.settings.width = 9
    bpy.ops.legorize.build()
    rebuilt = current_build(bpy.context.scene)
    assert len(builds(bpy.context.scene)) == 2
    assert_same(read_bricks(copy), once)
    assert state_of(rebuilt).summary["studs_x"] == 9
    bpy.ops.object.select_all(action="DESELECT")
    state_of(copy).root.select_set(True)
    bpy.context.scene.legorize.settings.width = 4
    bpy.ops.legorize.build()
    assert sorted(state_of(each).summary["studs_x"] for each in builds(bpy.context.scene)) == [4, 9]
    for each in builds(bpy.context.scene):
        assert cube.hide_viewport
        clear_build(bpy.context.scene, each)
    assert not cube.hide_viewport


def test_what_hangs_on_a_model_stays(build) -> None:
    """An object of the user's that is a child of a model stays where it is when the model goes."""
    bpy.ops.object.light_add(location=(3, 4, 5))
    lamp = bpy.context.object
    lamp.parent = state_of(build).root
    bpy.context.view_layer.update()
    world = np.array(lamp.matrix_world)
    clear_build(bpy.context.scene, build)
    bpy.context.view_layer.update()
    assert lamp.name in bpy.context.scene.objects
    np.testing.assert_allclose(np.array(lamp.matrix_world), world, atol=1e-4)


def test_users_collection_inside_a_model_stays(build) -> None:
    """A collection that the user put into a model moves out when the model goes."""
    own = bpy.data.collections.new("Mine")
    build.children.link(own)
    bpy.ops.object.light_add()
    lamp = bpy.context.object
    own.objects.link(lamp)
    bpy.context.scene.collection.objects.unlink(lamp)
    clear_build(bpy.context.scene, build)
    assert own.name in bpy.context.scene.collection.children
    assert list(own.objects) == [lamp]


def test_parts_that_the_user_keeps_stay() -> None:
    """Parts that the user has put into the scene are not swept away."""
    build = show(random_table(20))
    parts = state_of(build).parts
    bpy.context.scene.collection.children.link(parts)
    n = len(parts.objects)
    clear_build(bpy.context.scene, build)
    assert len(parts.objects) == n
    before = content()
    bpy.context.scene.collection.children.unlink(parts)
    clear_build(bpy.context.scene, show(random_table(3)))
    assert content() != before
    assert not [thing for thing in bpy.data.objects if "legorize_part" in thing]


def test_points_of_a_copy_are_found() -> None:
    """Each build finds its own points, whatever the names of the copies are."""
    build = show(random_table(40))
    copy = duplicate_collection(build)
    assert not set(point_objects(build)) & set(point_objects(copy))
    assert len(point_objects(build)) == len(point_objects(copy))
