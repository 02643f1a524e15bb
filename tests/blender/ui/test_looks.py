"""Looks set all settings at once; one's own come back from Blender's presets."""

from __future__ import annotations

from pathlib import Path

import bpy
import pytest

from legorize_addon.core.presets import PRESETS, preset_values
from legorize_addon.core.settings import Settings
from legorize_addon.ui import panels
from legorize_addon.ui.looks import look_of
from legorize_addon.ui.settings_properties import settings_of

pytestmark = pytest.mark.usefixtures("addon")


def chosen() -> Settings:
    """Return the settings of the scene."""
    return settings_of(bpy.context.scene.legorize.settings)


@pytest.mark.parametrize("word", PRESETS)
def test_a_look_sets_all_settings(word: str) -> None:
    """What was chosen before is gone, and undone settings are not written into the file."""
    group = bpy.context.scene.legorize.settings
    group.plates, group.seed = "none", 7
    assert bpy.ops.legorize.look(look=word) == {"FINISHED"}
    assert chosen() == Settings(**preset_values(word))
    assert not group.is_property_set("seed")


def test_a_look_leaves_the_size_and_is_told() -> None:
    """Who asked for 20 cm still gets 20 cm, unless the look is about the size; its name stands in the panel."""
    group = bpy.context.scene.legorize.settings
    assert look_of(group) == "display"
    group.size_by, group.cm = "cm", 20.0
    assert look_of(group) == "display"
    bpy.ops.legorize.look(look="bricks")
    assert (group.size_by, group.cm, look_of(group)) == ("cm", 20.0, "bricks")
    bpy.ops.legorize.look(look="desk")
    assert (group.size_by, group.width, look_of(group)) == ("width", 24, "desk")
    group.seed = 7
    assert look_of(group) is None


def test_a_look_helps_out_of_settings_that_exclude_each_other() -> None:
    """What no model can be built with is replaced, not read."""
    group = bpy.context.scene.legorize.settings
    group.dithering, group.one_to_one, group.size_by, group.cm = "ordered", True, "cm", 20.0
    assert bpy.ops.legorize.look(look="bricks") == {"FINISHED"}
    assert (chosen().dithering, chosen().cm) == ("none", 20.0)


def test_own_looks_come_back() -> None:
    """All settings are saved under a name, and set again by it; a second click removes them."""
    group = bpy.context.scene.legorize.settings
    group.width, group.plates, group.cusp = 33, "none", 1.7
    mine = chosen()
    assert bpy.ops.legorize.save_look(name="My own") == {"FINISHED"}
    [file] = [
        Path(folder) / "My_own.py"
        for folder in bpy.utils.preset_paths("legorize")
        if (Path(folder) / "My_own.py").exists()
    ]
    bpy.ops.legorize.look(look="desk")
    assert chosen() != mine
    bpy.ops.script.execute_preset(filepath=str(file), menu_idname="LEGORIZE_MT_looks")
    assert chosen() == mine
    assert bpy.ops.legorize.save_look(remove_name=True, name="My own") == {"FINISHED"}
    assert not file.exists()


def test_results_stand_above_the_settings() -> None:
    """The button, the size, what came out, and then all that few people change, closed."""
    names = [panel.bl_label for panel in panels.classes]
    assert names[:3] == ["Legorize", "Palette", "Result"]
    assert names.index("Result") < names.index("Advanced") < names.index("Colours")
    inside = {
        panel.bl_label for panel in panels.classes if getattr(panel, "bl_parent_id", "") == "LEGORIZE_PT_advanced"
    }
    assert {"Colours", "Supports", "Bricks"} <= inside
