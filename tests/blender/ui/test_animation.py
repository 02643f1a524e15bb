"""The buttons of the assembly animation and the film."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.render.film import FILM_KEY
from legorize_addon.ui.animation import HOLD
from legorize_addon.view.animation import Animation, animation_of
from legorize_addon.view.steps import n_steps
from tests.blender.bricks import show, table
from tests.blender.view.test_steps import ONE, RED, show_storeys

pytestmark = pytest.mark.usefixtures("addon")


def test_the_timeline_builds_the_model() -> None:
    """From the first frame of the scene, whose range grows as needed; one click takes it back."""
    scene, build = bpy.context.scene, show_storeys(0)[0]
    scene.frame_start = 5
    assert bpy.ops.legorize.animate(frames=3) == {"FINISHED"}
    made = animation_of(build)
    assert made == Animation(5, 3, n_steps(build))
    assert (scene.frame_current, scene.frame_end) == (5, made.last + HOLD)
    assert bpy.ops.legorize.stop_animation() == {"FINISHED"}
    assert animation_of(build) is None
    assert not bpy.ops.legorize.stop_animation.poll()


def test_a_film_is_a_scene() -> None:
    """It builds and turns as asked; with neither it is refused."""
    show_storeys(0)
    with pytest.raises(RuntimeError, match="switch on Build It or Turn It"):
        bpy.ops.legorize.film(build=False, turn=False)
    assert bpy.ops.legorize.film(build=True, turn=False, frames_a_step=2) == {"FINISHED"}
    [film] = [scene for scene in bpy.data.scenes if FILM_KEY in scene]
    assert bpy.context.window.scene == film


def test_without_steps_there_is_no_animation() -> None:
    """The button says what is missing."""
    show(table([(ONE, 0, 0, 0, 0, RED, 0, 0)]))
    with pytest.raises(RuntimeError, match="no building steps"):
        bpy.ops.legorize.animate()
    assert bpy.ops.legorize.film(build=False, turn=True) == {"FINISHED"}
