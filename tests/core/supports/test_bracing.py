"""Pillars that stay where a whole model would fall."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.mirror import boxes
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.progress import silent
from legorize_addon.core.statics import search
from legorize_addon.core.statics.collapse import least_clutch
from legorize_addon.core.statics.forces import HOLD
from legorize_addon.core.statics.upright import upright
from legorize_addon.core.supports.bracing import _pillar_of, _tested, _with_fewer, _with_more, add_bracing
from legorize_addon.core.supports.pillars import add_pillars
from scripts.benchmarks.stablelego import stair
from tests.core.standing import CATALOGUE, equations, judged, table


def propped(bricks):
    """Return bricks with pillars under what falls, the graph of their contacts, and how they stand."""
    after, found = add_bracing(Assembly(bricks, CATALOGUE), judged(bricks), clutch=HOLD)
    return after.bricks, after.graph, found


def same(one, other):
    """Return whether two tables are the same."""
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in Bricks.__slots__)


def test_what_stands_stays_as_it_is():
    """A tower that stands is given back, with its own proof."""
    bricks = table(("3003", 0, 0, 0), ("3003", 0, 0, 3))
    after, _, found = propped(bricks)
    assert after is bricks
    assert found.stable


@pytest.mark.parametrize("height", range(1, 6))
def test_one_pillar_under_what_tips_over(height):
    """A long beam on one stud at its end gets one pillar, beyond its middle, and stands as safely as it is wide."""
    tower = [("3005", 0, 0, 3 * level) for level in range(height)]
    bricks = table(*tower, ("3008", 0, 0, 3 * height))
    assert judged(bricks).tipping[0] < 0
    after, graph, found = propped(bricks)
    assert found.stable
    assert found.check()
    pillars = after.take(np.arange(len(bricks), len(after)))
    assert set(pillars.role.tolist()) == {Role.SUPPORT_KEPT}
    assert len(np.unique(pillars.corner[:, 0])) == 1
    assert pillars.corner[0, 0] >= 3
    np.testing.assert_allclose(found.tipping[0], 4)
    assert graph.n_components == 1


def test_pillar_under_what_tears_off():
    """A stair of 30 levels that hangs on its lowest studs is held by pillars under its upper half."""
    bricks = table(*stair(30), ("3001", 0, 0, 0), ("3001", -4, 0, 0))
    after, _, found = propped(bricks)
    assert not judged(bricks).stable
    assert found.stable
    assert same(after.take(np.arange(len(bricks))), bricks)
    assert (after.corner[len(bricks) :, 0] > 0).all()


def test_pillar_stands_on_what_is_below():
    """An arm over a floor gets its pillar on the floor, not through it."""
    bricks = table(("3007", 0, 0, 0), ("3005", 0, 0, 3), *[("3008", 0, 0, 6 + 3 * level) for level in range(12)])
    after, graph, found = propped(bricks)
    assert found.stable
    assert graph.collisions == 0
    assert (after.corner[len(bricks) :, 2] >= 3).all()


@st.composite
def arms(draw):
    """Return towers with arms sticking out that may tear off or tip over."""
    rows, z = [], 0
    for _ in range(draw(st.integers(1, 4))):
        rows.append(("3003", 4, 4, z))
        z += 3
        if draw(st.booleans()):
            rows.append((draw(st.sampled_from(["3008", "3007", "3001"])), draw(st.integers(0, 5)), 4, z))
            z += 3
            rows += [("3007", rows[-1][1], 4, z + 3 * level) for level in range(draw(st.integers(0, 6)))]
            z = rows[-1][3] + 3
    return table(*rows)


@given(arms())
@settings(max_examples=40, deadline=None)
def test_whatever_falls_is_left_alone_or_stands(bricks):
    """Pillars come after all that was there, overlap nothing, and are only kept if the model is proven to stand."""
    bricks = add_pillars(Assembly(bricks, CATALOGUE)).bricks
    before = judged(bricks)
    assembly, found = add_bracing(Assembly(bricks, CATALOGUE), before, clutch=HOLD)
    after = assembly.bricks
    assert assembly.graph.collisions == 0
    assert same(after.take(np.arange(len(bricks))), bricks)
    if len(after) > len(bricks):
        assert not before.stable
        assert found.stable
        assert found.check()
    else:
        assert found is before


@given(arms())
@settings(max_examples=10, deadline=None)
def test_what_is_known_is_not_tested_again(bricks):
    """Pillars are the same where it is known already how the bricks stand with something to spare."""
    assembly = add_pillars(Assembly(bricks, CATALOGUE))
    _, known = _tested(assembly, (), clutch=0.8 * HOLD, progress=silent)
    one, found = add_bracing(assembly, None, clutch=HOLD, spare=0.2)
    other, again = add_bracing(assembly, None, clutch=HOLD, spare=0.2, known=known)
    assert same(one.bricks, other.bricks)
    assert found.verdict is again.verdict


@pytest.mark.parametrize(
    ("verdict", "at_all", "more"),
    [(Verdict.UNDECIDED, True, False), (Verdict.UNDECIDED, False, True), (Verdict.COLLAPSES, True, True)],
)
def test_what_stays_open_gets_no_pillars_if_it_stands(verdict, at_all, more):
    """A search that ends without an answer is no reason for pillars under what stands with less to spare."""
    assembly = Assembly(table(("3005", 0, 0, 0), ("3008", 0, 0, 3)), CATALOGUE)
    _, falls = _tested(assembly, (), clutch=HOLD, progress=silent)
    facts = {name: getattr(falls, name) for name in ("stable", "tipping", "yielding", "statics")}
    first, pillars = (assembly, Mock(standing=verdict, **facts)), []

    def tested(pillars, **_):
        return _tested(assembly, pillars, clutch=HOLD, progress=silent)

    _, found = _with_more(tested, lambda *_, **__: (assembly, Mock(stable=at_all)), first, pillars)
    assert bool(pillars) == more
    assert found.stable == more


def test_pillars_that_bear_little_are_left_out():
    """Of seven pillars under a beam that tips over, one or two stay, and the model still stands."""
    bricks = table(("3005", 0, 0, 0), ("3008", 0, 0, 3))
    pillars = [table(("3005", x, 0, 0)) for x in range(1, 8)]
    tested = partial(_tested, Assembly(bricks, CATALOGUE), clutch=HOLD, progress=silent)
    (assembly, found), left = _with_fewer(tested(pillars), pillars, tested)
    after = assembly.bricks
    assert len(left) == len(after) - len(bricks)
    assert found.stable
    assert 1 <= len(after) - len(bricks) <= 2
    assert same(after.take(np.arange(len(bricks))), bricks)


def test_pillars_leave_where_forces_hold_that_lean(monkeypatch):
    """With pillars under two of four arms upright forces do, even if they bear but half; with one, others bear all."""

    def halved(whole):
        reduced = upright(whole)
        contacts = reduced.statics.contacts
        weak = replace(reduced.statics, contacts=replace(contacts, least=contacts.least / 2))
        return replace(reduced, statics=weak)

    monkeypatch.setattr(search, "upright", halved)
    bricks = table(("3001", 4, 0, 0, 1), *(("3001", x, y, 3) for x in (1, 5) for y in (0, 2)))
    clutch = 1.05 * least_clutch(equations(bricks))
    pillars = [table(("3005", 8, y, 0)) for y in (0, 3)]
    tested = partial(_tested, Assembly(bricks, CATALOGUE), clutch=clutch, progress=silent)
    both = tested(pillars)
    assert both[1].upright
    (_, found), left = _with_fewer(both, pillars, tested)
    assert found.stable
    assert not found.upright
    assert len(left) == 1


def test_contacts_that_stay_are_told_by_their_pillars():
    """What is left of the contacts of bricks with pillars, once some are taken away, are those of the others."""
    bricks = table(("3005", 0, 0, 0), ("3008", 0, 0, 3), ("3003", 6, 0, 6))
    pillars = [table(("3024", x, 0, 0), ("3024", x, 0, 1), ("3024", x, 0, 2)) for x in (3, 5, 6)]
    tested = partial(_tested, Assembly(bricks, CATALOGUE), clutch=HOLD, progress=silent)
    every = tested(pillars)
    for left in np.ndindex(2, 2, 2):
        fewer = tested([pillar for pillar, stays in zip(pillars, left, strict=True) if stays])[1].statics.contacts
        kept = np.array([*left, 1], dtype=bool)[_pillar_of(every, pillars)].all(axis=0)
        for name in ("point", "direction", "least"):
            assert np.array_equal(getattr(every[1].statics.contacts, name)[kept], getattr(fewer, name))


def test_pillars_of_a_symmetric_model_are_mirrored():
    """Two long arms of one stud each: the pillar under the left one moves to the image of that under the right one.

    A brick that hangs there makes it shorter by the height of a brick.
    """
    rows = [("3003", 20, 0, 3 * level) for level in range(4)]
    rows += [("3007", x, 0, 12) for x in (13, 21)]
    rows += [("3007", x, 0, 15) for x in (6, 28)]
    rows += [("3001", x, 0, 18) for x in (6, 32)]
    after, _, found = propped(table(*rows, ("3005", 31, 0, 12)))
    assert found.stable
    pillars = after.take(np.flatnonzero(after.role == Role.SUPPORT_KEPT))
    outline = boxes(pillars, CATALOGUE)
    assert set(outline[outline[:, 0] == outline[:, 1], 0].tolist()) == {41 - 31, 31}
