"""Texts of lists: a function for each format.

References
----------
BrickLink help, "Upload XML": a wanted list is an ``INVENTORY`` of ``ITEM`` with
``ITEMTYPE``, ``ITEMID``, ``COLOR`` and ``MINQTY``, without an XML declaration.
BrickLink Studio, parts list as it exports it: the columns of :func:`studio_csv`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final
from xml.etree import ElementTree

from ..safe_text import csv_text, one_line
from .lots import Lot
from .shopping_list import ShoppingList

MOST_A_LINE: Final = 999
"""Bricks that Pick a Brick takes in one line of an order, as programs that write its lists say; the rest needs
another line."""

REMARKS_LENGTH: Final = 200
"""Letters of a title in BrickLink's remarks, which have room for 255."""

SECONDS_A_MINUTE: Final = 60


def plain_csv(wanted: ShoppingList) -> str:
    """Return the list for people: a line for each lot, with names, mass in grams and, if known, price."""
    columns = (
        "part", "title", "colour", "colour_name", "count", "mass_g", "element", "second_element", "price", "cost",
    )  # fmt: skip
    rows = [
        (
            lot.part.number, lot.part.title, lot.colour.code, lot.colour.name, lot.count, f"{lot.mass:.2f}",
            lot.element or "", lot.second_element or "", money(lot.price), money(lot.cost),
        )
        for lot in wanted.lots
    ]  # fmt: skip
    return csv_text(columns, rows)


def bricklink_xml(wanted: ShoppingList) -> str:
    """Return a BrickLink wanted list: new or used, no notification, a spare one of each 1 x 1.

    The remarks say how many of the bricks are for the model, and how many are
    spare.
    """
    inventory = ElementTree.Element("INVENTORY")
    title = one_line(wanted.title)[:REMARKS_LENGTH]
    for lot in wanted.lots:
        extra = spare(lot)
        item = ElementTree.SubElement(inventory, "ITEM")
        fields = {
            "ITEMTYPE": "P",
            "ITEMID": lot.part.number,
            "COLOR": lot.colour.bricklink,
            "MINQTY": lot.count + extra,
            "CONDITION": "X",
            "REMARKS": f"{title}: {lot.count}" + (f", {extra} spare" if extra else ""),
            "NOTIFY": "N",
        }
        for tag, value in fields.items():
            ElementTree.SubElement(item, tag).text = str(value)
    # one field a line; "unicode" leaves out the declaration, which BrickLink does not take
    ElementTree.indent(inventory, "")
    return ElementTree.tostring(inventory, encoding="unicode") + "\n"


def spare(lot: Lot) -> int:
    """Return how many bricks to buy more than the model needs: one of what is small enough to be lost, 1 x 1."""
    return int(lot.part.length == lot.part.width == 1 and lot.part.height <= 3)


def rebrickable_csv(wanted: ShoppingList) -> str:
    """Return the parts list that Rebrickable imports."""
    rows = [(lot.part.number, lot.colour.rebrickable, lot.count) for lot in wanted.lots]
    return csv_text(("Part", "Color", "Quantity"), rows)


def any_lot(lot: Lot) -> bool:
    """Tell that a format can list whatever is built."""
    return lot.count > 0


def has_element(lot: Lot) -> bool:
    """Tell whether LEGO's number of a lot is known, without which its shop cannot read a line."""
    return lot.element != 0


def pick_a_brick_csv(wanted: ShoppingList) -> str:
    """Return the list that LEGO's Pick a Brick imports: newest element numbers, and what to try if one is sold out.

    Lots whose number is not known are left out. What is more than a line may
    order goes on in further lines.
    """
    rows = [
        (lot.element, count, lot.second_element or "")
        for lot in wanted.lots
        if has_element(lot)
        for count in shares(lot.count, MOST_A_LINE)
    ]
    return csv_text(("elementId", "quantity", "secondElementId"), rows)


def shares(count: int, most: int) -> Iterator[int]:
    """Yield a number in shares, none greater than the most."""
    for begin in range(0, count, most):
        yield min(most, count - begin)


def studio_csv(wanted: ShoppingList) -> str:
    """Return a list with the columns of BrickLink Studio's own; the weight is that of one brick in grams."""
    columns = (
        "BLItemNo", "ElementId", "LdrawId", "PartName", "BLColorId", "LDrawColorId", "ColorName", "ColorCategory",
        "Qty", "Weight",
    )  # fmt: skip
    rows = [
        (
            lot.part.number, lot.element or "", lot.part.number, lot.part.title, lot.colour.bricklink, lot.colour.code,
            lot.colour.name, "Solid Colors", lot.count, lot.part.mass,
        )
        for lot in wanted.lots
    ]  # fmt: skip
    return csv_text(columns, rows)


def totals_csv(wanted: ShoppingList) -> str:
    """Return the figures of the model, one a line: bricks, lots, mass, size, building time and, if known, price."""
    (x, y), cm = wanted.studs, wanted.cm
    rows: list[tuple[str, object, str]] = [
        ("bricks", wanted.count, ""),
        ("lots", len(wanted.lots), ""),
        ("parts", len({lot.part.number for lot in wanted.lots}), ""),
        ("colours", len({lot.colour.code for lot in wanted.lots}), ""),
        ("mass", f"{wanted.mass:.2f}", "g"),
        ("studs_x", x, "studs"),
        ("studs_y", y, "studs"),
        ("plates", wanted.plates, "plates"),
        *((f"size_{axis}", f"{length:.1f}", "cm") for axis, length in zip("xyz", cm, strict=True)),
        ("building_time", f"{wanted.seconds / SECONDS_A_MINUTE:.0f}", "min"),
    ]
    if wanted.cost is not None:
        rows += [("price", money(wanted.cost), ""), ("bricks_without_price", wanted.unpriced, "")]
    return csv_text(("figure", "value", "unit"), rows)


def money(amount: float | None) -> str:
    """Return a price with four digits after the point, since bricks cost a few hundredths; "" if it is not known."""
    return "" if amount is None else f"{amount:.4f}"
