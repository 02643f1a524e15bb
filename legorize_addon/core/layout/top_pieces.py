"""How the top of a brick is made smooth: cut into tiles where its studs are free, and plates where they hold others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model import Catalogue, Part
from ..units import PLATES_PER_BRICK

NONE: Final = 0
HOLDS: Final = 1
HIDDEN: Final = 2
SEEN: Final = 3
"""What a stud of a brick is: there is none; something lies on it; free, but nobody sees it; free and seen."""

Box = tuple[int, int, int, int]
"""First and last column, first and last row of some studs, the last ones exclusive."""


class Piece(NamedTuple):
    """A part in the place of a brick, or of some of it.

    Attributes
    ----------
    part : int
        Row in the catalogue.
    corner : (int, int, int)
        From that of the brick: x and y in studs, z in plates.
    turn : int
    """

    part: int
    corner: tuple[int, int, int]
    turn: int


@dataclass(frozen=True, slots=True)
class Cut:
    """The cheapest way to cover some studs.

    Attributes
    ----------
    cost : float
        In studs: those that stay in sight, and the price of each part.
    pieces : tuple of Piece
    """

    cost: float
    pieces: tuple[Piece, ...]

    def beside(self, other: Cut) -> Cut:
        """Return both together."""
        return Cut(self.cost + other.cost, self.pieces + other.pieces)


class Tops:
    """Finds what bricks are exchanged for.

    Parameters
    ----------
    catalogue : Catalogue
        Parts that may be laid.
    price : float
        Studs that a part more has to take out of sight; no more than that is not worth it. Infinite if there may be no
        more parts.
    """

    def __init__(self, catalogue: Catalogue, price: float) -> None:
        self._catalogue = catalogue
        self._price = min(price, _MANY)
        parts = list(enumerate(catalogue.parts))
        self._tiles = {_size(part): row for row, part in parts if part.profile == "tile"}
        studded = [(row, part) for row, part in parts if part.use == "model" and part.profile in ("box", "corner")]
        self._plates, self._bricks = (
            {_size(part): row for row, part in studded if part.height == height} for height in (1, PLATES_PER_BRICK)
        )
        self.rows = np.array([row for row, _ in studded])
        """Rows of the parts that can be exchanged."""
        self._known: dict[tuple[int, int, int, bytes], tuple[Piece, ...]] = {}

    def pieces(self, part: int, turn: int, colour: int, studs: NDArray[np.uint8]) -> tuple[Piece, ...]:
        """Return what a brick is exchanged for, from below; nothing if it stays.

        Parameters
        ----------
        part, turn, colour : int
        studs : (wide, deep) uint8 array
            What each stud in its bounding box is.

        Returns
        -------
        tuple of Piece
            They fill the same cells in the same colour. No tile lies where a stud holds something.
        """
        key = (part, turn, colour, studs.tobytes())
        if key not in self._known:
            self._known[key] = self._found(part, turn, colour, studs)
        return self._known[key]

    def _found(self, part: int, turn: int, colour: int, studs: NDArray[np.uint8]) -> tuple[Piece, ...]:
        whole = self._catalogue.parts[part]
        body = self._body(whole, turn)
        if not self._made([each.part for each in body], colour):
            return ()
        cut = self._cut((0, studs.shape[0], 0, studs.shape[1]), colour, studs, {})
        if cut is None or cut.cost + len(body) * self._price >= self._price + np.count_nonzero(studs == SEEN):
            return ()
        raised = whole.height - 1
        top = (each._replace(corner=(*each.corner[:2], raised)) for each in cut.pieces)
        return (*body, *top)

    def _body(self, whole: Part, turn: int) -> tuple[Piece, ...]:
        """Return what lies below the top plate of a brick: bricks, then plates, of its outline."""
        bricks, plates = divmod(whole.height - 1, PLATES_PER_BRICK)
        size, level = _size(whole), 0
        found = []
        for row, height, count in ((self._bricks, PLATES_PER_BRICK, bricks), (self._plates, 1, plates)):
            for _ in range(count):
                found.append(Piece(row.get(size, -1), (0, 0, level), turn))
                level += height
        return tuple(found)

    def _made(self, rows: list[int], colour: int) -> bool:
        return all(row >= 0 and bool(self._catalogue.exists_in(row, colour)) for row in rows)

    def _cut(self, box: Box, colour: int, studs: NDArray[np.uint8], known: dict[Box, Cut | None]) -> Cut | None:
        """Return the cheapest way to cover a box, of the fewest pieces; None if there is none."""
        if box not in known:
            ways = [self._whole(box, colour, studs)]
            for first, second in _halves(box):
                low, high = (self._cut(half, colour, studs, known) for half in (first, second))
                ways.append(low.beside(high) if low and high else None)
            # the first of equals
            known[box] = min(filter(None, ways), key=lambda way: (way.cost, len(way.pieces)), default=None)
        return known[box]

    def _whole(self, box: Box, colour: int, studs: NDArray[np.uint8]) -> Cut | None:
        """Cover a box by one piece, if there is one."""
        x0, x1, y0, y1 = box
        inside = studs[x0:x1, y0:y1]
        if not inside.any():
            return Cut(0.0, ())
        wide, deep = inside.shape
        kind = self._plates if (inside == HOLDS).any() else self._tiles
        row = kind.get((max(wide, deep), min(wide, deep), "box"), -1)
        if kind is self._tiles and not self._made([row], colour):
            kind, row = self._plates, self._plates.get((max(wide, deep), min(wide, deep), "box"), -1)
        if (inside == NONE).any() or not self._made([row], colour):
            return None
        left = np.count_nonzero(inside == SEEN) if kind is self._plates else 0
        return Cut(self._price + left, (Piece(row, (x0, y0, 0), int(deep > wide)),))


_MANY: Final = 1e6
"""More studs than any brick has."""


def _size(part: Part) -> tuple[int, int, str]:
    """Return what tells the outlines of parts apart."""
    return part.length, part.width, "corner" if part.corner else "box"


def _halves(box: Box) -> list[tuple[Box, Box]]:
    """Cut a box in two in every way."""
    x0, x1, y0, y1 = box
    return [
        *(((x0, x, y0, y1), (x, x1, y0, y1)) for x in range(x0 + 1, x1)),
        *(((x0, x1, y0, y), (x0, x1, y, y1)) for y in range(y0 + 1, y1)),
    ]
