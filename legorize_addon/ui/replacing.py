"""Colours found in the textures, what each became, and the choice of another brick colour for it."""

from __future__ import annotations

from typing import Any, Final

import bpy
from bpy.props import IntProperty

from ..core.errors import SettingsError
from ..core.model import load_catalogue
from ..scene import found_colours
from .current import current_build
from .palette import filled, ranked_colours, swatch
from .reporting import Reporting

MOST: Final = 16
"""Colours that the panel shows: the most frequent ones."""

SWATCHES: Final = 10
"""Colours in a row of the choice."""

WIDTH: Final = 300
"""Pixels of the choice."""


class LEGORIZE_OT_replace_colour(Reporting, bpy.types.Operator):
    """Let another brick colour stand for one, from the next build on."""

    bl_idname = "legorize.replace_colour"
    bl_label = "Replace Colour"
    bl_options = {"REGISTER", "UNDO"}

    code: IntProperty(name="Colour", description="LDraw code of the colour to replace")
    by: IntProperty(name="By", description="LDraw code of the colour to use instead; its own to replace nothing")

    @classmethod
    def description(cls, context: bpy.types.Context, properties: Any) -> str:
        """Return the tooltip: the names of the colours."""
        names = {colour.code: colour.name for colour in load_catalogue().colours}
        one, other = (names.get(code, "?") for code in (properties.code, properties.by))
        return f"Use {other} for what is {one} by itself, from the next build on"

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Change the setting."""
        return self.reported(self._replace, context.scene.legorize.settings)

    def _replace(self, settings: bpy.types.PropertyGroup) -> set[str]:
        # not loaded before the panel is opened
        from ..core.colours import replacements, replacements_text

        catalogue = load_catalogue()
        for code in (self.code, self.by):
            catalogue.colour_row(code)
        try:
            pairs = replacements(settings.replace_colours, catalogue)
        except SettingsError:
            # what cannot be read is written anew
            pairs = {}
        settings.replace_colours = replacements_text(pairs | {self.code: self.by}, catalogue)
        return {"FINISHED"}


class LEGORIZE_OT_choose_replacement(bpy.types.Operator):
    """Choose what stands for a colour from the next build on."""

    bl_idname = "legorize.choose_replacement"
    bl_label = "Replace Colour"
    bl_description = "Choose another brick colour for this colour of the texture, from the next build on"
    bl_options = {"INTERNAL"}

    code: IntProperty()

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show the colours at the mouse."""
        return context.window_manager.invoke_popup(self, width=WIDTH)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Do nothing: the buttons do it."""
        return {"FINISHED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw a button for each colour, in the order of a rainbow."""
        grid = self.layout.grid_flow(row_major=True, columns=SWATCHES, even_columns=True, even_rows=True, align=True)
        for colour in ranked_colours(load_catalogue()):
            button = grid.operator(LEGORIZE_OT_replace_colour.bl_idname, text="", icon_value=swatch(colour))
            button.code, button.by = self.code, colour.code


def draw_found(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Draw the colours that were found for the build that the panel shows: its own, its share, what it became."""
    build = current_build(context.scene)
    found = found_colours(build)[:MOST] if build else []
    if not found:
        return
    from ..core.colours import replacements

    catalogue = load_catalogue()
    try:
        pairs = replacements(context.scene.legorize.settings.replace_colours, catalogue)
    except SettingsError:
        pairs = {}
    known = {colour.code: colour for colour in catalogue.colours}
    layout.label(text="Found, and used for it:")
    column = layout.column(align=True)
    for entry in found:
        stands = known[pairs.get(entry.nearest, entry.nearest)]
        row = column.row(align=True)
        name = "texels {:02x}{:02x}{:02x}".format(*entry.rgb)
        row.label(text=f"{100 * entry.share:.0f} %", icon_value=filled(entry.rgb, name))
        button = row.operator(LEGORIZE_OT_choose_replacement.bl_idname, text=stands.name, icon_value=swatch(stands))
        button.code = entry.nearest


classes = (LEGORIZE_OT_replace_colour, LEGORIZE_OT_choose_replacement)
register, unregister = bpy.utils.register_classes_factory(classes)
