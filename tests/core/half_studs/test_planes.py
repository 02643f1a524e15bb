"""Planes: where a tower is off the studs, and the cheapest phases of random layers."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.half_studs.planes import Plane, _least, choose_planes, cost_of, halves_at
from legorize_addon.core.slicing.lattice import fit_grid
from tests.core.half_studs.tower import BLOCK, tower
from tests.core.solids import joined, mesh_of, sphere

LEVEL = 3 * BLOCK


def planes(mesh, **options):
    """Choose planes at a price of one cell."""
    return choose_planes(mesh, fit_grid(mesh, symmetric=True, plates=True), price=1.0, **options)


@pytest.mark.parametrize(("off", "half"), [((0.5, 0), (1, 0)), ((0, 0.5), (0, 1)), ((0.5, 0.5), (1, 1))])
def test_a_tower_between_the_studs_lies_half_a_stud_on(off, half):
    """The plane lies where the tower begins, and shifts it to where it is."""
    assert planes(tower(*off)) == (Plane(LEVEL, half),)


def test_a_tower_on_the_studs_stays():
    """There is no plane where nothing errs, none at a barred level, and none where it costs more than it saves."""
    assert planes(tower(0, 0)) == ()
    assert LEVEL not in [plane.level for plane in planes(tower(), barred={LEVEL})]
    mesh = tower()
    assert choose_planes(mesh, fit_grid(mesh, symmetric=True, plates=True), price=100.0) == ()


@pytest.mark.parametrize(("radius", "many"), [(60, 1), (900, 0)])
def test_little_is_not_worth_it(radius, many):
    """Beside a large flat lens below the plane, which no phase fits, the tower alone is too little to move for."""
    ball = sphere(12, radius, (2 * radius, 0, 0))
    lens = mesh_of(ball.vertices * (1, 1, 12 / radius) + (0, 0, 12), ball.faces)
    assert len(planes(joined(tower(), lens))) == many


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_the_phases_cost_least(n_layers, seed):
    """No other sequence of phases costs less than the one that is found; it begins with the first."""
    rng = np.random.default_rng(seed)
    error, changing = rng.integers(0, 9, (2, n_layers, 4)).astype(float)

    def cost(phases):
        """Add up what phases cost."""
        moves = [changing[n, here] for n, (before, here) in enumerate(pairwise(phases), 1) if here != before]
        return sum(moves) + error[np.arange(n_layers), phases].sum()

    found = _least(error, changing)
    assert found[0] == 0
    assert cost_of(found, error, changing) == pytest.approx(cost(found))
    assert cost(found) == min(cost([0, *rest]) for rest in product(range(4), repeat=n_layers - 1))


def test_half_studs_at_levels():
    """All from a plane on lies as the plane says, up to the next one."""
    found = halves_at(np.array([0, 2, 3, 8, 9, 20]), (Plane(3, (1, 0)), Plane(9, (0, 1))))
    assert found.tolist() == [[0, 0], [0, 0], [1, 0], [1, 0], [0, 1], [0, 1]]


def test_a_weighted_tower_pays_sooner():
    """At a price at which a tower stays where it is, one that counts four times as much moves."""
    mesh, price = tower(), 10.0
    while found := choose_planes(mesh, fit_grid(mesh, symmetric=True, plates=True), price=price):
        price *= 1.5
    above = replace(mesh, weight=3.0 * (mesh.vertices[:, 2] >= 9.6 * BLOCK))
    assert found == ()
    assert choose_planes(above, fit_grid(mesh, symmetric=True, plates=True), price=price) == (Plane(LEVEL, (1, 0)),)
