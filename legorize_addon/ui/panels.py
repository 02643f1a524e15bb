"""The sidebar tab "Legorize": what is built and the button, what came of it, and all settings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import bpy
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n

from ..core.progress import duration
from ..core.shopping import SECONDS_A_BRICK
from ..core.units import BRICK, STUD
from ..scene import builds, can_show_ghost, check_lines, damage, is_bare_root, orphans, state_of
from ..view import (
    ERROR_LEGEND,
    LEGEND,
    animation_of,
    can_highlight,
    colour_error_lines,
    has_colour_errors,
    has_margins,
    n_pieces,
    n_steps,
    roles_shown,
    shows_step,
)
from . import counts, job
from .animation import LEGORIZE_OT_animate, LEGORIZE_OT_film, LEGORIZE_OT_stop_animation
from .assets import LEGORIZE_OT_mark_asset
from .build import LEGORIZE_OT_build, LEGORIZE_OT_clear, LEGORIZE_OT_show_originals
from .current import current_build
from .edit_tool import LEGORIZE_PT_edits, draw_plan
from .everything import LEGORIZE_OT_export_folder
from .existing import LEGORIZE_OT_again, LEGORIZE_OT_open_ldraw
from .expectation import LINES, expected
from .export import LEGORIZE_OT_export_ldr, LEGORIZE_OT_export_mpd, LEGORIZE_OT_render_still
from .hints import draw_hints
from .instructions import LEGORIZE_OT_booklet, LEGORIZE_OT_layer_maps
from .live import draw_live
from .looks import draw_looks
from .palette import LEGORIZE_PT_palette
from .parts import LEGORIZE_OT_export_list, LEGORIZE_OT_list_parts, LEGORIZE_OT_show_all
from .progress_text import progress_text
from .requests import chosen_sources
from .setting_names import as_in_panel
from .settings_panels import GROUPS, SETTINGS_PANELS, SIZE, draw_settings
from .tab import BuildTab, Tab, draw_wrapped
from .updating import LEGORIZE_OT_build_beside, LEGORIZE_OT_update
from .weakest import LEGORIZE_OT_show_weakest, LEGORIZE_OT_show_worst_colour
from .working import A_STEP

MM_PER_CM: Final = 10.0

BARE: Final = n(
    "{} is the root of a model whose bricks are not in this scene: delete it, or bring the model's collection with "
    "File > Append"
)


class LEGORIZE_PT_main(Tab, bpy.types.Panel):
    """What is built, how large, how it looks, what that comes to, and the button; or how far it has come."""

    bl_label = "Legorize"
    entries = tuple(GROUPS[SIZE])

    def draw(self, context: bpy.types.Context) -> None:
        """Draw all that most people choose, from top to bottom in the order in which they choose it."""
        running = job.running()
        if running:
            stage, share = running.progress
            text = progress_text(stage, share, running.seconds_left, stopping=running.stopping)
            self.layout.progress(factor=share, type="BAR", text=text)
            self.layout.label(text="Esc stops")
            return
        draw_hints(context, self.layout)
        sources = [source.name for source in chosen_sources(context)]
        if sources:
            self.layout.label(text=", ".join(sources), icon="MESH_DATA")
        else:
            self.layout.label(text="Select an object", icon="INFO")
        draw_looks(self.layout, context.scene.legorize.settings)
        draw_settings(self.layout, context.scene.legorize.settings, self.entries)
        self._draw_expected(context)
        button = self.layout.column()
        button.scale_y = 1.6
        button.operator(LEGORIZE_OT_build.bl_idname, icon="MOD_BUILD")
        build = current_build(context.scene)
        if build and not shows_step(build):
            again = self.layout.row(align=True)
            again.operator(LEGORIZE_OT_update.bl_idname, icon="FILE_REFRESH")
            again.operator(LEGORIZE_OT_build_beside.bl_idname, icon="ADD")
        if context.window_manager.legorize_said:
            self.layout.label(text=context.window_manager.legorize_said, icon="INFO")
        if len(builds(context.scene)) > 1:
            self.layout.prop(context.scene.legorize, "build")
        self._draw_damage(context)
        self.layout.operator(LEGORIZE_OT_open_ldraw.bl_idname, icon="IMPORT")
        # last, because what it says would move what is below
        draw_live(context, self.layout)

    def _draw_expected(self, context: bpy.types.Context) -> None:
        """Draw what the settings will come to, with as much room before it is known: the button stays in its place."""
        lines = self.layout.column(align=True)
        told = expected(context)
        for line in told:
            draw_wrapped(context, lines, line, "NONE")
        for _ in range(0 if told else LINES):
            lines.label(text="")

    def _draw_damage(self, context: bpy.types.Context) -> None:
        """Draw what was deleted in Blender's own way, and the button that repairs it."""
        lost = [entry.source.name for entry in orphans(context.scene)]
        if lost:
            draw_wrapped(
                context,
                self.layout,
                iface("Hidden, although the model was deleted: {}").format(", ".join(lost)),
                "ERROR",
            )
            self.layout.operator(LEGORIZE_OT_show_originals.bl_idname, icon="HIDE_OFF")
        active = context.active_object
        if active and is_bare_root(context.scene, active):
            draw_wrapped(context, self.layout, iface(BARE).format(active.name), "ERROR")
        build = current_build(context.scene)
        sentence = build and damage(build)
        if sentence:
            draw_wrapped(context, self.layout, sentence, "ERROR")
            self.layout.operator(LEGORIZE_OT_clear.bl_idname, icon="X")


class LEGORIZE_PT_layers(BuildTab, bpy.types.Panel):
    """What is shown of a build."""

    bl_label = "Layers"
    of_steps = True

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the sliders of layers, steps and pieces, the cut, the roles, and what else may be shown."""
        self.layout.enabled = job.running() is None
        view = context.scene.legorize
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        build = current_build(context.scene)
        self.layout.prop(view, "top_layer", text=iface("Top of {}").format(state_of(build).layers))
        self.layout.prop(view, "single_layer")
        draw_plan(context, self.layout, build)
        self._draw_building(view, build)
        self.layout.row().prop(view, "section_axis", expand=True)
        if view.section_axis != "none":
            self.layout.prop(view, "section_at", slider=True)
            self.layout.prop(view, "section_flip")
        shown = self.layout.column(heading="Show", align=True)
        for role in roles_shown(build):
            shown.prop(view.roles, role.name.lower())
        self.layout.prop(view, "show_sources")
        if can_show_ghost(build):
            self.layout.prop(view, "ghost")
        self.layout.row().prop(view, "numbers", expand=True)
        self.layout.prop(view, "detail")

    def _draw_building(self, view: bpy.types.PropertyGroup, build: bpy.types.Collection) -> None:
        """Draw how far the model is built, and its pieces apart, as far as the build knows of them."""
        if n_steps(build):
            row = self.layout.row(heading=iface("Step of {}").format(n_steps(build)))
            row.prop(view, "by_steps", text="")
            slider = row.row()
            slider.active = view.by_steps
            slider.prop(view, "step", text="")
            if view.by_steps and can_highlight(build):
                self.layout.prop(view, "highlight")
            buttons = self.layout.row(align=True)
            buttons.operator(LEGORIZE_OT_booklet.bl_idname, text="Booklet", icon="DOCUMENTS")
            buttons.operator(LEGORIZE_OT_layer_maps.bl_idname, text="Layer Maps", icon="MESH_GRID")
            _draw_animation(self.layout, build)
        if n_pieces(build) > 1:
            self.layout.prop(view, "exploded", slider=True)


class LEGORIZE_PT_result(BuildTab, bpy.types.Panel):
    """What came out."""

    bl_label = "Result"
    of_steps = True

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the figures of the build and its remarks; of a step of the method say that it is one."""
        build = current_build(context.scene)
        state, step = state_of(build), shows_step(build)
        column = self.layout.column(align=True)
        for text in (*_figures(state.summary), *_building_figures(state.building)):
            column.label(text=text)
        for note in state.notes:
            draw_wrapped(context, self.layout, as_in_panel(note), "ERROR")
        if step:
            draw_wrapped(context, self.layout, A_STEP, "INFO")
        else:
            self.layout.operator(LEGORIZE_OT_again.bl_idname, icon="FILE_REFRESH")
        self.layout.operator(LEGORIZE_OT_clear.bl_idname, icon="X")


class LEGORIZE_PT_stability(BuildTab, bpy.types.Panel):
    """Whether the model stands."""

    bl_label = "Stability"

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the verdict, what is weak, and the switch of the heat map."""
        build = current_build(context.scene)
        for text, icon in check_lines(state_of(build).check):
            draw_wrapped(context, self.layout, text, icon)
        view = context.scene.legorize
        switch = self.layout.row()
        switch.enabled = has_margins(build) and job.running() is None
        switch.prop(view, "heat_map")
        switch.operator(LEGORIZE_OT_show_weakest.bl_idname, text="Weakest", icon="ZOOM_SELECTED")
        if view.heat_map:
            draw_wrapped(context, self.layout, LEGEND, "INFO")
        _draw_colour_errors(context, self.layout, build)


class LEGORIZE_PT_lots(BuildTab, bpy.types.Panel):
    """The table of parts."""

    bl_label = "Parts List"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the table and what it is sorted by; a click on a row shows its bricks."""
        self.layout.enabled = job.running() is None
        build = current_build(context.scene)
        if len(build.legorize_lots):
            self.layout.row().prop(build, "legorize_lot_order", expand=True)
            self.layout.template_list("LEGORIZE_UL_lots", "", build, "legorize_lots", build, "legorize_lot", rows=8)
        row = self.layout.row(align=True)
        row.operator(LEGORIZE_OT_list_parts.bl_idname, icon="FILE_REFRESH")
        row.operator(LEGORIZE_OT_show_all.bl_idname, icon="HIDE_OFF")


class LEGORIZE_PT_export(BuildTab, bpy.types.Panel):
    """What can be written."""

    bl_label = "Export"
    of_steps = True

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the buttons that write files; steps of the method have no building order, lists nor report."""
        self.layout.operator(LEGORIZE_OT_export_ldr.bl_idname, icon="EXPORT")
        if shows_step(current_build(context.scene)):
            self.layout.operator(LEGORIZE_OT_render_still.bl_idname, icon="RENDER_STILL")
            return
        self.layout.operator(LEGORIZE_OT_export_mpd.bl_idname, icon="EXPORT")
        self.layout.operator(LEGORIZE_OT_export_list.bl_idname, icon="EXPORT")
        # what most people buy by: as a format of the list alone, nobody finds it
        wanted = self.layout.operator(LEGORIZE_OT_export_list.bl_idname, text="BrickLink Wanted List", icon="EXPORT")
        wanted.kind = "bricklink"
        self.layout.operator(LEGORIZE_OT_export_folder.bl_idname, icon="EXPORT")
        self.layout.operator(LEGORIZE_OT_render_still.bl_idname, icon="RENDER_STILL")
        self.layout.operator(LEGORIZE_OT_mark_asset.bl_idname, icon="ASSET_MANAGER")


def _draw_colour_errors(context: bpy.types.Context, layout: bpy.types.UILayout, build: bpy.types.Collection) -> None:
    """Draw how far the colours are from the texture, and the switch of that view."""
    for text, icon in colour_error_lines(build):
        draw_wrapped(context, layout, text, icon)
    switch = layout.row()
    switch.enabled = has_colour_errors(build) and job.running() is None
    switch.prop(build, "legorize_colour_errors")
    switch.operator(LEGORIZE_OT_show_worst_colour.bl_idname, text="Worst Colour", icon="ZOOM_SELECTED")
    if build.legorize_colour_errors:
        draw_wrapped(context, layout, ERROR_LEGEND, "INFO")


def _draw_animation(layout: bpy.types.UILayout, build: bpy.types.Collection) -> None:
    """Draw the buttons of the assembly animation and the film."""
    buttons = layout.row(align=True)
    if animation_of(build):
        playing = bpy.context.screen.is_animation_playing
        word, icon = (iface("Pause"), "PAUSE") if playing else (iface("Play"), "PLAY")
        buttons.operator("screen.animation_play", text=word, icon=icon)
        buttons.operator(LEGORIZE_OT_stop_animation.bl_idname, text="", icon="X")
    else:
        buttons.operator(LEGORIZE_OT_animate.bl_idname, text="Animate", icon="PLAY")
    buttons.operator(LEGORIZE_OT_film.bl_idname, text="Film", icon="RENDER_ANIMATION")


def _figures(summary: Any) -> tuple[str, ...]:
    x, y, layers = summary["studs_x"], summary["studs_y"], summary["layers"]
    size = [length / MM_PER_CM for length in (x * STUD, y * STUD, layers * BRICK)]
    return (
        iface("{}, {:.0f} g").format(counts.bricks(summary["bricks"]), summary["mass"]),
        iface("{}, {}").format(counts.kinds_of_parts(summary["parts"]), counts.colours(summary["colours"])),
        counts.extent(x, y, layers),
        "{:.1f} x {:.1f} x {:.1f} cm".format(*size),
    )


def _building_figures(building: Mapping[str, Any] | None) -> tuple[str, ...]:
    """Return the lines on supports and building; none for a build of an earlier version, which does not know them."""
    if not building:
        return ()
    lines = [iface("Support bricks to take out: {}").format(building["removed"])]
    if building["removed"]:
        lines[0] += f", {building['removed_mass']:.0f} g"
    lines.append(iface("Support bricks that stay: {}").format(building["kept"]))
    if building.get("cost"):
        lines.append(iface("Price: {}").format(building["cost"]))
        if building["removed"]:
            lines.append(iface("Price of the supports to take out: {}").format(building["support_cost"]))
    lines.append(iface("Pieces: {}, building steps: {}").format(building["pieces"], building["steps"]))
    if building.get("moves"):
        time = duration(SECONDS_A_BRICK * building["moves"])
        lines.append(iface("Building time of practised hands: {}").format(time))
    if building.get("by_hand"):
        lines.append(iface("Towers to hold by hand: {}").format(building["by_hand"]))
    return tuple(lines)


# what came out stands above the settings that few people change
classes = (
    LEGORIZE_PT_main,
    LEGORIZE_PT_palette,
    LEGORIZE_PT_result,
    LEGORIZE_PT_edits,
    LEGORIZE_PT_stability,
    LEGORIZE_PT_layers,
    LEGORIZE_PT_lots,
    LEGORIZE_PT_export,
    *SETTINGS_PANELS,
)
register, unregister = bpy.utils.register_classes_factory(classes)
