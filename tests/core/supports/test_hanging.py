"""What holds a brick while the model is built from below."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.supports.hanging import NOT_HELD, Hanging
from scripts.benchmarks.stablelego import placed
from tests.core.standing import CATALOGUE, table

ROOF = (("3004", 0, 0, 0), ("3009", 0, 0, 3), ("3023", 4, 0, 2), ("3024", 5, 0, 1))
"""A foot, a beam on it, under the beam's free end a plate, and under that another one."""


def carrying(bricks, deepest, clutch=()):
    """Return what is held when some bricks stand."""
    height = np.array([part.height for part in CATALOGUE.parts])[bricks.part]
    made = Hanging(contact_graph(bricks, CATALOGUE), height, deepest=deepest)
    made.clutch(clutch)
    return made


def depths(made):
    """Return the depths, None of what is not held."""
    return [None if depth == NOT_HELD else depth for depth in made.depth.tolist()]


@pytest.mark.parametrize(
    ("deepest", "wanted"), [(0, [0, 0, None, None]), (1, [0, 0, 1, None]), (2, [0, 0, 1, 2]), (9, [0, 0, 1, 2])]
)
def test_hanging_is_limited(deepest, wanted):
    """What stands has depth 0, and each brick pressed from below hangs by its own height deeper."""
    assert depths(carrying(table(*ROOF), deepest, [0])) == wanted


def test_nothing_is_held_at_first():
    """Without a brick that stands none is held."""
    made = carrying(table(*ROOF), 9)
    assert depths(made) == [None] * 4
    assert not made.held(0)


def test_what_is_carried_carries():
    """A pillar under a hanging plate brings it to depth 0, and tells whom it holds from now on."""
    made = carrying(table(*ROOF), 0, [0])
    assert made.clutch([3]) == [3, 2]
    assert depths(made) == [0, 0, 0, 0]
    assert made.held(2)


def test_deepening_goes_on_from_there():
    """A higher limit later holds what it would have held at once."""
    made = carrying(table(*ROOF), 1, [0])
    assert made.deepen(2) == [3]
    assert depths(made) == depths(carrying(table(*ROOF), 2, [0]))


@st.composite
def models(draw):
    """Draw bricks of two studs on a small grid, in layers, some overlapping others by a stud."""
    rows = []
    for layer in range(draw(st.integers(1, 5))):
        at = draw(st.integers(0, 1))
        for x in range(at, 9, 2):
            if draw(st.booleans()):
                rows.append(("3004", x, 0, 3 * layer, 0))
    return placed(rows or [("3004", 0, 0, 0, 0)], CATALOGUE)


@given(models(), st.integers(0, 12), st.data())
def test_depths_are_a_fixed_point(bricks, deepest, data):
    """No depth can be bettered, each has its reason, and the order of holding does not matter."""
    level = bricks.corner[:, 2]
    ground = np.flatnonzero(level == level.min()).tolist()
    pairs = contact_graph(bricks, CATALOGUE).pairs
    made = carrying(bricks, deepest, ground)
    depth = made.depth.astype(np.int64)
    reason = np.where(level == level.min(), 0, NOT_HELD).astype(np.int64)
    for lower, upper in pairs.tolist():
        reason[upper] = min(reason[upper], depth[lower])
        hanging = depth[upper] + 3
        if hanging <= deepest:
            reason[lower] = min(reason[lower], hanging)
    np.testing.assert_array_equal(depth, reason)
    piecemeal = carrying(bricks, 0)
    for row in data.draw(st.permutations(ground)):
        piecemeal.clutch([row])
    piecemeal.deepen(deepest)
    np.testing.assert_array_equal(piecemeal.depth, made.depth)
