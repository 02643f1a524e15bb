"""High stacks of single studs get wider where there is room."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.supports.beams import beams
from legorize_addon.core.supports.boxes import bricks_of_boxes, sizes_in
from legorize_addon.core.supports.columns import columns, pillars
from legorize_addon.core.supports.stacks import SLIM, slim_stacks, widen
from tests.core.supports.places import (
    CATALOGUE,
    WHITE,
    assert_sound,
    ceilings,
    owners,
    room_under,
    triples,
)

SIZES = sizes_in(CATALOGUE, WHITE)


def widened(contacts, height):
    """Return wider pillars under contacts below a ceiling, and the room there."""
    room = room_under(height)
    return widen(pillars(contacts), room.open, SIZES), room


def slim(boxes):
    """Return the heights of the stacks of a single stud above four bricks, found by walking down from each box."""
    if not len(boxes):
        return []
    owner = owners(boxes, tuple(boxes[:, [2, 1, 0]].max(axis=0) + boxes[:, 3:].max() + 9))
    single = (boxes[:, 3:5] == 1).all(axis=1)
    heights = []
    for row in np.flatnonzero(single).tolist():
        x, y, z, _, _, height = boxes[row].tolist()
        above = owner[z + height, y, x]
        if above != NOBODY and single[above]:
            continue
        foot = z
        while foot and (below := owner[foot - 1, y, x]) != NOBODY and single[below]:
            foot = boxes[below, 2]
        heights.append(z + height - foot)
    return sorted(height for height in heights if height > SLIM)


@pytest.mark.parametrize("height", range(1, 40))
def test_below_four_bricks_a_stack_is_two_studs_wide(height):
    """Up to four bricks it stays as it is, and no higher one has more than four of a single stud on top."""
    boxes, room = widened([(4, 4, height)], np.full((9, 9), height))
    assert_sound(boxes, room, [(4, 4, height)])
    assert slim(boxes) == []
    wide = boxes[(boxes[:, 3:5] == 2).all(axis=1)]
    assert len(wide) == max(-(-(height - SLIM) // 3), 0)
    # one over the other
    assert len(np.unique(wide[:, :2], axis=0)) <= 1


def test_no_wider_than_the_shaft():
    """In a shaft two studs wide and one deep, bricks are as wide as that; in one of a single stud they stay."""
    for wide in (1, 2):
        height = np.zeros((7, 7), dtype=int)
        height[3, 3 : 3 + wide] = 30
        boxes, room = widened([(3, 3, 30)], height)
        assert_sound(boxes, room, [(3, 3, 30)])
        assert boxes[:, 3].max() == wide
        assert slim(boxes) == ([30] if wide == 1 else [])


def test_neighbours_become_one():
    """Two stacks side by side share their bricks."""
    beside, room = widened([(3, 3, 30), (4, 3, 30)], np.full((8, 8), 30))
    assert_sound(beside, room, [(3, 3, 30), (4, 3, 30)])
    assert len(beside) == 6 + 2 * 4


def test_wide_bricks_lie_on_the_foot():
    """Of all places that a wider brick could have, it takes that over the brick on which its stack stands."""
    foot = np.array([[5, 5, 0, 2, 2, 3]])
    stack = pillars([(5, 5, 30)])[1:]
    boxes = widen(np.concatenate([foot, stack]).astype(np.int32), np.ones((30, 20, 20), dtype=bool), SIZES)
    assert {tuple(each) for each in boxes[boxes[:, 3] == 2][:, :2].tolist()} == {(5, 5)}


def test_other_supports_keep_their_place():
    """Where others are is not free: the stack grows to the other side."""
    free = np.ones((30, 9, 9), dtype=bool)
    free[:, :, 6] = free[:, 6, :6] = False
    boxes = widen(pillars([(5, 5, 30)]), free, SIZES)
    assert {tuple(each) for each in boxes[boxes[:, 3] == 2][:, :2].tolist()} == {(4, 4)}


def test_only_parts_that_are_made():
    """Where there is no brick of 2 x 2 in a colour, one of 1 x 2 is laid, and where there is none either, nothing."""
    free = np.ones((30, 9, 9), dtype=bool)
    less = {size for size in SIZES if size != (2, 2, 3)}
    assert widen(pillars([(5, 5, 30)]), free, less)[:, 3:5].prod(axis=1).max() == 2
    assert widen(pillars([(5, 5, 30)]), free, {(1, 1, 3)})[:, 3:5].max() == 1


@given(ceilings(most=30))
def test_wider_supports_are_sound(case):
    """Of every kind: parts in open room that hold together and carry every contact, on the cells of before and more."""
    room, cells = case
    contacts = triples(cells)
    for made in (pillars(contacts), columns(contacts, room), beams(cells, room)):
        boxes = widen(made, room.open, SIZES)
        owner = assert_sound(boxes, room, contacts)
        assert (owner[owners(made, room.open.shape) != NOBODY] != NOBODY).all()
        assert len(slim(boxes)) <= len(slim(made))


@given(ceilings(most=30))
def test_slim_stacks_are_all_found(case):
    """As many and as high as a walk down from every brick finds."""
    _, cells = case
    boxes = pillars(triples(cells))
    bricks = bricks_of_boxes(boxes, CATALOGUE, colour=WHITE, role=4)
    found = slim_stacks(Assembly(bricks, CATALOGUE))
    assert sorted(found.height.tolist()) == slim(boxes)
    tops = bricks.corner[found.top, 2] + CATALOGUE.height[bricks.part[found.top]]
    assert sorted(tops.tolist()) == sorted(found.height.tolist())
