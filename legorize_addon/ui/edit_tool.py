"""The tool that picks bricks by clicks, its menu, the list of changes, and the outline of what is picked."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any, Final

import bpy
import gpu
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n
from gpu_extras.batch import batch_for_shader

from ..core.model import load_catalogue
from ..scene import damage, state_of
from ..view import edges_of, shows_step
from . import counts, job
from .current import current_build
from .edits import (
    LEGORIZE_OT_edit,
    LEGORIZE_OT_edit_automatic,
    LEGORIZE_OT_edit_frame,
    LEGORIZE_OT_edit_remove,
    LEGORIZE_OT_edit_swap,
    LEGORIZE_OT_pick,
)
from .palette import ranked_colours, swatch
from .tab import BuildTab, draw_wrapped

TOOL: Final = "legorize.edit_bricks"
ICON: Final = str(Path(__file__).with_name("icons") / "edit_bricks")
"""File of the icon, without its ending, as Blender wants it; drawn by ``scripts/draw_icon.py``."""

ICONS: Final = {"recolour": "COLOR", "delete": "TRASH", "force": "UV_SYNC_SELECT", "lock": "LOCKED", "forbid": "CANCEL"}
OUTLINE: Final = (1.0, 0.55, 0.0, 1.0)
"""Orange, as Blender's own outline of what is selected."""

WIDTH: Final = 2.0
"""Pixels of the outline."""

SWATCHES: Final = 10
"""Colours in a row of the menu."""


@cache
def _handles() -> list[Any]:
    """Return what draws in the 3D views."""
    return []


class LEGORIZE_WT_edit(bpy.types.WorkSpaceTool):
    """Click on bricks to pick them; right click for what to do with them."""

    bl_space_type = "VIEW_3D"
    bl_context_mode = "OBJECT"
    bl_idname = TOOL
    bl_label = "Edit Bricks"
    bl_description = (
        "Click on a brick of a model to pick it, with Shift for several; right click to recolour, lock, swap, forbid "
        "or delete it"
    )
    bl_icon = ICON
    bl_keymap = (
        (LEGORIZE_OT_pick.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),
        (
            LEGORIZE_OT_pick.bl_idname,
            {"type": "LEFTMOUSE", "value": "PRESS", "shift": True},
            {"properties": [("extend", True)]},
        ),
        (LEGORIZE_OT_pick.bl_idname, {"type": "RIGHTMOUSE", "value": "PRESS"}, {"properties": [("menu", True)]}),
    )

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, tool: Any) -> None:
        """Draw how many bricks are picked, and what can be done, in the tool's header."""
        build = current_build(context.scene)
        count = len(state_of(build).picked) if build else 0
        layout.label(text=counts.count_of(count, n("1 brick picked"), n("{} bricks picked")))
        if count:
            _draw_changes(layout.row(align=True))


def _draw_changes(layout: Any) -> None:
    """Draw a button for each change."""
    colours = layout.operator("wm.call_panel", text="Recolour", icon=ICONS["recolour"])
    colours.name, colours.keep_open = "LEGORIZE_PT_edit_colours", False
    layout.operator(LEGORIZE_OT_edit.bl_idname, text="Lock", icon=ICONS["lock"]).kind = "lock"
    layout.operator(LEGORIZE_OT_edit_swap.bl_idname, text="Swap Part", icon=ICONS["force"])
    layout.operator(LEGORIZE_OT_edit.bl_idname, text="Forbid", icon=ICONS["forbid"]).kind = "forbid"
    layout.operator(LEGORIZE_OT_edit.bl_idname, text="Delete", icon=ICONS["delete"]).kind = "delete"
    layout.operator(LEGORIZE_OT_edit_automatic.bl_idname, icon="LOOP_BACK")


class LEGORIZE_MT_edit(bpy.types.Menu):
    """What can be done with the picked bricks, at the mouse."""

    bl_label = "Edit Bricks"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw an entry for each change."""
        self.layout.operator_context = "INVOKE_DEFAULT"
        _draw_changes(self.layout)


class LEGORIZE_PT_edit_colours(bpy.types.Panel):
    """The colours to choose from, as swatches."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_label = "Recolour"
    bl_options = {"INSTANCED"}
    bl_ui_units_x = 14

    def draw(self, context: bpy.types.Context) -> None:
        """Draw a button for each colour, in the order of a rainbow."""
        grid = self.layout.grid_flow(row_major=True, columns=SWATCHES, even_columns=True, even_rows=True, align=True)
        for colour in ranked_colours(load_catalogue()):
            button = grid.operator(LEGORIZE_OT_edit.bl_idname, text="", icon_value=swatch(colour))
            button.kind, button.code = "recolour", colour.code


class LEGORIZE_UL_edits(bpy.types.UIList):
    """The list of changes: what and where, and the buttons that show it and take it back."""

    def draw_item(self, context: Any, layout: Any, data: Any, item: Any, icon: int, active: Any) -> None:
        """Draw a row without its place, for which there is no room; those that do not fit are marked."""
        row = layout.row(align=True)
        row.label(text=item.what or item.name, icon="ERROR" if item.reason else ICONS[item.kind])
        row.operator(LEGORIZE_OT_edit_frame.bl_idname, text="", icon="ZOOM_SELECTED").number = item.number
        row.operator(LEGORIZE_OT_edit_remove.bl_idname, text="", icon="X").number = item.number


class LEGORIZE_PT_edits(BuildTab, bpy.types.Panel):
    """What was changed by hand, and what no longer fits."""

    bl_label = "Edits by Hand"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the tool, what is picked, the list, and the button that plans the steps of what was changed."""
        self.layout.enabled = job.running() is None
        build = current_build(context.scene)
        self.layout.operator("wm.tool_set_by_id", text="Edit Bricks", icon="RESTRICT_SELECT_OFF").name = TOOL
        count = len(state_of(build).picked)
        self.layout.label(text=counts.count_of(count, n("1 brick picked"), n("{} bricks picked")))
        if count:
            _draw_changes(self.layout.grid_flow(columns=2, even_columns=True, align=True))
        if len(build.legorize_edits):
            self.layout.template_list("LEGORIZE_UL_edits", "", build, "legorize_edits", build, "legorize_edit", rows=5)
            if 0 <= build.legorize_edit < len(build.legorize_edits):
                chosen = build.legorize_edits[build.legorize_edit]
                draw_wrapped(context, self.layout, chosen.name, ICONS[chosen.kind])
                if chosen.reason:
                    told = iface("No longer fits, because {}.").format(chosen.reason)
                    draw_wrapped(context, self.layout, told, "ERROR")
            self.layout.operator(LEGORIZE_OT_edit_remove.bl_idname, text="Take All Back", icon="TRASH").number = -1
        draw_plan(context, self.layout, build)


def draw_plan(context: bpy.types.Context, layout: bpy.types.UILayout, build: bpy.types.Collection) -> None:
    """Draw that a model has no building steps, as after changes by hand, and the button that plans them."""
    if not state_of(build).steps and not shows_step(build):
        draw_wrapped(context, layout, iface("Supports and building steps are not planned yet."), "INFO")
        layout.operator("legorize.plan_steps", icon="PRESET")


def draw_outline() -> None:
    """Draw the edges of the picked bricks over everything else in a 3D view."""
    context = bpy.context
    build = current_build(context.scene)
    if build is None or damage(build) or not state_of(build).picked:
        return
    ends = edges_of(build, state_of(build).picked)
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    batch = batch_for_shader(shader, "LINES", {"pos": ends.tolist()})
    gpu.state.depth_test_set("NONE")
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", WIDTH * context.preferences.system.ui_scale)
    shader.uniform_float("color", OUTLINE)
    batch.draw(shader)


classes = (LEGORIZE_MT_edit, LEGORIZE_PT_edit_colours, LEGORIZE_UL_edits)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register menu, list and tool; the panel stands among the others."""
    _register_classes()
    bpy.utils.register_tool(LEGORIZE_WT_edit, separator=True)
    if not bpy.app.background:
        _handles().append(bpy.types.SpaceView3D.draw_handler_add(draw_outline, (), "WINDOW", "POST_VIEW"))


def unregister() -> None:
    """Undo :func:`register`."""
    while _handles():
        bpy.types.SpaceView3D.draw_handler_remove(_handles().pop(), "WINDOW")
    bpy.utils.unregister_tool(LEGORIZE_WT_edit)
    _unregister_classes()
