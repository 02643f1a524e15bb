"""Regions: what lies off the studs of the rest is found, above it or below it, as far as it pays."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.islands import Islands, find_islands
from legorize_addon.core.half_studs.regions import _candidates, choose_regions
from legorize_addon.core.slicing.lattice import fit_grid
from tests.core.half_studs.tower import BLOCK, table, tower
from tests.core.solids import box, joined


def choose(mesh, *, price=1.0, anywhere=False, **options):
    """Choose regions on the usual grid."""
    islands = find_islands(mesh, fit_grid(mesh, symmetric=True, plates=True))
    return islands, choose_regions(islands, price=price, anywhere=anywhere, **options)


@pytest.mark.parametrize("off", [(0.5, 0), (0, 0.5), (0.5, 0.5)])
def test_a_tower_between_the_studs_is_a_region(off):
    """It begins where the tower does and lies as far off as the tower."""
    _, found = choose(tower(*off))
    [region] = found.regions
    assert (region.low, region.high, region.upwards) == (BLOCK, BLOCK + 3, True)
    assert region.half == tuple(int(2 * each) for each in off)
    assert found.base == (0, 0)


def test_a_leg_is_a_region_by_itself():
    """One of four legs stands between the studs: it alone lies half a stud off, up to where the top begins."""
    islands, found = choose(table(0.5))
    [region] = found.regions
    assert (region.low, region.high, region.upwards, region.half) == (0, BLOCK - 1, False, (1, 0))
    off = np.flatnonzero(found.off)
    assert islands.layer[off].tolist() == list(range(BLOCK))


def test_what_lies_on_the_studs_stays():
    """There is no region where nothing errs, none that is barred, and none that costs more than it saves."""
    assert choose(tower(0, 0))[1].regions == ()
    _, found = choose(tower())
    _, other = choose(tower(), barred={found.regions[0].key})
    assert found.regions[0].key not in [each.key for each in other.regions]
    assert choose(tower(), price=100.0)[1].regions == ()


def test_the_whole_lies_further_on_before_a_part_does():
    """Where jumpers are dear, the grid of all is moved for what lies between the studs, if that is allowed."""
    mesh = joined(box((0, 0, 0), (48, 48, 9.6)), box((12, 8, 9.6), (36, 32, 96)))
    _, found = choose(mesh, price=100.0, anywhere=True)
    assert (found.base, found.regions) == ((1, 0), ())
    _, still = choose(mesh)
    assert still.base == (0, 0)
    assert [region.upwards for region in still.regions] == [True]


@pytest.mark.parametrize(("beside", "many"), [(10, 1), (400, 0)])
def test_little_is_not_worth_it(beside, many):
    """Where no phase fits the rest, the tower alone is too little to move for."""
    islands = find_islands(tower(), fit_grid(tower(), symmetric=True, plates=True))
    islands = replace(islands, error=islands.error + beside)
    assert len(choose_regions(islands, price=1.0, anywhere=True).regions) == many


def test_what_would_touch_is_moved_the_other_way_or_not_at_all():
    """A column right of another one, a stud and a half apart, may come nearer; a stud apart of two others it stays."""
    low = box((0, 0, 0), (72, 16, 9.6))

    def columns(*x):
        """Make columns of two studs' width on a plate, at some studs along x."""
        return joined(low, *(box((8 * each, 0, 9.6), (8 * each + 16, 16, 48)) for each in x))

    _, right = choose(columns(1, 4.5))
    assert [region.half for region in right.regions] == [(1, 0)]
    assert choose(columns(1, 3.5, 6))[1].regions == ()


def test_every_region_hangs_together():
    """Upwards and downwards, each is connected and all of its layers."""
    islands, _ = choose(table(0.5))
    found = _candidates(islands)
    members = np.split(found.islands.indices, found.islands.indptr[1:-1])
    for (low, high, upwards, number), rows in zip(found.keys, members, strict=True):
        assert rows[0] == number
        assert (islands.layer[rows].min(), islands.layer[rows].max()) == (low, high)
        lower, upper = islands.links.T
        leaving = np.isin(lower, rows) != np.isin(upper, rows)
        # nothing beyond the end where it is cut off
        assert (islands.layer[upper[leaving]] == (low if upwards else high + 1)).all()


def test_a_weighted_tower_pays_sooner():
    """At a price at which a tower stays where it is, one that counts four times as much moves."""
    mesh, price = tower(), 3.0
    while choose(mesh, price=price)[1].regions:
        price *= 1.5
    above = replace(mesh, weight=3.0 * (mesh.vertices[:, 2] >= 9.6 * BLOCK))
    assert [region.low for region in choose(above, price=price)[1].regions] == [BLOCK]


def test_leaves_take_no_memory_for_pairs():
    """Two thousand pieces that touch nothing: what is known of each region grows with its own islands."""
    n = 2000
    error = np.ones((n, 4))
    error[:, 1] = 0.0
    leaves = Islands(
        corner=np.zeros(2),
        label=np.full((20, 8, 8), -1, np.int32),
        layer=np.arange(n) // 100,
        error=error,
        cells=((np.zeros((1, 2), np.int64),) * 4,) * n,
        links=np.zeros((0, 2), np.int64),
        overlap=np.zeros(0),
    )
    tracemalloc.start()
    try:
        found = choose_regions(leaves, price=1.0, anywhere=False)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    # each leaf alone is too little
    assert found.regions == ()
    assert most < 8 * n**2


def test_changes_are_what_all_costs_anew():
    """For any phases, what a region in another one saves is the difference of what both cost in full."""
    islands, _ = choose(table(0.5))
    numbers = np.random.default_rng(0)
    found, off = _candidates(islands), numbers.integers(0, 4, len(islands.layer))

    def cost(phases):
        """Return what phases cost, link by link."""
        between = zip(islands.links.tolist(), islands.overlap.tolist(), strict=True)
        parts = sum(max(overlap, 1) for (low, high), overlap in between if phases[low] != phases[high])
        return sum(each[phase] for each, phase in zip(islands.error, phases, strict=True)) + 2.0 * 0.35 * parts

    changes = found.changes(islands, islands.error, off, 2.0).reshape(4, -1)
    for phase, row in np.ndindex(changes.shape):
        assert changes[phase, row] == pytest.approx(cost(found.moved(off, row, phase)) - cost(off), abs=1e-6)
