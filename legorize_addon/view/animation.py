"""A build that is put together as the frames go by: scrubbing, playing and rendering show it, no key frames needed."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ..core.model import Role
from ..scene import (
    FIRST,
    FRAMES,
    animated_tree,
    bricks_modifier,
    change_tree,
    get_input,
    has_input,
    point_objects,
    set_input,
    state_of,
)
from .highlight import highlight_step
from .steps import check_steps, n_steps
from .visibility import roles_shown, show_layers, show_role, show_steps


@dataclass(frozen=True, slots=True)
class Animation:
    """When a build is put together.

    Attributes
    ----------
    first : int
        Frame in which the first step begins.
    frames : int
        Frames that each step takes.
    steps : int
        Building steps.
    """

    first: int
    frames: int
    steps: int

    @property
    def last(self) -> int:
        """Frame from which the model stands complete."""
        return self.first + self.frames * self.steps


def animate(scene: bpy.types.Scene, build: bpy.types.Collection, *, first: int, frames: int) -> Animation:
    """Let a build be put together step by step, from a frame on.

    All layers are shown, and supports while they stand. The data of the bricks
    stay as they are.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene whose view layers show it.
    build : bpy.types.Collection
        The build, which knows its steps.
    first : int
        Frame in which the first step begins.
    frames : int
        Frames that each step takes, at least 1.

    Returns
    -------
    Animation

    Raises
    ------
    BuildError
        The build does not know its steps.
    """
    check_steps(build)
    # ends an earlier animation: supports are as they are without steps
    show_steps(build, 0)
    highlight_step(build, visible=False)
    show_layers(scene, build, state_of(build).layers)
    if Role.SUPPORT_OUTSIDE in roles_shown(build):
        state_of(build).supports_shown = roles_shown(build)[Role.SUPPORT_OUTSIDE]
        show_role(build, Role.SUPPORT_OUTSIDE, visible=True)
    for points in point_objects(build):
        modifier = bricks_modifier(points)
        change_tree(modifier, animated_tree())
        set_input(modifier, FIRST, float(first))
        set_input(modifier, FRAMES, float(frames))
    return Animation(first, frames, n_steps(build))


def animation_of(build: bpy.types.Collection) -> Animation | None:
    """Return when a build is put together; None if it is shown as a whole."""
    # all objects of a build change their trees together
    modifier = next(filter(None, map(bricks_modifier, point_objects(build))), None)
    if modifier is None or not has_input(modifier, FRAMES):
        return None
    first, frames = (round(get_input(modifier, name)) for name in (FIRST, FRAMES))
    return Animation(first, frames, n_steps(build))
