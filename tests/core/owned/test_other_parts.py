"""Small lots become parts that are there anyway: the same cells and colours, fewer lots, nothing comes apart."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.again import faithful
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import footprint
from legorize_addon.core.owned.other_parts import exchange_small
from tests.core.any_bricks import CATALOGUE, table

ROW = CATALOGUE.part_row
LENGTHS = {1: ROW("3005"), 2: ROW("3004"), 3: ROW("3622"), 4: ROW("3010"), 6: ROW("3009"), 8: ROW("3008")}
RED, BLUE = 4, 1


def brick(length, x, y=0, course=0, colour=RED, role=0):
    """Return the row of a brick one stud wide along x."""
    return LENGTHS[length], x, y, 3 * course, 0, colour, role, 0, 0


def lots(assembly):
    """Count the bricks of each part and colour."""
    return Counter(zip(assembly.bricks.part.tolist(), assembly.bricks.colour.tolist(), strict=True))


def apart(*lengths, colour=RED, y=10):
    """Return three bricks of each length, far from everything."""
    return [brick(length, 10 * n, y + 2 * row, colour=colour) for row, length in enumerate(lengths) for n in range(3)]


def test_a_single_long_brick_is_split():
    """A 1 x 6 across two 1 x 4 becomes a 1 x 2 and a 1 x 4 where there are such, and still joins what lies below."""
    model = Assembly(table([brick(4, 0), brick(4, 4), brick(6, 0, course=1), *apart(2, 4)]), CATALOGUE)
    found, n_split, n_joined = exchange_small(model, 1.0)
    assert (n_split, n_joined) == (1, 0)
    assert lots(found) == {(LENGTHS[4], RED): 6, (LENGTHS[2], RED): 4}
    assert found.graph.n_components == model.graph.n_components


def test_a_single_short_brick_is_joined():
    """A 1 x 1 beside a 1 x 3 becomes a 1 x 4 with it, which takes a brick less."""
    model = Assembly(table([brick(3, 0), brick(1, 3), *apart(3, 4)]), CATALOGUE)
    found, n_split, n_joined = exchange_small(model, 1.0)
    assert (n_split, n_joined) == (0, 1)
    assert lots(found) == {(LENGTHS[3], RED): 3, (LENGTHS[4], RED): 4}


@pytest.mark.parametrize(
    "rows",
    [
        # nothing that the two halves could be
        [brick(6, 0), *apart(4)],
        # in another colour
        [brick(6, 0), *apart(2, 4, colour=BLUE)],
        # a split would let the model come apart
        [brick(2, 0), brick(4, 2), brick(6, 0, course=1), *apart(2, 4)],
        # the other one of the lot cannot go
        [brick(3, 0), brick(1, 3), brick(1, 0, 50), *apart(3, 4)],
        # a support that stays
        [brick(6, 0, role=int(Role.SUPPORT_KEPT)), *apart(2, 4)],
        # three are no small lot
        [*apart(6, y=30), *apart(2, 4)],
        # a wedge plate is there for its shape
        [(ROW("43722"), 0, 0, 0, 0, RED, 0, 0, 0), *((ROW("3021"), 10 * n, 9, 0, 0, RED, 0, 0, 0) for n in range(3))],
    ],
)
def test_what_has_no_place_stays(rows):
    """The same object is given back."""
    model = Assembly(table(rows), CATALOGUE)
    assert exchange_small(model, 1.0) == (model, 0, 0)


def test_close_colours_come_first():
    """A lot that will be merged into a close colour keeps its parts."""
    base = [brick(4, 0, colour=320), brick(4, 4, colour=320), brick(6, 0, course=1, colour=320)]
    model = Assembly(table([*base, *apart(6), *apart(2, 4, colour=320, y=30)]), CATALOGUE)
    assert exchange_small(model, 60.0)[0] is model
    assert exchange_small(model, 1.0)[1] == 1


@st.composite
def walls(draw):
    """Draw a wall two studs thick of three courses, in bricks of random lengths and two colours."""
    rows = []
    for course in range(3):
        for y in range(2):
            x = 0
            while x < 24:
                length = draw(st.sampled_from([each for each in LENGTHS if each <= 24 - x]))
                rows.append(brick(length, x, y, course, draw(st.sampled_from([RED, RED, BLUE]))))
                x += length
    return Assembly(table(rows), CATALOGUE)


def cells(bricks):
    """Return all cells, each as often as it is filled."""
    return Counter(
        (x + dx, y + dy, z + up)
        for part, turn, (x, y, z) in zip(bricks.part, bricks.turn.tolist(), bricks.corner.tolist(), strict=True)
        for dx, dy in footprint(CATALOGUE.parts[part], turn).tolist()
        for up in range(CATALOGUE.parts[part].height)
    )


@given(walls())
@settings(max_examples=25, deadline=None)
def test_any_wall_keeps_its_cells_and_colours(model):
    """Fewer lots, none of them new; the same cells, each once, in the same colours; the counts are those of bricks."""
    found, n_split, n_joined = exchange_small(model, 1.0)
    assert cells(found.bricks) == cells(model.bricks)
    assert faithful(found.bricks, model.bricks, CATALOGUE)
    assert found.graph.n_components <= model.graph.n_components
    assert set(lots(found)) <= set(lots(model))
    assert len(found) == len(model) + n_split - n_joined
    assert (found is model) == (n_split + n_joined == 0)
    assert found is model or len(lots(found)) < len(lots(model))
    assert np.all(found.bricks.step == 0)
