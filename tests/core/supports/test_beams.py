"""Beams and steady pillars, as the paper's section on segmentation describes them."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.supports.beams import areas, beams, distribution, pillars_of
from scripts.research.full_columns import TALL_SIZES
from tests.core.supports.places import assert_sound, ceiling, ceilings, room_under, triples

LENGTHS = (1, 2, 3, 4, 6)

TABLE = [
    [1], [2], [3], [4], [3, 2], [6], [4, 3], [6, 2], [6, 3], [6, 4], [6, 3, 2], [6, 6], [6, 4, 3], [6, 6, 2],
]  # fmt: skip
"""Beams of rows of 1 to 14 studs."""


@pytest.mark.parametrize(("length", "wanted"), list(enumerate(TABLE, 1)))
def test_distribution(length, wanted):
    """By six, then by four and three with a remainder that is not one."""
    assert distribution(length) == wanted


@given(st.integers(0, 200))
def test_distribution_is_whole(length):
    """The beams are as long as the row, none but a row of one has a single stud, and only six repeats."""
    found = distribution(length)
    assert sum(found) == length
    assert length == 1 or 1 not in found
    assert all(found.count(each) == 1 for each in found if each != 6)


@pytest.mark.parametrize("length", range(1, 25))
def test_distribution_is_shortest(length):
    """No fewer beams are as long together."""
    fewer = len(distribution(length)) - 1
    assert all(sum(each) != length for n in range(fewer + 1) for each in combinations_with_replacement(LENGTHS, n))


def test_equal_rows_share_a_beam():
    """Two equal rows become one beam of double width, the third of three stays single."""
    y, x = np.indices((4, 3)).reshape(2, -1)
    assert areas(np.stack([x, y, 0 * x + 9], axis=1)).tolist() == [[0, 0, 9, 2, 4], [2, 0, 9, 1, 4]]


def test_unequal_rows_do_not():
    """Rows of another start or length keep beams of their own."""
    cells = [(0, 0), (0, 1), (1, 1), (1, 2), (2, 1), (2, 2), (2, 3)]
    found = areas(np.array([(x, y, 9) for x, y in cells]))
    assert sorted(found[:, [0, 1, 3, 4]].tolist()) == [[0, 0, 1, 2], [1, 1, 1, 2], [2, 1, 1, 3]]


def test_single_cells_become_beams_across():
    """A row of five single cells is cut into 3 and 2, turned."""
    found = areas(np.array([(x, 4, 9) for x in range(5)]))
    assert found.tolist() == [[0, 4, 9, 3, 1], [3, 4, 9, 2, 1]]


@given(ceilings())
def test_areas_cover_every_cell_once(case):
    """The beams of all levels cover just the cells."""
    _, cells = case
    covered = [(x + i, y + j, z) for x, y, z, a, b in areas(cells).tolist() for i in range(a) for j in range(b)]
    assert sorted(covered) == sorted(triples(cells))


@given(ceilings(density=(0.4, 1.0)))
def test_beams_are_sound(case):
    """Beams, pillars and links are parts in open room that hold together and carry every cell."""
    room, cells = case
    boxes = beams(cells, room)
    assert_sound(boxes, room, triples(cells))
    tall = boxes[boxes[:, 5] == 9]
    assert {(max(a, b), min(a, b)) for a, b in tall[:, 3:5].tolist()} <= set(TALL_SIZES)


@pytest.mark.parametrize("layers", range(1, 13))
def test_pillars_are_tall_bricks_and_then_single_ones(layers):
    """Under a wide beam a height of 3 q + r layers is q tall bricks and r single ones."""
    height = np.full((3, 2), 3 * (layers + 1))
    boxes = beams(ceiling(height), room_under(height))
    below = boxes[boxes[:, 2] < 3 * layers]
    assert below[:, 5].tolist() == [9] * (layers // 3) + [3] * (layers % 3)
    assert (below[:, 3:5] == 2).all()


@pytest.mark.parametrize("wide", [1, 2])
@pytest.mark.parametrize("length", LENGTHS)
def test_pillars_stand_under_the_middle(length, wide):
    """No pillar is longer than four studs; their common middle is half a stud off the beam's at most, either way."""
    for beam in {(5, 7, wide, length), (5, 7, length, wide)}:
        found = np.array(pillars_of(beam))
        assert found[:, 2:].max() <= 4
        middle = np.average(found[:, :2] + found[:, 2:] / 2, axis=0)
        assert np.abs(middle - np.array(beam[:2]) - np.array(beam[2:]) / 2).max() <= 0.5
        assert (found[:, :2] >= beam[:2]).all()
        assert (found[:, :2] + found[:, 2:] <= np.add(beam[:2], beam[2:])).all()


def test_beams_end_at_closed_columns():
    """A pillar of the model cuts a row of five in two."""
    height = np.full((5, 1), 6)
    height[2] = 0
    cells = np.array([(0, y, 6) for y in range(5)])
    found = beams(cells, room_under(height))
    assert sorted(found[found[:, 2] == 3][:, [1, 4]].tolist()) == [[0, 2], [3, 2]]
