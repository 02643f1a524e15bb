"""Collapse: what counts as its proof, and the linear programmes."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.statics.collapse import is_collapse, least_clutch, least_imbalance
from legorize_addon.core.statics.forces import HOLD, Ground
from scripts.benchmarks.stablelego import stair
from tests.core.standing import equations, judged, table, weight


def test_only_a_motion_that_wins_is_a_collapse() -> None:
    """Rest, the reversed motion, and the motion of a model that falls applied to one that stands prove nothing."""
    falls = judged(table(*stair(20)), ground=Ground.BASEPLATE)
    motion = falls.motion.reshape(-1)
    assert is_collapse(falls.statics, motion)
    assert np.abs(motion).max() == 1
    assert not is_collapse(falls.statics, -motion)
    assert not is_collapse(falls.statics, np.zeros_like(motion))
    stronger = equations(table(*stair(20)), clutch=1.05 * HOLD, ground=Ground.BASEPLATE)
    assert not is_collapse(stronger, motion)


def test_part_of_the_bricks_can_prove_a_collapse() -> None:
    """The bricks of an overhang, with all others in one lump, prove that the model falls; as one lump they do not."""
    rows = [*stair(20), *(("3001", x, 5, 0) for x in range(0, 40, 4))]
    found = equations(table(*rows), ground=Ground.BASEPLATE)
    # the bricks of the overhang by themselves, and each row of bricks in one lump
    assert is_collapse(found, least_imbalance(found, np.append(np.arange(20), np.full(10, 20))).motion)
    assert not is_collapse(found, least_imbalance(found, np.repeat([0, 1], [20, 10])).motion)


def test_work_of_a_brick_that_is_lifted_off() -> None:
    """A load that lifts a 1 x 1 brick wins against four holds and its weight, and not against a newton more."""
    for spare, falls in ((1e-6, True), (-1e-6, False)):
        load = np.array([[0, 0, 4 * HOLD + weight("3005") + spare]])
        found = equations(table(("3005", 0, 0, 0)), ground=Ground.BASEPLATE, loads=load)
        assert is_collapse(found, np.array([0, 0, 1.0, 0, 0, 0])) is falls
        assert is_collapse(found, np.array([0, 0, -1.0, 0, 0, 0])) is False


def test_a_motion_through_a_wall_is_none() -> None:
    """Where contacts close a little, the greatest force of all would stop the collapse."""
    found = equations(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)))
    motion = least_imbalance(found, np.arange(2)).motion
    assert is_collapse(found, motion)
    # the table stops a brick that sinks by a thousandth
    motion[2] -= 1e-3 * np.abs(motion).max()
    assert not is_collapse(found, motion)


@pytest.mark.parametrize("reserve", [0.0, 0.01])
def test_balance_by_a_linear_programme(reserve: float) -> None:
    """Where balance is possible nothing is left out of it, and every force keeps its distance from its least."""
    found = equations(table(*stair(10)), ground=Ground.BASEPLATE)
    solved = least_imbalance(found, np.arange(10), reserve=reserve)
    np.testing.assert_allclose(found.matrix @ solved.forces, -found.loads, atol=1e-7)
    assert (solved.forces >= found.contacts.least * (1 - reserve) - 1e-9).all()
    assert solved.imbalance < 1e-9
    np.testing.assert_array_equal(solved.motion, 0)


def test_the_motion_of_lumps_is_rigid() -> None:
    """What moves as one lump keeps its shape: nothing opens or closes inside, whichever way it turns."""
    below, above = (("3001", 0, 0), ("3007", 2, 0))
    bricks = table(*((*below, 3 * level) for level in range(3)), *((*above, 9 + 3 * level) for level in range(3)))
    found = equations(bricks, clutch=1e-3)
    solved = least_imbalance(found, np.array([0, 0, 0, 1, 1, 1]))
    assert is_collapse(found, solved.motion)
    inside = (found.contacts.by >= 0) & ((found.contacts.on < 3) == (found.contacts.by < 3))
    opening = found.matrix.T @ solved.motion
    assert np.abs(opening[inside]).max() < 1e-9 < np.abs(opening[~inside]).max()
    assert set(found.contacts.on[solved.across]) == {0, 3}


def test_least_hold_is_the_limit() -> None:
    """A hold a thousandth above it is enough, one a thousandth below is not; a brick by itself needs none."""
    limit = least_clutch(equations(table(*stair(15)), ground=Ground.BASEPLATE))
    assert judged(table(*stair(15)), clutch=1.001 * limit, ground=Ground.BASEPLATE).stable
    assert not judged(table(*stair(15)), clutch=0.999 * limit, ground=Ground.BASEPLATE).stable
    assert least_clutch(equations(table(("3001", 0, 0, 0)))) == 0
