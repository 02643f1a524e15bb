"""Update, builds side by side, and the panel that follows the chosen one with its settings."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.core import pipeline
from legorize_addon.core import stages as core_stages
from legorize_addon.core.errors import BuildError
from legorize_addon.scene import builds, read_bricks, sources_of, state_of
from legorize_addon.ui import updating
from legorize_addon.ui.current import current_build
from legorize_addon.ui.duplicates import adopt
from legorize_addon.ui.session import SESSION
from tests.blender.bricks import assert_same
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def settings() -> bpy.types.PropertyGroup:
    """Build a table on one leg, which needs supports, and return the settings of the panel."""
    SESSION.forget()
    add_table_on_one_leg()
    found = bpy.context.scene.legorize.settings
    found.width, found.layout = 10, "fast"
    assert bpy.ops.legorize.build() == {"FINISHED"}
    return found


def stages(monkeypatch, name="update") -> list[str]:
    """Run an operator; return the stages that had something to compute."""
    found = []
    plain = pipeline.legorize

    def watched(mesh, chosen, progress, *, trial, **more):
        before = set(map(id, SESSION.memo.entries))
        build = plain(mesh, chosen, progress, trial=trial, **more)
        found.extend(entry.stage for entry in trial.entries if id(entry) not in before)
        return build

    with monkeypatch.context() as patch:
        patch.setattr(pipeline, "legorize", watched)
        assert getattr(bpy.ops.legorize, name)() == {"FINISHED"}
    return list(dict.fromkeys(found))


def test_update_is_a_full_run_of_what_is_reached(settings, monkeypatch):
    """It computes the supports alone, as its tooltip says, and gives the bricks of a full run, in the same place."""
    scene = bpy.context.scene
    root = state_of(current_build(scene)).root
    root.location.x += 3
    scene.legorize.top_layer = 2
    assert "No setting has changed" in updating._outlook(bpy.context)
    settings.supports = "columns"
    assert "again: supports." in updating._outlook(bpy.context)
    place = root.matrix_basis.copy()
    bpy.ops.object.select_all(action="DESELECT")
    assert stages(monkeypatch) == ["supports"]
    [build] = builds(scene)
    updated = read_bricks(build)
    assert state_of(build).root.matrix_basis == place
    assert scene.legorize.top_layer == 2
    assert state_of(build).settings["supports"] == "columns"
    assert len(stages(monkeypatch, "build")) > 10
    assert_same(read_bricks(current_build(scene)), updated)


def test_a_failed_update_leaves_scene_and_memo(settings, monkeypatch):
    """The next update takes over what it would have taken over."""
    build, before = current_build(bpy.context.scene), SESSION.memo.entries

    def fail(*arguments, **more):
        raise BuildError("No.")

    settings.supports = "tree"
    with monkeypatch.context() as patch:
        patch.setattr(core_stages, "make_plan", fail)
        with pytest.raises(RuntimeError, match="No"):
            bpy.ops.legorize.update()
    assert builds(bpy.context.scene) == [build]
    assert SESSION.memo.entries is before


def test_another_file_forgets(settings):
    """After a file is opened an update is a full run, and its tooltip says so; what it keeps is told."""
    assert "MB" in updating._outlook(bpy.context)
    SESSION.forget()
    assert "Everything" in updating._outlook(bpy.context)
    assert len(SESSION.memo) == SESSION.memo.nbytes == 0


def test_builds_side_by_side(settings):
    """Each has its settings, which the panel shows with the build whose object is active; they do not touch."""
    scene, [first] = bpy.context.scene, builds(bpy.context.scene)
    state_of(first).root.rotation_euler.z = 0.5
    for word in ("columns", "none"):
        settings.supports = word
        assert bpy.ops.legorize.build_beside() == {"FINISHED"}
        scene.legorize.build = first
    assert [state_of(build).settings["supports"] for build in builds(scene)] == ["best", "columns", "none"]
    assert settings.supports == "best"
    bpy.context.view_layer.update()
    roots = [state_of(build).root.matrix_world for build in builds(scene)]
    gaps = [(roots[0].inverted() @ root).translation for root in roots]
    width = [state_of(build).extent[1][0] - state_of(build).extent[0][0] for build in builds(scene)]
    assert gaps[1].x > (width[0] + width[1]) / 2
    assert gaps[2].x > gaps[1].x + (width[1] + width[2]) / 2
    assert all(abs(gap.y) < 1e-2 and abs(gap.z) < 1e-2 for gap in gaps)
    updating.follow(scene, state_of(builds(scene)[1]).root)
    assert (current_build(scene), settings.supports) == (builds(scene)[1], "columns")
    updating.follow(scene, None)
    settings.supports = "tree"
    assert bpy.ops.legorize.update() == {"FINISHED"}
    assert sorted(state_of(build).settings["supports"] for build in builds(scene)) == ["best", "none", "tree"]


def test_nothing_to_update():
    """Without a build, or without what it was made of, the button is grey and says why."""
    assert not bpy.ops.legorize.update.poll()
    add_table_on_one_leg()
    bpy.context.scene.legorize.settings.width = 6
    table = bpy.context.object
    bpy.ops.legorize.build()
    assert bpy.ops.legorize.update.poll()
    bpy.data.objects.remove(table)
    assert not bpy.ops.legorize.update.poll()


def test_a_model_that_was_pasted_into_another_scene(settings):
    """It is made again of the objects in its first scene, though nothing here can be selected."""
    [first] = builds(bpy.context.scene)
    here, there = bpy.context.scene, bpy.data.scenes.new("there")
    bpy.ops.view3d.copybuffer()
    bpy.context.window.scene = there
    bpy.ops.view3d.pastebuffer()
    adopt(bpy.context)
    [copy] = builds(there)
    sources, n_bricks = sources_of(copy), len(read_bricks(copy))
    assert bpy.ops.legorize.update() == {"FINISHED"}
    [again] = builds(there)
    assert sources_of(again) == sources
    assert len(read_bricks(again)) == n_bricks
    assert bpy.ops.legorize.build_beside() == {"FINISHED"}
    assert len(builds(there)) == 2
    assert builds(here) == [first]
    assert not set(sources) & set(there.objects)
