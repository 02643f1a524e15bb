"""Live preview: quick bricks in the place of the model while settings change, which leaves no trace."""

from __future__ import annotations

import time
from collections.abc import Callable
from threading import Event

import bpy
import numpy as np
import pytest

from legorize_addon.core import preview as core_preview
from legorize_addon.scene import builds, preview_in, read_bricks, state_of
from legorize_addon.ui import live
from legorize_addon.ui.current import current_build
from legorize_addon.ui.requests import chosen_sources
from tests.blender.bricks import assert_same, content, instances
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def settings() -> bpy.types.PropertyGroup:
    """Build a table at 6 studs, switch the preview on, and return the settings of the panel."""
    add_table_on_one_leg()
    found = bpy.context.scene.legorize.settings
    found.width, found.layout, found.supports, found.plates = 6, "fast", "none", "none"
    assert bpy.ops.legorize.build() == {"FINISHED"}
    switch(on=True)
    return found


def switch(*, on: bool) -> None:
    """Click the switch, and let the panel be drawn."""
    bpy.context.window_manager.legorize_live = on
    if on:
        live.follow(bpy.context)


def soon() -> bool:
    """Draw the panel and wait; return whether there was something to do."""
    live.follow(bpy.context)
    return waited()


def waited() -> bool:
    """Do what the timer would do; return whether there was something to do."""
    if not bpy.app.timers.is_registered(live._tick):
        return False
    bpy.app.timers.unregister(live._tick)
    while (seconds := live._tick()) is not None:
        time.sleep(seconds)
    bpy.context.view_layer.update()
    return True


@pytest.fixture
def begun(monkeypatch) -> Callable[[], Event]:
    """Return what draws the panel and lets the thread begin; it goes on once the event is set that this returns."""
    go, made = Event(), live._made
    monkeypatch.setattr(live, "_made", lambda *given: made(*given) if go.wait(60) else None)

    def begin() -> Event:
        live.follow(bpy.context)
        assert live._tick() == live.BETWEEN
        return go

    return begin


def test_a_change_is_shown_in_place_and_leaves_no_trace(settings) -> None:
    """The model is hidden meanwhile; switched off, it is there as it was, with view and selection."""
    scene, build = bpy.context.scene, current_build(bpy.context.scene)
    root = state_of(build).root
    root.location.x += 3
    scene.legorize.top_layer = 2
    bpy.context.view_layer.update()
    before, bricks, place = content(), read_bricks(build), root.matrix_world.copy()
    assert not soon()
    settings.width = 12
    assert soon()
    shown = preview_in(scene)
    assert build.hide_viewport
    assert shown.hide_render
    assert builds(scene) == [build]
    assert len(shown.objects) == 3
    [points] = [thing for thing in shown.objects if thing.type == "MESH"]
    assert len(instances()) == len(points.data.vertices) > len(bricks)
    assert points.parent.matrix_world.translation.x == pytest.approx(place.translation.x, abs=0.2)
    assert "Preview" in live._live.said
    assert [thing.name for thing in chosen_sources(bpy.context)] == ["Cube.001"]
    assert not soon()
    switch(on=False)
    settings.width = 6
    bpy.context.view_layer.update()
    assert preview_in(scene) is None
    assert not build.hide_viewport
    assert root.select_get()
    assert bpy.context.view_layer.objects.active == root
    assert root.matrix_world == place
    assert scene.legorize.top_layer == 2
    assert_same(read_bricks(build), bricks)
    assert content() == before


def test_another_change_takes_the_place(settings) -> None:
    """There is one preview; what is the same is not computed again, and objects are read once."""
    state_of(current_build(bpy.context.scene)).root.location.x += 3
    bpy.context.view_layer.update()
    assert not soon()
    settings.width = 16
    assert soon()
    mesh, place = live._live.mesh, _place()
    settings.shell = 2
    assert soon()
    assert live._live.mesh is mesh
    assert _place() == pytest.approx(place)
    assert len([each for each in bpy.data.collections if "legorize_preview" in each]) == 1
    # what the panel has not drawn yet is left as well
    settings.shell = 3
    assert bpy.ops.legorize.end_preview() == {"FINISHED"}
    assert not bpy.ops.legorize.end_preview.poll()
    assert not soon()
    settings.shell = 1
    assert soon()


def _place() -> tuple[float, ...]:
    """Return where the preview stands."""
    [root] = [thing for thing in preview_in(bpy.context.scene).objects if thing.type == "EMPTY" and not thing.parent]
    return tuple(root.matrix_world.translation)


def test_a_preview_of_another_object_brings_the_first_one_back(settings) -> None:
    """Of two objects the one is hidden whose preview is shown; at the end none is, and the second one is selected."""
    build = current_build(bpy.context.scene)
    settings.width = 16
    assert soon()
    assert build.hide_viewport
    bpy.ops.object.select_all(action="DESELECT")
    bpy.ops.mesh.primitive_cube_add()
    other = bpy.context.object
    assert not soon()
    bpy.context.scene.legorize.settings.width = 12
    assert soon()
    assert not build.hide_viewport
    assert other.hide_viewport
    assert bpy.ops.legorize.end_preview() == {"FINISHED"}
    assert not build.hide_viewport
    assert not other.hide_viewport
    assert bpy.context.selected_objects == [other]


@pytest.mark.parametrize("name", ["build", "update", "clear"])
def test_buttons_end_it(settings, name: str) -> None:
    """The model takes its place, as if there had been no preview; nothing is left of a removed one."""
    settings.width = 14
    soon()
    assert getattr(bpy.ops.legorize, name)() == {"FINISHED"}
    assert preview_in(bpy.context.scene) is None
    assert not soon()
    assert not [each for each in bpy.data.collections if each.hide_viewport]
    if name == "clear":
        assert not instances()
        assert not bpy.data.objects["Cube.001"].hide_viewport
    else:
        [build] = builds(bpy.context.scene)
        assert state_of(build).summary["studs_x"] == 14


@pytest.mark.parametrize(("name", "chosen"), [("update", {}), ("show_method", {"step": "unit-bricks"})])
def test_buttons_end_what_is_still_being_made(settings, begun, name: str, chosen: dict[str, str]) -> None:
    """No preview comes up over the model afterwards."""
    settings.width = 14
    go = begun()
    assert getattr(bpy.ops.legorize, name)(**chosen) == {"FINISHED"}
    go.set()
    assert not waited()
    assert preview_in(bpy.context.scene) is None
    assert not [each for each in bpy.data.collections if each.hide_viewport]


def test_an_object_that_changes_meanwhile_is_read_again(begun) -> None:
    """The next preview shows its new form, not the one that the thread had begun with."""
    table = add_table_on_one_leg()
    switch(on=True)
    bpy.context.scene.legorize.settings.width = 12
    go = begun()
    table.scale.z *= 2
    go.set()
    assert waited()
    assert live._live.mesh is None


def _choose_another(table: bpy.types.Object) -> None:
    table.select_set(False)
    bpy.ops.mesh.primitive_cube_add()
    live.follow(bpy.context)


@pytest.mark.parametrize(
    "change",
    [
        lambda table: bpy.data.objects.remove(table),
        lambda table: table.users_collection[0].objects.unlink(table),
        _choose_another,
    ],
    ids=["deleted", "taken out", "another chosen"],
)
def test_what_is_gone_meanwhile_is_not_shown(begun, change: Callable[[bpy.types.Object], None]) -> None:
    """Nothing fails, and nothing is hidden that nobody has asked for any more."""
    table = add_table_on_one_leg()
    table.use_fake_user = True
    switch(on=True)
    bpy.context.scene.legorize.settings.width = 12
    go = begun()
    change(table)
    go.set()
    waited()
    assert preview_in(bpy.context.scene) is None
    assert not [thing for thing in bpy.data.objects if thing.hide_viewport]
    assert not live._live.said


def test_without_a_model_the_object_is_hidden_meanwhile() -> None:
    """It comes back selected; no file keeps a preview, and an undo leaves none."""
    table = add_table_on_one_leg()
    switch(on=True)
    settings = bpy.context.scene.legorize.settings
    for end in (live._end_everywhere, bpy.ops.legorize.end_preview):
        settings.width = 12 if settings.width != 12 else 13
        assert soon()
        assert table.hide_viewport
        assert chosen_sources(bpy.context) == [table]
        end()
        assert not table.hide_viewport
        assert bpy.context.selected_objects == [table]
    assert preview_in(bpy.context.scene) is None


def test_a_changed_object_is_read_again(settings) -> None:
    """It is shown as it is now."""
    settings.width = 12
    soon()
    bpy.data.objects["Cube.001"].scale.z *= 2
    bpy.data.objects["Cube.001"].hide_viewport = False
    bpy.context.view_layer.update()
    assert live._live.mesh is None


def test_another_weight_is_read(settings) -> None:
    """The preview has what is painted under the name that the panel says; a wrong name is told and shows nothing."""
    settings.width = 12
    soon()
    assert live._live.mesh.weight is None
    settings.weight = "face"
    soon()
    assert live._live.said.startswith("weight is 'face', but no vertex group")
    table = bpy.data.objects["Cube.001"]
    table.vertex_groups.new(name="leg").add(list(range(8)), 0.5, "REPLACE")
    settings.weight = "leg"
    soon()
    assert np.unique(live._live.mesh.weight).tolist() == [0, 0.5]


def test_what_is_too_large_is_refused(settings, monkeypatch) -> None:
    """One sentence says so, and the model is there as it was; settings that exclude each other are told as well."""
    settings.width = 12
    soon()
    monkeypatch.setattr(core_preview, "SECONDS", 0.0)
    settings.width = 13
    soon()
    assert "too large for a live preview" in live._live.said
    assert preview_in(bpy.context.scene) is None
    monkeypatch.undo()
    settings.hollow, settings.open_bottom = False, True
    assert not soon()
    assert live._live.said.startswith("Inside > Open bottom is on")
    settings.open_bottom = False
    live._live.mesh = None
    monkeypatch.setattr(live, "FACES", 5)
    soon()
    assert "too large for a live preview" in live._live.said


def test_a_large_one_is_shown_smaller(settings, monkeypatch) -> None:
    """The panel says how large, and that it should be larger."""
    monkeypatch.setattr(core_preview, "SECONDS", 0.15)
    settings.width = 200
    soon()
    assert "instead of 200 studs" in live._live.said
    assert preview_in(bpy.context.scene) is not None


def test_another_model_is_no_change(settings) -> None:
    """Its settings come with it; nobody has moved a slider."""
    scene = bpy.context.scene
    first = current_build(scene)
    settings.width = 12
    assert bpy.ops.legorize.build_beside() == {"FINISHED"}
    assert not soon()
    scene.legorize.build = first
    assert settings.width == 6
    assert not soon()
