"""Colours that the catalogue does not have, as the closest ones that it has."""

from __future__ import annotations

import csv

import numpy as np
import pytest

from legorize_addon.core.ldraw.colours import brick_colours, other_colours
from legorize_addon.core.model.catalogue import ASSETS, load_catalogue

CATALOGUE = load_catalogue()


def of(codes, defined=None):
    """Return the colours of codes, and what was replaced as (code, by, known, count)."""
    found, replaced = brick_colours(np.array(codes, np.int64), CATALOGUE, defined or {})
    return found.tolist(), [(each.code, each.by, each.known, each.count) for each in replaced]


def test_own_colours_stay():
    """Every colour of the catalogue is read as itself."""
    codes = CATALOGUE.codes.tolist()
    assert of(codes) == (codes, [])


@pytest.mark.parametrize("base", [0x2000000, 0x3000000])
def test_direct_colours_of_the_catalogue_s_values(base):
    """A direct colour with the value of a brick colour is that one, solid or transparent."""
    values = [red << 16 | green << 8 | blue for red, green, blue in (each.rgb for each in CATALOGUE.colours)]
    assert of([base + value for value in values])[0] == CATALOGUE.codes.tolist()


@pytest.mark.parametrize(("code", "by"), [(0x2FFFFFF, 15), (0x2B50000, 4), (7, 71), (8, 72), (47, 15), (256, 0)])
def test_others_are_read_as_the_closest_one(code, by):
    """White, red, the greys of old, clear, black rubber."""
    assert of([code, code]) == ([by, by], [(code, by, True, 2)])


def test_colours_that_the_file_defines_come_first():
    """What a document says of a code holds, also for one of LDraw's."""
    assert of([900], {900: (0, 0, 0)})[1] == [(900, 0, True, 1)]
    assert of([6], {6: (244, 244, 244)})[1] == [(6, 15, True, 1)]


@pytest.mark.parametrize("code", [16, 24, 7777])
def test_no_colour_is_grey(code):
    """Parts in the colour of a call that never came, or of one that nobody defines, are light bluish grey."""
    assert of([code]) == ([71], [(code, 71, False, 1)])


def test_table_has_what_the_catalogue_has_not():
    """LDraw's other colours have values, and none of them is in the catalogue."""
    others = other_colours()
    assert not set(others) & set(CATALOGUE.codes.tolist())
    rows = list(csv.DictReader((ASSETS / "other_colours.csv").read_text().splitlines()))
    assert len(rows) == len(others) == 161
    assert others[47] == (252, 252, 252)
