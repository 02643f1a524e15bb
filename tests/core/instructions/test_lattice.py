"""What is seen of bricks from a corner, against rays that are followed cell by cell."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.instructions.lattice import FRONT, PER_TOP, TOP, Cells, View, look, turned
from legorize_addon.core.model.bricks import NOBODY
from tests.core.any_bricks import CATALOGUE, everything, table

PART = {part.number: row for row, part in enumerate(CATALOGUE.parts)}
cells = st.sets(st.tuples(*(st.integers(0, size) for size in (3, 3, 5))), min_size=1, max_size=25)


def first_hit(filled, p, q):
    """Return the cell and side that a ray from the viewer meets first, in exact numbers."""
    best = None
    for x, y, z in filled:
        # the line of sight is ((at - q) / 3, (at - p) / 3, at): at which height does it cross the plane of a face
        for side, at in ((0, Fraction(z + 1)), (1, 3 * (x + 1) + q), (2, 3 * (y + 1) + p)):
            point = ((at - q) / 3, (at - p) / 3, at)
            inside = [low < value < low + 1 for low, value in zip((x, y, z), point, strict=True)]
            inside[(2, 0, 1)[side]] = True
            if all(inside) and (best is None or at > best[0]):
                best = (at, (x, y, z), side)
    return best and best[1:]


@settings(deadline=None, max_examples=30)
@given(cells)
def test_every_piece_shows_what_its_line_of_sight_meets_first(filled):
    """The depth buffer agrees with rays in fractions, piece by piece."""
    place = np.array(sorted(filled))
    sight = look(Cells(place, np.arange(len(place))), len(place))
    for (m, n, half), face in np.ndenumerate(sight.nearest):
        p, q = (Fraction(int(low) + one) for low, one in zip(sight.low, (m, n), strict=True))
        third, two = Fraction(1, 3), Fraction(2, 3)
        hit = first_hit(filled, p + (two if half else third), q + (third if half else two))
        # a ray through the middle of a piece never runs along a line of the lattice
        if face == NOBODY:
            assert hit is None
        else:
            assert hit == (tuple(sight.faces.place[face].tolist()), int(sight.faces.side[face]))


@settings(deadline=None, max_examples=30)
@given(cells)
def test_ground_is_all_around(filled):
    """The outermost squares show nothing, so that every piece that is seen has neighbours."""
    place = np.array(sorted(filled))
    nearest = look(Cells(place, np.zeros(len(place), np.int64)), 1).nearest
    for rim in (nearest[0], nearest[-1], nearest[:, 0], nearest[:, -1]):
        assert (rim == NOBODY).all()


@pytest.mark.parametrize("number", ["3005", "3024", "3001", "14716"])
def test_a_brick_alone_is_seen_whole(number):
    """Alone a box shows all that it can: its top and two sides, those a third a plate and stud."""
    part = CATALOGUE.parts[PART[number]]
    one = table([(PART[number], 2, -3, 4, 1, 4, 0, 0, 0)])
    sight = look(Cells.of(one, CATALOGUE, FRONT), 1)
    sides = (part.length + part.width) * part.height * PER_TOP // 3
    assert sight.free.tolist() == [part.length * part.width * PER_TOP + sides]
    assert sight.shares.tolist() == [1.0]


def test_all_parts_show_most_of_themselves_alone():
    """Only corner parts and slopes hide some of their own faces."""
    bricks = everything()
    for row in range(len(bricks)):
        one = bricks.take(np.array([row]))
        for view in [View(turns, below) for turns in range(4) for below in (False, True)]:
            [share] = look(Cells.of(one, CATALOGUE, view), 1).shares
            part = CATALOGUE.parts[one.part[0]]
            assert share == 1 or ((part.corner or part.shaped) and share > 0.6)


def test_what_stands_before_hides():
    """A plate behind a tall brick is not seen from the front, but from behind, and its underside from below."""
    tall, plate = (PART["14716"], 1, 1, 0, 0, 4, 0, 0, 0), (PART["3024"], 0, 0, 0, 0, 1, 0, 0, 0)
    bricks = table([tall, plate])
    shares = {
        view: look(Cells.of(bricks, CATALOGUE, view), 2).shares.tolist()
        for view in (View(0), View(1), View(2), View(0, below=True))
    }
    assert shares[View(0)] == [1.0, 0.0]
    assert shares[View(2)][1] == 1.0
    assert 0 < shares[View(1)][1] <= 1.0
    assert shares[View(0, below=True)][1] > 0


def test_turns():
    """Four quarter turns are none; laid on the back twice is a half turn about the upright."""
    place = np.array([[1, 2, 3], [-4, 0, 7]])
    for _ in range(4):
        place = turned(place, View(1))
    assert place.tolist() == [[1, 2, 3], [-4, 0, 7]]
    back = turned(place, View(0, below=True))
    assert back.tolist() == [[2, 1, -4], [0, -4, -8]]


def test_front_shows_the_sides_towards_minus_y_and_plus_x():
    """Seen from the front right, what lies before the model at -y covers it."""
    tall, plate = (PART["14716"], 1, -1, 0, 0, 4, 0, 0, 0), (PART["3024"], 0, 0, 0, 0, 1, 0, 0, 0)
    assert look(Cells.of(table([tall, plate]), CATALOGUE, FRONT), 2).shares.tolist() == [1.0, 0.0]


def test_nothing_to_see():
    """Without cells there are no faces, and shares of nothing are nothing."""
    sight = look(Cells(np.zeros((0, 3), np.int64), np.zeros(0, np.int64)), 2)
    assert len(sight.faces) == 0
    assert sight.shares.tolist() == [0.0, 0.0]
    assert (sight.bricks == NOBODY).all()
    assert not (sight.faces.side == TOP).any()
