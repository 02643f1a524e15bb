"""Whose numbers a table has."""

from __future__ import annotations

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.stock.lots import lots
from tests.core.any_bricks import CATALOGUE


def named(lot):
    """Return the numbers of part and colour."""
    return None if lot is None else (CATALOGUE.parts[lot[0]].number, CATALOGUE.colours[lot[1]].code)


def read(**cells):
    """Return what a table of one row means."""
    return named(lots([cells], CATALOGUE, "a.csv", "owned").of(cells))


@pytest.mark.parametrize(
    ("cells", "code"),
    [
        ({"part": "3001", "color": "326"}, 330),
        ({"partnum": "3001", "colorid": "158"}, 326),
        ({"itemid": "3001", "color": "155"}, 330),
        ({"itemno": "3001", "colorid": "155"}, 330),
        ({"part": "3001", "colour": "330"}, 330),
        ({"ldrawid": "3001", "ldrawcolorid": "330", "blcolorid": "155"}, 330),
        ({"part": "3001", "colour": "Olive Green"}, 330),
        ({"part": "3001", "color": "Dark Bluish Grey"}, 72),
        ({"itemid": "3001", "itemtype": "P", "color": "11"}, 0),
        ({"itemid": "3001", "itemtype": "Part", "color": "11"}, 0),
    ],
)
def test_colours_of_every_house(cells, code):
    """Olive Green is 330 for LDraw, 326 for Rebrickable and 155 for BrickLink; names have two spellings."""
    assert read(**cells) == ("3001", code)


def test_aliases_and_elements():
    """Other numbers of a part mean the same one, and an element number means part and colour at once."""
    assert read(part="3023b", color="0") == ("3023", 0)
    assert read(elementid="300526") == ("3005", 0)


@pytest.mark.parametrize(
    "cells",
    [
        {"part": "9999", "color": "0"},
        {"part": "3001", "color": "9999"},
        {"part": "3001", "color": "Plaid"},
        {"part": "3001", "color": ""},
        {"itemid": "3001", "itemtype": "S", "color": "11"},
        {"itemid": "3001", "itemtypeid": "M", "color": "11"},
    ],
)
def test_what_is_not_in_the_catalogue(cells):
    """Unknown parts and colours, sets and minifigures are none of our lots."""
    assert read(**cells) is None


@pytest.mark.parametrize(("cells", "words"), [({"colour": "4"}, "no column for a part"), ({"part": "1"}, "a colour")])
def test_missing_columns_get_a_sentence(cells, words):
    """It lists the columns that there are."""
    with pytest.raises(SettingsError, match=words) as refused:
        read(**cells)
    assert f"(its columns: {next(iter(cells))})" in str(refused.value)
