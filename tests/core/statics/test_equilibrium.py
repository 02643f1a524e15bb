"""Equilibrium: the search, and the check of what it found."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.statics import equilibrium
from legorize_addon.core.statics.collapse import is_collapse
from legorize_addon.core.statics.equilibrium import (
    AIMS,
    FACTORS,
    LEAST_PUSH,
    WEIGHT_GROUND,
    WEIGHT_SIDE,
    Aim,
    _box,
    _stagnates,
    _weights,
    balance,
    is_equilibrium,
    residual,
)
from legorize_addon.core.statics.forces import HOLD, Ground
from scripts.benchmarks.stablelego import CASES, Case, stair
from tests.core.standing import CATALOGUE, equations, judged, table


@pytest.mark.parametrize("case", [case for case in CASES if case.stands], ids=lambda case: case.name)
def test_check_finds_what_is_wrong(case: Case) -> None:
    """Forces that are out of balance by 0.1 micronewtons, or below a bound by less than that, are no proof."""
    found = judged(case.bricks(CATALOGUE), ground=Ground.BASEPLATE, loads=case.loads(CATALOGUE))
    assert found.residual <= 1e-8
    np.testing.assert_allclose(
        residual(found.statics, found.forces).reshape(-1),
        found.statics.matrix @ found.forces + found.statics.loads,
        atol=1e-12,
    )
    for row in range(0, len(found.forces), 7):
        forces = found.forces.copy()
        forces[row] += 1e-7
        assert not is_equilibrium(found.statics, forces)
    bounds = found.statics.contacts
    for bound, holds in ((found.forces, True), (np.nextafter(found.forces, np.inf), False)):
        raised = np.where(np.arange(len(bounds.least)) == 3, bound, bounds.least)
        assert is_equilibrium(replace(found.statics, contacts=replace(bounds, least=raised)), found.forces) == holds


def test_aims_leave_a_margin() -> None:
    """A search that aims at half of the hold leaves what counts as enough; one without turns finds nothing."""
    found = equations(table(*stair(12)), ground=Ground.BASEPLATE)
    reached = balance(found, aims=(Aim(0.5, 0.45, 100),))
    assert reached.found
    assert (reached.forces[found.contacts.least == -HOLD] >= -0.55 * HOLD).all()
    none = balance(equations(table(*stair(20)), ground=Ground.BASEPLATE), aims=(Aim(0.5, 0.45, 0),))
    assert (none.found, none.turns) == (False, 0)


def test_search_from_its_own_end_is_over_at_once() -> None:
    """Started from forces that were found, the search finds them again without a turn."""
    found = equations(table(*stair(18)), ground=Ground.BASEPLATE)
    first = balance(found, aims=AIMS[-1:])
    again = balance(found, aims=AIMS[-1:], start=first.forces)
    assert (first.found, again.found, again.turns) == (True, True, 0)
    assert first.turns > 0
    np.testing.assert_allclose(again.forces, first.forces, atol=1e-9)


def test_search_can_be_cancelled() -> None:
    """A progress callback that cancels ends the search; until then the share rises."""
    shares: list[float] = []

    def stop(stage: str, share: float) -> None:
        shares.append(share)
        if share > FACTORS:
            raise Cancelled

    with pytest.raises(Cancelled):
        judged(table(*stair(20)), ground=Ground.BASEPLATE, progress=stop)
    assert shares == sorted(shares)
    assert 0 <= shares[0] < FACTORS < shares[-1] < 1


def test_factorisation_can_be_cancelled() -> None:
    """Before the search begins, too, a callback is asked again and again."""
    shares: list[float] = []

    def stop(stage: str, share: float) -> None:
        shares.append(share)
        if share > 0:
            raise Cancelled

    with pytest.raises(Cancelled):
        judged(table(*stair(60)), ground=Ground.BASEPLATE, progress=stop)
    assert 0 < shares[-1] < FACTORS


def test_weights_of_ground_sides_and_contacts() -> None:
    """Forces of the ground have one weight, those that only press another, and all others 1."""
    found = equations(table(("3003", 0, 0, 0), ("3003", 2, 0, 0), ("3001", 0, 0, 3)), ground=Ground.BASEPLATE)
    contacts = found.contacts
    kinds = zip((contacts.by == NOBODY).tolist(), contacts.least.tolist(), strict=True)
    expected = [WEIGHT_GROUND if ground else 1.0 if least else WEIGHT_SIDE for ground, least in kinds]
    assert _weights(found).tolist() == expected
    assert WEIGHT_GROUND in expected
    assert 1.0 in expected


def test_search_ends_with_a_motion_that_proves_a_collapse() -> None:
    """Where beams lean over a single foot, what is left between box and plane is a motion by which they fall."""
    found = equations(table(("3005", 0, 0, 0), ("3008", 0, 0, 3), ("3008", 7, 0, 6)), ground=Ground.TABLE)
    reached = balance(found, aims=AIMS)
    assert (reached.found, reached.collapse) == (False, True)
    assert is_collapse(found, reached.motion)


def test_box_leaves_a_share_of_each_bound() -> None:
    """Of what pulls, a share of the pull; of what only pushes, a like share of a small push."""
    found = equations(table(("3003", 0, 0, 0), ("3003", 2, 0, 0), ("3001", 0, 0, 3)), ground=Ground.TABLE)
    least = found.contacts.least
    assert set(np.sign(least).tolist()) == {-1.0, 0.0}
    for share in (0.0, 0.25, 0.5):
        expected = [bound * (1 - share) if bound else share * LEAST_PUSH for bound in least.tolist()]
        np.testing.assert_allclose(_box(found, share), expected)


@pytest.mark.parametrize(
    ("gaps", "given_up"),
    [
        ([1.0] * 5, False),
        ([1.0] * 6, True),
        ([2.0, 1.0, 1.0, 1.0, 1.0, 1.0], False),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 0.9], False),
        ([1.0, 1.0, 1.0, 1.0, 1.0, 0.91], True),
        ([2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], True),
        ([1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 1.7], False),
    ],
)
def test_search_is_given_up_when_five_looks_gain_less_than_a_tenth(gaps: list[float], given_up: bool) -> None:
    """The distance now is compared with that of five looks before."""
    assert _stagnates(gaps) == given_up


def test_looks_measure_the_distance_between_box_and_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    """It falls from look to look, towards that between two sets that do not meet, and is far below the forces."""
    seen: list[list[float]] = []
    monkeypatch.setattr(equilibrium, "_stagnates", lambda gaps: seen.append(list(gaps)) or False)
    found = equations(table(*stair(15)), ground=Ground.BASEPLATE)
    reached = balance(found, aims=(Aim(0.5, 0.49, 120),))
    gaps = seen[-1]
    assert len(gaps) >= 10
    assert gaps == sorted(gaps, reverse=True)
    assert gaps[-1] < 0.05 * np.linalg.norm(reached.forces)
