"""The root of a build as a frame: as large as the bricks, never seen in a render, never a thing to legorize."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Vector

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.units import PLATE
from legorize_addon.scene.brick_points import box_corners
from legorize_addon.scene.builds import builds, damage, point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.duplicates import adopt_copies, is_bare_root
from legorize_addon.scene.root import RIM
from legorize_addon.scene.state import state_of
from legorize_addon.ui.current import current_build
from legorize_addon.ui.requests import chosen_sources
from tests.blender.bricks import assert_same, random_table, show, table

pytestmark = pytest.mark.usefixtures("registered")


@pytest.fixture
def build(cube) -> bpy.types.Collection:
    """Return a built cube, whose root is selected."""
    bpy.ops.legorize.build()
    return current_build(bpy.context.scene)


def test_view_selected_frames_the_bricks() -> None:
    """What the root spans in the world is what the bricks do, and a rim on the ground."""
    build = show(random_table(40), origin=(16.0, -24.0, 9.6), scale=0.5, mm_per_unit=1000.0)
    root = state_of(build).root
    root.scale *= 3
    root.location.x += 2
    bpy.context.view_layer.update()
    unit = root.matrix_world.median_scale
    spans = np.array([root.matrix_world @ Vector(corner) for corner in root.bound_box])
    bricks = read_bricks(build)
    stays = box_corners(bricks.take(bricks.role != Role.SUPPORT_OUTSIDE), load_catalogue()) * unit
    ground = box_corners(bricks, load_catalogue())[:, 2].min() * unit
    wide = stays.max(axis=0) - [*stays.min(axis=0)[:2], ground] + np.array([2, 2, 0]) * RIM * unit
    np.testing.assert_allclose(np.ptp(spans, axis=0), wide, rtol=1e-5)
    np.testing.assert_allclose(spans[:, 2].min(), root.location.z, atol=1e-5)


def test_supports_do_not_move_the_root() -> None:
    """It stands below the middle of what stays, whatever stands beside that for a while, on the ground of all."""
    rows = [(0, 4, 4, 3, 0, 4), (0, 8, 6, 3, 0, 4)]
    alone = show(table(rows), name="alone")
    supported = show(table([*rows, (0, 20, 4, 0, 0, 4, Role.SUPPORT_OUTSIDE)]), name="supported")
    (x, y, z), (other_x, other_y, ground) = state_of(alone).middle, state_of(supported).middle
    assert (x, y) == (other_x, other_y)
    assert z == 3 * PLATE
    assert ground == 0
    spans = [np.ptp(np.array(state_of(build).root.bound_box), axis=0) for build in (alone, supported)]
    np.testing.assert_allclose(spans[1] - spans[0], (0, 0, 3 * PLATE), atol=1e-4)


def test_a_root_has_nothing_to_render(build) -> None:
    """It is edges alone: what has no faces is in no picture, and is no surface to build."""
    root = state_of(build).root
    bpy.context.view_layer.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    assert not root.evaluated_get(depsgraph).data.polygons
    assert len(root.data.edges) == 4


def test_a_root_is_never_legorized(build, cube) -> None:
    """Selected, it stands for what its model was made of; hung on another root, it is no layer of bricks."""
    root = state_of(build).root
    assert bpy.context.selected_objects == [root]
    assert chosen_sources(bpy.context) == [cube]
    before = read_bricks(build)
    bpy.ops.object.duplicate()
    [copied] = bpy.context.selected_objects
    copied.parent = root
    assert len(point_objects(build)) == state_of(build).objects
    assert_same(read_bricks(build), before)
    assert damage(build) is None


@pytest.mark.parametrize(
    "change",
    [
        lambda: bpy.ops.object.transform_apply(location=False, rotation=False, scale=True),
        lambda: bpy.ops.object.transform_apply(location=True, rotation=True, scale=False),
        lambda: bpy.ops.object.origin_set(type="ORIGIN_GEOMETRY"),
    ],
    ids=["scale", "place", "origin"],
)
def test_a_changed_frame_is_told(build, change) -> None:
    """Blender then keeps the bricks in their place: the root no longer tells where they are."""
    state = state_of(build)
    state.root.scale *= 3
    state.root.location.x += 2
    state.root.rotation_euler.z = 1
    bpy.context.view_layer.update()
    assert damage(build) is None
    assert change() == {"FINISHED"}
    assert damage(build) == (
        "'Legorize Cube' is damaged, because the location, rotation or scale of its root was applied, or its origin "
        "was set: undo that, or remove the model and build it again."
    )
    assert not bpy.ops.legorize.export_ldr.poll()
    bpy.ops.legorize.build()
    [again] = builds(bpy.context.scene)
    assert damage(again) is None


def test_its_mesh_goes_with_the_last_root(build) -> None:
    """A linked duplicate shares the mesh of the frame until both are removed, or deleted by hand."""
    mesh = state_of(build).root.data.name
    bpy.ops.object.duplicate(linked=True)
    [(_, copy)] = adopt_copies(bpy.context.scene)
    clear_build(bpy.context.scene, build)
    assert state_of(copy).root.data.name == mesh
    bpy.data.objects.remove(state_of(copy).root)
    clear_build(bpy.context.scene, copy)
    assert not builds(bpy.context.scene)
    assert mesh not in bpy.data.meshes


def test_an_empty_of_an_earlier_version_is_a_root_too(build) -> None:
    """Its model is whole, is copied with it, and gets a frame when it is built again."""
    framed, empty = state_of(build).root, bpy.data.objects.new("Legorize Cube", None)
    build.objects.link(empty)
    empty["legorize_own"], empty.matrix_basis = True, framed.matrix_basis
    for thing in list(framed.children):
        inverse = thing.matrix_parent_inverse.copy()
        thing.parent = empty
        thing.matrix_parent_inverse = inverse
    build["legorize"]["root"] = empty
    bpy.data.objects.remove(framed)
    assert damage(build) is None
    assert len(point_objects(build)) == state_of(build).objects
    bpy.ops.object.select_all(action="DESELECT")
    empty.select_set(True)
    bpy.ops.object.duplicate()
    [(_, copy)] = adopt_copies(bpy.context.scene)
    assert state_of(copy).root.type == "EMPTY"
    assert not is_bare_root(bpy.context.scene, state_of(copy).root)
    clear_build(bpy.context.scene, copy)
    bpy.ops.legorize.build()
    [again] = builds(bpy.context.scene)
    assert state_of(again).root.type == "MESH"
