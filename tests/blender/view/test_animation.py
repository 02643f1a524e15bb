"""The assembly animation: at the end of each step it shows what the steps show, and between them things move."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.bricks import Role
from legorize_addon.scene.animated_tree import DROP
from legorize_addon.scene.collections import read_bricks
from legorize_addon.view.animation import Animation, animate, animation_of
from legorize_addon.view.steps import n_steps
from legorize_addon.view.visibility import roles_shown, show_layers, show_steps, stop_animation
from tests.blender.bricks import assert_same, show, table
from tests.blender.view.test_steps import ONE, RED, seen, show_storeys

FIRST, FRAMES = 10, 20


def frame(number: int) -> list[list[float]]:
    """Return where the viewport shows bricks in a frame, in order."""
    bpy.context.scene.frame_set(number)
    return seen()


@pytest.mark.parametrize("pieces", [(0,), (0, 1), (0, 2, 1)])
def test_at_its_end_a_step_is_done(pieces: tuple[int, ...]) -> None:
    """The last frame of each step shows what that step shows; scrubbing backwards too; afterwards all is complete."""
    build, bricks, _ = show_storeys(*pieces)
    scene, wanted = bpy.context.scene, {}
    for step in range(1, n_steps(build) + 1):
        show_steps(build, step)
        wanted[step] = seen()
    show_steps(build, 0)
    made = animate(scene, build, first=FIRST, frames=FRAMES)
    assert made == animation_of(build) == Animation(FIRST, FRAMES, n_steps(build))
    for step in [*wanted, 2, 1]:
        assert frame(FIRST + step * FRAMES - 1) == wanted[step], step
    assert frame(made.last) == frame(made.last + 1000) == wanted[n_steps(build)]
    assert frame(FIRST - 1) == frame(-1000) == []
    assert_same(read_bricks(build), bricks)


def test_things_fall_rise_and_come_over() -> None:
    """Within a step bricks are above their places, supports that go rise, and what is joined comes from its place."""
    build, _, steps = show_storeys(0, 1)
    kinds = {}
    for step in range(n_steps(build)):
        actions = set(steps.moves.action[steps.moves.step == step].tolist())
        kinds.setdefault(min(actions) if len(actions) == 1 else None, step)
    animate(bpy.context.scene, build, first=FIRST, frames=FRAMES)
    [[_, _, height]] = frame(FIRST)
    assert height == pytest.approx(DROP, abs=0.1)
    heights = [max(place[2] for place in frame(number)) for number in range(FIRST, FIRST + 3)]
    assert heights == sorted(heights, reverse=True)
    for action, step in kinds.items():
        start, end = (frame(FIRST + step * FRAMES + at) for at in (3, FRAMES - 1))
        assert start != end, action


def test_bricks_of_a_step_come_one_after_another() -> None:
    """They are not all there at its beginning, and nothing of the next step is there at its end."""
    build, _, steps = show_storeys(0)
    animate(bpy.context.scene, build, first=0, frames=100)
    counts = [len(frame(number)) for number in range(100)]
    assert counts == sorted(counts)
    assert counts[0] == 1
    assert counts[-1] == np.count_nonzero(steps.moves.step == 0)


def test_stopping_shows_everything_as_before() -> None:
    """Supports are shown as they were, in every frame."""
    build, _, _ = show_storeys(0)
    before, shown = frame(1), roles_shown(build)
    animate(bpy.context.scene, build, first=1, frames=5)
    assert roles_shown(build)[Role.SUPPORT_OUTSIDE]
    animate(bpy.context.scene, build, first=1, frames=9)
    stop_animation(build)
    stop_animation(build)
    assert animation_of(build) is None
    assert roles_shown(build) == shown
    assert frame(1) == frame(77) == before


def test_all_layers_are_shown() -> None:
    """A model of which only some layers were shown is complete in the end."""
    build, bricks, _ = show_storeys(0)
    show_layers(bpy.context.scene, build, 1)
    made = animate(bpy.context.scene, build, first=1, frames=5)
    assert len(frame(made.last)) == np.count_nonzero(bricks.role != Role.SUPPORT_OUTSIDE)


@pytest.mark.parametrize("change", [stop_animation, lambda build: show_steps(build, 2)])
def test_steps_end_it(change: Callable[[bpy.types.Collection], None]) -> None:
    """Whoever looks at a step by hand wants to see that step, whatever the frame."""
    build, _, _ = show_storeys(0)
    animate(bpy.context.scene, build, first=1, frames=5)
    change(build)
    assert animation_of(build) is None
    assert frame(1) == frame(50)


def test_a_build_without_steps_says_so() -> None:
    """One sentence."""
    build = show(table([(ONE, 0, 0, 0, 0, RED, 0, 0)]))
    with pytest.raises(BuildError, match="no building steps: legorize the object again"):
        animate(bpy.context.scene, build, first=1, frames=5)
