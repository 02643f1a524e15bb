"""The search for a proof: which ways it takes, and what it takes them for."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.statics import search as module
from legorize_addon.core.statics.collapse import is_collapse, least_clutch
from legorize_addon.core.statics.equilibrium import AIMS, Aim, is_equilibrium
from legorize_addon.core.statics.forces import HOLD, Ground
from legorize_addon.core.statics.search import search
from scripts.benchmarks.stablelego import stair
from tests.core.standing import CATALOGUE, equations, table


def looked(bricks, *, aims=AIMS, start=None, programme=600, kind="both", **options):
    """Return the balance of bricks and what the search comes to."""
    found = equations(bricks, **options)
    graph = contact_graph(bricks, CATALOGUE)
    return found, search(found, graph, aims=aims, start=start, programme=programme, kind=kind)


def test_upright_forces_are_enough_for_weight() -> None:
    """A stair with a margin is in balance with nothing sideways, unless that is not tried."""
    bricks = table(*stair(10))
    whole, found = looked(bricks, ground=Ground.BASEPLATE)
    assert is_equilibrium(whole, found.forces)
    pairs = found.forces.reshape(-1, 2)
    np.testing.assert_array_equal(pairs[:, 0], pairs[:, 1])
    whole, other = looked(bricks, ground=Ground.BASEPLATE, kind="all")
    assert is_equilibrium(whole, other.forces)
    assert not np.array_equal(*other.forces.reshape(-1, 2).T)


def test_what_leaves_no_margin_is_looked_at_with_all_forces() -> None:
    """Upright forces that would use more than the spare share do not end the search; any others may."""
    limit = least_clutch(equations(table(*stair(12)), ground=Ground.BASEPLATE))
    whole, found = looked(table(*stair(12)), clutch=1.02 * limit, ground=Ground.BASEPLATE)
    assert is_equilibrium(whole, found.forces)
    assert found.turns > sum(aim.turns for aim in AIMS[:2])


def test_a_start_is_taken_up() -> None:
    """From the forces of a proof the search ends at once, whether upright ones are tried or not."""
    bricks = table(*stair(17))
    aim = (Aim(0.01, 0.0, 300),)
    for kind in ("both", "all"):
        _, first = looked(bricks, aims=aim, ground=Ground.BASEPLATE, kind=kind)
        _, again = looked(bricks, aims=aim, ground=Ground.BASEPLATE, kind=kind, start=first.forces)
        assert first.turns > 0
        assert again.turns == 0


def test_a_tower_that_tips_over_needs_no_search() -> None:
    """Its motion is written down at once, with the lightest forces in balance."""
    whole, found = looked(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)))
    assert (found.collapse, found.found, found.turns) == (True, False, 0)
    assert is_collapse(whole, found.motion)
    np.testing.assert_allclose(whole.matrix @ found.forces, -whole.loads, atol=1e-8)


@pytest.mark.parametrize(("programme", "collapse"), [(600, True), (30, True), (0, False)])
def test_few_bricks_are_asked_first(monkeypatch, programme: int, collapse: bool) -> None:
    """Of a long wall with a weak stair, a programme of those that move most is enough to prove the collapse."""
    rows = [*stair(12), *(("3001", x, 5, z) for x in range(0, 120, 4) for z in (0, 3))]
    limit = least_clutch(equations(table(*stair(12)), ground=Ground.BASEPLATE))
    monkeypatch.setattr(module, "LOCAL", 20)
    asked: list[int] = []
    monkeypatch.setattr(
        module,
        "least_imbalance",
        lambda whole, bodies, reserve: asked.append(len(bodies)) or original(whole, bodies, reserve=reserve),
    )
    # no time to see it by projections
    aims = (Aim(0.01, 0.0, 9),)
    options = {"aims": aims, "programme": programme, "clutch": 0.99 * limit, "ground": Ground.BASEPLATE}
    whole, found = looked(table(*rows), **options)
    assert found.collapse is collapse
    assert asked == ([20] if programme else [])
    assert is_collapse(whole, found.motion) is collapse


original = module.least_imbalance


def test_a_programme_of_all_bricks_can_prove_that_they_stand() -> None:
    """Just above the limit, where projections end without an answer, the forces of the programme are the proof."""
    limit = least_clutch(equations(table(*stair(12)), ground=Ground.BASEPLATE))
    options = {"clutch": (1 + 1e-5) * limit, "ground": Ground.BASEPLATE}
    whole, found = looked(table(*stair(12)), aims=(Aim(0.01, 0.0, 5),), **options)
    assert is_equilibrium(whole, found.forces)
    _, unknown = looked(table(*stair(12)), aims=(Aim(0.01, 0.0, 5),), programme=0, **options)
    assert (unknown.found, unknown.collapse) == (False, False)
    assert limit < HOLD
