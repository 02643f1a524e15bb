"""Bricks of one part and colour: how many, and the small picture by which a builder finds them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import Bricks, Catalogue, Part
from .canvas import Item, Rgb, Text, moved
from .fonts import width
from .lattice import FRONT, Cells, look
from .picture import MM, Look, Picture
from .shades import mixed, tinted
from .slopes import draw_all

GREY: Final[Rgb] = (96, 98, 104)


@dataclass(frozen=True, slots=True)
class Lot:
    """Bricks of one part in one colour.

    Attributes
    ----------
    part : int
        Row of the part in the catalogue.
    colour : int
        Row of the colour.
    count : int
        Bricks.
    """

    part: int
    colour: int
    count: int


def lots_of(bricks: Bricks, catalogue: Catalogue) -> tuple[tuple[Lot, ...], Ints]:
    """Sort bricks into lots.

    Parameters
    ----------
    bricks : Bricks
        n rows.
    catalogue : Catalogue

    Returns
    -------
    lots : tuple of Lot
        By colour, of each the greatest parts first.
    lot : (n,) int64 array
        Row of each brick's lot.
    """
    colour = np.searchsorted(catalogue.codes, bricks.colour).astype(np.int64)
    studs = np.array([part.length * part.width * 16 + part.height for part in catalogue.parts])
    rank = np.lexsort((np.arange(len(studs)), -studs))
    place = np.argsort(rank)
    keys, lot, count = np.unique(colour * len(studs) + place[bricks.part], return_inverse=True, return_counts=True)
    row, place = np.divmod(keys, len(studs))
    found = zip(rank[place].tolist(), row.tolist(), count.tolist(), strict=True)
    return tuple(Lot(*each) for each in found), lot.reshape(-1).astype(np.int64)


Entry = tuple[Lot, Rgb | None]
"""A lot of a list; those of supports have a tint."""

ANY: Final = "any colour"
"""Colour of supports in lists."""


def entries_of(bricks: Bricks, catalogue: Catalogue, support: Mask, tint: Rgb) -> tuple[tuple[Entry, ...], Ints]:
    """Sort bricks into lots for a list, the supports last: they are of any colour, so those of one part are one lot.

    Parameters
    ----------
    bricks : Bricks
        n rows.
    catalogue : Catalogue
    support : (n,) bool array
        Bricks that are taken out again.
    tint : tuple of three int

    Returns
    -------
    entries : tuple of Entry
    lot : (n,) int64 array
        Row of each brick's entry.
    """
    found: list[Entry] = []
    row = np.empty(len(bricks), dtype=np.int64)
    for rows, colour in ((~support, None), (support, tint)):
        some = bricks.take(rows)
        if colour is not None:
            some = replace(some, colour=np.full_like(some.colour, some.colour.max(initial=0)))
        lots, lot = lots_of(some, catalogue)
        row[rows] = len(found) + lot
        found += [(each, colour) for each in lots]
    return tuple(found), row


def rgb_of(bricks: Bricks, catalogue: Catalogue) -> Ints:
    """Return the colours of bricks in sRGB bytes, (n, 3)."""
    return catalogue.rgb[np.searchsorted(catalogue.codes, bricks.colour)].astype(np.int64)


def shown_rgb(bricks: Bricks, catalogue: Catalogue, temporary: Mask, tint: Rgb) -> Ints:
    """Return the colours in which bricks are drawn, (n, 3) bytes: their own, those of supports tinted."""
    colour = rgb_of(bricks, catalogue)
    colour[temporary] = np.array(
        [tinted((red, green, blue), tint) for red, green, blue in colour[temporary].tolist()], dtype=np.int64
    ).reshape(-1, 3)
    return colour


def size_of(part: Part) -> str:
    """Return the size of a part in studs, and its height if that is not usual, as "2 x 4"; slopes along their fall."""
    text = f"{part.length} x {part.width}" if part.shaped else f"{part.width} x {part.length}"
    if part.height == 2:
        return f"{text} x 2/3"
    return f"{text} x {part.height // 3}" if part.height > 3 else text


def picture_of(lot: Lot, catalogue: Catalogue, tint: Rgb | None = None) -> Picture:
    """Return the picture of a brick of a lot; with a tint that of a support."""
    rgb = catalogue.colours[lot.colour].rgb
    return _picture(lot.part, rgb if tint is None else tinted(rgb, tint), catalogue)


@lru_cache(maxsize=1024)
def _picture(part: int, rgb: Rgb, catalogue: Catalogue) -> Picture:
    one = Bricks(
        np.array([part], np.int16), np.zeros((1, 3), np.int32), np.zeros(1, np.uint8), np.zeros(1, np.int16),
        np.zeros(1, np.uint8), np.zeros(1, np.int16), np.zeros(1, np.int32),
    )  # fmt: skip
    colour, new = np.array([rgb], dtype=np.int64), np.ones(1, dtype=bool)
    return draw_all(look(Cells.of(one, catalogue, FRONT), 1), Look(colour, new, smooth=~catalogue.studs[one.part]))


def placed(picture: Picture, x: float, y: float, scale: float) -> Item:
    """Return a picture with its upper left corner at a point, a mm of the model as `scale` mm."""
    unit = scale * MM
    return moved(picture.items, x - picture.low[0] * unit, y - picture.low[1] * unit, unit)


@dataclass(frozen=True, slots=True, eq=False)
class Callout:
    """A row of lots: pictures with the number and the size of each.

    Attributes
    ----------
    items : tuple of Item
        From (0, 0) on.
    width, height : float
        In mm.
    """

    items: tuple[Item, ...]
    width: float
    height: float


def callout(lots: Sequence[tuple[Lot, Rgb | None]], catalogue: Catalogue, *, room: float, scale: float) -> Callout:
    """Lay out lots in rows.

    Parameters
    ----------
    lots : sequence of (Lot, tint or None)
        Supports have a tint.
    catalogue : Catalogue
    room : float
        Greatest width in mm.
    scale : float
        mm for a mm of the parts.

    Returns
    -------
    Callout
        A wide part has a row for itself if need be.
    """
    items: list[Item] = []
    row: list[Callout] = []
    top = right = 0.0
    for lot, tint in lots:
        one = _entry(lot, tint, catalogue, scale)
        if row and sum(each.width + _GAP for each in row) + one.width > room:
            items += _row(row, top)
            top, row = top + max(each.height for each in row) + _GAP / 2, []
        row.append(one)
        right = max(right, sum(each.width + _GAP for each in row) - _GAP)
    return Callout((*items, *_row(row, top)), right, top + max((each.height for each in row), default=0.0))


def _row(entries: Sequence[Callout], top: float) -> Iterator[Item]:
    """Yield entries side by side, on one base line."""
    x, height = 0.0, max((each.height for each in entries), default=0.0)
    for each in entries:
        yield moved(each.items, x, top + height - each.height)
        x += each.width + _GAP


_WIDEST: Final = 40.0
"""mm of a picture at most: baseplates are drawn smaller than their neighbours."""

_GAP: Final = 3.5
_LETTERS: Final = 3.6
_SMALL: Final = 2.5


def _entry(lot: Lot, tint: Rgb | None, catalogue: Catalogue, scale: float) -> Callout:
    picture = picture_of(lot, catalogue, tint)
    scale = min(scale, _WIDEST / (picture.size[0] * MM))
    wide, high = picture.size * scale * MM
    count, size = f"{lot.count}x", size_of(catalogue.parts[lot.part])
    step = width(count, _LETTERS, bold=True) + 1.2
    base = high + _LETTERS
    items = (
        placed(picture, 0, 0, scale),
        Text(count, 0, base, _LETTERS, bold=True),
        Text(size, step, base, _SMALL, colour=mixed(GREY, (255, 255, 255), 0.1)),
    )
    return Callout(items, max(wide, step + width(size, _SMALL)), base + 0.4)
