"""The buttons of moving pictures: the assembly as the frames go by, and a film with a camera of its own."""

from __future__ import annotations

from typing import Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt
from bpy.props import BoolProperty, IntProperty

from ..core.errors import BuildError
from ..render import Cut, make_film
from ..view import animate, animation_of, n_steps, stop_animation
from . import counts
from .current import current_build
from .working import OnBuild

HOLD: Final = 48
"""Frames for which the scene goes on after the last step: two seconds at Blender's usual rate."""


class LEGORIZE_OT_animate(OnBuild, bpy.types.Operator):
    """Let the build be put together as the frames go by."""

    bl_idname = "legorize.animate"
    bl_label = "Animate Assembly"
    bl_description = "Put the model together step by step in the timeline: play, scrub or render it"
    bl_options = {"REGISTER", "UNDO"}
    frames: IntProperty(
        name="Frames a Step", description="Frames that each building step takes", default=12, min=1, max=10_000
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Animate the build from the first frame of the scene, whose range then ends after it."""
        return self.reported(self._animate, context.scene)

    def _animate(self, scene: bpy.types.Scene) -> set[str]:
        made = animate(scene, current_build(scene), first=scene.frame_start, frames=self.frames)
        scene.frame_end = made.last + HOLD
        scene.frame_set(made.first)
        told = rpt("{} in frames {} to {}. Press Space to play.").format(
            counts.steps(made.steps), made.first, made.last
        )
        self.report({"INFO"}, told)
        return {"FINISHED"}


class LEGORIZE_OT_stop_animation(OnBuild, bpy.types.Operator):
    """Show the whole build in every frame again."""

    bl_idname = "legorize.stop_animation"
    bl_label = "Remove Animation"
    bl_description = "Show the whole model in every frame again"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether the build is animated."""
        return super().poll(context) and animation_of(current_build(context.scene)) is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Stop it."""
        stop_animation(current_build(context.scene))
        return {"FINISHED"}


class LEGORIZE_OT_film(OnBuild, bpy.types.Operator):
    """Make a scene with camera, light and ground that can be rendered as it is."""

    bl_idname = "legorize.film"
    bl_label = "Make Film"
    bl_description = (
        "Make a scene with camera, light and ground, in which the model is built, turns round, or both. It becomes the "
        "scene of the window: render it with Ctrl-F12, or save the file and render it elsewhere"
    )
    bl_options = {"REGISTER", "UNDO"}
    build: BoolProperty(name="Build It", description="Show how the model is put together", default=True)
    turn: BoolProperty(name="Turn It", description="Let the camera go round the finished model once", default=True)
    frames_a_step: IntProperty(
        name="Frames a Step", description="Frames that each building step takes", default=12, min=1, max=10_000
    )
    frames_a_turn: IntProperty(
        name="Frames a Turn", description="Frames in which the camera goes round once", default=120, min=2, max=100_000
    )
    samples: IntProperty(name="Samples", description="Light paths per pixel", default=8, min=1, max=100_000)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask what is to be shown."""
        self.build = n_steps(current_build(context.scene)) > 0
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Make the film and show its scene."""
        return self.reported(self._make, context)

    def _make(self, context: bpy.types.Context) -> set[str]:
        if not (self.build or self.turn):
            raise BuildError("The film shows nothing: switch on Build It or Turn It.")
        cut = Cut(self.frames_a_step * self.build, self.frames_a_turn * self.turn)
        film = make_film(context.scene, current_build(context.scene), cut, samples=self.samples)
        if context.window:
            context.window.scene = film
        told = rpt("{} frames in the scene {!r}: Ctrl-F12 renders them.").format(film.frame_end, film.name)
        self.report({"INFO"}, told)
        return {"FINISHED"}


classes = (LEGORIZE_OT_animate, LEGORIZE_OT_stop_animation, LEGORIZE_OT_film)
register, unregister = bpy.utils.register_classes_factory(classes)
