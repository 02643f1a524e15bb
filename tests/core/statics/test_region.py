"""Forces of a few bodies under fixed forces of all others."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.statics.equilibrium import AIMS, is_equilibrium
from legorize_addon.core.statics.forces import Ground
from legorize_addon.core.statics.region import mended, region
from legorize_addon.core.statics.search import Work, search
from scripts.benchmarks.stablelego import stair
from tests.core.standing import CATALOGUE, equations, table


@pytest.fixture(scope="module")
def proof():
    """Return the balance of a stair, and forces that prove it."""
    bricks = table(*stair(10))
    whole = equations(bricks, ground=Ground.BASEPLATE)
    return whole, search(whole, contact_graph(bricks, CATALOGUE), Work(AIMS, 0)).forces


@pytest.mark.parametrize("chosen", [[0], [3, 4, 5], [0, 9], list(range(10))])
def test_forces_of_all_are_in_balance_in_every_region(proof, chosen) -> None:
    """Whatever bodies are chosen, the forces among them balance their weight and the forces of the others."""
    whole, forces = proof
    part, inner = region(whole, forces, np.isin(np.arange(10), chosen))
    np.testing.assert_allclose(part.matrix @ forces[inner] + part.loads, 0, atol=1e-9)
    assert is_equilibrium(part, forces[inner])
    ends = whole.contacts.on[inner], whole.contacts.by[inner]
    assert np.isin(ends[0], chosen).all()
    assert np.isin(ends[1], [-1, *chosen]).all()
    np.testing.assert_array_equal(part.rows, whole.rows[chosen])


def test_lost_forces_are_found_again(proof) -> None:
    """Forces that were lost inside are found anew, those outside stay to the last bit."""
    whole, forces = proof
    inside = np.isin(np.arange(10), [3, 4, 5, 6])
    _, inner = region(whole, forces, inside)
    lost = forces.copy()
    lost[inner] = -9.0
    found = mended(whole, lost, inside, reserve=0.05)
    assert is_equilibrium(whole, found)
    np.testing.assert_array_equal(np.delete(found, inner), np.delete(forces, inner))
    assert (found[inner] >= 0.951 * whole.contacts.least[inner]).all()


def test_a_region_may_be_too_small(proof) -> None:
    """Nothing inside bears a body of which the outer forces do not."""
    whole, forces = proof
    alone = np.arange(10) == 4
    none = np.where((whole.contacts.on == 4) | (whole.contacts.by == 4), 0.0, forces)
    assert mended(whole, none, alone, reserve=0.05) is None
