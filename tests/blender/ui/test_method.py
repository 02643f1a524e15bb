"""The buttons that show and write the steps of the method."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.core.model.bricks import Role
from legorize_addon.scene.builds import builds, line_objects
from legorize_addon.ui.current import current_build
from legorize_addon.view.visibility import roles_shown
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def scene() -> bpy.types.Scene:
    """Return a scene with a table on one leg."""
    add_table_on_one_leg()
    bpy.context.object.name = "Table"
    bpy.context.scene.legorize.settings.width = 12
    bpy.context.scene.legorize.settings.hanging = 0
    return bpy.context.scene


def test_a_step_is_shown_and_its_trajectories_switched(scene):
    """The panel then shows the step; the switch works on its trajectories; the next step takes its place."""
    assert bpy.ops.legorize.show_method(step="unit-bricks", lines="colours") == {"FINISHED"}
    build = current_build(scene)
    assert build.name == "Legorize Table unit bricks"
    assert line_objects(build)
    assert not scene.legorize.trajectories
    scene.legorize.trajectories = True
    assert not any(thing.hide_render for thing in line_objects(build))
    assert bpy.ops.legorize.show_method(step="trajectories") == {"FINISHED"}
    assert [each.name for each in builds(scene)] == ["Legorize Table trajectories"]


def test_the_files_have_the_supports_of_the_model(scene, tmp_path):
    """Written without a model, no support is drawn; with one, its supports are."""
    assert bpy.ops.legorize.write_method(filepath=str(tmp_path / "one"), lines="sides") == {"FINISHED"}
    texts = [path.read_text(encoding="utf-8") for path in sorted((tmp_path / "one" / "hollowing").iterdir())]
    assert not any("support outside" in text for text in texts)
    assert (tmp_path / "one" / "tree.txt").read_text(encoding="utf-8").startswith("Layer 1, plate ")
    assert bpy.ops.legorize.build() == {"FINISHED"}
    assert Role.SUPPORT_OUTSIDE in roles_shown(current_build(scene))
    assert bpy.ops.legorize.write_method(filepath=str(tmp_path / "two"), lines="sides") == {"FINISHED"}
    texts = [path.read_text(encoding="utf-8") for path in sorted((tmp_path / "two" / "hollowing").iterdir())]
    assert any("support outside" in text for text in texts)


def test_a_size_in_parts_is_refused(scene):
    """One sentence, and no model."""
    scene.legorize.settings.size_by = "parts"
    with pytest.raises(RuntimeError, match="choose the width"):
        bpy.ops.legorize.show_method(step="hollowing")
    assert not builds(scene)


def shown_panels() -> set[str]:
    """Return the panels about a build that are there."""
    panels = (
        "LEGORIZE_PT_result",
        "LEGORIZE_PT_edits",
        "LEGORIZE_PT_stability",
        "LEGORIZE_PT_layers",
        "LEGORIZE_PT_lots",
        "LEGORIZE_PT_export",
    )
    return {name.removeprefix("LEGORIZE_PT_") for name in panels if getattr(bpy.types, name).poll(bpy.context)}


def offered() -> set[str]:
    """Return what may be done with the build that the panel shows."""
    return {name for name in (*OF_STEPS, *OF_MODELS) if getattr(bpy.ops.legorize, name).poll()}


OF_STEPS = {"clear", "export_ldr", "render_still"}
OF_MODELS = {"again", "plan_steps", "pick", "show_weakest", "export_list", "export_folder", "mark_asset", "update"}


def test_a_step_is_no_model(scene):
    """Nothing is said of whether it stands, and it is not laid, planned nor changed; the model beside it is."""
    assert bpy.ops.legorize.build() == {"FINISHED"}
    model = current_build(scene)
    everything = {"result", "edits", "stability", "layers", "lots", "export"}
    assert shown_panels() == everything
    assert offered() == OF_STEPS | OF_MODELS
    assert bpy.ops.legorize.show_method(step="hollowing") == {"FINISHED"}
    step = current_build(scene)
    assert step != model
    assert shown_panels() == {"result", "layers", "export"}
    assert offered() == OF_STEPS
    scene.legorize.build = model
    assert shown_panels() == everything
    assert offered() == OF_STEPS | OF_MODELS
    scene.legorize.build = step
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert builds(scene) == [model]
