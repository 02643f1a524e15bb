"""The list of lots beside a map."""

from __future__ import annotations

import pytest

from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.legend import Legend, lettered
from legorize_addon.core.instructions.lots import Lot
from tests.core.any_bricks import CATALOGUE


def test_letters_go_on_like_columns_of_a_sheet():
    """After Z comes AA, after ZZ AAA, and none stands for two numbers."""
    assert [lettered(number) for number in (0, 25, 26, 51, 52, 701, 702)] == ["A", "Z", "AA", "AZ", "BA", "ZZ", "AAA"]
    assert len({lettered(number) for number in range(2000)}) == 2000


@pytest.mark.parametrize("count", [1, 7, 20, 43, 120])
def test_every_lot_has_its_place(count):
    """All lots fit into the height, however many."""
    room = 170.0
    legend = Legend.of(count, room)
    assert legend.rows * legend.row <= room + 1e-9
    lots = [Lot(number % len(CATALOGUE.parts), number % 20, number + 1) for number in range(count)]
    items = list(legend.items([(lot, None) for lot in lots], CATALOGUE))
    assert len({item.matrix for item in items}) == count
    assert all(0 <= item.matrix[4] < legend.width and 0 <= item.matrix[5] < room for item in items)
    texts = [each.text for item in items for each in item.items if isinstance(each, Text)]
    assert f"{count}x" in texts
    assert all(isinstance(each, (Group, Text)) for item in items for each in item.items)


def test_names_have_all_the_room_beside_the_map():
    """A long name is cut in the least width, and not where the legend is wider."""
    legend = Legend.of(26, 170.0)
    part = next(row for row, part in enumerate(CATALOGUE.parts) if part.number == "2420")
    longest = max(range(len(CATALOGUE.colours)), key=lambda row: len(CATALOGUE.colours[row].name))
    entries = [(Lot(part, longest, 1), None)] * 26
    name = f"{CATALOGUE.parts[part].title}, {CATALOGUE.colours[longest].name}"

    def shown(wide):
        items = legend._replace(width=wide).items(entries, CATALOGUE)
        return [each.text for item in items for each in item.items if isinstance(each, Text)]

    assert name not in shown(legend.width)
    assert name in shown(2 * legend.width)


def test_supports_have_no_colour():
    """What is taken out again is of any colour in the legend, too."""
    [item] = Legend.of(1, 170.0).items([(Lot(0, 3, 2), (90, 200, 210))], CATALOGUE)
    texts = [each.text for each in item.items if isinstance(each, Text)]
    assert "any colour" in texts
    assert CATALOGUE.colours[3].name not in texts
