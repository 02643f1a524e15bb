"""From where steps are seen."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.moves import Action
from legorize_addon.core.instructions.lattice import FRONT, View
from legorize_addon.core.instructions.shots import shots
from legorize_addon.core.instructions.sightlines import ENOUGH, Stage, removal, scenes
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import PART, arm, pair

NONE = np.zeros(0, dtype=np.int64)
TALL, SMALL, PLATE = PART["14716"], PART["3005"], PART["3024"]


def seen(bricks, stays, placed, *, below=False):
    """Return the pictures of one step."""
    return list(scenes(Stage(bricks, CATALOGUE), np.array(stays, int), np.array(placed, int), NONE, FRONT, below=below))


def test_what_is_seen_well_is_not_turned():
    """A brick on top is seen from the front."""
    [scene] = seen(table([(SMALL, 0, 0, 0, 0, 4, 0, 0, 0), (SMALL, 0, 0, 3, 0, 4, 0, 0, 0)]), [0], [1])
    assert scene.view == FRONT
    assert scene.shares.tolist() == [1.0]
    assert not len(scene.left_out)


def test_the_model_is_turned_to_what_is_behind_it():
    """A plate behind a wall is seen from behind."""
    wall = [(TALL, x, 0, 0, 0, 4, 0, 0, 0) for x in range(-4, 5)]
    [scene] = seen(table([*wall, (PLATE, 0, 1, 0, 0, 1, 0, 0, 0)]), range(9), [9])
    assert scene.view != FRONT
    assert not scene.view.below
    assert scene.good


def test_what_is_pressed_under_a_roof_is_seen_from_below():
    """A plate below a wide roof is seen from no corner above; the model is laid on its back."""
    roof = [(PART["3034"], 8 * i, 2 * j, 9, 0, 4, 0, 0, 0) for i in range(3) for j in range(12)]
    walls = [(TALL, x, y, 0, 0, 4, 0, 0, 0) for x in range(24) for y in range(24) if x in (0, 23) or y in (0, 23)]
    bricks = table([*roof, *walls, (PLATE, 12, 12, 8, 0, 1, 0, 0, 0)])
    [scene] = seen(bricks, range(len(bricks) - 1), [len(bricks) - 1], below=True)
    assert scene.view.below
    assert scene.good
    assert not len(scene.left_out)


def test_what_stands_before_is_left_out():
    """A plate on the ground of a deep pit is shown with the wall before it left out, and no more than that."""
    pit = [(TALL, x, y, 0, 0, 4, 0, 0, 0) for x in range(-1, 2) for y in range(-1, 2) if (x, y) != (0, 0)]
    bricks = table([*pit, (PLATE, 0, 0, 0, 0, 1, 0, 0, 0)])
    [scene] = seen(bricks, range(8), [8])
    assert scene.good
    assert 0 < len(scene.left_out) < 8


def test_bricks_that_hide_each_other_have_pictures_of_their_own():
    """A plate that is built over in the same step is shown before."""
    rows = [(PLATE, 0, 0, 0, 0, 4, 0, 0, 0), *((TALL, x, y, z, 0, 4, 0, 0, 0) for x, y, z in RING)]
    bricks = table([*rows, (SMALL, 0, 0, 1, 0, 4, 0, 0, 0)])
    pictures = seen(bricks, [], range(len(bricks)))
    assert len(pictures) > 1
    assert [row for scene in pictures for row in scene.new.tolist()] == list(range(len(bricks)))
    assert all(scene.good for scene in pictures)


RING = [(x, y, 0) for x in range(-1, 2) for y in range(-1, 2) if (x, y) != (0, 0)]


@pytest.mark.parametrize("model", [arm, pair])
def test_every_new_brick_is_seen(model):
    """In the steps of whole models each brick shows at least the share that is asked for in one picture."""
    plan = model()
    stage = Stage(plan.bricks, CATALOGUE)
    for shot in shots(plan.steps, temporary=plan.temporary):
        if shot.step.action == Action.REMOVE:
            continue
        pictures = scenes(stage, shot.stays, shot.placed, shot.came, FRONT, below=shot.step.pressed)
        shown = {}
        for scene in pictures:
            shown |= dict(zip(scene.new.tolist(), scene.shares.tolist(), strict=True))
        assert set(shown) == set(shot.new.tolist())
        assert all(shown[row] >= ENOUGH for row in shot.placed.tolist())


def test_shares_are_those_of_the_picture():
    """What is left out is not seen: its faces are in no piece of the plane."""
    pit = [(TALL, x, y, 0, 0, 4, 0, 0, 0) for x in range(-1, 2) for y in range(-1, 2) if (x, y) != (0, 0)]
    bricks = table([*pit, (PLATE, 0, 0, 0, 0, 1, 0, 0, 0)])
    [scene] = seen(bricks, range(8), [8])
    assert not np.isin(scene.left_out, scene.sight.bricks).any()
    assert scene.view in [View(turns) for turns in range(4)]


def taken(bricks, rows, first=FRONT):
    """Return how some bricks are seen when they are taken out, each a stack by itself."""
    stays = np.setdiff1d(np.arange(len(bricks)), rows)
    return removal(Stage(bricks, CATALOGUE), stays, np.array(rows), first, np.arange(len(rows)))


ROOF = [(PART["3034"], 8 * i, 2 * j, 1, 0, 4, 0, 0, 0) for i in range(3) for j in range(12)]
MIDDLE, RIM = (PLATE, 12, 12, 0, 0, 1, 1, 0, 0), (PLATE, 12, 0, 0, 0, 1, 1, 0, 0)


def test_what_is_hidden_from_above_is_taken_out_from_below():
    """A support under the middle of a roof is seen from no corner above, one under its rim is."""
    assert taken(table([*ROOF, MIDDLE]), [36]).view.below
    assert not taken(table([*ROOF, RIM]), [36]).view.below
    both = taken(table([*ROOF, MIDDLE, RIM]), [36, 37])
    assert both.view.below
    assert (both.shares >= ENOUGH).all()


def test_of_a_stack_one_brick_is_enough():
    """A plate over a support that is seen need not be seen itself."""
    high = [(part, x, y, 4, *rest) for part, x, y, _, *rest in ROOF]
    bricks = table([*high, (SMALL, 12, 0, 0, 0, 1, 1, 0, 0), (PLATE, 12, 0, 3, 0, 1, 1, 0, 0)])
    scene = removal(Stage(bricks, CATALOGUE), np.arange(36), np.array([36, 37]), FRONT, np.zeros(2, int))
    assert not scene.view.below
