"""Models deleted the Blender way, as a whole or in part: the original comes back, and nothing of the model stays."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.reading.importers import load
from legorize_addon.render.still import render_still
from legorize_addon.scene.builds import builds, damage, n_deleted, point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.hidden_sources import HIDDEN_SOURCES_KEY, orphans
from legorize_addon.scene.state import state_of
from legorize_addon.ui.current import current_build
from legorize_addon.ui.export import written
from tests.blender.bricks import content, instances, show, table

pytestmark = pytest.mark.usefixtures("registered")


@pytest.fixture
def cube() -> bpy.types.Object:
    """Return a selected cube that renders do not show."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.hide_render = True
    bpy.context.scene.legorize.settings.width = 6
    return bpy.context.object


def delete_hierarchy(build: bpy.types.Collection) -> None:
    """Delete a collection with all that is in it, as "Delete Hierarchy" does."""
    for thing in list(build.all_objects):
        bpy.data.objects.remove(thing)
    for collection in [*build.children_recursive, build]:
        bpy.data.collections.remove(collection)


def unlink(build: bpy.types.Collection) -> None:
    """Take a collection out of the scene, as "Unlink" does."""
    bpy.context.scene.collection.children.unlink(build)


def hidden(source: bpy.types.Object) -> tuple[bool, bool]:
    """Return how an object is hidden."""
    return source.hide_viewport, source.hide_render


@pytest.mark.parametrize("delete", [delete_hierarchy, unlink])
def test_original_of_a_deleted_model_is_offered(cube, delete) -> None:
    """The panel's button shows it as it was before, selects it, and clears up; then nothing is left to offer."""
    before = content()
    assert not bpy.ops.legorize.show_originals.poll()
    bpy.ops.legorize.build()
    assert not bpy.ops.legorize.show_originals.poll()
    delete(current_build(bpy.context.scene))
    assert current_build(bpy.context.scene) is None
    assert [entry.source for entry in orphans(bpy.context.scene)] == [cube]
    assert bpy.ops.legorize.show_originals() == {"FINISHED"}
    assert hidden(cube) == (False, True)
    assert bpy.context.selected_objects == [cube]
    assert not bpy.ops.legorize.show_originals.poll()
    assert HIDDEN_SOURCES_KEY not in bpy.context.scene
    if delete is delete_hierarchy:
        assert content() == before


def test_what_the_state_held_goes_too(cube) -> None:
    """Objects that Blender left in the file without users, as the deleted state held them, are cleared up."""
    before = content()
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    for collection in [*build.children_recursive, build]:
        for thing in list(collection.objects):
            collection.objects.unlink(thing)
        bpy.data.collections.remove(collection)
    assert [thing for thing in bpy.data.objects if thing != cube and not thing.users]
    bpy.ops.legorize.show_originals()
    assert content() == before


def test_button_builds_the_original_again(cube) -> None:
    """With nothing selected the big button works on what a deleted model hid, and still knows how it was before."""
    bpy.ops.legorize.build()
    delete_hierarchy(current_build(bpy.context.scene))
    assert bpy.ops.legorize.build.poll()
    bpy.ops.legorize.build()
    assert hidden(cube) == (True, True)
    assert len(instances()) > 3
    bpy.ops.legorize.clear()
    assert hidden(cube) == (False, True)
    assert not orphans(bpy.context.scene)


def test_offer_survives_a_file_and_undo(cube, tmp_path) -> None:
    """A saved file still offers the original; an undone deletion takes the offer back."""
    bpy.ops.legorize.build()
    bpy.ops.ed.undo_push(message="built")
    delete_hierarchy(current_build(bpy.context.scene))
    bpy.ops.ed.undo_push(message="deleted")
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.ed.undo()
    assert not orphans(bpy.context.scene)
    assert damage(current_build(bpy.context.scene)) is None
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bpy.ops.legorize.show_originals() == {"FINISHED"}
    assert hidden(bpy.data.objects["Cube"]) == (False, True)


def test_original_that_was_shown_or_deleted_is_not_offered(cube) -> None:
    """Whoever has shown the original, or deleted it too, is not asked again."""
    bpy.ops.legorize.build()
    delete_hierarchy(current_build(bpy.context.scene))
    cube.hide_viewport = False
    assert not orphans(bpy.context.scene)
    cube.hide_viewport = True
    assert orphans(bpy.context.scene)
    cube.hide_viewport = False
    bpy.ops.object.select_all(action="DESELECT")
    cube.select_set(True)
    bpy.ops.object.delete()
    assert not orphans(bpy.context.scene)


@pytest.mark.parametrize("what", ["root", "plane", "parts", "everything"])
def test_damaged_model_says_so_and_can_be_removed(cube, what: str) -> None:
    """Whatever was deleted of it, the model is refused in one sentence, and its removal leaves the scene as it was."""
    before = content()
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    if what == "parts":
        bpy.data.collections.remove(state_of(build).parts)
    elif what == "everything":
        for thing in list(build.all_objects):
            bpy.data.objects.remove(thing)
    else:
        bpy.data.objects.remove(getattr(state_of(build), what))
    assert "some of its objects were deleted" in damage(build)
    view = bpy.context.scene.legorize
    looked_at = (view.top_layer, view.step, view.heat_map, view.exploded, view.section_axis, view.roles.shell)
    assert len(looked_at) == 6
    view.top_layer, view.section_axis, view.heat_map, view.exploded, view.by_steps = 1, "x", True, 0.5, True
    view.detail = "low"
    for write in (bpy.ops.legorize.export_ldr, bpy.ops.legorize.render_still):
        with pytest.raises(RuntimeError, match="some of its objects were deleted"):
            write(filepath="x")
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert content() == before
    assert hidden(cube) == (False, True)


def test_deleted_by_the_keyboard(cube) -> None:
    """X with all of the model selected leaves an empty collection, which is removed like any model."""
    before = content()
    bpy.ops.legorize.build()
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.delete()
    build = current_build(bpy.context.scene)
    assert damage(build)
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert hidden(cube) == (False, True)
    bpy.data.orphans_purge(do_local_ids=True, do_linked_ids=True, do_recursive=True)
    assert content() == before


def test_damaged_model_can_be_built_again(cube) -> None:
    """The button replaces it."""
    bpy.ops.legorize.build()
    bpy.data.objects.remove(state_of(current_build(bpy.context.scene)).root)
    bpy.ops.legorize.build()
    [build] = builds(bpy.context.scene)
    assert damage(build) is None
    assert len(instances()) > 3


def test_damaged_model_is_left_out_of_pictures(cube, tmp_path) -> None:
    """A picture shows the whole models beside a damaged one."""
    bpy.ops.legorize.build()
    bpy.data.objects.remove(state_of(current_build(bpy.context.scene)).root)
    show(table([(10, 0, 0, 0, 0, 4)]))
    render_still(bpy.context.scene, tmp_path / "still.png", samples=1, resolution=(32, 24))
    assert (tmp_path / "still.png").stat().st_size > 100


def test_deleted_layers_are_no_damage(cube) -> None:
    """Bricks may be taken away for good: what is left is shown and read."""
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    n = len(read_bricks(build))
    bpy.data.objects.remove(point_objects(build)[-1])
    assert damage(build) is None
    assert 0 < len(read_bricks(build)) < n
    clear_build(bpy.context.scene, build)
    assert not cube.hide_viewport


def test_source_deleted_by_the_keyboard_is_gone(cube) -> None:
    """A source that lives on in the file alone is neither built again nor shown."""
    bpy.ops.legorize.build()
    view = bpy.context.scene.legorize
    view.show_sources = True
    bpy.ops.object.select_all(action="DESELECT")
    cube.select_set(True)
    bpy.ops.object.delete()
    assert not bpy.ops.legorize.build.poll()
    clear_build(bpy.context.scene, current_build(bpy.context.scene))
    assert np.array_equal([thing.name for thing in bpy.context.scene.objects], [])


def test_file_with_a_damaged_model_is_read(cube, tmp_path) -> None:
    """A .blend in which a model was damaged gives its original."""
    cube.hide_render = False
    bpy.ops.legorize.build()
    bpy.data.objects.remove(state_of(current_build(bpy.context.scene)).root)
    state = state_of(current_build(bpy.context.scene))
    assert [entry.source.name for entry in state.sources] == ["Cube"]
    path = tmp_path / "damaged.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    assert {thing.name for thing in load(path).objects} == {"Cube"}


def test_exports_tell_of_deleted_bricks(cube, tmp_path) -> None:
    """A model of which one layer's bricks were deleted is not exported as if it were whole."""
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    assert (n_deleted(build), written(tmp_path, build)[0]) == (0, {"INFO"})
    bpy.data.objects.remove(point_objects(build)[0])
    assert n_deleted(build) == 1
    kind, text = written(tmp_path / "a.ldr", build)
    assert kind == {"WARNING"}
    assert "bricks were deleted by hand since" in text
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / "a.ldr")) == {"FINISHED"}
