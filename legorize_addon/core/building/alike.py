"""Submodels that are equal up to their places, as wheels and hooves: they are built together."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import numpy as np

from ..arrays import Ints
from ..model import Bricks
from .items import REACH, span
from .steps import Steps

COPIES: Final = 2
"""Equal pieces that are built at once: each then has half a step of every picture."""


def alike_pieces(bricks: Bricks, box: Ints, pieces: Iterable[int]) -> dict[int, dict[int, int]]:
    """Find pieces that are equal to another one near them, supports included.

    Parameters
    ----------
    bricks : Bricks
        Model and supports.
    box : (n, 4) int64 array
        Their outlines, see :func:`.mirror.boxes`.
    pieces : iterable of int
        Numbers of the pieces that may be built together.

    Returns
    -------
    dict of int to dict of int to int
        Of each piece that is like one before it, the row of the brick of that
        one to which each of its own is equal: each first one has one such piece.
    """
    found: dict[int, dict[int, int]] = {}
    single: dict[bytes, Ints] = {}
    for piece in pieces:
        rows = np.flatnonzero(bricks.piece == piece)
        rows, look = _looks(bricks, rows)
        first = single.get(look)
        if first is not None and span(box[np.concatenate([first, rows])]) <= REACH:
            found[piece] = dict(zip(first.tolist(), rows.tolist(), strict=True))
            del single[look]
        else:
            single[look] = rows
    return found


def still_alike(steps: Steps, bricks: Bricks) -> bool:
    """Return whether submodels that are written once are equal where their bricks lie half studs further on, too.

    Parameters
    ----------
    steps : Steps
        Planned for bricks on one grid.
    bricks : Bricks
        The same ones at their true places.
    """
    looks = [_looks(bricks, steps.all_rows(each.number), roles=False)[1] for each in steps.submodels]
    return all(looks[each.number] == looks[each.like] for each in steps.submodels)


def _looks(bricks: Bricks, rows: Ints, *, roles: bool = True) -> tuple[Ints, bytes]:
    """Return bricks in an order that depends on their places among each other alone, and what they look like."""
    place = 2 * bricks.corner[rows].astype(np.int64)
    if bricks.half is not None:
        place[:, :2] += bricks.half[rows]
    place -= place.min(axis=0, initial=np.iinfo(np.int64).max)
    role = bricks.role[rows] if roles else np.zeros(len(rows), np.uint8)
    what = np.column_stack([place[:, ::-1], bricks.part[rows], bricks.turn[rows], bricks.colour[rows], role])
    order = np.lexsort(what.T[::-1])
    return rows[order], what[order].astype(np.int64).tobytes()
