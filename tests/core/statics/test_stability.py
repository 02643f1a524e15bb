"""Stability: verdicts against mechanics by hand, the StableLego cases, and linear programmes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linprog

from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.profiles import centre, columns
from legorize_addon.core.model.verdict import UNSUPPORTED, Verdict
from legorize_addon.core.statics import search
from legorize_addon.core.statics.collapse import least_clutch
from legorize_addon.core.statics.equilibrium import is_equilibrium
from legorize_addon.core.statics.forces import CAUTIOUS_HOLD, GRAVITY, HOLD, TABLE_FRICTION, Ground, Statics
from legorize_addon.core.statics.stability import _margins
from scripts.benchmarks.stablelego import CASES, NARROW, Case, arm, stair
from tests.core.standing import CATALOGUE, downward, equations, judged, table, weight

STABLE, WEDGED, COLLAPSES, UNDECIDED = Verdict


NEEDED = (0.901, 1.005, 0.901, 0.921, 1.022, 0.934, 1.024, 0.641, 1.187)
"""Share of the clutch that each case needs by its studs alone, as another programme found it for g = 9.8."""


@pytest.mark.parametrize(
    ("case", "needed"), list(zip(CASES, NEEDED, strict=True)), ids=lambda each: getattr(each, "name", "")
)
def test_cases_of_the_article(case: Case, needed: float) -> None:
    """Each published case needs the hold that is known, and stands or falls as the article says, with proof."""
    bricks = case.bricks(CATALOGUE)
    found = judged(bricks, ground=Ground.BASEPLATE, loads=case.loads(CATALOGUE))
    # all forces are in proportion to g
    alone = equations(bricks, ground=Ground.BASEPLATE, loads=case.loads(CATALOGUE))
    assert least_clutch(alone) * (9.8 / GRAVITY) / HOLD == pytest.approx(needed, abs=6e-4)
    if case.name == "arm of two layers":
        assert found.verdict is WEDGED
    else:
        assert found.verdict is (STABLE if case.stands else COLLAPSES)
    assert found.stands == case.stands
    assert found.check()


def test_stairs_end_at_twenty() -> None:
    """As in the article, nineteen levels stand and twenty fall; with the cautious hold seventeen and eighteen."""
    for clutch, last in ((HOLD, 19), (CAUTIOUS_HOLD, 17)):
        verdicts = [
            judged(table(*stair(n)), clutch=clutch, ground=Ground.BASEPLATE).verdict for n in range(last - 1, last + 3)
        ]
        assert verdicts == [STABLE, STABLE, COLLAPSES, COLLAPSES]


@pytest.mark.parametrize("part", [part.number for part in CATALOGUE.parts])
def test_any_part_stands(part: str) -> None:
    """A single part stands on the table, which carries its weight; nothing pulls. Long inverted slopes fall over."""
    found = judged(table((part, 0, 0, 0)))
    row = CATALOGUE.parts[CATALOGUE.part_row(part)]
    feet = columns(row, 0).xy[columns(row, 0).foot]
    middle = np.array(centre(row, 0)[:2])
    if not (feet.min(axis=0) <= middle).all() or not (middle <= feet.max(axis=0) + 1).all():
        assert found.verdict is COLLAPSES
        assert found.check()
        return
    assert found.stable
    assert found.check()
    assert found.forces @ found.statics.contacts.direction[:, 2] == pytest.approx(weight(part))
    assert found.margin.tolist() == [1]
    assert found.enough_clutch == 0
    assert found.unsupported.tolist() == []


def test_neighbours_press_in_a_proof_of_its_own() -> None:
    """What stands by pushes of neighbours alone is wedged, says where its studs would tear, and is nothing without."""
    bricks = CASES[6].bricks(CATALOGUE)
    found = judged(bricks, ground=Ground.BASEPLATE)
    assert (found.verdict, found.stable, found.stands) == (WEDGED, False, True)
    sides = (found.statics.contacts.least == 0) & (found.statics.contacts.by >= 0)
    assert found.forces[sides].max() > 1
    assert 0 < found.enough_clutch <= HOLD
    held = (found.margin_by_studs == 0) & (found.margin > 0)
    assert held.any()
    np.testing.assert_array_equal(held, (np.abs(found.yielding) > 1e-3).any(axis=1))
    alone = judged(bricks, ground=Ground.BASEPLATE, neighbours=False)
    assert (alone.verdict, alone.stands) == (COLLAPSES, False)
    assert alone.check()
    np.testing.assert_array_equal(alone.torn, found.torn)
    np.testing.assert_array_equal(alone.motion, found.yielding)
    assert len(found.torn)
    assert (found.motion == 0).all()


def test_pushes_of_neighbours_bear_no_more_than_the_studs_beside_them() -> None:
    """Ten times the load on the arm that neighbours hold is more than studs bear sideways: it collapses."""
    bricks = CASES[6].bricks(CATALOGUE)
    loads = downward(bricks, len(bricks) - 3, 1.0)
    assert judged(bricks, ground=Ground.BASEPLATE, loads=loads).verdict is COLLAPSES


def test_studs_are_the_first_proof() -> None:
    """In what stands by its studs nothing counts on a neighbour, though there are some."""
    rows = [("3001", x, 0, 3 * z) for x in (0, 4) for z in range(3)]
    found = judged(table(*rows, ("3001", 2, 0, 9)))
    assert found.stable
    contacts = found.statics.contacts
    assert ((contacts.least < 0) | (contacts.by < 0)).all()


@pytest.mark.parametrize(("share", "verdict"), [(0.25, STABLE), (1.0, COLLAPSES)])
def test_a_stud_bears_a_twist_up_to_its_clutch(share: float, verdict: Verdict) -> None:
    """A beam on one stud is pushed sideways in its middle: its points bear a clutch times a stud at most.

    Each of the four is a quarter of a stud from the middle, and the friction of all of
    them together is four clutches and the weight.
    """
    bricks = table(("3005", 0, 0, 0), ("3008", 0, 0, 3))
    clutch = 10 * HOLD
    loads = np.zeros((2, 3))
    loads[1, 1] = 1.001 * share * (clutch + weight("3008") / 4) / 3.5
    found = judged(bricks, loads=loads, clutch=clutch, ground=Ground.BASEPLATE)
    assert found.verdict is verdict
    assert found.check()


def test_no_bricks() -> None:
    """Nothing stands as well as anything."""
    found = judged(table())
    assert found.verdict is STABLE
    assert found.tipping.shape == (0,)
    assert found.residual == 0


def test_bridge() -> None:
    """Two bricks that one on top joins stand, each on its own half of the weight."""
    found = judged(table(("3001", 0, 0, 0), ("3001", 4, 0, 0), ("3001", 2, 0, 3)))
    assert found.stable
    contacts = found.statics.contacts
    feet = contacts.by < 0
    carried = np.bincount(contacts.on[feet], found.forces[feet] * contacts.direction[feet, 2])
    np.testing.assert_allclose(carried, 1.5 * weight("3001"))


@pytest.mark.parametrize("n", [1, 2, 3])
def test_cantilever_by_hand(n: int) -> None:
    """An arm of 1 x 8 bricks that each grip one stud needs what the lever says.

    The brick tilts over the point nearest to the load, a quarter of a stud
    before the middle; the other three points pull with levers of a quarter,
    a quarter and a half: one hold times one stud.
    """
    bricks = table(("3005", 0, 0, 0), *((NARROW[8], 7 * level, 0, 3 * level + 3) for level in range(n)))
    needed = weight(NARROW[8]) * sum(3.25 + 7 * level for level in range(n))
    assert least_clutch(equations(bricks, ground=Ground.BASEPLATE)) == pytest.approx(needed, rel=1e-6)
    for factor, verdict in ((1.001, STABLE), (0.999, COLLAPSES)):
        found = judged(bricks, clutch=factor * needed, ground=Ground.BASEPLATE)
        assert found.verdict is verdict
        assert found.check()


@pytest.mark.parametrize("n", [1, 2, 4])
def test_brick_hangs_by_its_studs(n: int) -> None:
    """Under a beam one stud wide, n studs bear four holds each and not more."""
    columns = [(1, x, layer) for x in (0, 7) for layer in (0, 1)]
    rows = arm((8, 0, 2), (n, (8 - n) // 2, 1), *columns)
    bricks = table(*rows)
    most = 4 * n * HOLD - weight(NARROW[n])
    for factor, verdict in ((0.999, STABLE), (1.001, COLLAPSES)):
        found = judged(bricks, loads=downward(bricks, 1, factor * most))
        assert found.verdict is verdict
        assert found.check()


@pytest.mark.parametrize(("top", "inside"), [("3001", 2 - 5.47 / 3.31), ("3007", 2 - 18.75 / 5.55)])
def test_tower_that_tips_over(top: str, inside: float) -> None:
    """A long brick on a short one tips over the edge of the short one as soon as the weight is outside of it."""
    bricks = table(("3003", 0, 0, 0), (top, 0, 0, 3))
    found = judged(bricks)
    assert found.tipping[0] == pytest.approx(8 * inside)
    assert found.verdict is (STABLE if inside > 0 else COLLAPSES)
    assert found.check()
    assert judged(bricks, ground=Ground.BASEPLATE).stable
    if inside < 0:
        assert least_clutch(found.statics) == np.inf
        # both turn the same way about the edge: what hangs over goes down
        assert (found.motion[:, 4] > 0).all()
        assert found.motion[1, 2] < 0


def test_load_tips_a_tower() -> None:
    """A load beyond the edge counts as weight does; two bodies are judged by themselves."""
    bricks = table(("3003", 0, 0, 0), ("3001", 0, 0, 3), ("3001", 2, 0, 6), ("3003", 9, 9, 0))
    free = judged(bricks)
    lever = (weight("3003") * 1 + weight("3001") * 6) / (weight("3003") + 2 * weight("3001"))
    np.testing.assert_allclose(free.tipping, [8 * (2 - lever), 8])
    one, two = (judged(bricks, loads=downward(bricks, 1, load)) for load in (0.0, -0.01))
    assert one.verdict is COLLAPSES
    assert two.tipping[0] < one.tipping[0]
    np.testing.assert_allclose(one.motion[3], 0, atol=1e-9)


@pytest.mark.parametrize(("factor", "verdict"), [(0.99, STABLE), (1.01, COLLAPSES)])
def test_table_slides(factor: float, verdict: Verdict) -> None:
    """Pushed sideways a brick slides beyond the friction of the table, but never on a baseplate."""
    loads = np.array([[factor * TABLE_FRICTION * weight("3001"), 0, 0]])
    assert judged(table(("3001", 0, 0, 0)), loads=loads).verdict is verdict
    assert judged(table(("3001", 0, 0, 0)), loads=loads, ground=Ground.BASEPLATE).stable


@pytest.mark.parametrize(("factor", "verdict"), [(0.99, STABLE), (1.01, COLLAPSES)])
def test_baseplate_lets_go(factor: float, verdict: Verdict) -> None:
    """A 2 x 4 brick is held by three points a stud; a table holds nothing that is lifted."""
    lifted = np.array([[0, 0, factor * 24 * HOLD + weight("3001")]])
    assert judged(table(("3001", 0, 0, 0)), loads=lifted, ground=Ground.BASEPLATE).verdict is verdict
    assert judged(table(("3001", 0, 0, 0)), loads=lifted).verdict is COLLAPSES


def test_what_hangs_in_the_air_falls() -> None:
    """Bricks in the air are named and the rest is judged without them."""
    found = judged(table(("3001", 0, 0, 0), ("3001", 0, 0, 6), ("3003", 0, 0, 3), ("3003", 5, 0, 3)))
    assert found.unsupported.tolist() == [3]
    assert (found.verdict, found.standing) == (COLLAPSES, STABLE)
    assert not found.stable
    assert (found.margin[:3] > 0.99).all()
    assert found.margin[3] == UNSUPPORTED
    assert found.weakest(1).tolist() == [3]
    assert np.isnan(found.tipping).tolist() == (np.arange(2) == found.component[3]).tolist()
    assert found.enough_clutch == np.inf


def test_collapse_tears_where_it_hangs() -> None:
    """Of a stair that falls it tears one of the lowest contacts, and what is below does not move."""
    found = judged(table(*stair(20)), ground=Ground.BASEPLATE)
    assert found.torn.tolist() == [[0, 1]]
    np.testing.assert_allclose(found.motion[0], 0, atol=1e-6)
    assert (found.motion[1:, 4] > 0).all()
    tipping = judged(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)))
    assert (tipping.verdict, tipping.torn.shape) == (COLLAPSES, (0, 2))
    assert judged(table(*stair(2)), ground=Ground.BASEPLATE).torn.shape == (0, 2)


def test_weakest_brick_is_at_the_root() -> None:
    """The stud that carries the whole arm has the least margin, and the proof tells how much hold is enough."""
    found = judged(table(*stair(12)), ground=Ground.BASEPLATE)
    assert found.stable
    assert set(found.weakest(2)) <= {0, 1, 2}
    assert 0 < found.margin.min() < found.margin[-1] <= 1
    again = judged(table(*stair(12)), clutch=found.enough_clutch + 1e-9, ground=Ground.BASEPLATE)
    assert is_equilibrium(again.statics, found.forces)
    assert least_clutch(again.statics) <= found.enough_clutch + 1e-6


@pytest.mark.parametrize(("factor", "verdict"), [(1 + 1e-5, STABLE), (1 - 1e-5, COLLAPSES)])
def test_programme_decides_what_projections_do_not(factor: float, verdict: Verdict) -> None:
    """A hundred thousandth beside the limit a linear programme proves either; without it the answer is open."""
    bricks = table(*stair(12))
    clutch = factor * least_clutch(equations(bricks, ground=Ground.BASEPLATE))
    found = judged(bricks, clutch=clutch, ground=Ground.BASEPLATE)
    assert found.verdict is verdict
    assert found.check()
    assert judged(bricks, clutch=clutch, ground=Ground.BASEPLATE, programme=0).verdict in (verdict, UNDECIDED)


def test_undecided_is_said(monkeypatch) -> None:
    """A billionth below the limit projections know nothing, and without programmes the verdict says so."""
    monkeypatch.setattr(search, "least_imbalance", lambda *_, **__: None)
    bricks = table(*stair(12))
    clutch = least_clutch(equations(bricks, ground=Ground.BASEPLATE))
    open_case = judged(bricks, clutch=clutch * (1 - 1e-9), ground=Ground.BASEPLATE, programme=0)
    assert open_case.verdict is UNDECIDED
    assert (open_case.motion == 0).all()
    assert not open_case.stable


def test_same_bricks_same_proof() -> None:
    """Two runs give the same bytes."""
    first, second = (judged(CASES[6].bricks(CATALOGUE), ground=Ground.BASEPLATE) for _ in range(2))
    assert first.forces.tobytes() == second.forces.tobytes()


@st.composite
def piles(draw):
    """Return bricks thrown on a pile, some of them only just on it."""
    parts = ["3005", "3004", "3010", "3003", "3001", "2357", "3022", "3460"]
    rows, top = [], np.zeros((24, 24), dtype=int)
    for _ in range(draw(st.integers(1, 9))):
        number, turn = draw(st.sampled_from(parts)), draw(st.integers(0, 3))
        x, y = draw(st.integers(4, 12)), draw(st.integers(4, 12))
        part = CATALOGUE.parts[CATALOGUE.part_row(number)]
        across = (part.width, part.length) if turn % 2 else (part.length, part.width)
        under = top[x : x + across[0], y : y + across[1]]
        z = int(under.max())
        rows.append((number, x, y, z, turn))
        under[:] = z + part.height
    return table(*rows)


def solvable(equations: Statics, reserve: float) -> bool:
    """Return whether a linear programme finds forces in balance that much above their least."""
    least = equations.contacts.least + reserve
    bounds = np.column_stack([least, np.full(len(least), np.inf)])
    found = linprog(np.zeros(len(least)), A_eq=equations.matrix, b_eq=-equations.loads, bounds=bounds)
    assert found.status in (0, 2)
    return bool(found.status == 0)


@settings(max_examples=60)
@given(piles(), st.sampled_from([0.002, 0.02, 0.98]), st.sampled_from(list(Ground)))
def test_verdicts_agree_with_a_linear_programme(bricks, clutch, ground) -> None:
    """What is proven to stand is feasible, what is proven to fall is not; only what has nothing to spare is open."""
    found = judged(bricks, clutch=clutch, ground=ground)
    assert found.check()
    feasible, to_spare = (solvable(found.statics, reserve) for reserve in (0.0, 2e-6))
    if found.standing is UNDECIDED:
        # on a knife's edge, as when the weight is right above the edge of a foot
        assert feasible
        assert not to_spare
    else:
        assert feasible == (found.standing is STABLE)
    assert set(found.unsupported) == set(np.flatnonzero(~contact_graph(bricks, CATALOGUE).grounded))


def test_a_pull_that_nothing_gives_counts_as_missing():
    """A contact that can only push has no friction to use, but a pull at it is short by its share of the clutch."""
    alone = equations(table(("3005", 0, 0, 0)), clutch=0.5)
    assert (alone.contacts.least == 0).all()
    pulled = np.full(len(alone.contacts.least), -0.1)
    assert _margins(alone, pulled, 1).tolist() == pytest.approx([-0.2])
    assert _margins(alone, -pulled, 1).tolist() == [1]
