"""Every building step tested by forces."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from legorize_addon.core.building import proof as module
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.proof import prove_steps
from legorize_addon.core.errors import Cancelled
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.report.building_remarks import remarks_on_proof
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.standing import CATALOGUE, table

BRIDGE = (("3005", 0, 0, 0), ("3010", 0, 0, 3), ("3005", 7, 0, 0), ("3010", 4, 0, 3), ("3008", 0, 0, 6))
"""Stands when it is whole; its halves fall before."""


def proof(bricks, temporary=None, **options):
    """Return the proof of bricks in their order, one a step."""
    gone = np.zeros(len(bricks), bool) if temporary is None else temporary
    assembly = Assembly(bricks, CATALOGUE)
    pairs = building_contacts(assembly, temporary=gone).pairs
    steps = plan_steps(bricks, CATALOGUE, pairs, temporary=gone)
    moves = replace(steps.moves, step=np.arange(len(steps.moves), dtype=np.int32))
    return prove_steps(replace(steps, moves=moves), assembly, clutch=0.98, **options)


def test_tower_stands_at_every_step():
    """A tower is proven after each of its bricks."""
    found = proof(table(*(("3003", 0, 0, 3 * k) for k in range(4))))
    assert found.stands
    assert found.steps.tolist() == [0, 1, 2, 3]
    assert remarks_on_proof(found) == ()


def test_step_that_falls_is_named():
    """The halves of a bridge fall in the steps before the last, though the whole stands."""
    found = proof(table(*BRIDGE))
    assert found.collapsing.tolist() == [2, 3]
    assert len(found.undecided) == 0
    [sentence] = remarks_on_proof(found)
    assert "after 2 steps (3, 4)" in sentence


def test_steps_of_each_class_are_named(monkeypatch):
    """Steps that stand only by pushes of neighbours are listed like those that fall or are in doubt, but they stand."""
    verdicts = [Verdict.WEDGED, Verdict.STABLE, Verdict.WEDGED, Verdict.STABLE]
    told = iter([*verdicts, Verdict.COLLAPSES, Verdict.UNDECIDED, Verdict.WEDGED, Verdict.STABLE])
    monkeypatch.setattr(module, "stability", lambda *_, **__: SimpleNamespace(verdict=next(told)))
    tower = table(*(("3003", 0, 0, 3 * k) for k in range(4)))
    found = proof(tower)
    assert (found.wedged.tolist(), found.stands) == ([0, 2], True)
    [sentence] = remarks_on_proof(found)
    assert sentence == (
        "The bricks placed so far stand only while neighbouring bricks press on each other after 2 steps (1, 3)."
    )
    found = proof(tower)
    lists = found.collapsing, found.undecided, found.wedged
    assert ([each.tolist() for each in lists], found.stands) == ([[0], [1], [2]], False)
    assert len(remarks_on_proof(found)) == 3


def test_supports_make_all_steps_stand():
    """With what the supports add, the same bridge is proven at every step, and when they are gone."""
    built = plan_assembly(Assembly(table(*BRIDGE), CATALOGUE), deepest=3)
    assert prove_steps(built.steps, Assembly(built.bricks, CATALOGUE), clutch=0.98).stands


def test_pieces_are_tested_on_their_own_tables():
    """A stair that leans too far stands as a piece of its own, and falls as soon as it is joined to a narrow foot."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3001", 1, 0, 6))
    assert proof(replace(bricks, piece=np.array([0, 1, 1], np.int16))).collapsing.tolist() == [3]
    wide = table(("3001", 0, 0, 0), ("3001", 0, 0, 3), ("3001", 1, 0, 6))
    assert proof(replace(wide, piece=np.array([0, 1, 1], np.int16))).stands


def test_proof_can_be_cancelled():
    """A request to stop ends it."""

    def stop(*_):
        raise Cancelled("now")

    with pytest.raises(Cancelled):
        proof(table(*BRIDGE), progress=stop)
