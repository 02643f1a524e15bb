"""Columns under contacts, and full columns as the reference."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.supports.columns import columns, covered, pillars, within_clearance
from scripts.research.full_columns import FLAT, TALL_SIZES, full_columns
from tests.core.supports.places import assert_sound, ceiling, ceilings, room_under, triples

OPEN = np.full((6, 6), 20)


@pytest.mark.parametrize("height", range(1, 10))
def test_column_is_bricks_and_then_plates(height):
    """Bricks stand on layers counted from the ground, what is left of the height is plates right under the contact."""
    boxes = pillars([(2, 2, height)])
    assert boxes[:, 5].tolist() == [3] * (height // 3) + [1] * (height % 3)
    np.testing.assert_array_equal(boxes[:, 2], np.cumsum([0, *boxes[:-1, 5]]))


def test_foot_is_two_by_two():
    """A column has a wide foot under slim bricks."""
    boxes = columns([(2, 2, 9)], room_under(OPEN))
    assert sorted(map(tuple, boxes[:, 3:].tolist())) == [(1, 1, 3), (1, 1, 3), (2, 2, 3)]


def test_neighbours_share_a_foot():
    """Four columns in a square stand on one foot, and a fifth apart has one of its own."""
    square = [(2, 2, 6), (3, 2, 6), (2, 3, 6), (3, 3, 6)]
    boxes = columns([*square, (5, 5, 6)], room_under(OPEN))
    assert (boxes[:, 2] == 0).sum() == 2
    assert_sound(boxes, room_under(OPEN), [*square, (5, 5, 6)])


def test_foot_needs_room():
    """In a shaft of one stud the foot is as slim as the column."""
    height = np.zeros((5, 5), dtype=int)
    height[2, 2] = 9
    assert (columns([(2, 2, 9)], room_under(height))[:, 3:5] == 1).all()


@given(ceilings())
def test_columns_are_sound(case):
    """Columns and pillars are parts that stand in open room, hold together and carry every contact."""
    room, cells = case
    contacts = triples(cells)
    assert_sound(columns(contacts, room), room, contacts)
    assert_sound(pillars(contacts), room, contacts)


@given(ceilings())
def test_full_columns_fill_all_room_below(case):
    """They are sound, cover exactly what lies under the cells, and only with the paper's types and plates."""
    room, cells = case
    boxes = full_columns(cells, room)
    owner = assert_sound(boxes, room, triples(cells))
    below = np.zeros(room.open.shape, dtype=bool)
    for x, y, z in cells.tolist():
        below[:z, y, x] = True
    np.testing.assert_array_equal(owner != NOBODY, below)
    sizes = {(max(a, b), min(a, b), height) for _, _, _, a, b, height in boxes.tolist()}
    assert sizes <= {(*flat, height) for flat in FLAT for height in (1, 3)} | {(*tall, 9) for tall in TALL_SIZES}


def test_full_columns_take_the_largest():
    """A block of 4 x 2 studs and three layers is one brick, twelve by twelve and one layer are twelve of 2 x 6."""
    block = np.full((2, 4), 9)
    assert full_columns(ceiling(block), room_under(block)).tolist() == [[0, 0, 0, 4, 2, 9]]
    flat = np.full((12, 12), 3)
    boxes = full_columns(ceiling(flat), room_under(flat))
    assert len(boxes) == 12
    assert np.sort(boxes[:, 3:5]).tolist() == [[2, 6]] * 12


def test_twenty_thousand_cells():
    """A wide ceiling at many heights is filled to the last cell."""
    y, x = np.indices((140, 143))
    height = 3 + (x + 2 * y) // 7
    boxes = full_columns(ceiling(height), room_under(height))
    assert boxes[:, 3:].prod(axis=1).sum() == height.sum()


def test_covered_leaves_what_fits_nothing():
    """Cells that no size fits into stay uncovered."""
    cells = np.zeros((1, 3, 3), dtype=bool)
    cells[0, :2, :2] = cells[0, 2, 2] = True
    assert covered(cells, [(2, 2)]).tolist() == [[0, 0, 0, 2, 2]]


def test_cells_without_room_are_left_out():
    """A cell over a closed column, and one on the ground, get nothing; doubles count once."""
    room = room_under([[6, 0]])
    assert within_clearance(np.array([[0, 0, 6], [0, 0, 6], [1, 0, 6], [0, 0, 0]]), room).tolist() == [[0, 0, 6]]
    assert len(full_columns(np.zeros((0, 3), dtype=int), room)) == 0
