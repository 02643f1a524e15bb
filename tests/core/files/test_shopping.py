"""The lists that shops read: nothing lost, nothing invented, every number the shop's own."""

from __future__ import annotations

import csv
import io
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.shopping import (
    bricklink_xml,
    count_parts,
    masses,
    not_made,
    parts_csv,
    pick_a_brick_csv,
    rebrickable_csv,
)
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue

CATALOGUE = load_catalogue()
unhurried = settings(deadline=None, max_examples=50)


def bricks_of(pairs):
    """Return bricks of the given (part row, LDraw code), all in one place."""
    part, colour = np.array(pairs, np.int16).reshape(-1, 2).T
    n = len(part)
    return Bricks(
        part=part,
        corner=np.zeros((n, 3), np.int32),
        turn=np.zeros(n, np.uint8),
        colour=colour,
        role=np.zeros(n, np.uint8),
        piece=np.zeros(n, np.int16),
        step=np.zeros(n, np.int32),
    )


def read_csv(text):
    """Return the rows of a CSV text as dictionaries."""
    return list(csv.DictReader(io.StringIO(text)))


bought = st.lists(
    st.tuples(st.integers(0, len(CATALOGUE.parts) - 1), st.sampled_from(CATALOGUE.codes.tolist())), max_size=60
)


@unhurried
@given(bought)
def test_counts_add_up(pairs):
    """Every pair of part and colour is counted once, sorted, with as many bricks as there are."""
    parts = count_parts(Assembly(bricks_of(pairs), CATALOGUE))
    entries = [(part.number, colour.code, count) for part, colour, count in parts.entries(CATALOGUE)]
    wanted = sorted((row, code, pairs.count((row, code))) for row, code in set(pairs))
    assert entries == [(CATALOGUE.parts[row].number, code, count) for row, code, count in wanted]


@unhurried
@given(bought)
def test_mass_is_that_of_the_bricks(pairs):
    """The masses of the list add up to those of the single bricks."""
    total = masses(count_parts(Assembly(bricks_of(pairs), CATALOGUE)), CATALOGUE).sum()
    assert total == pytest.approx(sum(CATALOGUE.parts[row].mass for row, _ in pairs))


@unhurried
@given(bought)
def test_every_list_holds_every_brick(pairs):
    """Each of the four lists has all bricks; Pick a Brick together with what it leaves out."""
    parts = count_parts(Assembly(bricks_of(pairs), CATALOGUE))
    assert sum(int(row["count"]) for row in read_csv(parts_csv(parts, CATALOGUE))) == len(pairs)
    assert sum(int(row["Quantity"]) for row in read_csv(rebrickable_csv(parts, CATALOGUE))) == len(pairs)
    wanted = ElementTree.fromstring(bricklink_xml(parts, CATALOGUE)).iter("MINQTY")
    assert sum(int(field.text) for field in wanted) == len(pairs)
    text, left_out = pick_a_brick_csv(parts, CATALOGUE)
    assert sum(int(row["quantity"]) for row in read_csv(text)) + left_out.count.sum() == len(pairs)


def test_each_shop_gets_its_own_colour_number():
    """Olive Green is 330 for LDraw, 155 for BrickLink and 326 for Rebrickable."""
    row = CATALOGUE.part_row("3001")
    parts = count_parts(Assembly(bricks_of([(row, 330)] * 3), CATALOGUE))
    [line] = read_csv(parts_csv(parts, CATALOGUE))
    element = int(CATALOGUE.element[row, CATALOGUE.colour_row(330)])
    assert line == {
        "part": "3001", "title": "Brick 2 x 4", "colour": "330", "colour_name": "Olive Green", "count": "3",
        "mass_g": "6.48", "element": str(element),
    }  # fmt: skip
    assert rebrickable_csv(parts, CATALOGUE) == "Part,Color,Quantity\n3001,326,3\n"
    assert pick_a_brick_csv(parts, CATALOGUE)[0] == f"elementId,quantity\n{element},3\n"
    [item] = ElementTree.fromstring(bricklink_xml(parts, CATALOGUE))
    assert {field.tag: field.text for field in item} == {
        "ITEMTYPE": "P", "ITEMID": "3001", "COLOR": "155", "MINQTY": "3", "CONDITION": "X", "NOTIFY": "N",
    }  # fmt: skip


def test_wanted_list_has_no_declaration():
    """BrickLink's list starts with its root element, also when it is empty."""
    for pairs in ([], [(0, 4)]):
        assert bricklink_xml(count_parts(Assembly(bricks_of(pairs), CATALOGUE)), CATALOGUE).startswith("<INVENTORY")


def test_pair_without_element_number_is_left_out_and_named():
    """A pair whose element number is not known is not written but handed back, and stays in the parts list."""
    element = CATALOGUE.element.copy()
    element[0, CATALOGUE.colour_row(4)] = 0
    gap = Catalogue(CATALOGUE.parts, CATALOGUE.colours, CATALOGUE.exists, element)
    parts = count_parts(Assembly(bricks_of([(0, 4), (0, 4), (1, 4)]), gap))
    text, left_out = pick_a_brick_csv(parts, gap)
    assert [row["quantity"] for row in read_csv(text)] == ["1"]
    assert [(part.number, colour.code, count) for part, colour, count in left_out.entries(gap)] == [("3005", 4, 2)]
    assert [row["element"] == "" for row in read_csv(parts_csv(parts, gap))] == [True, False]


def test_pairs_that_are_not_made_are_found():
    """Of a 2 x 2 corner and a 1 x 1 brick in Dark Turquoise only the corner was never made."""
    pairs = [(CATALOGUE.part_row("2357"), 3), (CATALOGUE.part_row("3005"), 3)]
    missing = not_made(count_parts(Assembly(bricks_of(pairs), CATALOGUE)), CATALOGUE)
    assert [part.number for part, _, _ in missing.entries(CATALOGUE)] == ["2357"]


def test_colour_outside_the_catalogue_is_refused():
    """A brick in a colour that nobody sells is an error, not a gap in the list."""
    with pytest.raises(BuildError, match="Colour 6 is not"):
        count_parts(Assembly(bricks_of([(0, 6)]), CATALOGUE))
