"""What a mosaic lies on: a rectangle of as few baseplates or large plates as guillotine cuts allow.

A cut goes from one side of a rectangle to the other. The fewest parts of every
rectangle follow from those of its two halves, over all cuts (the recursion of
P. C. Gilmore and R. E. Gomory, "Multistage cutting stock problems of two and
more dimensions", Operations Research 13(1), 1965).
"""

from __future__ import annotations

from typing import Final, Literal, NamedTuple

import numpy as np

from ..arrays import Ints
from ..errors import SettingsError
from ..model import Bricks, Catalogue, Role

Kind = Literal["auto", "baseplates", "plates"]

MODULE: Final = 16
"""Studs of which the sides of all baseplates are multiples."""

_NEVER: Final = 1 << 30


class Slab(NamedTuple):
    """A part of a base: its row in the catalogue, its place, and its quarter turns."""

    part: int
    x: int
    y: int
    turn: int


def lay_base(size: tuple[int, int], kind: Kind, colour: int, catalogue: Catalogue) -> Bricks:
    """Lay the base of a mosaic.

    Parameters
    ----------
    size : (int, int)
        Studs along x and y.
    kind : {"auto", "baseplates", "plates"}
        Baseplates make a base that may be larger than the mosaic; "auto" takes them where they fit exactly and are
        made in the colour.
    colour : int
        LDraw code.
    catalogue : Catalogue

    Returns
    -------
    Bricks
        On plate 0, from (0, 0).

    Raises
    ------
    SettingsError
        Nothing of the kind is made in the colour.
    """
    name = catalogue.colours[catalogue.colour_row(colour)].name
    baseplates, plates = (_sizes(catalogue, colour, sockets=sockets) for sockets in (False, True))
    fits = not (size[0] % MODULE or size[1] % MODULE)
    found: list[Slab] | None = None
    if kind == "baseplates" or (kind == "auto" and fits):
        units = {(a // MODULE, b // MODULE): part for (a, b), part in baseplates.items()}
        slabs = _cut(-(-size[0] // MODULE), -(-size[1] // MODULE), units)
        found = None if slabs is None else [slab._replace(x=slab.x * MODULE, y=slab.y * MODULE) for slab in slabs]
    if found is None and kind == "baseplates":
        raise SettingsError(
            f"No baseplates that make up {size[0]} x {size[1]} studs are made in {name}: choose another base_colour, "
            "or set mosaic_base to 'plates'."
        )
    if found is None:
        found = _cut(*size, plates)
    if found is None:
        raise SettingsError(f"No plate of one stud is made in {name}: choose another base_colour.")
    return _table(sorted(found, key=lambda slab: (slab.y, slab.x)), colour)


def _sizes(catalogue: Catalogue, colour: int, *, sockets: bool) -> dict[tuple[int, int], int]:
    """Return the rows of plates, or of baseplates, that are made in a colour, by (longer, shorter) side."""
    made = catalogue.exists_in(np.arange(len(catalogue.parts)), colour)
    return {
        (part.length, part.width): row
        for row, part in enumerate(catalogue.parts)
        if made[row] and part.sockets == sockets and part.height == 1 and part.profile in ("box", "baseplate")
    }


def _cut(across: int, deep: int, sizes: dict[tuple[int, int], int]) -> list[Slab] | None:
    """Return the fewest parts that cover a rectangle, None if none do."""
    fewest = _fewest(across, deep, set(sizes))
    if fewest[across, deep] >= _NEVER:
        return None
    todo, slabs = [(0, 0, across, deep)], []
    while todo:
        x, y, wide, long = todo.pop()
        part = sizes.get((max(wide, long), min(wide, long)))
        if part is not None:
            slabs.append(Slab(part, x, y, int(long > wide)))
            continue
        upright = _sums(fewest[1:wide, long])
        level = _sums(fewest[wide, 1:long])
        if upright.min(initial=_NEVER) <= level.min(initial=_NEVER):
            # of equal cuts the last: the largest part comes first
            at = len(upright) - int(upright[::-1].argmin())
            todo += [(x + at, y, wide - at, long), (x, y, at, long)]
        else:
            at = len(level) - int(level[::-1].argmin())
            todo += [(x, y + at, wide, long - at), (x, y, wide, at)]
    return slabs


def _fewest(across: int, deep: int, sizes: set[tuple[int, int]]) -> Ints:
    """Return the fewest parts of all rectangles up to a size, (across + 1, deep + 1)."""
    table = np.full((across + 1, deep + 1), _NEVER, dtype=np.int64)
    for wide in range(1, across + 1):
        for long in range(1, deep + 1):
            if (max(wide, long), min(wide, long)) in sizes:
                table[wide, long] = 1
                continue
            cuts = (_sums(table[1:wide, long]), _sums(table[wide, 1:long]))
            table[wide, long] = min(each.min(initial=_NEVER) for each in cuts)
    return table


def _sums(fewest: Ints) -> Ints:
    """Return the parts of both sides of each cut, given those of all shorter rectangles."""
    sums: Ints = fewest + fewest[::-1]
    return sums


def _table(slabs: list[Slab], colour: int) -> Bricks:
    n = len(slabs)
    part, x, y, turn = np.array(slabs, dtype=np.int64).reshape(-1, 4).T
    return Bricks(
        part=part.astype(np.int16),
        corner=np.stack([x, y, np.zeros(n, dtype=np.int64)], axis=1).astype(np.int32),
        turn=turn.astype(np.uint8),
        colour=np.full(n, colour, dtype=np.int16),
        role=np.full(n, Role.INSIDE, dtype=np.uint8),
        piece=np.zeros(n, dtype=np.int16),
        step=np.zeros(n, dtype=np.int32),
    )
