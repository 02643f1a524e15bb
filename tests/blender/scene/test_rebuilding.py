"""Building again: the new model stands and is shown as the old one was; sources may be hidden in any way."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Matrix

from legorize_addon.scene.builds import builds
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import state_of
from legorize_addon.ui.current import current_build
from legorize_addon.view.animation import animation_of
from legorize_addon.view.heat_map import heat_map_shown
from legorize_addon.view.visibility import section_of
from tests.blender.bricks import content, instances
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("registered")


@pytest.fixture
def table() -> bpy.types.Object:
    """Return a selected table on one leg, to be built 12 studs long: supports have to carry its ends."""
    add_table_on_one_leg()
    bpy.context.scene.legorize.settings.width = 12
    bpy.context.scene.legorize.settings.hanging = 0
    return bpy.context.object


def build_again(**settings) -> bpy.types.Collection:
    """Build with other settings what the panel shows."""
    bpy.ops.object.select_all(action="DESELECT")
    for name, value in settings.items():
        setattr(bpy.context.scene.legorize.settings, name, value)
    assert bpy.ops.legorize.build() == {"FINISHED"}
    [build] = builds(bpy.context.scene)
    return build


def middle() -> np.ndarray:
    """Return the middle of the box around the bricks that are shown."""
    bpy.context.view_layer.update()
    places = np.array([matrix[:3, 3] for _, _, matrix in instances()])
    return (places.min(axis=0) + places.max(axis=0)) / 2


def test_place_turn_and_scale_stay(table) -> None:
    """A model that was moved, turned and scaled by hand is built again where it stands, in another size too."""
    bpy.ops.legorize.build()
    unmoved = middle()
    move = Matrix.Translation((40, -10, 3)) @ Matrix.Rotation(0.7, 4, "Z") @ Matrix.Scale(2.0, 4)
    root = state_of(current_build(bpy.context.scene)).root
    root.matrix_basis = move @ root.matrix_basis
    moved = middle()
    np.testing.assert_allclose(moved, (np.array(move) @ [*unmoved, 1])[:3], atol=1.0)
    before = np.array(root.matrix_basis)
    again = build_again()
    np.testing.assert_allclose(np.array(state_of(again).root.matrix_basis), before, atol=1e-5)
    # twice as fine: bricks of half the size at the same place
    finer = build_again(width=24)
    np.testing.assert_allclose(middle(), moved, atol=1.0)
    turned = np.array(state_of(finer).root.matrix_basis)[:3, :3]
    np.testing.assert_allclose(turned, before[:3, :3] / 2, atol=1e-5)


def test_unmoved_model_lies_over_its_source(table) -> None:
    """A source that was moved since takes its model along: only the user's own moves of the model stay."""
    bpy.ops.legorize.build()
    first = middle()
    table.location.x += 100
    build_again()
    np.testing.assert_allclose(middle() - first, [100, 0, 0], atol=1e-3)


def test_parent_and_collection_stay(table) -> None:
    """A model that hangs on something, and lies in a collection of the user's, does so after it was built again."""
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    own = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(own)
    own.children.link(build)
    bpy.context.scene.collection.children.unlink(build)
    holder = bpy.data.objects.new("Holder", None)
    holder.location = (0, 0, 50)
    own.objects.link(holder)
    bpy.context.view_layer.update()
    state_of(build).root.parent = holder
    place = middle()
    again = build_again()
    assert again.name in own.children
    assert state_of(again).root.parent == holder
    np.testing.assert_allclose(middle(), place, atol=1e-3)


def test_unticked_collection_is_left(table) -> None:
    """What is built is to be seen: not in a collection that the view layer leaves out."""
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    own = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(own)
    own.children.link(build)
    bpy.context.scene.collection.children.unlink(build)
    bpy.context.view_layer.layer_collection.children["Mine"].exclude = True
    again = build_again()
    assert again.name in bpy.context.scene.collection.children
    assert instances()


def test_what_is_shown_stays(table) -> None:
    """Roles, layers, section, steps, pieces apart and the heat map are shown as before."""
    bpy.ops.legorize.build()
    view = bpy.context.scene.legorize
    view.roles.support_outside, view.roles.shell = True, False
    view.heat_map = True
    view.top_layer, view.single_layer = 5, True
    view.section_axis, view.section_at, view.section_flip = "x", 0.25, True
    again = build_again(clutch=0.9)
    assert (view.roles.support_outside, view.roles.shell, view.heat_map) == (True, False, True)
    assert (view.top_layer, view.single_layer) == (5, True)
    assert section_of(again) == Section("x", view.section_at, flip=True)
    assert heat_map_shown(again)
    again = build_again(width=4)
    assert view.top_layer == min(5, state_of(again).layers)


def test_steps_stay(table) -> None:
    """A model that is shown half built is so again; supports are then as they were wanted before."""
    bpy.ops.legorize.build()
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = 3
    build_again(clutch=0.9)
    assert (view.by_steps, view.step) == (True, 3)
    view.by_steps = False
    assert not view.roles.support_outside


def test_animation_stays(table) -> None:
    """A model that is built in the timeline is so again."""
    bpy.ops.legorize.build()
    bpy.ops.legorize.animate(frames=7)
    again = build_again(clutch=0.9)
    assert animation_of(again).frames == 7
    bpy.ops.legorize.stop_animation()
    assert not bpy.context.scene.legorize.roles.support_outside


def test_whole_model_stays_whole(table) -> None:
    """Where all layers were shown all are shown, however many the new model has."""
    bpy.ops.legorize.build()
    again = build_again(width=24)
    assert state_of(again).top_layer == state_of(again).layers > 10


def hide_by_eye(table, own) -> None:
    """Close the eye of the object."""
    table.hide_set(True)


def untick(table, own) -> None:
    """Leave its collection out of the view layer."""
    bpy.context.view_layer.layer_collection.children[own.name].exclude = True


def close_collection(table, own) -> None:
    """Close the eye of its collection."""
    bpy.context.view_layer.layer_collection.children[own.name].hide_viewport = True


def hide_collection(table, own) -> None:
    """Hide its collection in all viewports."""
    own.hide_viewport = True


@pytest.mark.parametrize("hide", [hide_by_eye, untick, close_collection, hide_collection])
def test_hidden_source_is_built_again(table, hide) -> None:
    """The source is read with its modifiers however it is hidden, and stays hidden in the same way."""
    own = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(own)
    own.objects.link(table)
    for collection in set(table.users_collection) - {own}:
        collection.objects.unlink(table)
    copies = table.modifiers.new("Array", "ARRAY")
    copies.count = 2
    bpy.ops.legorize.build()
    once, before = len(instances()), content()
    hide(table, own)
    layer = bpy.context.view_layer
    closed = table.name in layer.objects and table.hide_get()
    entry = layer.layer_collection.children["Mine"]
    flags = (entry.exclude, entry.hide_viewport, own.hide_viewport)
    build_again()
    assert len(instances()) == once
    assert content() == before
    entry = layer.layer_collection.children["Mine"]
    assert (entry.exclude, entry.hide_viewport, own.hide_viewport) == flags
    assert (table.name in layer.objects and table.hide_get()) == closed
    assert list(table.users_collection) == [own]
