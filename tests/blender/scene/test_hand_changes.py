"""Bricks that were deleted or moved by hand."""

from __future__ import annotations

import bmesh
import bpy
import pytest

from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.hand_changes import CLOSE, changed_by_hand, hand_remark
from legorize_addon.ui.current import current_build
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def build() -> bpy.types.Collection:
    """Return the model of a table on one leg."""
    add_table_on_one_leg()
    bpy.context.object.name = "Table"
    bpy.context.scene.legorize.settings.width = 12
    assert bpy.ops.legorize.build() == {"FINISHED"}
    return current_build(bpy.context.scene)


def delete_points(mesh, count):
    """Delete the first points of a mesh, as in Edit Mode."""
    edited = bmesh.new()
    edited.from_mesh(mesh)
    edited.verts.ensure_lookup_table()
    bmesh.ops.delete(edited, geom=edited.verts[:count], context="VERTS")
    edited.to_mesh(mesh)
    edited.free()


def test_nothing_is_said_of_a_build_as_it_was_shown(build, tmp_path):
    """Neither at once nor from a file."""
    assert changed_by_hand(build) == (0, 0)
    assert hand_remark(build) == ""
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    assert changed_by_hand(current_build(bpy.context.scene)) == (0, 0)


def test_deleted_and_moved_bricks_are_counted(build):
    """Points deleted in Edit Mode and moved points, however little they are off the grid."""
    first, second = point_objects(build)[:2]
    delete_points(first.data, 1)
    assert changed_by_hand(build) == (1, 0)
    second.data.vertices[0].co.z += 2 * CLOSE
    assert changed_by_hand(build) == (1, 1)
    assert hand_remark(build).startswith("1 brick was deleted and 1 brick was moved by hand since 'Legorize Table'")


def test_the_bricks_of_a_moved_object_are_moved(build):
    """An object that was dragged away takes all of its bricks along."""
    thing = point_objects(build)[-1]
    thing.location.x += 8
    n = len(thing.data.vertices)
    assert changed_by_hand(build) == (0, n)


def test_a_deleted_object_is_all_of_its_bricks(build):
    """They are counted, as the building steps know them."""
    thing = point_objects(build)[-1]
    n = len(thing.data.vertices)
    bpy.data.objects.remove(thing)
    assert changed_by_hand(build) == (n, 0)


def test_files_of_moved_bricks_come_with_a_warning(build, tmp_path, capfd):
    """The file is written, and the sentence says what to do."""
    point_objects(build)[-1].data.vertices[0].co.x += 8
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / "a.ldr")) == {"FINISHED"}
    assert bpy.ops.legorize.booklet(filepath=str(tmp_path / "a.html")) == {"FINISHED"}
    said = capfd.readouterr()
    assert (said.out + said.err).count("1 brick was moved by hand since 'Legorize Table' was built") == 2
    assert "undo that, or legorize the object again" in said.out + said.err


def test_moving_the_model_is_no_change(build):
    """It may stand anywhere, turned as one likes."""
    root = point_objects(build)[0].parent
    root.location, root.rotation_euler.z = (100, 20, 0), 1.0
    bpy.context.view_layer.update()
    assert changed_by_hand(build) == (0, 0)
