"""What parts cost, from a user's price file: own tables, price guides and the inventories of stores."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Mask
from ..errors import SettingsError
from ..model import Bricks, Catalogue
from .amounts import amount, currency
from .lots import lots
from .tables import Row, column, read_table

_PRICES: Final = (
    "qtyavgprice", "quantityaverageprice", "avgprice", "averageprice", "price", "unitprice", "priceeach",
    "priceperunit", "pricepc", "myprice", "cost", "saleprice", "minprice", "maxprice",
)  # fmt: skip
"""Columns with the price of one part: the mean of what was sold comes before what one seller asks."""

_CURRENCIES: Final = ("currency", "currencycode", "basecurrency")
_BEGINNINGS: Final = ("price", "unitprice", "avgprice", "qtyavgprice", "averageprice")
"""Beginnings of columns such as "Price (EUR)"."""


@dataclass(frozen=True, slots=True, eq=False)
class Prices:
    """What each part costs in each colour.

    Attributes
    ----------
    price : (n_parts, n_colours) float64 array
        Of one part: the lowest that the file states, or an estimate.
    stated : (n_parts, n_colours) bool array
        Whether the file states it.
    currency : str
        Code of the currency; empty if the file does not say.
    unknown : int
        Rows of the file whose part or colour is not in the catalogue.
    """

    price: Floats
    stated: Mask
    currency: str
    unknown: int

    def each(self, bricks: Bricks, catalogue: Catalogue) -> Floats:
        """Return the price of each of some bricks, (n,)."""
        return self.price[bricks.part, catalogue.colour_rows(bricks.colour)]

    def known(self, bricks: Bricks, catalogue: Catalogue) -> Mask:
        """Return for which of some bricks the file has a price, (n,)."""
        return self.stated[bricks.part, catalogue.colour_rows(bricks.colour)]

    def money(self, value: float) -> str:
        """Return an amount in words."""
        return f"{value:,.2f} {self.currency}".rstrip()


def read_prices(path: str, catalogue: Catalogue) -> Prices:
    """Read a price file.

    Parameters
    ----------
    path : str
        CSV or XML.
    catalogue : Catalogue

    Returns
    -------
    Prices
        Where a lot has several rows, the lowest price counts. A lot without a row gets an estimate: the median price of
        the same part in other colours or, where no colour of the part has a price, its mass at the median price of a
        gram.

    Raises
    ------
    SettingsError
        The file cannot be read, or has no column of parts, colours or prices, prices in two currencies, or no price
        of a part of the catalogue.
    """
    rows = read_table(path, "prices")
    priced = _price_column(rows, path)
    found, price, unknown = lots(rows, catalogue, path, "prices"), np.full(catalogue.exists.shape, np.inf), 0
    codes = Counter[str]()
    for row in rows:
        lot, value = found.of(row), amount(row.get(priced, ""))
        if lot is None:
            unknown += 1
        elif value is not None:
            price[lot] = min(price[lot], value)
            codes[_currency(row, priced)] += 1
    stated = np.isfinite(price)
    if not stated.any():
        raise SettingsError(
            f"prices is {path!r}, which has no price of any of the {len(catalogue.parts)} parts: "
            "give a file with the columns part, colour and price."
        )
    named = sorted(code for code in codes if code)
    if len(named) > 1:
        raise SettingsError(f"prices is {path!r}, which has prices in {' and '.join(named)}: leave one currency in it.")
    return Prices(_estimated(price, stated, catalogue), stated, named[0] if named else "", unknown)


def _price_column(rows: list[Row], path: str) -> str:
    """Return the column with the prices."""
    keys = {name: "" for row in rows for name in row}
    longer = tuple(sorted(name for name in keys if name.startswith(_BEGINNINGS)))
    name = column(keys, (*_PRICES, *longer))
    if name is None:
        raise SettingsError(
            f"prices is {path!r}, which has no column for a price (its columns: {', '.join(filter(None, keys))}): "
            "name it price."
        )
    return name


def _currency(row: Row, priced: str) -> str:
    """Return the currency of a row: a column of its own, beside the number, or in the name of the column."""
    own = column(row, _CURRENCIES)
    stated = row[own].upper() if own else ""
    code = currency(stated) or currency(row[priced])
    tail = priced.removeprefix("qty").removeprefix("avg").removeprefix("unit").removeprefix("price")
    return code or (tail.upper() if len(tail) == 3 and tail.isalpha() and tail not in ("per",) else "")


def _estimated(price: Floats, stated: Mask, catalogue: Catalogue) -> Floats:
    """Return prices of all lots."""
    by_gram = np.median((price / catalogue.mass[:, None])[stated])
    usual = np.array(
        [
            np.median(of_part[known]) if known.any() else by_gram * mass
            for of_part, known, mass in zip(price, stated, catalogue.mass, strict=True)
        ]
    )
    return np.where(stated, price, usual[:, None])
