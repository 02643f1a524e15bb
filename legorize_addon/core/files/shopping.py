"""Which parts to buy: counts, weights, and the lists that shops can read.

References
----------
BrickLink help, "Upload XML": a wanted list is an ``INVENTORY`` of ``ITEM`` with
``ITEMTYPE``, ``ITEMID``, ``COLOR`` and ``MINQTY``, without an XML declaration.
"""

from __future__ import annotations

from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..model import Assembly, Catalogue, Colour, Part
from ..safe_text import csv_text


@dataclass(frozen=True, slots=True, eq=False)
class PartsList:
    """How many of each part in each colour, by part row, then colour row.

    Attributes
    ----------
    part : (n,) int64 array
        Row of the part in the catalogue.
    colour : (n,) int64 array
        Row of the colour in the catalogue, not the LDraw code.
    count : (n,) int64 array
        Bricks, at least one.
    """

    part: NDArray[np.int64]
    colour: NDArray[np.int64]
    count: NDArray[np.int64]

    def __len__(self) -> int:
        """Return the number of different pairs of part and colour."""
        return len(self.part)

    def take(self, rows: Mask) -> PartsList:
        """Return the pairs that a mask picks."""
        return PartsList(self.part[rows], self.colour[rows], self.count[rows])

    def entries(self, catalogue: Catalogue) -> list[tuple[Part, Colour, int]]:
        """Return part, colour and count of each pair."""
        rows = zip(self.part.tolist(), self.colour.tolist(), self.count.tolist(), strict=True)
        return [(catalogue.parts[part], catalogue.colours[colour], count) for part, colour, count in rows]


def count_parts(assembly: Assembly) -> PartsList:
    """Count the bricks of each part in each colour.

    Parameters
    ----------
    assembly : Assembly
        What is to be bought.

    Returns
    -------
    PartsList
        Pairs that occur, by part row, then colour row.

    Raises
    ------
    BuildError
        A brick has a colour that is not in the catalogue.
    """
    codes, column = np.unique(assembly.bricks.colour, return_inverse=True)
    colours = np.array([assembly.catalogue.colour_row(int(code)) for code in codes], np.int64)
    pairs = assembly.bricks.part.astype(np.int64) * len(assembly.catalogue.colours) + colours[column]
    pair, count = np.unique(pairs, return_counts=True)
    part, colour = np.divmod(pair, len(assembly.catalogue.colours))
    return PartsList(part, colour, count.astype(np.int64))


def masses(parts: PartsList, catalogue: Catalogue) -> Floats:
    """Return the mass of all bricks of each pair in grams, shape (n,)."""
    return np.asarray(catalogue.mass[parts.part] * parts.count)


def not_made(parts: PartsList, catalogue: Catalogue) -> PartsList:
    """Return the pairs of which the part was never made in the colour."""
    return parts.take(~catalogue.exists[parts.part, parts.colour])


def parts_csv(parts: PartsList, catalogue: Catalogue) -> str:
    """Return the parts list for people: one line a pair with names, count, mass in grams and element number."""
    grams = masses(parts, catalogue).tolist()
    elements = catalogue.element[parts.part, parts.colour].tolist()
    rows = [
        (part.number, part.title, colour.code, colour.name, count, f"{mass:.2f}", element or "")
        for (part, colour, count), mass, element in zip(parts.entries(catalogue), grams, elements, strict=True)
    ]
    return csv_text(("part", "title", "colour", "colour_name", "count", "mass_g", "element"), rows)


def bricklink_xml(parts: PartsList, catalogue: Catalogue) -> str:
    """Return a BrickLink wanted list: new or used, no notification."""
    inventory = ElementTree.Element("INVENTORY")
    for part, colour, count in parts.entries(catalogue):
        item = ElementTree.SubElement(inventory, "ITEM")
        fields = {"ITEMTYPE": "P", "ITEMID": part.number, "COLOR": colour.bricklink, "MINQTY": count}
        for tag, value in {**fields, "CONDITION": "X", "NOTIFY": "N"}.items():
            ElementTree.SubElement(item, tag).text = str(value)
    # one field a line; "unicode" leaves out the declaration, which BrickLink does not take
    ElementTree.indent(inventory, "")
    return ElementTree.tostring(inventory, encoding="unicode") + "\n"


def rebrickable_csv(parts: PartsList, catalogue: Catalogue) -> str:
    """Return the parts list that Rebrickable imports."""
    rows = [(part.number, colour.rebrickable, count) for part, colour, count in parts.entries(catalogue)]
    return csv_text(("Part", "Color", "Quantity"), rows)


def pick_a_brick_csv(parts: PartsList, catalogue: Catalogue) -> tuple[str, PartsList]:
    """Write the list that LEGO's Pick a Brick imports.

    Parameters
    ----------
    parts : PartsList
        What is to be bought.
    catalogue : Catalogue
        Its element numbers.

    Returns
    -------
    text : str
        Element numbers and counts.
    left_out : PartsList
        Pairs whose element number is not known; they must be bought elsewhere.
    """
    # the shop cannot read a line without a number, so the caller must report what is missing
    element = catalogue.element[parts.part, parts.colour]
    known = element != 0
    rows = zip(element[known].tolist(), parts.count[known].tolist(), strict=True)
    return csv_text(("elementId", "quantity"), rows), parts.take(~known)
