"""The shapes of the parts: what each of their columns claims and holds, and their exact solids.

A part that falls along its length is given by two lines along it, of its top and its bottom, drawn out over its
width; one with slanted sides by its outline as seen from above. Columns, solids and centres of mass follow from these.
Measured in LDraw's library: slopes end in a lip of half a plate, cheese slopes are a twentieth of a plate lower than
two plates and flat for 0.67 LDU at their edge.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..units import PLATE_LDU, STUD_LDU
from .parts import Part, footprint, outline
from .polygons import centroid, depths, shares

Line = tuple[tuple[float, float], ...]

LIP: Final = 4 / PLATE_LDU
"""Height in plates of the edge in which a slope ends; that of an inverted slope is as thick."""

THIN_LIP: Final = 3 / PLATE_LDU
"""The same of inverted slopes that are three studs long."""

FACETS: Final = 7
"""Straight pieces of a curve."""

CHEESE_TOP: Final = 15.6 / PLATE_LDU
CHEESE_EDGE: Final = 0.67 / STUD_LDU

STUD_ROOM: Final = 7.8 / STUD_LDU
SOCKET_ROOM: Final = 5.5 / STUD_LDU
"""How far from the sides of a wedge plate the middle of a square with a stud is, and of one that clutches a stud.

Where it is nearer there is a notch below, in which a stud may stand. Measured in LDraw's library: studs are 10 LDU from
slanted sides or more, squares without one 7.3 or less; of these, those from 6.3 on clutch, those to 4.5 are notches."""

_FINE: Final = 32
"""Samples of a cell along each axis for the volume of a part: its centre is off by less than a thousandth of a stud."""


_EDGE: Final = 1e-9
"""How far from its edge in studs a column is looked at, which tells what is its own of a step there."""


@dataclass(frozen=True, slots=True, eq=False)
class Columns:
    """The stud squares of a turned part, in the order of its footprint.

    Attributes
    ----------
    xy : (k, 2) int32 array
        Cells, from the lowest corner of the turned bounding box.
    low, high : (k,) int32 arrays
        Plates above the part's corner from which and up to which it claims the column.
    stud : (k,) bool array
        Whether a stud stands on the column, at `high`.
    socket : (k,) bool array
        Whether the column clutches a stud below, at `low`.
    foot : (k,) bool array
        Whether the column has a flat underside all over, at `low`, to stand on.
    """

    xy: NDArray[np.int32]
    low: NDArray[np.int32]
    high: NDArray[np.int32]
    stud: Mask
    socket: Mask
    foot: Mask


def lines(part: Part) -> tuple[Line, Line]:
    """Return the lines of a part's top and bottom along its length: studs from its start, plates from its bottom."""
    length, height = float(part.length), float(part.height)
    bottom: Line = ((0.0, 0.0), (length, 0.0))
    if part.profile == "slope":
        return ((0.0, height), (1.0, height), (length, LIP)), bottom
    if part.profile == "cheese":
        return ((0.0, CHEESE_TOP), (CHEESE_EDGE, CHEESE_TOP), (length, LIP)), bottom
    if part.profile in ("curved", "bow"):
        return _curve(part), _steps(part)
    top: Line = ((0.0, height), (length, height))
    if part.profile == "inverted":
        bottom = ((0.0, 0.0), (1.0, 0.0), (length, height - (LIP if part.length == 2 else THIN_LIP)))
    elif part.profile == "baseplate":
        bottom = ((0.0, height / 2), (length, height / 2))
    return top, bottom


def _curve(part: Part) -> Line:
    """Return the top of a part that is level at its start and falls ever more, to the lip."""
    drop = part.height - LIP
    # an ellipse up to half of its quarter, or the circle that is level at the start
    flat = drop * PLATE_LDU / (part.length * STUD_LDU)
    angle = np.linspace(0, np.pi / 4 if part.profile == "curved" else 2 * np.arctan(flat), FACETS + 1)
    along = part.length * np.sin(angle) / np.sin(angle[-1])
    down = drop * (1 - np.cos(angle)) / (1 - np.cos(angle[-1]))
    return tuple(zip(along.tolist(), (part.height - down).tolist(), strict=True))


def _steps(part: Part) -> Line:
    """Return the underside of a part with a curved top: the lower end stands two studs long, each stud up a plate."""
    low = max(part.length - 2, 1)
    level = [float(max(low - row, 0)) for row in range(part.length)]
    return tuple((float(row + end), z) for row, z in enumerate(level) for end in (0, 1))


@cache
def columns(part: Part, turn: int) -> Columns:
    """Return the stud squares of a part: what it claims there, and where it has studs, sockets and feet.

    Parameters
    ----------
    part : Part
        The part.
    turn : int
        Quarter turns, counter-clockwise as seen from above.

    Returns
    -------
    Columns
        In the order of :func:`footprint`.
    """
    xy = footprint(part, turn)
    if part.wedge:
        return _flat_columns(part, turn, xy)
    place = np.floor(_unturned(part, turn, _middles(xy)))
    start = place[:, 0]
    top, bottom = (_extremes(line, start) for line in lines(part))
    # baseplates fill the upper half of their plate
    low = np.floor(bottom[0]).astype(np.int32)
    high = np.ceil(top[1]).astype(np.int32)
    foot = (bottom[0] == bottom[1]) | (not part.sloped)
    stud = (top[0] == top[1]) & part.studs
    if part.jumper:
        # what lies half a stud beyond its corner has the stud over its lowest square
        stud &= (place == 0).all(axis=1)
    return Columns(xy, low, high, stud, foot & part.sockets, foot)


def _flat_columns(part: Part, turn: int, xy: NDArray[np.int32]) -> Columns:
    """Return the stud squares of a wedge plate: it stands on those that it covers all over."""
    deep = depths(outline(part), _unturned(part, turn, _middles(xy)))
    low = np.zeros(len(xy), np.int32)
    x, y = xy.T
    foot = np.rot90(shares(outline(part), part.length, part.width), turn)[x, y] == 1
    return Columns(xy, low, low + np.int32(part.height), deep >= STUD_ROOM, deep >= SOCKET_ROOM, foot)


def _extremes(line: Line, start: Floats) -> tuple[Floats, Floats]:
    """Return the lowest and the highest level of a line in each stud from `start`, steps at its ends left out."""
    found: list[Floats] = []
    rows, row = np.unique(start, return_inverse=True)
    for first in rows.tolist():
        inside = [z for x, z in line if first < x < first + 1]
        ends = _level(line, first + np.array([_EDGE, 1 - _EDGE]))
        found.append(np.round([min([*inside, *ends]), max([*inside, *ends])], 6))
    low, high = np.array(found)[row.reshape(-1)].T
    return low, high


def solid(part: Part, turn: int, across: int, up: int) -> Mask:
    """Return the part as samples at the middles of subcells; walls, hollows and tubes are solid.

    Parameters
    ----------
    part : Part
        The part.
    turn : int
        Quarter turns, counter-clockwise as seen from above.
    across : int
        Samples of a stud along x and along y.
    up : int
        Samples of a plate.

    Returns
    -------
    (k, height * up, across, across) bool array
        By footprint cell, z, y and x; studs are left out.
    """
    xy = footprint(part, turn)
    middle = (np.arange(across) + 0.5) / across
    y, x = np.meshgrid(middle, middle, indexing="ij")
    places = xy[:, None, None].astype(np.float64) + np.stack([x, y], axis=-1)
    own = _unturned(part, turn, places)
    if part.wedge:
        within = depths(outline(part), own.reshape(-1, 2)).reshape(own.shape[:-1]) > 0
        return np.repeat(within[:, None], part.height * up, axis=1)
    along = own[..., 0]
    top, bottom = (_level(line, along)[:, None] for line in lines(part))
    z = ((np.arange(part.height * up) + 0.5) / up)[:, None, None]
    inside: Mask = (z > bottom) & (z < top)
    return inside


def filled(part: Part, turn: int, across: int) -> Floats:
    """Return the exact shares of small parts of squares within the outline of a wedge plate.

    Parameters
    ----------
    part : Part
        A wedge plate.
    turn : int
        Quarter turns, counter-clockwise as seen from above.
    across : int
        Small parts of a stud along x and along y.

    Returns
    -------
    (k, across, across) float64 array
        By footprint cell, y and x.
    """
    whole = np.rot90(shares(outline(part), part.length, part.width, across), turn)
    x, y = footprint(part, turn).T
    squares = whole.reshape(whole.shape[0] // across, across, whole.shape[1] // across, across)
    return squares[x, :, y].transpose(0, 2, 1)


@cache
def centre(part: Part, turn: int) -> tuple[float, float, float]:
    """Return the centre of mass of a part from its corner, x and y in studs, z in plates; as if solid all through.

    Boxes have it in the middle of their squares, half way up.
    """
    if part.wedge:
        x, y = turned(part, turn, centroid(outline(part))).tolist()
        return x, y, part.height / 2
    cells = _middles(footprint(part, turn))
    if not part.sloped:
        x, y = cells.mean(axis=0).tolist()
        return x, y, part.height / 2
    at = (np.arange(part.length * _FINE) + 0.5) / _FINE
    top, bottom = (_level(line, at) for line in lines(part))
    weight = top - bottom
    along = float((at * weight).sum() / weight.sum())
    up = float(((top + bottom) / 2 * weight).sum() / weight.sum())
    x, y = turned(part, turn, np.array([along, part.width / 2])).tolist()
    return x, y, up


def turned(part: Part, turn: int, places: Floats) -> Floats:
    """Turn places (..., 2) in the bounding box of a part, in studs from its lowest corner before and after."""
    x, y = places[..., 0], places[..., 1]
    long, wide = part.length, part.width
    ways = ((x, y), (wide - y, x), (long - x, wide - y), (y, long - x))
    return np.stack(ways[turn % 4], axis=-1)


def jumper_turn(part: Part, turn: int, half_x: int, half_y: int) -> int:
    """Return the turn of a jumper, which looks the same, in which its stud counts to the square of what lies on it.

    Parameters
    ----------
    part : Part
        A jumper.
    turn : int
        One that looks right.
    half_x, half_y : int
        Half studs, 0 or 1, by which it lies beyond its corner; what lies on its stud has the other number of them along
        its length, or along both sides if it is square.

    Returns
    -------
    int
    """
    if part.length == part.width:
        # 0 and 0, 1 and 0, 1 and 1, 0 and 1: the squares of the stud, turn by turn
        return ((0, 3), (1, 2))[half_x][half_y]
    return turn % 2 + 2 * (half_y if turn % 2 else half_x)


def _level(line: Line, along: Floats) -> Floats:
    """Return how high a line is at places along the part."""
    x, z = np.array(line).T
    level: Floats = np.interp(along, x, z)
    return level


def _middles(xy: NDArray[np.int32]) -> Floats:
    """Return the middles of stud squares."""
    return xy.astype(np.float64) + 0.5


def _unturned(part: Part, turn: int, places: Floats) -> Floats:
    """Turn places in the bounding box of a turned part back to those at turn 0."""
    x, y = places[..., 0], places[..., 1]
    long, wide = part.length, part.width
    ways = ((x, y), (y, wide - x), (long - x, wide - y), (long - y, x))
    return np.stack(ways[turn % 4], axis=-1)
