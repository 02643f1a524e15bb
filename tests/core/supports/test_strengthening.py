"""Ties where the proof says that studs are too weak."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.statics.collapse import least_clutch
from legorize_addon.core.statics.equilibrium import is_equilibrium
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.supports import strengthening as module
from legorize_addon.core.supports.strengthening import rigid_parts, strengthen, velocity
from scripts.benchmarks.stablelego import stair
from tests.core.layout.cells import CATALOGUE, RED, assert_covers, brick_grid
from tests.core.standing import equations, judged, table


def crane():
    """Return a tower with an arm of 2 x 4 bricks that one column of studs joins to it, and its grid."""
    even, odd = (("3001", 0), ("3001", 4), ("3001", 8)), (("3003", 0), ("3001", 2), ("3001", 6), ("3003", 10))
    rows = [(part, x, 0, 3 * level) for level in range(4) for part, x in (even, odd)[level % 2]]
    rows += [("3001", x, 0, 3 * level) for level in (2, 3) for x in (12, 16, 20)]
    rows += [("3001", x, 0, 12) for x in (11, 15, 19)]
    colour = np.full((5, 2, 24), COLOUR_EMPTY)
    colour[:4, :, :12] = colour[2:4, :, 12:] = colour[4, :, 11:23] = RED
    return table(*rows), brick_grid(colour)


def test_the_crane_is_as_it_should_be() -> None:
    """The grid and the bricks of the example agree, and the arm tears off where it is joined."""
    bricks, grid = crane()
    assert_covers(bricks, grid)
    limit = least_clutch(equations(bricks))
    found = judged(bricks, clutch=0.9 * limit, neighbours=False)
    assert found.standing is Verdict.COLLAPSES
    assert len(found.torn)


def test_ties_make_do_with_less_clutch() -> None:
    """With half of the clutch that the studs of a crane need, ties find a model that stands by its studs alone."""
    bricks, grid = crane()
    limit = least_clutch(equations(bricks))
    tied, after, found = strengthen(bricks, grid, CATALOGUE, clutch=0.5 * limit, plates=True)
    assert len(tied) > len(bricks)
    assert_covers(tied, after)
    assert contact_graph(tied, CATALOGUE).collisions == 0
    assert least_clutch(equations(tied)) <= 0.5 * limit
    assert is_equilibrium(equations(tied, clutch=0.5 * limit), found.forces)


def test_what_stays_open_is_tied_where_it_opens_most(monkeypatch) -> None:
    """Without a proof that the crane falls, what opens in the last motion is tied as if it tore."""
    bricks, grid = crane()
    limit = least_clutch(equations(bricks))
    verdicts = iter([Verdict.UNDECIDED, Verdict.STABLE])

    def stays_open(model, **options):
        found = stability(model, **options)
        return replace(found, standing=next(verdicts), torn=found.torn[:0])

    monkeypatch.setattr(module, "stability", stays_open)
    tied, after, _ = strengthen(bricks, grid, CATALOGUE, clutch=0.9 * limit, plates=True)
    assert least_clutch(equations(tied)) < limit
    assert_covers(tied, after)


def test_rounds_are_as_many_as_allowed(monkeypatch) -> None:
    """With one round, ties are laid once, and how the bricks stand with them is told."""
    bricks, grid = crane()
    asked = []

    def counted(model, **options):
        asked.append(len(model))
        return stability(model, **options)

    monkeypatch.setattr(module, "stability", counted)
    tied, _, found = strengthen(bricks, grid, CATALOGUE, clutch=1e-3, plates=True, most=1)
    assert asked == [len(bricks), len(tied)]
    assert len(found.margin) == len(tied) > len(bricks)


def test_what_stands_is_given_back_with_its_proof() -> None:
    """With the clutch that it needs and a little more, the crane is the same object, and the forces prove it."""
    bricks, grid = crane()
    limit = least_clutch(equations(bricks))
    tied, after, found = strengthen(bricks, grid, CATALOGUE, clutch=1.1 * limit, plates=True)
    assert tied is bricks
    assert after is grid
    assert is_equilibrium(equations(bricks, clutch=1.1 * limit), found.forces)


def test_what_tips_over_is_left_to_pillars() -> None:
    """No tie helps what tips over: the bricks are the same, and what they do is proven."""
    bricks = table(("3003", 0, 0, 0), ("3007", 0, 0, 3))
    colour = np.full((2, 2, 8), RED)
    colour[0, :, 2:] = COLOUR_EMPTY
    tied, _, found = strengthen(bricks, brick_grid(colour), CATALOGUE, clutch=0.7, plates=True)
    assert tied is bricks
    assert found.standing is Verdict.COLLAPSES


def test_rigid_parts_are_what_does_not_tear() -> None:
    """Of a stair that falls, the brick at the bottom is one part and all the others the second."""
    bricks = table(*stair(20), ("3001", 40, 0, 0))
    found = judged(bricks)
    graph = Assembly(bricks, CATALOGUE).graph
    assert len(np.unique(rigid_parts(graph, found.torn[:0]))) == 2
    parts = rigid_parts(graph, np.array([[0, 1]]))
    assert len(np.unique(parts)) == 3
    assert len(np.unique(parts[1:20])) == 1


def test_velocity_is_that_of_a_rigid_body() -> None:
    """A tower that tips over turns about an edge of its foot, where nothing moves."""
    bricks = table(("3003", 0, 0, 0), ("3007", 0, 0, 3))
    found = judged(bricks)
    edge = np.array([(2.0, 0.0, 0.0), (2.0, 2.0, 0.0), (8.0, 1.0, 0.0)])
    speed = velocity(found, np.array([0, 1, 1]), edge)
    np.testing.assert_allclose(speed[:2], 0, atol=1e-12)
    assert speed[2, 2] < 0


def test_it_can_be_cancelled() -> None:
    """Progress is told under a name of its own, rises, and may end the run."""
    shares: list[float] = []

    def stop(stage: str, share: float) -> None:
        assert stage == "strengthening"
        shares.append(share)
        if len(shares) == 4:
            raise Cancelled

    bricks, grid = crane()
    with pytest.raises(Cancelled):
        strengthen(bricks, grid, CATALOGUE, clutch=0.01, plates=True, progress=stop)
    assert shares == sorted(shares)
