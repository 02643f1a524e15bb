"""Panels of the settings, one for each group, drawn from what the settings say of themselves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import Field, fields
from itertools import groupby
from types import MappingProxyType
from typing import Any, Final

import bpy

from ..core.settings import Settings, has_effect
from . import job
from .learning import LEGORIZE_OT_forget, LEGORIZE_OT_learn
from .tab import Tab

BUTTONS: Final = MappingProxyType({"Bricks": (LEGORIZE_OT_learn, LEGORIZE_OT_forget)})
"""Operators below the settings of a group."""

GROUPS: Final[dict[str, list[Field[Any]]]] = {
    name: list(entries) for name, entries in groupby(fields(Settings), key=lambda entry: entry.metadata["group"])
}
"""The settings by their groups, in their order."""

SIZE, *_OTHERS = GROUPS
"""The group of settings that stands beside the button, and those in Advanced."""


def draw_settings(layout: bpy.types.UILayout, group: bpy.types.PropertyGroup, entries: Sequence[Field[Any]]) -> None:
    """Draw settings, those without effect in grey; of several numbers for one thing, only the chosen one."""
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    for entry in entries:
        counts = has_effect(entry, group)
        if counts or entry.name not in entry.metadata["needs"]:
            row = column.row()
            row.active = counts
            row.prop(group, entry.name)


class _SettingsPanel(Tab):
    """The settings of one group.

    Attributes
    ----------
    entries : tuple of Field
        The settings, in their order.
    buttons : tuple of type
        Operators below them.
    """

    bl_parent_id = "LEGORIZE_PT_advanced"
    bl_options = {"DEFAULT_CLOSED"}
    entries: tuple[Field[Any], ...] = ()
    buttons: tuple[type[bpy.types.Operator], ...] = ()

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the group's settings and buttons; locked while a job runs."""
        self.layout.enabled = job.running() is None
        draw_settings(self.layout, context.scene.legorize.settings, self.entries)
        for button in self.buttons:
            self.layout.operator(button.bl_idname)


class LEGORIZE_PT_advanced(Tab, bpy.types.Panel):
    """Holds the panels of all settings but the size."""

    bl_parent_id = "LEGORIZE_PT_main"
    bl_label = "Advanced"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw nothing but the panels inside."""


def _settings_panel(group: str) -> type:
    """Return the panel of a group of settings."""
    members = {
        "__doc__": f"The settings of the group {group}.",
        "bl_label": group,
        "entries": tuple(GROUPS[group]),
        "buttons": BUTTONS.get(group, ()),
    }
    return type(f"LEGORIZE_PT_{group.lower()}", (_SettingsPanel, bpy.types.Panel), members)


SETTINGS_PANELS: Final = (LEGORIZE_PT_advanced, *map(_settings_panel, _OTHERS))
"""The panel that few people open, and those of the groups in it."""
