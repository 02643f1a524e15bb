"""Lots: nothing lost, nothing invented."""

from __future__ import annotations

import pytest
from hypothesis import given, settings

from legorize_addon.core.errors import BuildError
from legorize_addon.core.shopping.lots import count_lots, mass_of, not_made, priced, totals
from tests.core.shopping.wanted import CATALOGUE, assembly_of, bought

unhurried = settings(deadline=None, max_examples=50)


@unhurried
@given(bought)
def test_counts_add_up(pairs):
    """Every pair of part and colour is counted once, sorted, with as many bricks as there are."""
    found = [(lot.part.number, lot.colour.code, lot.count) for lot in count_lots(assembly_of(pairs))]
    wanted = sorted((row, code, pairs.count((row, code))) for row, code in set(pairs))
    assert found == [(CATALOGUE.parts[row].number, code, count) for row, code, count in wanted]


@unhurried
@given(bought)
def test_mass_is_that_of_the_bricks(pairs):
    """The masses of the lots add up to those of the single bricks."""
    assert mass_of(count_lots(assembly_of(pairs))) == pytest.approx(sum(CATALOGUE.parts[row].mass for row, _ in pairs))


def test_lot_knows_its_elements():
    """The newest number comes first and the second one is older; a part with one number alone has no second one."""
    twice, once = count_lots(assembly_of([(CATALOGUE.part_row("3005"), 15), (CATALOGUE.part_row("3005"), 4)]))[::-1]
    assert (twice.element, twice.second_element) == (6552096, 6548258)
    assert (once.element, once.second_element) == (300521, 0)


def test_second_elements_are_older_ones_of_the_same_pair():
    """No second number without a first one; they differ, and no number belongs to two pairs."""
    first, second = CATALOGUE.element, CATALOGUE.second_element
    assert (second <= first).all()
    assert (first[second > 0] > second[second > 0]).all()
    numbers = [*first[first > 0].tolist(), *second[second > 0].tolist()]
    assert len(set(numbers)) == len(numbers)
    # as counted in the public list
    assert (second > 0).sum() == 1032


def test_prices_are_put_in_once():
    """Prices are those of single bricks; where none is known, the sum leaves the lot out."""
    lots = priced(
        count_lots(assembly_of([(0, 4), (0, 4), (1, 4)])), lambda part, colour: 0.25 if part.number == "3005" else None
    )
    assert [(lot.price, lot.cost) for lot in lots] == [(0.25, 0.5), (None, None)]
    assert totals(lots) == (3, pytest.approx(2 * 0.43 + 0.81), 0.5)
    assert totals(priced(lots, lambda part, colour: None))[2] is None


def test_pairs_that_are_not_made_are_found():
    """Of a 2 x 2 corner and a 1 x 1 brick in Dark Turquoise only the corner was never made."""
    pairs = [(CATALOGUE.part_row("2357"), 3), (CATALOGUE.part_row("3005"), 3)]
    assert [lot.part.number for lot in not_made(count_lots(assembly_of(pairs)))] == ["2357"]


def test_colour_outside_the_catalogue_is_refused():
    """A brick in a colour that nobody sells is an error, not a gap in the list."""
    with pytest.raises(BuildError, match="Colour 6 is not"):
        count_lots(assembly_of([(0, 6)]))
