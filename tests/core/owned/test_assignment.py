"""Bricks are taken from owned lots: known assignments, and never more than there are."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.owned.assignment import assign, differences, visible_cells
from tests.core.any_bricks import CATALOGUE, table
from tests.core.owned_box import owning, used

BRICK = CATALOGUE.part_row("3001")


def row_of(*codes):
    """Return 2 x 4 bricks side by side in some colours."""
    return Assembly(table([(BRICK, 4 * at, 0, 0, 0, code, 0, 0, 0) for at, code in enumerate(codes)]), CATALOGUE)


def test_own_colours_first_then_the_closest():
    """Of three red bricks two are owned in red; the one that is seen least becomes dark red."""
    found = assign(
        row_of(4, 4, 4), np.array([5, 1, 9]), owning({("3001", 4): 2, ("3001", 320): 1, ("3001", 2): 9}), keep=False
    )
    assert found.colour.tolist() == [4, 320, 4]
    assert not found.missing.any()
    assert found.scarcity[BRICK, CATALOGUE.colour_row(4)] > 0 == found.scarcity[BRICK, CATALOGUE.colour_row(2)]


def test_kept_colours_are_missing_rather_than_changed():
    """If colours are kept, what is seen is missing, and what is hidden takes any lot."""
    found = assign(row_of(4, 4, 4), np.array([5, 0, 9]), owning({("3001", 4): 1, ("3001", 2): 9}), keep=True)
    assert found.missing.sum() == 1
    assert found.colour[1] in (2, 4)
    assert set(found.colour[[0, 2]].tolist()) == {4}


def test_parts_that_are_not_owned_are_missing():
    """Without any brick of the part all of them are missing, in their colours."""
    found = assign(row_of(4, 15), np.array([1, 1]), owning({("3005", 4): 5}), keep=False)
    assert found.missing.all()
    assert found.colour.tolist() == [4, 15]


@given(st.data(), st.booleans())
@settings(max_examples=40, deadline=None)
def test_no_lot_is_overdrawn_and_no_better_assignment_exists(data, keep):
    """Whatever is owned: no lot gives more than it has, and as many bricks are served as an assignment can."""
    codes = [0, 4, 14, 15, 320]
    wanted = data.draw(st.lists(st.sampled_from(codes), min_size=1, max_size=8))
    seen = np.array(data.draw(st.lists(st.integers(0, 1), min_size=len(wanted), max_size=len(wanted))))
    count = owning({("3001", code): data.draw(st.integers(0, 3)) for code in codes})
    found = assign(row_of(*wanted), seen, count, keep=keep)
    bricks = replace(row_of(*wanted).bricks, colour=found.colour.astype(np.int16))
    assert (used(bricks.take(~found.missing)) <= count).all()
    units = np.repeat(np.arange(len(CATALOGUE.colours)), count[BRICK])
    apart = differences(CATALOGUE)[CATALOGUE.colour_rows(np.array(wanted))] * seen[:, None]
    cost = np.where(keep & (apart > 0), 1e6, apart)[:, units]
    rows, columns = linear_sum_assignment(np.hstack([cost, np.full((len(wanted), len(wanted)), 1e6)]))
    best = np.hstack([cost, np.full((len(wanted), len(wanted)), 1e6)])[rows, columns]
    assert found.missing.sum() == (best >= 1e6).sum()
    taken = CATALOGUE.colour_rows(found.colour)
    served = ~found.missing
    assert (apart[np.arange(len(wanted)), taken] * served).sum() == pytest.approx(best[best < 1e6].sum(), abs=1e-6)


def test_cells_on_the_ground_are_not_seen_from_below():
    """A 2 x 4 alone shows all of its 24 cells but none is counted twice; one under another shows its sides."""
    alone = Assembly(table([(BRICK, 0, 0, 0, 0, 4, 0, 0, 0)]), CATALOGUE)
    assert visible_cells(alone.graph).tolist() == [24]
