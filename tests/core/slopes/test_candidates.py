"""Where slopes pay: on a ramp that they fit, in the colours of its cells, and where they hold."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model import COLOUR_ANY, Fill
from legorize_addon.core.slopes.candidates import candidates
from legorize_addon.core.slopes.forms import forms, slopes_of
from legorize_addon.core.slopes.site import Site
from tests.core.slopes.ramps import CATALOGUE, RED, WHITE, cells_of_ramp, ramp

FORMS = slopes_of(CATALOGUE, plates=True)


def listed(grid, shell=None, price=0.3, catalogue=CATALOGUE, mesh=None):
    """List what pays on a ramp as part, turn, place, colour and score."""
    site = Site.of(ramp() if mesh is None else mesh, grid, grid if shell is None else shell)
    found = candidates(site, FORMS, catalogue, price=price)
    parts = [CATALOGUE.parts[FORMS[row].part].number for row in found.form]
    turns = [FORMS[row].turn for row in found.form]
    corners = map(tuple, site.corners(found.place).tolist())
    return dict(zip(zip(parts, turns, corners, strict=True), zip(found.colour, found.score, strict=True), strict=True))


def test_the_slopes_that_fit():
    """Where 2 x 2 slopes fit exactly, they pay, and save what is wrong without them."""
    found = listed(cells_of_ramp(), price=0.0)
    code, score = found["3039", 0, (5, 1, 3)]
    assert code == RED
    # cells of the fall have shares of .98, .6 and .2; two studs wide; parts that the fall goes through count half
    assert 0.9 < score < 2 * (0.02 + 0.4 + 0.2)
    assert ("3039", 2, (5, 1, 3)) not in found
    # as wide as the ramp is twice as good, and nothing is better
    assert found["3037", 0, (5, 1, 3)][1] == pytest.approx(2 * score)
    assert max(found.values(), key=lambda each: each[1])[1] == pytest.approx(2 * score)


def test_parts_cost():
    """A higher price leaves less, and a slope that saves parts pays at any."""
    counts = [len(listed(cells_of_ramp(), price=price)) for price in (0.0, 0.3, 1.0, 3.0)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[-1]


def test_colours():
    """A slope takes the colour of most of its cells; cells of others cost, and what is not made is out."""
    grid = cells_of_ramp()
    colour = grid.colour.copy()
    colour[1, 2, 1, 5] = WHITE
    mixed = listed(replace(grid, colour=colour))
    assert mixed["3039", 0, (5, 2, 3)] == listed(grid)["3039", 0, (5, 2, 3)]
    assert ("3039", 0, (5, 1, 3)) not in mixed or mixed["3039", 0, (5, 1, 3)][1] < mixed["3039", 0, (5, 2, 3)][1] - 0.5
    exists = CATALOGUE.exists.copy()
    exists[CATALOGUE.part_row("3039"), CATALOGUE.colour_row(RED)] = False
    assert not any(part == "3039" for part, *_ in listed(grid, catalogue=replace(CATALOGUE, exists=exists)))


def test_what_is_seen_past_slopes_costs():
    """What has to be built because one looks at it past a slope costs a plate's share of the price of a part."""
    grid = cells_of_ramp()
    colour, cover = grid.colour.copy(), grid.cover.copy()
    colour[1, 1, 3, 6] = COLOUR_ANY
    at = ("3039", 0, (5, 1, 3))
    usual = listed(grid)[at][1]
    assert listed(replace(grid, colour=colour))[at][1] == pytest.approx(usual)
    cover[1, 1, 3, 6] = Fill.OPTIONAL
    assert listed(replace(grid, colour=colour, cover=cover))[at][1] == pytest.approx(usual - 0.3 * 0.15)


def test_it_holds_to_the_shell():
    """A slope under whose sockets nothing has to be built is held by nothing."""
    grid = cells_of_ramp()
    cover = grid.cover.copy()
    cover[0, 2, :, 5:] = np.where(cover[0, 2, :, 5:] == Fill.REQUIRED, Fill.OPTIONAL, Fill.EMPTY)
    assert ("3039", 0, (5, 1, 3)) not in listed(grid, replace(grid, cover=cover))


def test_what_is_above_the_fall_stays_free():
    """Nothing is laid under a cell of the model with its smooth side."""
    grid = cells_of_ramp()
    colour, cover = grid.colour.copy(), grid.cover.copy()
    colour[2, 0, 1:3, 6], cover[2, 0, 1:3, 6] = RED, Fill.REQUIRED
    found = listed(replace(grid, colour=colour, cover=cover))
    assert ("3039", 0, (5, 1, 3)) not in found
    assert ("3039", 0, (5, 3, 3)) in found


def test_every_form_is_as_of_itself():
    """Lists of several forms are those of each, one after the other."""
    grid = cells_of_ramp()
    site = Site.of(ramp(), grid, grid)
    every = forms(CATALOGUE.parts, plates=True)
    found = candidates(site, every, CATALOGUE, price=0.1)
    singly = [len(candidates(site, (form,), CATALOGUE, price=0.1).form) for form in every]
    assert np.bincount(found.form, minlength=len(every)).tolist() == singly


def test_weighted_surface_pays_and_costs_more():
    """Where all counts four times, a slope that costs no part gains four times as much, and a wrong colour costs so."""
    usual = listed(cells_of_ramp(), price=0.0)
    mesh = replace(ramp(), weight=np.full(len(ramp().vertices), 3.0))
    assert listed(cells_of_ramp(), price=0.0, mesh=mesh) == {
        key: (code, pytest.approx(4 * score)) for key, (code, score) in usual.items()
    }
    grid = cells_of_ramp()
    colour = grid.colour.copy()
    colour[1, 2, 1, 5] = WHITE
    mixed = replace(grid, colour=colour)
    place = ("3037", 0, (5, 1, 3))
    gains = [listed(mixed, price=0.0, mesh=each).get(place, (0, 0.0))[1] for each in (ramp(), mesh)]
    assert gains[1] == pytest.approx(4 * gains[0])
