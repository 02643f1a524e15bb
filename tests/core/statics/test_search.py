"""The search for a proof: which ways it takes, and what it takes them for."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.progress import silent
from legorize_addon.core.statics import search as module
from legorize_addon.core.statics.collapse import is_collapse, least_clutch, least_imbalance
from legorize_addon.core.statics.equilibrium import AIMS, Aim, Balance, is_equilibrium
from legorize_addon.core.statics.forces import HOLD, Ground
from legorize_addon.core.statics.search import Work, search
from legorize_addon.core.statics.upright import upright
from scripts.benchmarks.stablelego import stair
from tests.core.standing import CATALOGUE, equations, table


def looked(bricks, *, aims=AIMS, start=None, programme=600, kind="both", **options):
    """Return the balance of bricks and what the search comes to."""
    found = equations(bricks, **options)
    graph = contact_graph(bricks, CATALOGUE)
    return found, search(found, graph, Work(aims, programme, module.ROUNDS), start=start, kind=kind)


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


@pytest.mark.parametrize(("factor", "stands"), [(1.1, True), (0.95, False)])
def test_what_upright_forces_do_not_bear_is_looked_at_with_all(monkeypatch, factor: float, stands: bool) -> None:
    """If upright forces could bear only half, a stair stands by others, or the lumps that tore are asked first."""

    def halved(whole):
        reduced = upright(whole)
        contacts = reduced.statics.contacts
        weak = replace(reduced.statics, contacts=replace(contacts, least=contacts.least / 2))
        return replace(reduced, statics=weak)

    monkeypatch.setattr(module, "upright", halved)
    bricks = table(*stair(12))
    limit = least_clutch(equations(bricks, ground=Ground.BASEPLATE))
    whole, found = looked(bricks, clutch=factor * limit, ground=Ground.BASEPLATE, programme=0)
    assert is_equilibrium(whole, found.forces) is found.found is stands
    assert is_collapse(whole, found.motion) is found.collapse is not stands
    assert not found.upright


def test_a_start_is_taken_up() -> None:
    """From the forces of a proof the search ends at once, whether upright ones are tried or not."""
    bricks = table(*stair(17))
    aim = (Aim(0.01, 0.0, 300),)
    for kind in ("both", "all"):
        _, first = looked(bricks, aims=aim, ground=Ground.BASEPLATE, kind=kind)
        _, again = looked(bricks, aims=aim, ground=Ground.BASEPLATE, kind=kind, start=first.forces)
        assert first.turns > 0
        assert again.turns == 0


def test_what_changed_is_asked_first(monkeypatch) -> None:
    """Where a few forces of a proof are lost, others are found there without any projection, and only there."""
    bricks = table(*(("3003", 0, 0, 3 * level) for level in range(30)))
    whole, known = looked(bricks)
    forces = known.forces
    monkeypatch.setattr(module, "REGION", 18 * 3)
    monkeypatch.setattr(module, "balance", None)
    lost = forces.copy()
    lost[(whole.contacts.on == 15) | (whole.contacts.on == 16)] = -5.0
    found = search(whole, contact_graph(bricks, CATALOGUE), Work(AIMS, 0), start=lost)
    assert (found.found, found.turns) == (True, 0)
    assert is_equilibrium(whole, found.forces)
    far = (whole.contacts.on < 7) | (whole.contacts.on > 23)
    np.testing.assert_array_equal(found.forces[far], forces[far])


def test_the_worst_contacts_tell_of_the_collapse_that_is_left(monkeypatch) -> None:
    """From the forces of a stair beside a wall that fall short, its collapse is found without any projection."""
    bricks, limit = wall()
    aims = (Aim(0.01, 0.0, 30),)
    whole, known = looked(bricks, aims=aims, programme=0, clutch=0.9 * limit, ground=Ground.BASEPLATE)
    assert known.collapse
    monkeypatch.setattr(module, "balance", None)
    # nor by all that fails
    monkeypatch.setattr(module, "_changed", None)
    found = search(whole, contact_graph(bricks, CATALOGUE), Work(aims, 0, worst_first=True), start=known.forces)
    assert (found.collapse, found.turns) == (True, 0)
    assert is_collapse(whole, found.motion)


def test_leaning_forces_are_looked_for_from_leaning_ones(monkeypatch) -> None:
    """Where forces among all kinds are nearly in balance, those around what is lost are asked, and no upright ones."""
    bricks = table(*stair(17))
    whole, known = looked(bricks, aims=(Aim(0.01, 0.0, 300),), ground=Ground.BASEPLATE, kind="all")
    monkeypatch.setattr(module, "upright", None)
    monkeypatch.setattr(module, "balance", None)
    lost = known.forces.copy()
    lost[(whole.contacts.on == 9)] = 0.0
    found = search(whole, contact_graph(bricks, CATALOGUE), Work((), 0), start=lost, kind="all")
    assert (found.found, found.turns) == (True, 0)
    assert is_equilibrium(whole, found.forces)


def test_a_wide_change_of_leaning_forces_is_searched_by_projections(monkeypatch) -> None:
    """Where more bodies are out of balance than a small linear programme takes, the lost forces are their start."""
    bricks = table(*stair(17))
    aims = (Aim(0.01, 0.0, 300),)
    whole, known = looked(bricks, aims=aims, ground=Ground.BASEPLATE, kind="all")
    monkeypatch.setattr(module, "LOOSE", 3)
    monkeypatch.setattr(module, "REGION", 6)
    lost = known.forces * (whole.contacts.on % 2)
    found = search(whole, contact_graph(bricks, CATALOGUE), Work(aims, 0), start=lost, kind="all")
    assert found.found
    assert found.turns > 0
    assert is_equilibrium(whole, found.forces)


def test_a_tower_that_tips_over_needs_no_search() -> None:
    """Its motion is written down at once, with the lightest forces in balance."""
    whole, found = looked(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)))
    assert (found.collapse, found.found, found.turns) == (True, False, 0)
    assert is_collapse(whole, found.motion)
    np.testing.assert_allclose(whole.matrix @ found.forces, -whole.loads, atol=1e-8)


def wall():
    """Return a long wall and beside it a stair, and the least clutch of the stair."""
    rows = [*stair(12), *(("3001", x, 5, z) for x in range(0, 120, 4) for z in (0, 3))]
    return table(*rows), least_clutch(equations(table(*stair(12)), ground=Ground.BASEPLATE))


@pytest.mark.parametrize("rounds", [1, 0])
def test_few_lumps_are_asked(monkeypatch, rounds: int) -> None:
    """Bricks at the worst contacts of a weak stair beside a long wall, and few lumps of others, prove the collapse."""
    bricks, limit = wall()
    asked: list[int] = []

    def counted(whole, lump, **options):
        asked.append(len(np.unique(lump)))
        return least_imbalance(whole, lump, **options)

    monkeypatch.setattr(module, "least_imbalance", counted)
    monkeypatch.setattr(module, "UPRIGHT_ROUNDS", rounds)
    monkeypatch.setattr(module, "ROUNDS", rounds)
    # no time to see it by projections
    options = {"aims": (Aim(0.01, 0.0, 9),), "programme": 0, "clutch": 0.9 * limit, "ground": Ground.BASEPLATE}
    whole, found = looked(bricks, **options)
    assert is_collapse(whole, found.motion) is found.collapse is bool(rounds)
    assert len(asked) == 2 * rounds
    assert all(number <= 42 < len(bricks) for number in asked)


def test_too_many_loose_bricks_are_not_tried(monkeypatch) -> None:
    """Where more would have to be let loose than a programme takes, the answer stays open."""
    bricks, limit = wall()
    monkeypatch.setattr(module, "LOOSE", 1)
    monkeypatch.setattr(module, "REGION", 6)
    _, found = looked(bricks, programme=0, clutch=0.9 * limit, ground=Ground.BASEPLATE, aims=(Aim(0.01, 0.0, 9),))
    assert (found.found, found.collapse) == (False, False)


def test_a_motion_that_tears_all_apart_is_not_asked(monkeypatch) -> None:
    """A programme of as many lumps as there are bricks would take minutes; of fewer it is asked."""
    bricks = table(*stair(12))
    whole = equations(bricks, ground=Ground.BASEPLATE)
    start = Balance(np.zeros(len(whole.contacts.least)), False, np.zeros(len(whole.loads)), False, 0)
    asked: list[int] = []
    monkeypatch.setattr(module, "least_imbalance", lambda _, lump, **__: asked.append(len(np.unique(lump))))
    monkeypatch.setattr(module, "LOOSE", 5)
    for lump in (np.arange(12), np.arange(12) // 3):
        assert not module._torn(whole, start, lump, 0, silent).collapse
    assert asked == [4]


def test_the_worst_are_few(monkeypatch) -> None:
    """Bricks at contacts that bear least come first, the ground is none of them, and what holds is none either."""
    whole = equations(table(*(("3003", 0, 0, 3 * level) for level in range(4))))
    forces = whole.contacts.least.copy()
    assert not module._worst(whole, forces).any()
    forces[whole.contacts.on == 2] -= 1
    forces[whole.contacts.on == 0] -= 0.5
    assert module._worst(whole, forces).tolist() == [True, True, True, False]
    monkeypatch.setattr(module, "WORST", 2)
    assert module._worst(whole, forces).tolist() == [False, True, True, False]


def test_a_programme_of_all_bricks_can_prove_that_they_stand(monkeypatch) -> None:
    """Just above the limit, where projections end without an answer, the forces of the programme are the proof."""
    monkeypatch.setattr(module, "UPRIGHT_ROUNDS", 0)
    monkeypatch.setattr(module, "ROUNDS", 0)
    limit = least_clutch(equations(table(*stair(12)), ground=Ground.BASEPLATE))
    options = {"clutch": (1 + 1e-5) * limit, "ground": Ground.BASEPLATE}
    whole, found = looked(table(*stair(12)), aims=(Aim(0.01, 0.0, 5),), **options)
    assert is_equilibrium(whole, found.forces)
    _, unknown = looked(table(*stair(12)), aims=(Aim(0.01, 0.0, 5),), programme=0, **options)
    assert (unknown.found, unknown.collapse) == (False, False)
    assert limit < HOLD


@pytest.mark.parametrize(("turned", "last", "tries"), [(False, 4, 4), (False, 2, 2), (True, 2, 1)])
def test_projections_begin_anew_where_they_ended(monkeypatch, turned: bool, last: int, tries: int) -> None:
    """From forces that may lean they do so up to four times until they reach a balance; from upright ones never."""
    whole = equations(table(*stair(3)))
    whole = upright(whole).statics if turned else whole
    starts = []

    def ended(equations, *, start, **_):
        starts.append(start.copy())
        return Balance(start + 1, len(starts) == last, np.zeros(len(equations.loads)), False, 5)

    monkeypatch.setattr(module, "balance", ended)
    found = module._polished(whole, np.zeros(len(whole.contacts.least)), None, silent)
    assert [start.mean() for start in starts] == list(range(tries))
    assert (found.turns, found.found) == (5 * tries, tries == last)
