"""What was shown of a build, shown of the one that takes its place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import bpy

from ..core.model import Role
from ..scene import Section, damage, state_of
from .animation import Animation, animate, animation_of
from .colour_errors import colour_errors_shown, has_colour_errors, show_colour_errors
from .heat_map import has_margins, heat_map_shown, show_heat_map
from .highlight import highlight_step, highlighted
from .steps import explode, exploded, n_steps, steps_done
from .visibility import cut_away, roles_shown, section_of, show_layers, show_role, show_steps


@dataclass(frozen=True, slots=True)
class KeptView:
    """What is shown of a build.

    Attributes
    ----------
    roles : mapping of Role to bool
        Whether each role that occurs is shown.
    top_layer : int or None
        Number of layers shown; None for all.
    single_layer : bool
        Whether only the highest of these is shown.
    section : Section
        The cut.
    exploded : float
        How far its pieces are apart.
    steps : int
        Building steps that are done; 0 for all.
    heat_map : bool
        Whether its heat map is shown.
    colour_errors : bool
        Whether its colour errors are shown.
    highlighted : bool
        Whether what was there before the last step is pale.
    animation : Animation or None
        When it is put together, if it is.
    """

    roles: Mapping[Role, bool]
    top_layer: int | None
    single_layer: bool
    section: Section
    exploded: float
    steps: int
    heat_map: bool
    colour_errors: bool
    highlighted: bool
    animation: Animation | None

    @classmethod
    def of(cls, builds: Sequence[bpy.types.Collection]) -> KeptView | None:
        """Return what is shown of the first whole one of some builds; None without one."""
        for build in builds:
            if damage(build) is None:
                state = state_of(build)
                return cls(
                    roles=_wanted_roles(build),
                    top_layer=state.top_layer if state.top_layer < state.layers or state.single_layer else None,
                    single_layer=state.single_layer,
                    section=section_of(build),
                    exploded=exploded(build),
                    steps=steps_done(build),
                    heat_map=heat_map_shown(build),
                    colour_errors=colour_errors_shown(build),
                    highlighted=highlighted(build),
                    animation=animation_of(build),
                )
        return None

    def show(self, scene: bpy.types.Scene, build: bpy.types.Collection) -> None:
        """Show the same of another build, as far as it has it.

        Parameters
        ----------
        scene : bpy.types.Scene
            Scene of the build.
        build : bpy.types.Collection
            A new one.
        """
        for role in roles_shown(build):
            if role in self.roles:
                show_role(build, role, visible=self.roles[role])
        if self.top_layer is not None:
            show_layers(scene, build, min(self.top_layer, state_of(build).layers), single=self.single_layer)
        cut_away(build, self.section)
        if n_steps(build):
            explode(build, self.exploded)
            show_steps(build, min(self.steps, n_steps(build)))
            highlight_step(build, visible=self.highlighted)
            if self.animation is not None:
                animate(scene, build, first=self.animation.first, frames=self.animation.frames)
        if self.heat_map and has_margins(build):
            show_heat_map(build, visible=True)
        if self.colour_errors and has_colour_errors(build):
            show_colour_errors(build, visible=True)


def _wanted_roles(build: bpy.types.Collection) -> dict[Role, bool]:
    """Return the roles as the user wants them shown, whatever the building steps show for a while."""
    roles = roles_shown(build)
    if (steps_done(build) or animation_of(build)) and Role.SUPPORT_OUTSIDE in roles:
        roles[Role.SUPPORT_OUTSIDE] = state_of(build).supports_shown
    return roles
