"""The step that is shown stands out: what was there before is pale, supports are tinted."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.scene.brick_tree import STEPS
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import read_bricks
from legorize_addon.scene.instancing import bricks_modifier, get_input
from legorize_addon.ui.current import current_build
from legorize_addon.view.heat_map import show_heat_map
from legorize_addon.view.highlight import highlight_step, highlighted
from legorize_addon.view.steps import n_steps
from tests.blender.bricks import content, instances
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def build() -> bpy.types.Collection:
    """Return the model of a table on one leg: supports have to carry its ends."""
    add_table_on_one_leg()
    bpy.context.scene.legorize.settings.width = 12
    bpy.context.scene.legorize.settings.hanging = 0
    assert bpy.ops.legorize.build() == {"FINISHED"}
    return current_build(bpy.context.scene)


def look() -> tuple[int, int, int]:
    """Return how many bricks are bright, pale, and pale as supports."""
    names = [material for _, material, _ in instances()]
    pale = sum(name.startswith("Brick") and "pale" in name for name in names)
    tinted = sum(name.startswith("Support") for name in names)
    return len(names) - pale - tinted, pale, tinted


def expected(build: bpy.types.Collection, step: int) -> tuple[int, int, int]:
    """Return the same, of the table of bricks, for a step that takes nothing out."""
    bricks = read_bricks(build)
    supports = bricks.role == 4
    old = bricks.step < step - 1
    return int((bricks.step == step - 1).sum()), int((old & ~supports).sum()), int((old & supports).sum())


def test_every_step_stands_out(build):
    """Whatever way the slider goes, the bricks of its step are bright, those before pale, supports tinted."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    first_removal = int(np.max(read_bricks(build).step)) + 1
    for step in (1, 2, 3, first_removal, 2, 4, 1):
        view.step = step
        assert look() == expected(build, step)
    assert highlighted(build)


def test_leaving_the_steps_leaves_nothing(build):
    """All is as it was before, to the last material."""
    before, shown = content(), look()
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = 2
    assert content() != before
    view.by_steps = False
    assert content() == before
    assert look() == shown
    assert shown[1:] == (0, 0)


def test_it_can_be_switched_off(build):
    """Without it all bricks of the steps have their own colours."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = 3
    view.highlight = False
    assert look()[1:] == (0, 0)
    assert look()[0] == sum(expected(build, 3))
    view.highlight = True
    assert look() == expected(build, 3)


def test_the_heat_map_wins(build):
    """While the heat map is on bricks have its colours, and then those of the step again."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = 3
    show_heat_map(build, visible=True)
    assert all(material.startswith("Heat") for _, material, _ in instances())
    show_heat_map(build, visible=False)
    assert look() == expected(build, 3)


def test_building_again_keeps_it(build):
    """A model built in the place of another one stands out in the same way."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = 2
    assert bpy.ops.legorize.build() == {"FINISHED"}
    again = current_build(bpy.context.scene)
    assert highlighted(again)
    assert look() == expected(again, 2)


def test_removing_the_model_removes_all_of_it(build):
    """No pale part or material stays."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert not [each for each in (*bpy.data.objects, *bpy.data.materials, *bpy.data.collections) if "pale" in each.name]


def test_only_what_changes_is_evaluated(build):
    """From one step to the next only objects with bricks that appear, vanish or turn pale get the new number."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    view.step = n_steps(build) - 3
    before = {points: get_input(bricks_modifier(points), STEPS) for points in point_objects(build)}
    view.step = n_steps(build) - 2
    after = {points: get_input(bricks_modifier(points), STEPS) for points in point_objects(build)}
    assert before != after
    assert any(before[points] == after[points] for points in before)


def test_twice_is_once(build):
    """Switched on or off again nothing changes."""
    view = bpy.context.scene.legorize
    view.by_steps = True
    once = content()
    highlight_step(build, visible=True)
    assert content() == once
