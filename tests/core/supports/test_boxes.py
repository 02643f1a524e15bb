"""Boxes of supports, and the bricks that they become."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from legorize_addon.core.model.bricks import NOBODY, Role
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.supports.boxes import (
    boxes_of,
    bricks_of_boxes,
    merge_upwards,
    of_the_paper,
    sizes_in,
    split_missing,
)
from legorize_addon.core.supports.columns import pillars
from scripts.research.full_columns import full_columns
from tests.core.supports.places import CATALOGUE, WHITE, ceilings, owners, triples


def bricks_of(boxes):
    """Return white bricks of boxes."""
    return bricks_of_boxes(boxes, CATALOGUE, colour=WHITE, role=Role.SUPPORT_OUTSIDE)


def tower(n, z=0):
    """Return bricks of 2 x 2 on each other."""
    return boxes_of((1, 1, z + 3 * step, 2, 2, 3) for step in range(n))


def test_no_boxes():
    """An empty list is an array of no rows, and no bricks."""
    assert boxes_of([]).shape == (0, 6)
    assert len(bricks_of(boxes_of([]))) == len(merge_upwards(boxes_of([]), CATALOGUE, WHITE)) == 0


def test_parts_of_the_paper():
    """Five bricks one stud wide, four two studs wide, two tall ones, and those of eight studs; one plate."""
    narrow = {(length, 1, 3) for length in (1, 2, 3, 4, 6, 8)}
    wide = {(length, 2, 3) for length in (2, 3, 4, 6, 8)}
    few = of_the_paper(CATALOGUE)
    assert set(sizes_in(few, WHITE)) == narrow | wide | {(2, 2, 9), (4, 2, 9)} | {(1, 1, 1)}
    assert few.parts == CATALOGUE.parts


@pytest.mark.parametrize("n", range(10))
@pytest.mark.parametrize("z", [0, 1, 2])
def test_three_bricks_become_a_tall_one(n, z):
    """A tower becomes as many tall bricks as can be, from below, on whatever plate it begins."""
    joined = merge_upwards(tower(n, z), CATALOGUE, WHITE)
    assert joined[:, 5].tolist() == [9] * (n // 3) + [3] * (n % 3)
    assert joined[:, 3:].prod(axis=1).sum() == 12 * n


def test_only_equal_bricks_are_joined():
    """Neither a brick of another size, nor a gap, nor plates are joined, nor sizes without a tall part."""
    apart = [
        boxes_of([(0, 0, 0, 2, 2, 3), (0, 0, 3, 2, 1, 3), (0, 0, 6, 2, 2, 3)]),
        boxes_of([(0, 0, 0, 2, 2, 3), (0, 0, 3, 2, 2, 3), (0, 0, 9, 2, 2, 3)]),
        boxes_of((0, 0, z, 2, 2, 1) for z in range(9)),
        boxes_of((0, 0, 3 * z, 3, 2, 3) for z in range(3)),
    ]
    for boxes in apart:
        np.testing.assert_array_equal(merge_upwards(boxes, CATALOGUE, WHITE), boxes)


def test_tall_bricks_need_their_colour():
    """Where the tall part is not made in a colour, three bricks stay three."""
    made = {code: sizes_in(CATALOGUE, code) for code in CATALOGUE.codes.tolist()}
    without = next(code for code, sizes in made.items() if (2, 2, 3) in sizes and (2, 2, 9) not in sizes)
    assert len(merge_upwards(tower(3), CATALOGUE, without)) == 3


@given(ceilings())
def test_joining_keeps_the_cells(case):
    """Joined boxes cover the same cells, and none more than once."""
    room, cells = case
    for boxes in (pillars(triples(cells)), full_columns(cells, room)):
        joined = merge_upwards(boxes, CATALOGUE, WHITE)
        before, after = (owners(each, room.open.shape) != NOBODY for each in (boxes, joined))
        np.testing.assert_array_equal(before, after)
        assert len(joined) <= len(boxes)


@given(ceilings())
def test_bricks_fill_their_boxes(case):
    """Each box becomes the brick of its size at its place, turned where it is longer along y."""
    room, cells = case
    boxes = full_columns(cells, room)
    bricks = bricks_of(boxes)
    graph = contact_graph(bricks, CATALOGUE)
    assert graph.collisions == 0
    wanted = owners(boxes, room.open.shape)
    n_z, n_y, n_x = graph.owner.shape
    np.testing.assert_array_equal(graph.owner, wanted[:n_z, :n_y, :n_x])
    assert (bricks.role == Role.SUPPORT_OUTSIDE).all()
    assert (bricks.colour == WHITE).all()


def test_corners_are_no_boxes():
    """The size of 2 x 2 studs is the square part, not the corner."""
    for row in sizes_in(CATALOGUE, WHITE).values():
        assert not CATALOGUE.parts[row].corner


def test_boxes_without_a_part_become_smaller_ones():
    """A tall box becomes three, a long one halves, and the same cells are filled; what has a part stays."""
    sizes = {(2, 1, 3), (1, 1, 3), (2, 2, 3)}
    boxes = boxes_of([(0, 0, 0, 2, 2, 9), (5, 0, 0, 1, 5, 3), (9, 9, 9, 2, 1, 3)])
    split = split_missing(boxes, sizes)
    assert {(max(a, b), min(a, b), height) for *_, a, b, height in split.tolist()} <= sizes

    def cells(boxes):
        return sorted(
            (x + i, y + j, z + k)
            for x, y, z, a, b, height in boxes.tolist()
            for i in range(a) for j in range(b) for k in range(height)
        )  # fmt: skip

    assert cells(split) == cells(boxes)
    assert split_missing(boxes[2:], sizes).tolist() == boxes[2:].tolist()
