"""Looks: settings that belong together, those that the add-on brings and those that the user saved."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

import bpy
from bl_operators.presets import AddPresetBase
from bpy.props import EnumProperty

from ..core.presets import PRESETS, preset_values
from ..core.settings import Settings
from .settings_properties import set_settings

FOLDER: Final = "legorize"
"""Below Blender's own folder of presets."""


class LEGORIZE_OT_look(bpy.types.Operator):
    """Choose settings that belong together."""

    bl_idname = "legorize.look"
    bl_label = "Choose Look"
    bl_description = "Choose settings that belong together; all others get their defaults"
    bl_options = {"REGISTER", "UNDO"}
    look: EnumProperty(
        name="Look",
        items=[(word, preset.name, preset.text.removesuffix(".")) for word, preset in PRESETS.items()],
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set all settings."""
        set_settings(context.scene.legorize.settings, Settings(**preset_values(self.look)))
        return {"FINISHED"}


class LEGORIZE_OT_save_look(AddPresetBase, bpy.types.Operator):
    """Save the settings under a name, or remove the look of this name."""

    bl_idname = "legorize.save_look"
    bl_label = "Save Look"
    bl_description = "Save all settings under a name"
    preset_menu = "LEGORIZE_MT_looks"
    preset_subdir = FOLDER
    preset_defines = ("settings = bpy.context.scene.legorize.settings",)
    preset_values = tuple(f"settings.{entry.name}" for entry in fields(Settings))


class LEGORIZE_MT_looks(bpy.types.Menu):
    """The looks of the add-on, and below them the user's own."""

    bl_label = "Look"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw both lists."""
        self.layout.operator_enum(LEGORIZE_OT_look.bl_idname, "look")
        self.layout.separator()
        bpy.types.Menu.draw_preset(self, context)


def draw_looks(layout: bpy.types.UILayout) -> None:
    """Draw the menu of looks, and the buttons that save and remove one's own."""
    row = layout.row(align=True)
    row.menu(LEGORIZE_MT_looks.__name__, icon="PRESET")
    row.operator(LEGORIZE_OT_save_look.bl_idname, text="", icon="ADD")
    row.operator(LEGORIZE_OT_save_look.bl_idname, text="", icon="REMOVE").remove_active = True


classes = (LEGORIZE_OT_look, LEGORIZE_OT_save_look, LEGORIZE_MT_looks)
register, unregister = bpy.utils.register_classes_factory(classes)
