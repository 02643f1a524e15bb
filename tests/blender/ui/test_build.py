"""The buttons: a model from one click, one sentence when it cannot be, and the scene back on undo."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import numpy as np
import pytest

import legorize_addon
from legorize_addon.core import pipeline
from legorize_addon.core.errors import Cancelled
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.progress import Progress
from legorize_addon.core.settings import Settings
from legorize_addon.core.units import STUD
from legorize_addon.scene.builds import builds
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.state import BUILD_KEY, state_of
from legorize_addon.ui import build as operators
from legorize_addon.ui import job, panels
from legorize_addon.ui.current import current_build
from legorize_addon.ui.requests import chosen_sources
from tests.blender.bricks import assert_same, content, instances
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")

WHITE = 15


@pytest.fixture
def table() -> bpy.types.Object:
    """Return a selected table on one leg, to be built 12 studs long: supports have to carry its ends."""
    add_table_on_one_leg()
    bpy.context.scene.legorize.settings.width = 12
    return bpy.context.object


@pytest.fixture
def box() -> bpy.types.Object:
    """Return a selected box of 2 x 1 x 1 Blender units, to be built 12 studs long."""
    bpy.ops.mesh.primitive_cube_add(size=1, scale=(2, 1, 1))
    bpy.context.scene.legorize.settings.width = 12
    return bpy.context.object


def corners() -> np.ndarray:
    """Return the corners of the box around all instances in Blender units, (2, 3), studs left out."""
    points = [
        np.array([vertex.co for vertex in mesh.vertices if vertex.co.z < 9.55]) @ matrix[:3, :3].T + matrix[:3, 3]
        for mesh, _, matrix in instances()
    ]
    return np.array(
        [np.min([each.min(axis=0) for each in points], axis=0), np.max([each.max(axis=0) for each in points], axis=0)]
    )


@pytest.mark.parametrize("way", ["EXEC_DEFAULT", "INVOKE_DEFAULT"])
def test_one_click_builds(box, way: str) -> None:
    """The button gives a model over its source, as long as asked for; the source is hidden, its mesh untouched."""
    before = np.array([vertex.co for vertex in box.data.vertices])
    assert bpy.ops.legorize.build(way) == {"FINISHED"}
    build = current_build(bpy.context.scene)
    assert build.name == f"Legorize {box.name}"
    assert build[BUILD_KEY]["summary"]["studs_x"] == 12
    assert Settings(**build[BUILD_KEY]["settings"].to_dict()) == Settings(width=12)
    # a stud is 2/12 of a unit here; bricks are whole, and a tenth of a mm narrower on each side
    stud = 2 / 12
    np.testing.assert_allclose(corners(), [[-1, -0.5, -0.5], [1, 0.5, 0.5]], atol=1.2 * stud / 2)
    np.testing.assert_allclose(corners()[:, 0], [-1, 1], atol=0.02 * stud)
    assert box.hide_viewport
    np.testing.assert_array_equal([vertex.co for vertex in box.data.vertices], before)


def test_scale_of_the_scene_counts(box) -> None:
    """In a scene in millimetres the original size is that in millimetres; the bricks still lie over the box."""
    bpy.context.scene.unit_settings.scale_length = 0.001
    box.scale *= 60
    settings = bpy.context.scene.legorize.settings
    settings.size_by, settings.scale = "scale", 10.0
    bpy.ops.legorize.build()
    assert current_build(bpy.context.scene)[BUILD_KEY]["summary"]["studs_x"] == 2 * 60 / STUD
    np.testing.assert_allclose(corners()[:, 0], [-60, 60], atol=0.2)


@pytest.mark.parametrize(("up", "size"), [("auto", (2, 1, 3)), ("y", (2, 3, 1)), ("x", (3, 1, 2))])
def test_axis_that_points_up(box, up: str, size: tuple[float, float, float]) -> None:
    """The model stands as the object is seen; with an axis chosen it is turned, on the same ground and middle."""
    box.scale, box.location = (1, 1, 3), (10, -5, 1.5)
    settings = bpy.context.scene.legorize.settings
    settings.size_by, settings.scale, settings.up = "scale", 10 * 6 * STUD / 1000, up
    bpy.ops.legorize.build()
    low, high = corners()
    stud = 1 / 6
    np.testing.assert_allclose(high - low, size, atol=1.2 * stud)
    np.testing.assert_allclose([*(low + high)[:2] / 2, low[2]], (10, -5, 0), atol=0.6 * stud)


def test_again_takes_its_place(box) -> None:
    """With the model selected, and with nothing selected, the button builds the same source once more."""
    bpy.ops.legorize.build()
    once = content()
    assert bpy.context.selected_objects == [current_build(bpy.context.scene)[BUILD_KEY]["root"]]
    bpy.ops.legorize.build()
    assert content() == once
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.scene.legorize.settings.width = 8
    bpy.ops.legorize.build()
    [build] = builds(bpy.context.scene)
    assert build[BUILD_KEY]["summary"]["studs_x"] == 8
    assert box.hide_viewport


def test_same_click_same_bricks(box) -> None:
    """Two builds with the same settings are equal to the last brick."""
    bpy.ops.legorize.build()
    first = read_bricks(current_build(bpy.context.scene))
    bpy.ops.legorize.build()
    assert_same(read_bricks(current_build(bpy.context.scene)), first)


def test_several_objects_are_one_model(box) -> None:
    """All selected objects with a surface make one model; lamps stay what they are."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=(3, 0, 0))
    cube = bpy.context.object
    bpy.ops.object.light_add()
    lamp = bpy.context.object
    for thing in (box, cube, lamp):
        thing.select_set(True)
    bpy.ops.legorize.build()
    [build] = builds(bpy.context.scene)
    assert build.name == f"Legorize {box.name} + {cube.name}"
    assert [box.hide_viewport, cube.hide_viewport, lamp.hide_viewport] == [True, True, False]
    np.testing.assert_allclose(corners()[:, 0], [-1, 3.5], atol=0.1)


def test_undo_gives_the_scene_back(box) -> None:
    """One undo takes a build away with all its data; one redo brings it back; then a second build can be undone."""
    name = box.name
    bpy.ops.ed.undo_push(message="before")
    before = content()
    bpy.ops.legorize.build("EXEC_DEFAULT", True)
    after = content()
    bricks = read_bricks(current_build(bpy.context.scene))
    bpy.ops.ed.undo()
    assert content() == before
    assert not bpy.data.objects[name].hide_viewport
    assert current_build(bpy.context.scene) is None
    bpy.ops.ed.redo()
    assert content() == after
    assert_same(read_bricks(current_build(bpy.context.scene)), bricks)
    bpy.context.scene.legorize.settings.width = 6
    bpy.ops.legorize.build("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    assert_same(read_bricks(current_build(bpy.context.scene)), bricks)


def test_undo_brings_a_removed_model_back(box) -> None:
    """Removing the model can be undone too."""
    bpy.ops.legorize.build()
    bricks = read_bricks(current_build(bpy.context.scene))
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.legorize.clear("EXEC_DEFAULT", True)
    assert current_build(bpy.context.scene) is None
    bpy.ops.ed.undo()
    assert_same(read_bricks(current_build(bpy.context.scene)), bricks)
    assert len(instances()) == len(bricks)


def test_clear_leaves_the_source(box) -> None:
    """Removing the model leaves what was there before, shown again."""
    before = content()
    bpy.ops.legorize.build()
    bpy.ops.legorize.clear()
    assert content() == before
    assert not box.hide_viewport


def failing(error: Exception):
    """Return a core that raises an error."""

    def legorize(mesh, settings, progress: Progress, **more) -> None:
        raise error

    return legorize


def test_bad_input_is_one_sentence(box) -> None:
    """What the user can mend is reported as an error in one sentence, and nothing changes."""
    box.data.clear_geometry()
    before = content()
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.legorize.build()
    message = str(caught.value)
    assert message.startswith("Error: ")
    assert "Traceback" not in message
    assert message.strip().endswith(".")
    assert content() == before
    assert not box.hide_viewport


def test_bad_palette_is_one_sentence(box) -> None:
    """So is a setting that only the core can judge."""
    bpy.context.scene.legorize.settings.palette = "4, red"
    with pytest.raises(RuntimeError, match=r"^Error: [^\n]*\.\n?$"):
        bpy.ops.legorize.build()


def test_a_bug_keeps_its_traceback(box, monkeypatch) -> None:
    """Anything else than an expected failure comes out as it is."""
    monkeypatch.setattr(pipeline, "legorize", failing(ZeroDivisionError("a bug")))
    with pytest.raises(RuntimeError, match=r"Traceback[\s\S]*ZeroDivisionError: a bug"):
        bpy.ops.legorize.build()


def test_stopping_changes_nothing(box, monkeypatch) -> None:
    """A run that was stopped leaves the scene alone and is no error."""
    monkeypatch.setattr(pipeline, "legorize", failing(Cancelled()))
    before = content()
    assert bpy.ops.legorize.build() == {"CANCELLED"}
    assert content() == before
    assert not box.hide_viewport


def test_buttons_say_why_they_are_grey(box, monkeypatch) -> None:
    """Each button tells in its tooltip what is missing."""
    with pytest.raises(RuntimeError, match="Legorize an object first"):
        bpy.ops.legorize.clear()
    with pytest.raises(RuntimeError, match="Legorize an object first"):
        bpy.ops.legorize.export_ldr(filepath="x.ldr")
    bpy.ops.object.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="Select an object"):
        bpy.ops.legorize.build()
    box.select_set(True)
    work = job.Job(lambda progress: [progress("working", 0.0) for _ in iter(int, 1)])
    work.start()
    with pytest.raises(RuntimeError, match="press Esc"):
        bpy.ops.legorize.build()
    job.stop()
    assert operators.LEGORIZE_OT_build.poll(bpy.context)


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "WEIGHT_PAINT"])
def test_the_button_leaves_other_modes(box, mode: str) -> None:
    """In the middle of editing the object is taken with its last changes, and Blender is in Object Mode then."""
    bpy.context.scene.legorize.settings.width = 4
    layers = []
    for change in (False, True):
        bpy.ops.object.mode_set(mode=mode)
        if change and mode == "EDIT":
            bpy.ops.mesh.select_all(action="SELECT")
            bpy.ops.transform.resize(value=(1, 1, 3))
        assert bpy.ops.legorize.build() == {"FINISHED"}
        assert bpy.context.mode == "OBJECT"
        layers.append(state_of(current_build(bpy.context.scene)).layers)
        bpy.ops.legorize.clear()
        box.select_set(True)
        bpy.context.view_layer.objects.active = box
    assert (layers[1] > 2 * layers[0]) == (mode == "EDIT")


def test_opening_a_file_stops_the_job() -> None:
    """No thread goes on when its scene is gone; nor when the add-on is switched off."""
    for leave in (bpy.ops.wm.read_homefile, legorize_addon.unregister):
        work = job.Job(lambda progress: [progress("working", 0.0) for _ in iter(int, 1)])
        work.start()
        leave()
        assert not work.is_alive()
    legorize_addon.register()


def test_export_reads_back(box, tmp_path) -> None:
    """The LDraw file holds the bricks of the build, also after opening the saved .blend."""
    bpy.ops.legorize.build()
    bricks = read_bricks(current_build(bpy.context.scene))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / "model.ldr")) == {"FINISHED"}
    text = (tmp_path / "model.ldr").read_bytes().decode()
    found = read_ldraw(text, load_catalogue()).bricks
    assert rows(found) == rows(bricks)
    assert len(set(rows(bricks))) == len(bricks) > 1


def test_supports_are_at_hand(table) -> None:
    """Supports come with the model, hidden at first; the figures of the panel are those of the model without them."""
    bpy.context.scene.legorize.settings.hanging = 0
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    bricks = read_bricks(build)
    outside = bricks.role == Role.SUPPORT_OUTSIDE
    assert outside.any()
    assert set(bricks.colour[outside].tolist()) == {WHITE}
    state = build[BUILD_KEY].to_dict()
    assert state["summary"]["bricks"] == len(instances()) == len(bricks) - outside.sum()
    assert state["building"]["removed"] == outside.sum()
    view = bpy.context.scene.legorize
    assert not view.roles.support_outside
    view.roles.support_outside = True
    assert len(instances()) == len(bricks)
    lines = panels._building_figures(build[BUILD_KEY]["building"])
    assert lines[0].startswith(f"Support bricks to take out: {outside.sum()}, ")
    assert f"building steps: {state['building']['steps']}" in lines[2]
    assert view.step == state["building"]["steps"] > bricks.step.max() + 1
    assert panels._building_figures(None) == ()


def test_heat_map_of_a_model_with_supports(table) -> None:
    """The map colours the model and leaves supports grey; it goes as it came."""
    bpy.ops.legorize.build()
    view = bpy.context.scene.legorize
    before = content()
    view.heat_map = view.roles.support_outside = True
    assert {name.split()[0] for _, name, _ in instances()} == {"Heat"}
    view.heat_map = False
    assert content() == before


def test_exports_of_a_model_with_supports(table, tmp_path) -> None:
    """The .ldr holds the finished model, the .mpd all of it, with supports that are taken out; both also reopened."""
    bpy.context.scene.legorize.settings.hanging = 0
    bpy.ops.legorize.build()
    bricks = read_bricks(current_build(bpy.context.scene))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / "model.ldr")) == {"FINISHED"}
    assert bpy.ops.legorize.export_mpd(filepath=str(tmp_path / "model.mpd")) == {"FINISHED"}
    finished, whole = (
        read_ldraw((tmp_path / name).read_bytes().decode(), load_catalogue()).bricks
        for name in ("model.ldr", "model.mpd")
    )
    assert rows(finished) == rows(bricks.take(bricks.role != Role.SUPPORT_OUTSIDE))
    assert rows(whole) == rows(bricks)
    assert set(whole.role.tolist()) == set(bricks.role.tolist())
    text = (tmp_path / "model.mpd").read_text()
    assert text.startswith("0 FILE model.ldr")
    assert text.count("0 !LEOCAD PIECE STEP_HIDE") == (bricks.role == Role.SUPPORT_OUTSIDE).sum() > 0


def rows(bricks: Bricks) -> list[tuple[int, ...]]:
    """Return part, colour and corner of each brick, in order."""
    return sorted(map(tuple, np.column_stack([bricks.part, bricks.colour, bricks.corner]).tolist()))


def test_export_where_nobody_can_write(box, tmp_path) -> None:
    """A path that cannot be written gives a sentence; what was there stays, and nothing is left over."""
    bpy.ops.legorize.build()
    (tmp_path / "folder.ldr").mkdir()
    (tmp_path / "file").write_text("old")
    for path in (tmp_path / "folder.ldr", tmp_path / "nowhere" / "model.ldr", tmp_path / "file" / "model.ldr"):
        with pytest.raises(
            RuntimeError, match=r"^Error: The file .* cannot be written \(.*\): choose another .*\.\n?$"
        ):
            bpy.ops.legorize.export_ldr(filepath=str(path))
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["file", "folder.ldr"]


@pytest.mark.parametrize("way", ["export_ldr", "export_mpd", "render_still"])
def test_no_name_is_one_sentence(box, way: str, monkeypatch: pytest.MonkeyPatch, tmp_path) -> None:
    """An empty name and a working folder that is gone are told; nothing is written."""
    bpy.ops.legorize.build()
    export = getattr(bpy.ops.legorize, way)
    with pytest.raises(RuntimeError, match=r"^Error: The file has no name: give it one\.\n?$"):
        export(filepath="")
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    with pytest.raises(RuntimeError, match="working folder is no longer there"):
        export(filepath="model")


def test_names_are_no_commands(box, tmp_path) -> None:
    """A model called like a command, in a file with a line end in its name, reads back."""
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    build.name = "STEP"
    name = "a\n1 4 0 0 0.ldr"
    assert bpy.ops.legorize.export_ldr(filepath=str(tmp_path / name)) == {"FINISHED"}
    text = (tmp_path / name).read_text()
    assert text.startswith("0 Model STEP\n0 Name: a 1 4 0 0 0.ldr\n")
    assert rows(read_ldraw(text, load_catalogue()).bricks) == rows(read_bricks(build))


def test_two_slashes_are_the_folder_of_the_scene(box, tmp_path) -> None:
    """As everywhere in Blender, // is where the .blend file lies."""
    bpy.ops.legorize.build()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert bpy.ops.legorize.export_ldr(filepath="//model.ldr") == {"FINISHED"}
    assert (tmp_path / "model.ldr").exists()


def test_picture_button(box, tmp_path) -> None:
    """The render button writes a picture of the asked size."""
    bpy.ops.legorize.build()
    path = tmp_path / "still.png"
    assert bpy.ops.legorize.render_still(filepath=str(path), samples=1, width=32, height=16) == {"FINISHED"}
    image = bpy.data.images.load(str(path))
    assert tuple(image.size) == (32, 16)
    with pytest.raises(RuntimeError, match="cannot be written"):
        bpy.ops.legorize.render_still(filepath=str(tmp_path / "nowhere" / "still.png"), samples=1)


@pytest.fixture
def twins(tmp_path) -> tuple[bpy.types.Object, bpy.types.Object]:
    """Return a box of the file and a linked one of the same name, twice as long, at another place."""
    for length, x in ((4, 20), (2, 0)):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        bpy.ops.mesh.primitive_cube_add(size=1, location=(x, 0, 0), scale=(length, 1, 1))
        bpy.context.object.name = "twin"
        if x:
            bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"), copy=True)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (_, wanted):
        wanted.objects = ["twin"]
    [linked] = wanted.objects
    bpy.context.scene.collection.objects.link(linked)
    bpy.context.scene.legorize.settings.size_by = "scale"
    bpy.context.scene.legorize.settings.scale = 10 * 6 * STUD / 1000
    local = next(thing for thing in bpy.data.objects if thing.library is None)
    assert local.name == linked.name
    return local, linked


@pytest.mark.parametrize("which", [0, 1])
def test_twins_are_told_apart(twins, which: int) -> None:
    """Of a linked object and one of the file with its name the chosen one is built, hidden, built again and shown."""
    chosen, other = twins[which], twins[1 - which]
    bpy.ops.object.select_all(action="DESELECT")
    chosen.select_set(True)
    for _ in range(2):
        bpy.ops.legorize.build()
        build = current_build(bpy.context.scene)
        assert build[BUILD_KEY]["summary"]["studs_x"] == (12, 24)[which]
        assert (chosen.hide_viewport, other.hide_viewport) == (True, False)
        assert operators.chosen_sources(bpy.context) == [chosen]
    bpy.ops.legorize.clear()
    assert (chosen.hide_viewport, other.hide_viewport) == (False, False)


def test_both_twins_are_one_model(twins) -> None:
    """Both are built and hidden, in the same order every time."""
    for twin in twins:
        twin.select_set(True)
    assert operators.chosen_sources(bpy.context) == list(twins)
    bpy.ops.legorize.build()
    assert current_build(bpy.context.scene).name == "Legorize twin + twin"
    assert all(twin.hide_viewport for twin in twins)


@pytest.mark.parametrize("shown", [True, False])
def test_linked_sources_stay_hidden_in_a_saved_file(twins, shown: bool, tmp_path) -> None:
    """A file cannot keep that an object of another file is hidden: it is hidden again when the file is opened."""
    twins[0].select_set(False)
    twins[1].select_set(True)
    bpy.ops.legorize.build()
    bpy.context.scene.legorize.show_sources = shown
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    [linked] = [thing for thing in bpy.data.objects if thing.library is not None]
    [local] = [thing for thing in bpy.data.objects if thing.name == linked.name and thing.library is None]
    assert (linked.hide_viewport, linked.hide_render) == (not shown, not shown)
    assert not local.hide_viewport
    bpy.ops.legorize.clear()
    assert not linked.hide_viewport


def while_building(monkeypatch, change) -> None:
    """Let something happen between the reading of objects and the showing of bricks."""
    legorize = pipeline.legorize

    def changing(*arguments, **more):
        change()
        return legorize(*arguments, **more)

    monkeypatch.setattr(pipeline, "legorize", changing)


def test_renamed_while_building(box, monkeypatch) -> None:
    """An object that gets another name meanwhile, and one that gets its old name, are told apart."""

    def rename() -> None:
        box.name = "renamed"
        bpy.context.scene.collection.objects.link(bpy.data.objects.new("Cube", None))

    while_building(monkeypatch, rename)
    bpy.ops.legorize.build()
    assert box.hide_viewport
    assert not bpy.data.objects["Cube"].hide_viewport


def test_deleted_while_building(box, monkeypatch) -> None:
    """The model of an object that is deleted meanwhile is shown, and can be removed."""
    while_building(monkeypatch, lambda: bpy.data.objects.remove(box))
    bpy.ops.legorize.build()
    assert instances()
    assert operators.chosen_sources(bpy.context) == []
    bpy.ops.legorize.clear()
    assert not builds(bpy.context.scene)


def test_scene_deleted_while_building(box, monkeypatch) -> None:
    """A scene that is deleted meanwhile is missed in one sentence; the other scene gets nothing."""
    bpy.data.scenes.new("other")
    while_building(monkeypatch, lambda: bpy.data.scenes.remove(bpy.context.scene))
    with pytest.raises(RuntimeError, match=r"^Error: The scene was deleted while [^\n]*\.\n?$"):
        bpy.ops.legorize.build()
    assert not [collection for collection in bpy.data.collections if BUILD_KEY in collection]


def test_other_scene_while_building(box, monkeypatch) -> None:
    """The model comes into the scene in which it was asked for, whatever scene is looked at meanwhile."""
    first, second = bpy.context.scene, bpy.data.scenes.new("other")
    while_building(monkeypatch, lambda: setattr(bpy.context.window, "scene", second))
    bpy.ops.legorize.build()
    assert [len(builds(scene)) for scene in (first, second)] == [1, 0]


@pytest.mark.parametrize("first", [0, 1])
@pytest.mark.parametrize("hidden", [True, False])
def test_one_object_in_two_scenes(box, first: int, hidden: bool) -> None:
    """An object built in two scenes is shown as it was before when both models are gone, whichever goes first."""
    scenes = [bpy.context.scene, bpy.data.scenes.new("other")]
    scenes[1].collection.objects.link(box)
    box.hide_render = hidden
    for scene in scenes:
        with bpy.context.temp_override(scene=scene, view_layer=scene.view_layers[0], selected_objects=[box]):
            scene.legorize.settings.width = 6
            bpy.ops.legorize.build()
    assert [len(builds(scene)) for scene in scenes] == [1, 1]
    for scene, gone in ((scenes[first], False), (scenes[1 - first], True)):
        assert box.hide_viewport
        clear_build(scene, builds(scene)[0])
        assert box.hide_viewport != gone
    assert box.hide_render == hidden


def test_a_giant_is_refused_without_a_window(box) -> None:
    """What is larger than the limits is refused, and built if it is wanted all the same; the settings stay."""
    settings = bpy.context.scene.legorize.settings
    settings.limit_size = 5
    before = content()
    with pytest.raises(RuntimeError, match=r"^Error: The model would be [^\n]*raise Limits > Size \(cm\) to 10\.\n?$"):
        bpy.ops.legorize.build()
    assert content() == before
    assert bpy.ops.legorize.build(larger=True) == {"FINISHED"}
    assert settings.limit_size == 5


def test_a_giant_is_a_question_in_a_window(box, monkeypatch) -> None:
    """Before a job begins, the same sentence is asked; the answer builds the model."""
    bpy.context.scene.legorize.settings.limit_size = 5
    asked: list[str] = []
    monkeypatch.setattr(operators, "ask", asked.append)
    pressed = SimpleNamespace(larger=False, afresh=False, _sources=chosen_sources)
    order = operators.LEGORIZE_OT_build._take_order(pressed, bpy.context)
    assert operators.LEGORIZE_OT_build._begin(None, bpy.context, order) == {"CANCELLED"}
    [sentence] = asked
    assert sentence.endswith("raise Limits > Size (cm) to 10.")
    assert job.running() is None
    assert bpy.ops.legorize.build_larger("EXEC_DEFAULT", reason=sentence) == {"FINISHED"}
    assert current_build(bpy.context.scene) is not None


def test_end_of_the_memory_is_one_sentence(box, monkeypatch) -> None:
    """A scene that does not get its model for want of memory says so in a sentence."""

    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr(operators, "show_result", full)
    with pytest.raises(RuntimeError, match=r"^Error: There is not enough memory[^\n]*\.\n?$"):
        bpy.ops.legorize.build()


def test_what_cannot_be_selected_is_named(box) -> None:
    """With nothing chosen, the button says what to do first where an object is hidden or its collection is unticked."""

    def said() -> str:
        bpy.context.view_layer.update()
        with pytest.raises(RuntimeError) as caught:
            bpy.ops.legorize.build()
        return str(caught.value)

    shelf = bpy.data.collections.new("shelf")
    bpy.context.scene.collection.children.link(shelf)
    for collection in box.users_collection:
        collection.objects.unlink(box)
    shelf.objects.link(box)
    box.select_set(False)
    assert "Select an object with a surface." in said()
    box.hide_set(True)
    assert f"{box.name!r} is hidden: show it" in said()
    box.hide_set(False)
    bpy.context.view_layer.layer_collection.children[shelf.name].exclude = True
    assert f"{box.name!r} is in a collection that is unticked in the outliner: tick it" in said()
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.select_set(False)
    assert "Select an object with a surface." in said()
