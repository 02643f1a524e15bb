"""The list of lots beside a map: letter, picture, count, size and colour of each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from ..model import Catalogue
from .canvas import Item, Text, moved
from .fonts import shortened
from .lots import GREY, Lot, picture_of, placed
from .picture import MM

_COLUMN: Final = 66.0
"""mm of a column."""

_ROW: Final = 13.0
_LEAST_ROW: Final = 6.5
"""mm of a lot, where there is room, and at least."""


def lettered(number: int) -> str:
    """Return the letters of a row: A to Z, AA to AZ, and so on."""
    text = ""
    number += 1
    while number:
        number, rest = divmod(number - 1, 26)
        text = chr(ord("A") + rest) + text
    return text


class Legend(NamedTuple):
    """The lots of a layer in columns.

    Attributes
    ----------
    rows : int
        Lots in a column.
    row : float
        mm of a lot.
    width : float
        mm of all columns.
    """

    rows: int
    row: float
    width: float

    @classmethod
    def of(cls, lots: int, room: float) -> Legend:
        """Return the legend of some lots for a height in mm."""
        most = int(room / _LEAST_ROW)
        columns = max(1, -(-lots // most))
        rows = max(1, -(-lots // columns))
        return cls(rows, min(_ROW, room / rows), columns * _COLUMN)

    def items(self, lots: Sequence[Lot], catalogue: Catalogue) -> Iterator[Item]:
        """Yield the callouts: letter, picture, count, size and colour."""
        for number, lot in enumerate(lots):
            column, row = divmod(number, self.rows)
            yield moved(tuple(_callout(lettered(number), lot, catalogue, self.row)), column * _COLUMN, row * self.row)


def _callout(letters: str, lot: Lot, catalogue: Catalogue, row: float) -> Iterator[Item]:
    picture = picture_of(lot, catalogue)
    box = 17.0, row - 1.2
    scale = min(0.42, *(room / (size * MM) for room, size in zip(box, picture.size.tolist(), strict=True)))
    wide, high = (picture.size * MM * scale).tolist()
    middle = row / 2
    part, colour = catalogue.parts[lot.part], catalogue.colours[lot.colour]
    yield Text(letters, 5, middle + 1.1, 3, bold=True, anchor="end")
    yield placed(picture, 6.5 + (box[0] - wide) / 2, middle - high / 2, scale)
    yield Text(f"{lot.count}x", 34, middle + 1.4, 4, bold=True, anchor="end")
    title = part.title.removeprefix("Brick ") if part.height > 1 else part.title
    if row < 9:
        yield Text(shortened(f"{title}, {colour.name}", 2.6, _COLUMN - 36), 35.5, middle + 1, 2.6, colour=GREY)
        return
    yield Text(part.title, 35.5, middle - 0.4, 2.8)
    yield Text(shortened(colour.name, 2.8, _COLUMN - 36), 35.5, middle + 3.2, 2.8, colour=GREY)
