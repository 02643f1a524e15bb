"""The stud squares that bricks cover, and what each brick is there."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from .bricks import Bricks
from .catalogue import Catalogue
from .parts import Part
from .profiles import Columns, columns

Rows = NDArray[np.int32]


def stud_columns(bricks: Bricks, catalogue: Catalogue) -> tuple[Rows, Rows]:
    """List the stud squares that the bricks cover.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.

    Returns
    -------
    brick : (n_columns,) int32 array
        Row of the brick, ascending: a 2 x 4 brick appears eight times.
    columns : (n_columns, 3) int32 array
        Stud square (x, y) and lowest plate z of the brick there.
    """
    brick, kind, nth = _each(bricks, catalogue)
    table = _tables(catalogue.parts)
    squares = bricks.corner[brick]
    squares[:, :2] += table.xy[kind, nth]
    squares[:, 2] += table.low[kind, nth]
    return brick, squares


def column_facts(bricks: Bricks, catalogue: Catalogue) -> Columns:
    """Return what the bricks are in the stud squares that :func:`stud_columns` lists, in its order.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.

    Returns
    -------
    Columns
        All counted from the corner of each brick; arrays of length n_columns.
    """
    _, kind, nth = _each(bricks, catalogue)
    table = _tables(catalogue.parts)
    return Columns(*(getattr(table, name)[kind, nth] for name in Columns.__slots__))


def stud_middles(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return where the studs over the squares that :func:`stud_columns` lists have, or would have, their middles.

    Parameters
    ----------
    bricks : Bricks
    catalogue : Catalogue

    Returns
    -------
    (n_columns, 2) float64 array
        x and y in studs. The one stud of a jumper is in its middle, half a stud beyond its square.
    """
    brick, squares = stud_columns(bricks, catalogue)
    off = off_square(catalogue.parts)[bricks.part, bricks.turn] / 2
    middle: Floats = squares[:, :2] + 0.5 + (bricks.shift[:, :2] + off)[brick]
    return middle


@lru_cache
def off_square(parts: tuple[Part, ...]) -> NDArray[np.int64]:
    """Return the half studs by which the stud of every part at every turn lies beyond its square, (n_parts, 4, 2)."""
    off = np.zeros((len(parts), 4, 2), np.int64)
    for row, part in enumerate(parts):
        for turn in range(4 * part.jumper):
            facts = columns(part, turn)
            off[row, turn] = facts.xy.max(axis=0) - 2 * facts.xy[facts.stud][0]
    return off


def _each(bricks: Bricks, catalogue: Catalogue) -> tuple[Rows, NDArray[np.intp], NDArray[np.intp]]:
    """Return the brick, the oriented part, and the number within it of each stud square."""
    kind = bricks.part.astype(np.intp) * 4 + bricks.turn
    count = _sizes(catalogue.parts)[kind]
    brick = np.repeat(np.arange(len(bricks), dtype=np.int32), count)
    nth = np.arange(len(brick)) - np.repeat(np.cumsum(count) - count, count)
    return brick, kind[brick], nth


@lru_cache
def oriented(parts: tuple[Part, ...]) -> tuple[Columns, ...]:
    """Return the columns of every part at every turn."""
    return tuple(columns(part, turn) for part in parts for turn in range(4))


@lru_cache
def _sizes(parts: tuple[Part, ...]) -> NDArray[np.intp]:
    """Return how many stud squares every part has at every turn, (4 n_parts,)."""
    return np.array([len(each.xy) for each in oriented(parts)])


@lru_cache
def _tables(parts: tuple[Part, ...]) -> Columns:
    """Return the columns of every part at every turn, arrays of (4 n_parts, most)."""
    found, most = oriented(parts), _sizes(parts).max()
    made = []
    for name in Columns.__slots__:
        first = getattr(found[0], name)
        table = np.zeros((len(found), most, *first.shape[1:]), first.dtype)
        for row, each in enumerate(found):
            table[row, : len(each.xy)] = getattr(each, name)
        made.append(table)
    return Columns(*made)
