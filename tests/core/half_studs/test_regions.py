"""Regions: what lies off the studs of the rest is found, above it or below it, as far as it pays."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.islands import find_islands
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
    for (low, high, upwards, number), rows in _candidates(islands):
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
