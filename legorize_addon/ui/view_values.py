"""What the view of the current build is: what the panel's properties read and set, each for the whole build."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy

from ..core.model import load_catalogue
from ..scene import (
    Section,
    damage,
    ghost_shown,
    own_parts,
    point_objects,
    set_detail,
    show_ghost,
    show_sources,
    state_of,
)
from ..view import (
    cut_away,
    explode,
    exploded,
    has_margins,
    heat_map_shown,
    highlight_step,
    n_steps,
    section_of,
    show_heat_map,
    show_layers,
    show_steps,
    show_trajectories,
    steps_done,
    trajectories_shown,
)
from .current import current_build
from .settings_properties import take_kept
from .view_choices import CUTS


def whole_build(self: bpy.types.PropertyGroup) -> bpy.types.Collection | None:
    """Return the build that the panel shows if there is one and it is not damaged."""
    build = current_build(self.id_data)
    return None if build is None or damage(build) else build


def top_layer(self: bpy.types.PropertyGroup) -> int:
    """Return how many layers are shown."""
    build = current_build(self.id_data)
    return state_of(build).top_layer if build else 1


def set_top_layer(self: bpy.types.PropertyGroup, value: int) -> None:
    """Show that many layers."""
    build = whole_build(self)
    if build:
        top = max(1, min(value, state_of(build).layers))
        show_layers(self.id_data, build, top, single=state_of(build).single_layer)


def single_layer(self: bpy.types.PropertyGroup) -> bool:
    """Return whether the highest of them is shown alone."""
    build = current_build(self.id_data)
    return bool(build) and state_of(build).single_layer


def set_single_layer(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Show the highest layer alone, or all below it too."""
    build = whole_build(self)
    if build:
        show_layers(self.id_data, build, state_of(build).top_layer, single=value)


def _section(self: bpy.types.PropertyGroup) -> Section:
    build = current_build(self.id_data)
    return section_of(build) if build else Section()


def _cut(self: bpy.types.PropertyGroup, **changes: Any) -> None:
    build = whole_build(self)
    if build:
        cut_away(build, replace(section_of(build), **changes))


def section_axis(self: bpy.types.PropertyGroup) -> int:
    """Return the number of the axis of the cut."""
    return CUTS.index(_section(self).axis)


def set_section_axis(self: bpy.types.PropertyGroup, value: int) -> None:
    """Cut at right angles to another axis."""
    _cut(self, axis=CUTS[value])


def section_at(self: bpy.types.PropertyGroup) -> float:
    """Return where the cut is."""
    return _section(self).at


def set_section_at(self: bpy.types.PropertyGroup, value: float) -> None:
    """Move the cut."""
    _cut(self, at=value)


def section_flip(self: bpy.types.PropertyGroup) -> bool:
    """Return which side of the cut is hidden."""
    return _section(self).flip


def set_section_flip(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Hide the other side of the cut."""
    _cut(self, flip=value)


def heat_map(self: bpy.types.PropertyGroup) -> bool:
    """Return whether the heat map is shown."""
    build = current_build(self.id_data)
    return bool(build) and heat_map_shown(build)


def set_heat_map(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Show or hide the heat map."""
    build = whole_build(self)
    if build and has_margins(build):
        show_heat_map(build, visible=value)


def apart(self: bpy.types.PropertyGroup) -> float:
    """Return how far pieces are apart."""
    build = current_build(self.id_data)
    return exploded(build) if build else 0.0


def set_apart(self: bpy.types.PropertyGroup, value: float) -> None:
    """Move pieces apart."""
    build = whole_build(self)
    if build and n_steps(build):
        explode(build, value)


def step(self: bpy.types.PropertyGroup) -> int:
    """Return how many steps are shown as done."""
    build = current_build(self.id_data)
    return steps_done(build) or n_steps(build) if build else 0


def set_step(self: bpy.types.PropertyGroup, value: int) -> None:
    """Show that many steps."""
    build = whole_build(self)
    if build and n_steps(build):
        show_steps(build, max(1, min(value, n_steps(build))))
        highlight_step(build, visible=self.highlight)


def by_steps(self: bpy.types.PropertyGroup) -> bool:
    """Return whether steps are shown."""
    build = current_build(self.id_data)
    return bool(build) and bool(steps_done(build))


def set_by_steps(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Show all steps, or the whole model again."""
    build = whole_build(self)
    if build and n_steps(build):
        show_steps(build, step(self) if value else 0)
        highlight_step(build, visible=value and self.highlight)


def update_highlight(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Draw what was there before a step pale, or not."""
    set_by_steps(self, by_steps(self))


def update_sources(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Show or hide the originals."""
    build = current_build(self.id_data)
    if build:
        show_sources(build, visible=self.show_sources)


def ghost(self: bpy.types.PropertyGroup) -> bool:
    """Return whether originals are shown as ghosts."""
    build = current_build(self.id_data)
    return bool(build) and ghost_shown(build)


def set_ghost(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Show or hide originals as ghosts."""
    build = current_build(self.id_data)
    if build:
        self["show_sources"] = False
        show_ghost(build, visible=value)


def update_detail(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Draw the parts as finely as is chosen."""
    build = whole_build(self)
    if build:
        own_parts(state_of(build), point_objects(build))
        set_detail(state_of(build).parts, load_catalogue(), self.detail)


def take_settings(self: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Let the panel have the settings of the build that it shows; limits are the user's, not a build's."""
    if self.build is not None:
        take_kept(self.settings, state_of(self.build).settings)


def trajectories(self: bpy.types.PropertyGroup) -> bool:
    """Return whether trajectories are shown."""
    build = current_build(self.id_data)
    return bool(build) and trajectories_shown(build)


def set_trajectories(self: bpy.types.PropertyGroup, value: bool) -> None:
    """Show or hide trajectories."""
    build = whole_build(self)
    if build:
        show_trajectories(build, visible=value)
