"""Price files: what they state, what is estimated, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.stock.prices import read_prices
from tests.core.any_bricks import CATALOGUE, table

BRICK, PLATE = CATALOGUE.part_row("3001"), CATALOGUE.part_row("3020")
RED, WHITE, BLUE = (CATALOGUE.colour_row(code) for code in (4, 15, 1))


@pytest.fixture
def read(tmp_path):
    """Return a function that reads a price file with some text."""

    def reading(text, name="prices.csv"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        return read_prices(str(tmp_path / name), CATALOGUE)

    return reading


def test_stated_prices_and_estimates(read):
    """Other colours of a part cost its median, other parts their mass at the median price of a gram."""
    found = read("part,colour,price\n3001,4,0.10\n3001,15,0.20\n3001,1,0.60\n")
    assert found.price[BRICK, [RED, WHITE, BLUE]].tolist() == [0.1, 0.2, 0.6]
    assert found.stated.sum() == 3
    assert found.price[BRICK, CATALOGUE.colour_row(0)] == pytest.approx(0.2)
    gram = 0.2 / CATALOGUE.mass[BRICK]
    np.testing.assert_allclose(found.price[PLATE], gram * CATALOGUE.mass[PLATE])
    assert np.isfinite(found.price).all()


@pytest.mark.parametrize(
    "text",
    [
        "part;colour;price\n3001;4;0,10 €\n",
        "Item No\tColor ID\tColor\tQty Avg Price\tMin Price\tCurrency\n3001\t5\tRed\t0.10\t0.01\tEUR\n",
        "part,colour,price (EUR)\n3001,4,0.1\n",
        "BLItemNo,BLColorId,Price\n3001,5,EUR 0.1\n",
        '<BrickStoreXML><Inventory Currency="EUR"><Item><ItemID>3001</ItemID><ItemTypeID>P</ItemTypeID>'
        "<ColorID>5</ColorID><Qty>7</Qty><Price>0.1</Price></Item></Inventory></BrickStoreXML>",
        "<INVENTORY><ITEM><ITEMTYPE>P</ITEMTYPE><ITEMID>3001</ITEMID><COLOR>5</COLOR><PRICE>0.1</PRICE><QTY>3</QTY>"
        "<CURRENCY>EUR</CURRENCY></ITEM></INVENTORY>",
    ],
)
def test_files_of_other_programs(read, text):
    """Own tables, price guides and stores say the same: a red 2 x 4 for ten cents."""
    found = read(text)
    assert (found.price[BRICK, RED], found.currency, found.stated.sum()) == (0.1, "EUR", 1)


def test_the_lowest_of_several_prices(read):
    """A store has the same lot new and used; rows that cannot be used are counted."""
    found = read("part,colour,price\n3001,4,0.3\n3001,4,0.1\n3001,4,0.2\n9999,4,0.1\n3001,4,\n")
    assert (found.price[BRICK, RED], found.unknown) == (0.1, 1)


def test_bricks_are_priced(read):
    """Each brick has the price of its lot, and says whether it is an estimate."""
    found = read("part,colour,price\n3001,4,0.10 EUR\n")
    bricks = table([(BRICK, 0, 0, 0, 0, 4, 0, 0, 0), (BRICK, 4, 0, 0, 0, 15, 0, 0, 0)])
    assert found.each(bricks, CATALOGUE).tolist() == [0.1, 0.1]
    assert found.known(bricks, CATALOGUE).tolist() == [True, False]
    assert found.money(1234.5) == "1,234.50 EUR"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("part,colour\n3001,4\n", "no column for a price"),
        ("part,colour,price\n9999,4,0.1\n", "no price of any"),
        ("part,colour,price\n3001,4,free\n", "no price of any"),
        ("part,colour,price\n3001,4,0.1 EUR\n3002,4,$0.1\n", "prices in EUR and USD"),
    ],
)
def test_bad_files_get_one_sentence(read, text, words):
    """What is wrong and what to do."""
    with pytest.raises(SettingsError, match=rf"^prices is .*{words}.*: .*\.$"):
        read(text)
