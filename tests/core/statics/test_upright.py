"""Upright forces: a smaller balance of which every solution is one of the whole."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from legorize_addon.core.statics.equilibrium import AIMS, balance, is_equilibrium
from legorize_addon.core.statics.forces import HOLD, Ground
from legorize_addon.core.statics.upright import upright
from scripts.benchmarks.stablelego import stair
from tests.core.standing import equations, table


@pytest.mark.parametrize("ground", list(Ground))
def test_one_force_a_contact_point(ground: Ground) -> None:
    """Forces at a point become one that may be what all of them may be, in three equations a brick."""
    whole = equations(table(("3001", 0, 0, 0), ("3010", 0, 0, 3), ("2357", 2, 0, 3)), ground=ground)
    reduced = upright(whole)
    contacts = reduced.statics.contacts
    points = np.unique(np.column_stack([whole.contacts.on, whole.contacts.by, whole.contacts.point]), axis=0)
    assert len(contacts.on) == len(points)
    assert reduced.statics.matrix.shape == (3 * 3, len(points))
    np.testing.assert_array_equal(contacts.direction, np.tile([0, 0, 1], (len(points), 1)))
    np.testing.assert_allclose(np.unique(contacts.least), [-HOLD] if ground is Ground.BASEPLATE else [-HOLD, 0])


def test_upright_forces_are_forces_of_the_whole() -> None:
    """Raised, they add up to nothing sideways and to themselves upwards; lowered again, they are the same."""
    whole = equations(table(*stair(4)), ground=Ground.BASEPLATE)
    reduced = upright(whole)
    forces = np.random.default_rng(1).normal(size=len(reduced.statics.contacts.on))
    raised = reduced.raised(forces)
    sums = (whole.matrix @ raised).reshape(-1, 6)
    np.testing.assert_allclose(sums[:, [2, 3, 4]].reshape(-1), reduced.statics.matrix @ forces, atol=1e-12)
    np.testing.assert_allclose(sums[:, [0, 1, 5]], 0, atol=1e-12)
    np.testing.assert_allclose(reduced.lowered(raised), forces)


def test_a_balance_of_upright_forces_is_one() -> None:
    """What the search finds among them passes the check of the whole, at its bounds as well."""
    whole = equations(table(*stair(19)), ground=Ground.BASEPLATE)
    reduced = upright(whole)
    found = balance(reduced.statics, aims=AIMS)
    assert found.found
    assert is_equilibrium(whole, reduced.raised(found.forces))
    least = reduced.statics.contacts.least
    bounds = np.column_stack([least, np.full(len(least), np.inf)])
    for direction in np.random.default_rng(2).normal(size=(5, len(least))):
        solved = linprog(
            np.abs(direction), A_eq=reduced.statics.matrix, b_eq=-reduced.statics.loads, bounds=bounds, method="highs"
        )
        assert (reduced.raised(solved.x) >= whole.contacts.least - 1e-9).all()


def test_loads_from_the_side_are_not_for_upright_forces() -> None:
    """A push along x leaves them no balance, a weight does."""
    bricks = table(("3001", 0, 0, 0))
    assert upright(equations(bricks, loads=np.array([[0.01, 0, 0]]))) is None
    assert upright(equations(bricks, loads=np.array([[0, 0, -0.01]]))) is not None
    assert len(upright(equations(table())).statics.contacts.on) == 0
