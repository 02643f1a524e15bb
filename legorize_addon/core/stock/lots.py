"""Which part and colour of the catalogue a row of a table means.

Shops number colours differently. Whose numbers a file has follows from the names
of its columns: ``Part`` and ``Color`` are Rebrickable's, ``ITEMID`` and ``Color ID``
beside it BrickLink's, ``colour`` is LDraw's code, as in our own ``parts.csv``.
A colour can also be a name.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

from ..errors import SettingsError
from ..model import Catalogue, Colour
from .tables import Row, column

_BRICKLINK_PARTS: Final = ("blitemno", "itemid", "itemno", "itemnumber", "bricklinkid", "bricklinkpart")
_OTHER_PARTS: Final = ("part", "partnum", "partnumber", "partno", "partid", "ldrawid", "designid", "number", "item")
_ELEMENTS: Final = ("elementid", "element", "elementnumber")
_COLOURS: Final = (
    ("ldrawcolorid", "code"), ("ldrawcolourid", "code"), ("ldrawcolor", "code"), ("colourcode", "code"),
    ("blcolorid", "bricklink"), ("bricklinkcolor", "bricklink"), ("bricklinkcolorid", "bricklink"),
    ("rebrickablecolor", "rebrickable"), ("colour", "code"), ("colourid", "code"),
    ("colorname", ""), ("colourname", ""), ("colorid", ""), ("color", ""),
)  # fmt: skip
"""Columns with the colour, and whose numbers they have; where that is empty, the column with the part tells."""

_TYPES: Final = ("itemtype", "itemtypeid")
"""Columns that tell parts from sets and minifigures."""

Lot = tuple[int, int]
"""Row of the part and row of the colour in the catalogue."""


class Lots(NamedTuple):
    """How to read the lot of a row."""

    of: Callable[[Row], Lot | None]


def lots(rows: list[Row], catalogue: Catalogue, path: str, setting: str) -> Lots:
    """Recognise the columns of a table.

    Parameters
    ----------
    rows : list of Row
        At least one.
    catalogue : Catalogue
    path, setting : str
        The file, and the setting that names it, for errors.

    Returns
    -------
    Lots
        Finds the lot of each row; None for parts and colours that are not in the catalogue.

    Raises
    ------
    SettingsError
        There is no column with a part, or none with a colour.
    """
    keys = {name: "" for row in rows for name in row}
    part = column(keys, (*_BRICKLINK_PARTS, *_OTHER_PARTS))
    element = column(keys, _ELEMENTS)
    colours = [(name, whose) for name, whose in _COLOURS if name in keys]
    if (part is None or not colours) and element is None:
        found = ", ".join(name for name in keys if name) or "none"
        wanted = "a part" if part is None else "a colour"
        raise SettingsError(
            f"{setting} is {path!r}, which has no column for {wanted} (its columns: {found}): "
            "name the columns part, colour and price or quantity."
        )
    usual = "bricklink" if part in _BRICKLINK_PARTS else "rebrickable"
    parts = {name: row for row, each in enumerate(catalogue.parts) for name in (each.number, *each.aliases)}
    numbers = {whose: _numbers(catalogue, whose) for whose in ("code", "bricklink", "rebrickable")}
    names = {_name(colour): row for row, colour in enumerate(catalogue.colours)}
    elements = _elements(catalogue)

    def of(row: Row) -> Lot | None:
        """Return the lot of a row."""
        if any(row.get(name, "P")[:1].upper() not in ("P", "") for name in _TYPES):
            return None
        if element is not None and row.get(element, "").isdecimal() and int(row[element]) in elements:
            return elements[int(row[element])]
        which = parts.get(row.get(part or "", "").strip().lower())
        if which is None:
            return None
        for name, whose in colours:
            text = row.get(name, "").strip()
            found = numbers[whose or usual].get(int(text)) if text.isdecimal() else names.get(_spelling(text))
            if found is not None:
                return which, found
        return None

    return Lots(of)


def _numbers(catalogue: Catalogue, whose: str) -> dict[int, int]:
    """Return the rows of the colours by somebody's numbers."""
    return {int(getattr(colour, whose)): row for row, colour in enumerate(catalogue.colours)}


def _elements(catalogue: Catalogue) -> dict[int, Lot]:
    """Return lots by LEGO's element numbers."""
    part, colour = catalogue.element.nonzero()
    return {int(catalogue.element[lot]): lot for lot in zip(part.tolist(), colour.tolist(), strict=True)}


def _name(colour: Colour) -> str:
    return _spelling(colour.name)


def _spelling(name: str) -> str:
    """Return a colour's name without differences of spelling."""
    return "".join(letter for letter in name.casefold().replace("grey", "gray") if letter.isalnum())
