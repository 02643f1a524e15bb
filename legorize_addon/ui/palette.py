"""The palette as swatches: which colours the next model may have."""

from __future__ import annotations

from collections.abc import Iterable, Sequence, Set
from functools import cache
from typing import Any, Final

import bpy
import bpy.utils.previews
import numpy as np
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_rpt as rpt
from bpy.app.translations import pgettext_tip as tip
from bpy.props import IntProperty

from ..core.errors import SettingsError
from ..core.model import Catalogue, Colour, load_catalogue
from . import job
from .current import current_build
from .tab import Tab
from .working import OnBuild

PIXELS: Final = 32
"""Height and width of a swatch."""

COLUMNS: Final = 8
"""Swatches in a row: as many as the sidebar has room for at its usual width."""

RARE: Final = 0.75
"""Share of the parts below which a colour counts as hard to buy: more than one part in four is then not made in it."""


@cache
def _swatches() -> bpy.utils.previews.ImagePreviewCollection:
    """Return the pictures that were made so far, by the codes of the colours."""
    return bpy.utils.previews.new()


def swatch(colour: Colour) -> int:
    """Return the number of an icon that is filled with a brick colour."""
    return filled(colour.rgb, str(colour.code))


def filled(rgb: Sequence[int], name: str) -> int:
    """Return the number of an icon of a name that is filled with sRGB bytes."""
    known = _swatches()
    if name not in known:
        pixels = np.ones((PIXELS, PIXELS, 4), dtype=np.float32)
        pixels[..., :3] = np.array(rgb) / 255
        made = known.new(name)
        made.icon_size = (PIXELS, PIXELS)
        made.icon_pixels_float = pixels.ravel()
    return known[name].icon_id


def palette_text(codes: Iterable[int], catalogue: Catalogue) -> str:
    """Return the setting for some colours; empty for all."""
    chosen = sorted(set(codes))
    return "" if len(chosen) == len(catalogue.colours) else ", ".join(map(str, chosen))


def codes_of(text: str, catalogue: Catalogue) -> set[int]:
    """Return the colours that the setting names; none if it names what is no colour."""
    # not loaded before the panel is opened
    from ..core.colours import chosen_palette

    try:
        return set(chosen_palette(text, catalogue).tolist())
    except SettingsError:
        return set()


def rare(catalogue: Catalogue) -> dict[int, bool]:
    """Return for each colour whether few parts are made in it."""
    made = catalogue.exists[catalogue.used_for("model")].mean(axis=0)
    return {colour.code: bool(share < RARE) for colour, share in zip(catalogue.colours, made, strict=True)}


class LEGORIZE_OT_palette_colour(bpy.types.Operator):
    """Let the next model have a colour, or not."""

    bl_idname = "legorize.palette_colour"
    bl_label = "Use Colour"
    bl_options = {"REGISTER", "UNDO", "INTERNAL"}
    code: IntProperty()

    @classmethod
    def description(cls, context: bpy.types.Context, properties: Any) -> str:
        """Return the tooltip: the name of the colour, and what a click does."""
        catalogue = load_catalogue()
        colour = catalogue.colours[catalogue.colour_row(properties.code)]
        sentences = [f"{colour.name} ({colour.code})."]
        if rare(catalogue)[colour.code]:
            sentences.append(tip("Few parts are made in it, so it takes more and smaller bricks."))
        sentences.append(tip("Click to use it or not; with Shift, to use no other colour"))
        return " ".join(sentences)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Change the palette; with Shift, to this colour alone."""
        if event.shift:
            context.scene.legorize.settings.palette = str(self.code)
            return {"FINISHED"}
        return self.execute(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Take the colour in, or out unless it is the last one."""
        settings, catalogue = context.scene.legorize.settings, load_catalogue()
        left = codes_of(settings.palette, catalogue) ^ {self.code}
        if not left:
            self.report({"WARNING"}, rpt("A model needs at least one colour: add another one first."))
            return {"CANCELLED"}
        settings.palette = palette_text(left, catalogue)
        return {"FINISHED"}


class LEGORIZE_OT_palette_all(bpy.types.Operator):
    """Let the next model have every colour."""

    bl_idname = "legorize.palette_all"
    bl_label = "All"
    bl_description = "Use all colours that are made today"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Empty the setting."""
        context.scene.legorize.settings.palette = ""
        return {"FINISHED"}


class LEGORIZE_OT_palette_of_build(OnBuild, bpy.types.Operator):
    """Let the next model have the colours of the one that the panel shows."""

    bl_idname = "legorize.palette_of_build"
    bl_label = "As Built"
    bl_description = "Use only the colours that the model has now; then take out those that you do not want"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether the colours of the model are known."""
        return super().poll(context) and len(current_build(context.scene).legorize_lots) > 0

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Set them, as far as models may have them."""
        catalogue = load_catalogue()
        used = {row.code for row in current_build(context.scene).legorize_lots}
        used &= set(catalogue.codes.tolist())
        if not used:
            self.report({"WARNING"}, rpt("The model has no colour of the palette."))
            return {"CANCELLED"}
        context.scene.legorize.settings.palette = palette_text(used, catalogue)
        return {"FINISHED"}


class LEGORIZE_PT_palette(Tab, bpy.types.Panel):
    """Swatches to click on, and how many bricks of the model have each colour."""

    bl_parent_id = "LEGORIZE_PT_main"
    bl_label = "Palette"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the swatches, in the order of a rainbow, and the buttons."""
        self.layout.enabled = job.running() is None
        catalogue = load_catalogue()
        used = codes_of(context.scene.legorize.settings.palette, catalogue)
        self.layout.label(text=iface("{} of {} colours").format(len(used), len(catalogue.colours)))
        self.layout.label(text="Shift-click: use only that colour")
        row = self.layout.row(align=True)
        row.operator(LEGORIZE_OT_palette_all.bl_idname)
        row.operator(LEGORIZE_OT_palette_of_build.bl_idname)
        hard = rare(catalogue)
        ranked = ranked_colours(catalogue)
        self._draw_swatches([colour for colour in ranked if not hard[colour.code]], used)
        self.layout.label(text="Made of few parts:")
        self._draw_swatches([colour for colour in ranked if hard[colour.code]], used)
        self._draw_counts(context)
        # which knows this module
        from .replacing import draw_found

        draw_found(context, self.layout)

    def _draw_swatches(self, colours: Sequence[Colour], used: Set[int]) -> None:
        """Draw a button for each colour, pressed where it is used."""
        grid = self.layout.grid_flow(row_major=True, columns=COLUMNS, even_columns=True, even_rows=True, align=True)
        for colour in colours:
            button = grid.operator(
                LEGORIZE_OT_palette_colour.bl_idname,
                text="",
                icon_value=swatch(colour),
                depress=colour.code in used,
            )
            button.code = colour.code

    def _draw_counts(self, context: bpy.types.Context) -> None:
        """Draw how many bricks of the model have each colour, most first."""
        build = current_build(context.scene)
        counts: dict[int, int] = {}
        for lot in build.legorize_lots if build else ():
            counts[lot.code] = counts.get(lot.code, 0) + lot.count
        known = {colour.code: colour for colour in load_catalogue().colours}
        column = self.layout.column(align=True)
        for code, count in sorted(counts.items(), key=lambda entry: -entry[1]):
            if code in known:
                column.label(text=f"{count} {known[code].name}", icon_value=swatch(known[code]))


def ranked_colours(catalogue: Catalogue) -> list[Colour]:
    """Return all colours in the order of a rainbow."""
    return sorted(catalogue.colours, key=_rainbow)


def _rainbow(colour: Colour) -> tuple[bool, float, float]:
    """Return a colour's place: greys by lightness, then all others by hue."""
    red, green, blue = (channel / 255 for channel in colour.rgb)
    high, low = max(red, green, blue), min(red, green, blue)
    if high - low < 0.1:
        return False, high, 0.0
    hue = {red: (green - blue), green: 2 * (high - low) + blue - red, blue: 4 * (high - low) + red - green}[high]
    return True, (hue / (high - low)) % 6, high


classes = (LEGORIZE_OT_palette_colour, LEGORIZE_OT_palette_all, LEGORIZE_OT_palette_of_build)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the operators; the panel stands among the others."""
    _register_classes()


def unregister() -> None:
    """Undo :func:`register`, and free the swatches."""
    _unregister_classes()
    bpy.utils.previews.remove(_swatches())
    _swatches.cache_clear()
