"""The parts: their sizes and profiles, and the cells that they cover."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from .polygons import shares

MISSING_CELL: Final = ((1, 1), (0, 1), (0, 0), (1, 0))
"""Cell (x, y) of the 2 x 2 bounding box that a corner part leaves free, by quarter turn."""

Profile = Literal[
    "box", "corner", "tile", "baseplate", "slope", "cheese", "inverted", "curved", "bow", "jumper", "wedge"
]
"""What a part looks like: a box with studs on top; the same as a 2 x 2 corner, which lacks one cell of its bounding
box; smooth on top; flat below and half as thick as a plate, in the upper half of its cells; falling along its length:
from a row of studs, from a sharp edge, upside down under a top full of studs, or as a curve, elliptical or circular,
over an underside in steps (see ``profiles``); smooth on top but for one stud in the middle; or with sides that run
at an angle as seen from above."""

SLOPED: Final = ("slope", "cheese", "inverted", "curved", "bow")
"""Profiles that fall along the length: their high or deep end is at low x at turn 0."""

Use = Literal["model", "tiles", "plates", "base", "surface"]
"""What a part is laid for: models of all kinds; mosaics of tiles; mosaics of plates, and bases; bases alone; the
surface of models."""


@dataclass(frozen=True, slots=True)
class Part:
    """A part that stands upright on the grid.

    Attributes
    ----------
    number : str
        LDraw number, the same at BrickLink and Rebrickable.
    title : str
        Name for people, "Brick 2 x 4".
    length, width : int
        Studs along x and y at turn 0; the length is the longer side, that of a slope the one along which it falls, and
        that of a wedge plate the one along which it gets narrower.
    height : int
        Plates: 1 a plate, 3 a brick, 9 a tall brick.
    profile : str
        See ``Profile``.
    use : {"model", "tiles", "plates", "base", "surface"}
        See ``Use``.
    mass : float
        Grams.
    mass_source : str
        Who weighed it, or how it was estimated.
    aliases : tuple of str
        Other numbers that LDraw files use for the same part.
    outline : tuple of (float, float), optional
        Of a part with slanted sides: its corners as seen from above at turn 0, counter-clockwise, in studs from the
        lowest corner of its box. Convex.
    """

    number: str
    title: str
    length: int
    width: int
    height: int
    profile: Profile
    use: Use
    mass: float
    mass_source: str
    aliases: tuple[str, ...]
    outline: tuple[tuple[float, float], ...] = ()

    @property
    def corner(self) -> bool:
        """Whether it is a corner part."""
        return self.profile == "corner"

    @property
    def jumper(self) -> bool:
        """Whether it has one stud in its middle: its turns say which of its squares that counts to."""
        return self.profile == "jumper"

    @property
    def studs(self) -> bool:
        """Whether it has any studs on top, for other parts to clutch."""
        return self.profile not in ("tile", "cheese", "curved", "bow")

    @property
    def sockets(self) -> bool:
        """Whether it clutches studs below."""
        return self.profile != "baseplate"

    @property
    def sloped(self) -> bool:
        """Whether it falls along its length."""
        return self.profile in SLOPED

    @property
    def wedge(self) -> bool:
        """Whether it has sides that run at an angle as seen from above."""
        return self.profile == "wedge"

    @property
    def shaped(self) -> bool:
        """Whether it is laid for its shape, which is no box: it falls, or has slanted sides."""
        return self.sloped or self.wedge

    @property
    def turns(self) -> int:
        """Number of different orientations: 1, 2 or 4 quarter turns."""
        if self.corner or self.shaped or self.jumper:
            return 4
        return 1 if self.length == self.width else 2


def footprint(part: Part, turn: int) -> NDArray[np.int32]:
    """Return the cells that a part covers, seen from above.

    Parameters
    ----------
    part : Part
        The part.
    turn : int
        Quarter turns, counter-clockwise as seen from above.

    Returns
    -------
    (k, 2) int32 array
        Cells (x, y) as offsets from the lowest corner of the turned bounding
        box, by ascending x, then y.
    """
    if part.wedge:
        return np.argwhere(np.rot90(_covered(part), turn)).astype(np.int32)
    covered = np.ones((part.width, part.length) if turn % 2 else (part.length, part.width), bool)
    if part.corner:
        covered[MISSING_CELL[turn % 4]] = False
    return np.argwhere(covered).astype(np.int32)


def outline(part: Part) -> Floats:
    """Return the corners of a part as seen from above at turn 0, counter-clockwise, (n, 2) studs from its box's own."""
    if part.wedge:
        return np.array(part.outline)
    x, y = float(part.length), float(part.width)
    if part.corner:
        return np.array([[0, 0], [x, 0], [x, 1], [1, 1], [1, y], [0, y]])
    return np.array([[0, 0], [x, 0], [x, y], [0, y]])


@cache
def _covered(part: Part) -> Mask:
    """Return the squares that a part with slanted sides reaches into at turn 0, (length, width)."""
    return shares(outline(part), part.length, part.width) > 0
