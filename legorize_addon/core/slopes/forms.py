"""The slopes in all their turns: what each of their cells claims, holds and fills."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..model import Catalogue, Part, columns, filled, part_images, solid
from ..slicing import ACROSS, UP
from ..units import PLATE, PLATES_PER_BRICK, STUD

PARTS: Final = UP * ACROSS * ACROSS
"""Small parts of a cell."""

_FINE: Final = 16
"""Parts of a stud and of a plate, to measure how steep a slope is: 6 % too little at most."""

SIDES: Final = ((0, 0, -1), (0, 0, 1), (0, -1, 0), (0, 1, 0))
"""Steps (z, y, x) to the cells beside a cell."""


@dataclass(frozen=True, slots=True, eq=False)
class Form:
    """A slope in one of its turns; cells are steps (z, y, x) from its corner.

    Attributes
    ----------
    part : int
        Row of the part in the catalogue.
    turn : int
        Quarter turns.
    height : int
        Plates.
    cells : (n, 3) int64 array
        What it claims.
    fill : (n, PARTS) float32 array
        How much it fills of the parts of these cells, 0 to 1.
    above, below : (k, 3) int64 arrays
        Cells that must stay empty: over columns of a slope without a stud, under those without a socket. What lies
        flat, as a wedge plate, may have something over it and under it.
    held, holding : (k, 3) int64 arrays
        Cells over its studs, and under its sockets.
    beside : (k, 3) int64 arrays
        Cells beside it that are seen past its open sides.
    columns : (k, 4) int64 array
        First cell of each column (z, y, x), and how many it claims.
    facing : (3,) float64 array
        Which way its slope faces: the area as seen along x, y and z, outwards, in mm².
    images : tuple of two (int, int)
        Row and turn of what it is in a mirror along x, and in one along y.
    """

    part: int
    turn: int
    height: int
    cells: Ints
    fill: NDArray[np.float32]
    above: Ints
    below: Ints
    held: Ints
    holding: Ints
    beside: Ints
    columns: Ints
    facing: Floats
    images: tuple[tuple[int, int], ...]


@lru_cache
def forms(parts: tuple[Part, ...], *, plates: bool) -> tuple[Form, ...]:
    """List the slopes of a catalogue in all their turns; without plates those alone that leave room for bricks."""
    return tuple(
        _form(parts, row, turn)
        for row, part in enumerate(parts)
        if part.shaped and (plates or _as_bricks(part))
        for turn in range(part.turns)
    )


def _as_bricks(part: Part) -> bool:
    """Return whether bricks alone fit above and below a part: not under the steps of a curved one."""
    facts = columns(part, 0)
    return not ((facts.low % PLATES_PER_BRICK).any() or (facts.high % PLATES_PER_BRICK).any())


def slopes_of(catalogue: Catalogue, *, plates: bool) -> tuple[Form, ...]:
    """Return the forms of the slopes of a catalogue that exist in any colour; wedge plates are not laid yet."""
    laid = catalogue.exists.any(axis=1) & np.array([part.sloped for part in catalogue.parts])
    return tuple(form for form in forms(catalogue.parts, plates=plates) if laid[form.part])


def _form(parts: tuple[Part, ...], row: int, turn: int) -> Form:
    """Return a part in a turn."""
    part = parts[row]
    facts = columns(part, turn)
    inside = _shares(part, turn)
    low, high = facts.low.astype(np.int64), facts.high.astype(np.int64)
    column = np.repeat(np.arange(len(low)), high - low)
    level = np.arange(len(column)) - np.repeat(np.cumsum(high - low) - high, high - low)
    cells = _at(facts.xy[column], level)
    fill = inside[column, level]
    return Form(
        part=row,
        turn=turn,
        height=part.height,
        cells=cells,
        fill=fill.reshape(len(fill), -1).astype(np.float32),
        above=_at(facts.xy, high)[~facts.stud & part.sloped],
        below=_at(facts.xy, low - 1)[~facts.socket & part.sloped],
        held=_at(facts.xy, high)[facts.stud],
        holding=_at(facts.xy, low - 1)[facts.socket],
        beside=_beside(cells, fill),
        columns=np.column_stack([_at(facts.xy, low), high - low]),
        facing=_facing(part, turn),
        images=tuple(tuple(part_images(parts, axis)[row, turn].tolist()) for axis in (0, 1)),
    )


def _shares(part: Part, turn: int) -> Floats:
    """Return how much of each small part of its columns a part fills, (k, height, UP, ACROSS, ACROSS)."""
    if part.wedge:
        across = filled(part, turn, ACROSS)[:, None, None]
        return np.broadcast_to(across, (len(across), part.height, UP, ACROSS, ACROSS))
    whole = solid(part, turn, ACROSS, UP)
    return whole.reshape(len(whole), part.height, UP, ACROSS, ACROSS).astype(np.float64)


def _facing(part: Part, turn: int) -> Floats:
    """Return which way the columns face that a slope does not fill."""
    filled = solid(part, turn, _FINE, _FINE)
    filled = filled[~filled.all(axis=(1, 2, 3))].astype(np.float64)
    # the first and the last small part are a little nearer to each other than the faces of the column
    along_z, along_y, along_x = (
        np.take(filled, 0, axis).mean(axis=(1, 2)).sum() - np.take(filled, -1, axis).mean(axis=(1, 2)).sum()
        for axis in (1, 2, 3)
    )
    high = part.height * PLATE
    return np.array([STUD * high * along_x, STUD * high * along_y, STUD * STUD * along_z])


def _at(xy: NDArray[np.int32], level: Ints) -> Ints:
    """Return cells as z, y and x."""
    return np.column_stack([level, xy[:, 1], xy[:, 0]]).astype(np.int64)


def _beside(cells: Ints, fill: Floats) -> Ints:
    """Return the cells beside those of a slope that are not hidden by it all over."""
    own = set(map(tuple, cells.tolist()))
    faces = (fill[..., 0], fill[..., -1], fill[..., 0, :], fill[..., -1, :])
    found = set()
    for step, face in zip(SIDES, faces, strict=True):
        closed = (face.reshape(len(face), -1) == 1).all(axis=1)
        found |= set(map(tuple, (cells[~closed] + step).tolist())) - own
    return np.array(sorted(found), dtype=np.int64).reshape(-1, 3)
