"""Looks: settings that belong together, those that the add-on brings and those that the user saved."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Final

import bpy
from bl_operators.presets import AddPresetBase
from bpy.props import EnumProperty

from ..core.presets import PRESETS, preset_values
from ..core.settings import Settings
from .settings_properties import set_settings, value_of

FOLDER: Final = "legorize"
"""Below Blender's own folder of presets."""


_SIZE: Final = frozenset(entry.name for entry in fields(Settings) if entry.metadata["group"] == "Size")
"""Settings that a look leaves as they are, unless it has a size of its own."""


def look_of(settings: Any) -> str | None:
    """Return the look that settings, by their names, are those of, whatever the size where it has none; None of none.

    Of several, which differ in their sizes, the one that says most.
    """
    found = None
    for word, preset in PRESETS.items():
        left = frozenset() if _SIZE & preset.values.keys() else _SIZE
        wanted = {entry.name: preset.values.get(entry.name, entry.default) for entry in fields(Settings)}
        same = all(value_of(getattr(settings, name)) == value for name, value in wanted.items() if name not in left)
        if same and (found is None or len(preset.values) > len(PRESETS[found].values)):
            found = word
    return found


def with_look(settings: Any, word: str) -> Settings:
    """Return a look, in the size of settings unless it has one; nothing else of these is read, as it may be wrong."""
    values = preset_values(word)
    kept = {} if _SIZE & values.keys() else {name: value_of(getattr(settings, name)) for name in _SIZE}
    return Settings(**{**kept, **values})


class LEGORIZE_OT_look(bpy.types.Operator):
    """Choose settings that belong together."""

    bl_idname = "legorize.look"
    bl_label = "Choose Look"
    bl_description = "Choose settings that belong together; all others but the size get their defaults"
    bl_options = {"REGISTER", "UNDO"}
    look: EnumProperty(
        name="Look",
        items=[(word, preset.name, preset.text.removesuffix(".")) for word, preset in PRESETS.items()],
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set all settings, the size only if the look has one."""
        group = context.scene.legorize.settings
        set_settings(group, with_look(group, self.look))
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
        # without this folder, Blender would draw an entry that says so
        if bpy.utils.preset_paths(FOLDER):
            self.layout.separator()
            bpy.types.Menu.draw_preset(self, context)


def draw_looks(layout: bpy.types.UILayout, settings: bpy.types.PropertyGroup) -> None:
    """Draw the menu of looks with the name of the one that is chosen, and the buttons for one's own."""
    row = layout.row(align=True)
    look = look_of(settings)
    row.menu(LEGORIZE_MT_looks.__name__, text=PRESETS[look].name if look else "Look", icon="PRESET")
    row.operator(LEGORIZE_OT_save_look.bl_idname, text="", icon="ADD")
    row.operator(LEGORIZE_OT_save_look.bl_idname, text="", icon="REMOVE").remove_active = True


classes = (LEGORIZE_OT_look, LEGORIZE_OT_save_look, LEGORIZE_MT_looks)
register, unregister = bpy.utils.register_classes_factory(classes)
