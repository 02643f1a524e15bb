"""Which slopes are chosen: the best ones, as one after the other would choose them, none over another one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model import contact_graph
from legorize_addon.core.slopes.candidates import Candidates, rows
from legorize_addon.core.slopes.choice import best, choose_slopes
from legorize_addon.core.slopes.forms import slopes_of
from legorize_addon.core.slopes.site import Site
from tests.core.slopes.ramps import CATALOGUE, RED, cells_of_ramp, ramp

FORMS = slopes_of(CATALOGUE, plates=True)


def test_a_ramp_gets_its_slopes():
    """A 2 x 4 slope lies on a ramp of four studs, and one of 2 x 3 beside it on a ramp of seven."""
    grid = cells_of_ramp()
    bricks = choose_slopes(ramp(), grid, grid, CATALOGUE, price=0.5, plates=True).bricks
    assert [CATALOGUE.parts[row].number for row in bricks.part] == ["3037"]
    assert bricks.corner.tolist() == [[5, 1, 3]]
    assert bricks.turn.tolist() == [0]
    assert (bricks.colour == RED).all()
    assert bricks.step.tolist() == [1]
    grid = cells_of_ramp(7)
    bricks = choose_slopes(ramp(7), grid, grid, CATALOGUE, price=0.5, plates=True).bricks
    assert sorted(CATALOGUE.parts[row].number for row in bricks.part) == ["3037", "3038"]


def test_nothing_pays():
    """A single slope that takes a part more is chosen where that costs little, and not where it costs much."""
    grid = cells_of_ramp(1)
    bricks = [choose_slopes(ramp(1), grid, grid, CATALOGUE, price=price, plates=True).bricks for price in (0.1, 10.0)]
    assert [CATALOGUE.parts[row].number for row in bricks[0].part] == ["3040b"]
    assert not len(bricks[1])


@given(st.lists(st.tuples(st.integers(0, len(FORMS) - 1), st.integers(0, 400), st.integers(1, 9)), max_size=60))
@settings(max_examples=40, deadline=None)
def test_as_one_after_the_other(places):
    """In rounds the same slopes are chosen as by going from the best to the worst."""
    grid = cells_of_ramp()
    site = Site.of(ramp(), grid, grid)
    places = sorted(set(places))
    form, place, score = np.array(places, np.int64).reshape(-1, 3).T
    place = place + site.shape[1] * site.shape[2] + 40
    found = Candidates(form, place, score.astype(float), score.astype(float), np.full(len(form), RED))
    claims, keeps = {}, {}
    for which, claimed, kept in rows(site, FORMS, found):
        for row, one, other in zip(which.tolist(), claimed.tolist(), kept.tolist(), strict=True):
            claims[row], keeps[row] = set(one), set(other)
    chosen, taken, closed = [], set(), set()
    for row in sorted(range(len(form)), key=lambda row: (-score[row], form[row], place[row])):
        if not claims[row] & (taken | closed) and not keeps[row] & taken:
            chosen.append(row)
            taken |= claims[row]
            closed |= keeps[row]
    assert best(site, FORMS, found, np.arange(len(form))).tolist() == sorted(chosen)


def test_no_two_in_one_cell():
    """Chosen slopes do not collide."""
    grid = cells_of_ramp(7)
    bricks = choose_slopes(ramp(7), grid, grid, CATALOGUE, price=0.0, plates=True).bricks
    assert len(bricks) >= 2
    assert contact_graph(bricks, CATALOGUE).collisions == 0


def test_what_slopes_are_worth():
    """What a slope is worth does not depend on the price of parts, and a wider one on a ramp is worth more."""
    found = [
        choose_slopes(ramp(width), cells_of_ramp(width), cells_of_ramp(width), CATALOGUE, price=price, plates=True)
        for width, price in ((1, 0.1), (1, 0.2), (4, 0.1))
    ]
    assert [len(each.bricks) for each in found] == [1, 1, 1]
    assert found[0].worth.tolist() == found[1].worth.tolist()
    assert found[2].worth.tolist() == pytest.approx((4 * found[0].worth).tolist())
