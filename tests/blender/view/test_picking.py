"""Which brick a ray meets, and the edges that outline it."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from mathutils import Matrix, Vector

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene import middles, read_bricks, state_of, world_from_mm
from legorize_addon.ui.current import current_build
from legorize_addon.view import brick_under, edges_of, show_layers
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def build():
    """Return the build of a table on one leg."""
    add_table_on_one_leg()
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout = 12, "fast"
    bpy.ops.legorize.build()
    return current_build(bpy.context.scene)


def met(build, row, direction):
    """Return the row of the brick that a ray meets that goes through the middle of another one from outside."""
    place = world_from_mm(build) @ Vector(middles(read_bricks(build), load_catalogue())[row])
    far = 1000 * world_from_mm(build).median_scale
    found = brick_under(bpy.context, place - Vector(direction) * far, Vector(direction))
    return None if found is None else found[1]


@pytest.mark.parametrize("moved", [Matrix(), Matrix.Translation((3, 4, 5)) @ Matrix.Rotation(0.7, 4, (1, 2, 3))])
def test_every_brick_can_be_picked(build, moved):
    """Of each brick a ray from one of six sides meets that brick, and no hidden one, wherever the model stands."""
    state_of(build).root.matrix_world = moved @ state_of(build).root.matrix_world
    bpy.context.view_layer.update()
    bricks = read_bricks(build)
    sides = [Vector(side) for axis in np.eye(3) for side in (axis, -axis)]
    turned = [(moved.to_3x3() @ side).normalized() for side in sides]
    final = np.flatnonzero(bricks.role != Role.SUPPORT_OUTSIDE).tolist()
    hidden = set(range(len(bricks))) - set(final)
    found = {row: {met(build, row, side) for side in turned} for row in final}
    assert not hidden & set.union(*found.values())
    # of a compact model nearly every brick is seen from some side through its own middle
    assert sum(row in rows for row, rows in found.items()) > 0.9 * len(final)


def test_hidden_layers_are_not_met(build):
    """What the panel hides is not in the way."""
    bricks = read_bricks(build)
    top = int(np.argmax(bricks.corner[:, 2]))
    assert met(build, top, (0, 0, -1)) == top
    show_layers(bpy.context.scene, build, 1)
    bpy.context.view_layer.update()
    assert met(build, top, (0, 0, -1)) != top


def test_other_objects_are_no_bricks(build):
    """Before a brick something else may stand; beside the model there is nothing."""
    bpy.ops.mesh.primitive_cube_add(size=100, location=(0, 0, 200))
    assert brick_under(bpy.context, Vector((0, 0, 1000)), Vector((0, 0, -1))) is None
    assert brick_under(bpy.context, Vector((500, 500, 1000)), Vector((0, 0, -1))) is None


def test_edges(build):
    """Each brick has twelve edges, along its sides, in the world."""
    ends = edges_of(build, [0, 2, 10_000]).reshape(2, 12, 2, 3)
    along = np.abs(ends[:, :, 1] - ends[:, :, 0])
    assert ((along > 1e-9).sum(axis=2) == 1).all()
    middle = np.array(world_from_mm(build) @ Vector(middles(read_bricks(build), load_catalogue())[2]))
    np.testing.assert_allclose(ends[1].reshape(-1, 3).mean(axis=0), middle, atol=1e-5)
