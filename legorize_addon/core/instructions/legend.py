"""The list of lots beside a map: letter, picture, count, size and colour of each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from ..model import Catalogue
from .canvas import Item, Rgb, Text, moved
from .fonts import shortened
from .lots import ANY, GREY, Entry, Lot, picture_of, placed
from .picture import MM

_COLUMN: Final = 66.0
"""mm of a column at least."""

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
    columns : int
    width : float
        mm of all columns.
    """

    rows: int
    row: float
    columns: int
    width: float

    @classmethod
    def of(cls, lots: int, room: float) -> Legend:
        """Return the legend of some lots for a height in mm."""
        most = int(room / _LEAST_ROW)
        columns = max(1, -(-lots // most))
        rows = max(1, -(-lots // columns))
        return cls(rows, min(_ROW, room / rows), columns, columns * _COLUMN)

    def items(self, entries: Sequence[Entry], catalogue: Catalogue) -> Iterator[Item]:
        """Yield the callouts: letter, picture, count, size and colour; supports are of any colour."""
        wide = self.width / self.columns
        for number, (lot, tint) in enumerate(entries):
            column, row = divmod(number, self.rows)
            shown = tuple(_callout(lettered(number), lot, tint, catalogue, (wide, self.row)))
            yield moved(shown, column * wide, row * self.row)


def _callout(
    letters: str, lot: Lot, tint: Rgb | None, catalogue: Catalogue, size: tuple[float, float]
) -> Iterator[Item]:
    wide, row = size
    picture = picture_of(lot, catalogue, tint)
    box = 17.0, row - 1.2
    scale = min(0.42, *(room / (length * MM) for room, length in zip(box, picture.size.tolist(), strict=True)))
    across, high = (picture.size * MM * scale).tolist()
    middle = row / 2
    part, colour = catalogue.parts[lot.part], ANY if tint else catalogue.colours[lot.colour].name
    yield Text(letters, 5, middle + 1.1, 3, bold=True, anchor="end")
    yield placed(picture, 6.5 + (box[0] - across) / 2, middle - high / 2, scale)
    yield Text(f"{lot.count}x", 34, middle + 1.4, 4, bold=True, anchor="end")
    title = part.title.removeprefix("Brick ") if part.height > 1 else part.title
    if row < 9:
        yield Text(shortened(f"{title}, {colour}", 2.6, wide - 36), 35.5, middle + 1, 2.6, colour=GREY)
        return
    yield Text(part.title, 35.5, middle - 0.4, 2.8)
    yield Text(shortened(colour, 2.8, wide - 36), 35.5, middle + 3.2, 2.8, colour=GREY)
