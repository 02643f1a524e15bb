"""Slopes in all their turns: what they claim is what contacts say, and what they hold turns with them."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import contact_graph
from legorize_addon.core.model.profiles import solid
from legorize_addon.core.slicing import ACROSS, UP
from legorize_addon.core.slopes.forms import forms, slopes_of
from tests.core.any_bricks import table
from tests.core.slopes.ramps import CATALOGUE, RED

FORMS = forms(CATALOGUE.parts, plates=True)


def named(number, turn):
    """Return a form by the number of its part."""
    return next(form for form in FORMS if CATALOGUE.parts[form.part].number == number and form.turn == turn)


def cells(rows):
    """Return cells as a set of tuples."""
    return set(map(tuple, np.asarray(rows).tolist()))


@pytest.mark.parametrize("form", FORMS, ids=lambda form: f"{CATALOGUE.parts[form.part].number}-{form.turn}")
def test_claims_are_those_of_the_contact_graph(form):
    """The cells of a form are those that its part fills as a brick, filled by the volume of the part."""
    owner = contact_graph(table([(form.part, 0, 0, 0, form.turn, RED, 0, 0, 0)]), CATALOGUE).owner
    assert cells(form.cells) == cells(np.argwhere(owner >= 0))
    part = CATALOGUE.parts[form.part]
    # samples of what runs at an angle are not exact
    fine = 8 if part.wedge else 1
    sampled = solid(part, form.turn, fine * ACROSS, UP).sum() / fine**2
    assert form.fill.sum() == pytest.approx(sampled, rel=0.03 * part.wedge)
    assert form.height == part.height
    assert form.columns[:, 3].sum() == len(form.cells)


def test_what_a_slope_holds():
    """A 2 x 1 slope has a stud over its high end, sockets under both squares, and keeps its low end free above."""
    form = named("3040b", 0)
    assert cells(form.held) == {(3, 0, 0)}
    assert cells(form.holding) == {(-1, 0, 0), (-1, 0, 1)}
    assert cells(form.above) == {(3, 0, 1)}
    assert cells(form.below) == set()
    # past the fall one sees what stands in front of it and at both sides
    assert {(1, 0, 2), (1, 1, 1), (1, -1, 1)} <= cells(form.beside)
    assert (1, 0, -1) not in cells(form.beside)


def test_an_inverted_slope_is_upside_down():
    """An inverted slope has studs over both squares and keeps its deep end free below."""
    form = named("3665", 0)
    assert cells(form.held) == {(3, 0, 0), (3, 0, 1)}
    assert cells(form.holding) == {(-1, 0, 0)}
    assert cells(form.below) == {(-1, 0, 1)}


def test_bricks_alone():
    """Without plates there are no slopes but those of a brick's height; what is made in no colour is left out."""
    assert {form.height % 3 for form in forms(CATALOGUE.parts, plates=False)} == {0}
    none = CATALOGUE.exists.copy()
    none[named("3039", 0).part] = False
    left = slopes_of(type(CATALOGUE)(CATALOGUE.parts, CATALOGUE.colours, none, none * 0, none * 0), plates=True)
    usual = slopes_of(CATALOGUE, plates=True)
    assert {form.part for form in usual} - {form.part for form in left} == {CATALOGUE.part_row("3039")}
