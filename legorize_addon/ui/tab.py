"""The sidebar tab of all panels, and texts in it."""

from __future__ import annotations

import textwrap
from itertools import takewhile
from typing import Final
from unicodedata import category, east_asian_width

import bpy
from bpy.app.translations import pgettext_iface as iface

from ..scene import damage
from ..view import shows_step
from .current import current_build

PIXELS_PER_LETTER: Final = 8.0
"""Width of a letter in the sidebar, with room for the icon: Blender does not wrap texts."""

AGAIN: Final = 0.2
"""Seconds until panels are drawn once more."""

ENDS: Final = frozenset({"Po", "Pe", "Pf"})
"""Categories of the wide letters that stand at the end of a line, never at the beginning of one: full stops."""


class Tab:
    """Where every panel stands."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Legorize"


class BuildTab(Tab):
    """What is about a build, and is not there without a whole one.

    Attributes
    ----------
    of_steps : bool
        Whether it is about a step of the method, too.
    """

    bl_parent_id = "LEGORIZE_PT_main"
    of_steps = False

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is a whole build."""
        build = current_build(context.scene)
        return build is not None and damage(build) is None and (cls.of_steps or not shows_step(build))


def draw_wrapped(context: bpy.types.Context, layout: bpy.types.UILayout, text: str, icon: str) -> None:
    """Draw a text in as many lines as it takes, the first one with an icon."""
    width = int(context.region.width / (PIXELS_PER_LETTER * context.preferences.system.ui_scale))
    lines = layout.column(align=True)
    for row, line in enumerate(wrapped(iface(text), max(width, 20))):
        lines.label(text=line, icon="BLANK1" if row else icon)


def wrapped(text: str, width: int) -> list[str]:
    """Return a text in lines of so many letters; half as many where they are as wide as Chinese and Japanese ones."""
    wide = sum(east_asian_width(letter) in "WF" for letter in text)
    lines: list[str] = []
    for line in textwrap.wrap(text, width // 2 if wide > len(text) / 2 else width):
        # such lines are cut between any two letters, but none begins with what ends a sentence
        ends = len(list(takewhile(_is_end, line))) if lines else 0
        if ends:
            lines[-1] += line[:ends]
        if line[ends:]:
            lines.append(line[ends:])
    return lines


def _is_end(letter: str) -> bool:
    return east_asian_width(letter) in "WF" and category(letter) in ENDS


def redraw(context: bpy.types.Context) -> None:
    """Let all 3D viewports, and the tab in them, be drawn anew, and once more a moment later.

    Blender puts panels in their places by how high those above were when they
    were drawn last: a panel that has become higher would lie on the next ones
    until the mouse is moved.
    """
    _tag()
    if not bpy.app.background and not bpy.app.timers.is_registered(_tag):
        bpy.app.timers.register(_tag, first_interval=AGAIN)


def _tag() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def register() -> None:
    """Panels and operators register themselves."""


def unregister() -> None:
    """Drop the timer, if there is one."""
    if bpy.app.timers.is_registered(_tag):
        bpy.app.timers.unregister(_tag)
