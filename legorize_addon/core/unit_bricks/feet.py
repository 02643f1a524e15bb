"""Feet for models that fall over at a touch: at the ground, on both sides of walls and posts.

A model falls to a side if it is tilted so far that its weight lies over the rim of its base. Where a few degrees do
that to a wall or a post, blocks two studs wide and two bricks high grow out of it at its ends, and in between where it
is long. They are cells of the model like all others: bricks are laid across wall and foot, and stay.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..model import CELL_SIZE, COLOUR_EMPTY, Fill, Role, UnitGrid, ground_of
from ..units import PLATES_PER_BRICK

STANDS: Final = 10.0
"""Degrees by which a model with feet can be tilted: chosen, not measured."""

THIN: Final = 3
"""Studs that the base of a wall or a post is deep at most: what is thicker has a shape that feet would spoil."""

DEEP: Final = 6
"""Studs that the whole of it is deep at most, a relief or a frame included: figures that lean out further are steadied
by pillars, of which the forces say where they are needed."""

WIDE: Final = 2
"""Studs of a foot along the wall."""

APART: Final = 24
"""Studs between feet at most: half a wall of the usual width."""

_LAYERS: Final = 2
"""Layers of bricks of a foot, the upper one half as long: bricks across the joint need others over them."""


@dataclass(frozen=True, slots=True)
class Feet:
    """Feet on two sides of a model.

    Attributes
    ----------
    axis : int
        0 if they lie along x, 1 if along y.
    studs : int
        How far they reach out on each side.
    places : tuple of int
        First stud of each along the wall, from 1, counted from the first column of the model.
    before, after : float
        Degrees by which the model can be tilted to the weaker of these sides, without feet and with them.
    """

    axis: int
    studs: int
    places: tuple[int, ...]
    before: float
    after: float

    def sentence(self) -> str:
        """Say where they are, and why."""
        first, last = ("left", "right") if self.axis == 0 else ("front", "back")
        where = ("studs " if len(self.places) > 1 else "stud ") + ", ".join(map(str, self.places))
        studs = f"{self.studs} studs" if self.studs > 1 else "1 stud"
        return (
            f"{_BEGIN}{studs} at the {first} and the {last}, which begin at {where} along the model, are part of it: "
            f"they are put on with its first {_LAYERS} layers and stay. Tilted by {self.before:.1f} degrees it would "
            f"fall over without them, with them by {self.after:.1f} degrees.{_CURE}"
        )


_BEGIN: Final = "Feet of "
_CURE: Final = " Turn feet off to leave them out."


def said_of_feet(notes: Iterable[str]) -> tuple[str, ...]:
    """Return what a builder should know of feet, from the sentences of a run."""
    return tuple(note.removesuffix(_CURE) for note in notes if note.startswith(_BEGIN) and note.endswith(_CURE))


def add_feet(grid: UnitGrid) -> tuple[UnitGrid, tuple[Feet, ...]]:
    """Let feet grow out of a model that falls over at a touch.

    Parameters
    ----------
    grid : UnitGrid
        All unit bricks of the model, before hollowing.

    Returns
    -------
    grid : UnitGrid
        With cells of feet, which are required, in the colour that the model has most of there; enlarged on both sides
        alike where they need room. The same grid where none are needed.
    feet : tuple of Feet
        One for each axis along which there are some.
    """
    solid = grid.solid.reshape(-1, *grid.solid.shape[2:])
    if not solid.any():
        return grid, ()
    base, middle = solid[ground_of(solid)], _middle(solid)
    found, more = [], []
    for axis in (0, 1):
        low, high = _ends(base, axis)
        beside = min(middle[axis] - low, high + 1 - middle[axis])
        before = _degrees(beside, middle[2])
        places = _places(base, axis)
        first, last = _ends(solid.any(axis=0), axis)
        if before < STANDS and high - low < THIN and last - first < DEEP and places:
            studs = max(1, math.ceil(middle[2] * math.tan(math.radians(STANDS)) / CELL_SIZE[axis] - beside))
            start = _ends(base, 1 - axis)[0]
            after = _degrees(beside + studs, middle[2])
            found.append(Feet(axis, studs, tuple(place - start + 1 for place in places), before, after))
            more.append(places)
    shift = 0
    for feet, places in zip(found, more, strict=True):
        grid = _with(grid, feet, [place + shift for place in places])
        # feet along x move what lies along x
        shift = feet.studs
    return grid, tuple(found)


def _middle(solid: Mask) -> Floats:
    """Return the middle of all cells: x and y in studs, and the height over the ground in mm."""
    z, y, x = (each.astype(np.float64) for each in np.nonzero(solid))
    height = (z.mean() + 0.5 - ground_of(solid)) * CELL_SIZE[2]
    return np.array([x.mean() + 0.5, y.mean() + 0.5, height])


def _degrees(studs: float, height: float) -> float:
    """Return by how much something can be tilted whose middle is so far from the rim of its base, and so high."""
    return math.degrees(math.atan2(studs * CELL_SIZE[0], height))


def _ends(base: Mask, axis: int) -> tuple[int, int]:
    """Return the first and the last stud of the base along x (0) or y (1)."""
    used = np.flatnonzero(base.any(axis=axis))
    return int(used[0]), int(used[-1])


def _places(base: Mask, axis: int) -> list[int]:
    """Return where feet begin along the other axis: near both ends, and between them where these are far apart."""
    used = base.any(axis=1 - axis)
    starts = np.flatnonzero(used[: len(used) - WIDE + 1] & used[WIDE - 1 :])
    if not len(starts):
        return []
    first, last = int(starts[0]), int(starts[-1])
    count = 1 if last - first < WIDE else 1 + math.ceil((last - first) / APART)
    wanted = np.linspace(first, last, count) if count > 1 else [first]
    return sorted({int(starts[np.abs(starts - place).argmin()]) for place in wanted})


def _with(grid: UnitGrid, feet: Feet, places: list[int]) -> UnitGrid:
    """Return a grid with feet."""
    along = 3 - feet.axis
    grid = _padded(grid, feet.studs, along)
    # one view of all cells: layer, plate, along the foot, along the wall
    made = UnitGrid(grid.colour.copy(), grid.cover.copy(), grid.role.copy(), grid.origin)
    colour, cover, role = (np.moveaxis(each, along, 2) for each in (made.colour, made.cover, made.role))
    bottom = ground_of(grid.solid.reshape(-1, *grid.solid.shape[2:]))
    first = bottom // PLATES_PER_BRICK
    for place in places:
        wall = np.s_[place : place + WIDE]
        paint = _colour(made.colour.take(range(place, place + WIDE), axis=5 - along)[first : first + _LAYERS])
        for layer in range(first, min(first + _LAYERS, len(colour))):
            reach = feet.studs if layer == first else math.ceil(feet.studs / 2)
            used = np.flatnonzero((cover[layer][..., wall] != Fill.EMPTY).any(axis=(0, 2)))
            if not len(used):
                continue
            plates = np.arange(PLATES_PER_BRICK) + layer * PLATES_PER_BRICK >= bottom
            at = np.ix_(plates, np.arange(used[0] - reach, used[-1] + reach + 1), np.arange(place, place + WIDE))
            _fill(colour[layer], cover[layer], role[layer], at, paint)
    return made


def _fill(
    colour: NDArray[np.int16], cover: NDArray[np.uint8], role: NDArray[np.uint8], at: tuple[Ints, ...], paint: int
) -> None:
    """Fill the cells of a layer that are empty."""
    empty = cover[at] == Fill.EMPTY
    colour[at] = np.where(empty, paint, colour[at])
    role[at] = np.where(empty, Role.SHELL, role[at])
    cover[at] = np.where(empty, Fill.REQUIRED, cover[at])


def _padded(grid: UnitGrid, studs: int, along: int) -> UnitGrid:
    """Return a grid with empty cells on both sides, so that its middle stays where it is."""
    width = [(0, 0)] * 4
    width[along] = (studs, studs)
    origin = grid.origin.copy()
    axis = 3 - along
    origin[axis] -= studs * CELL_SIZE[axis]
    return UnitGrid(
        np.pad(grid.colour, width, constant_values=COLOUR_EMPTY),
        np.pad(grid.cover, width, constant_values=Fill.EMPTY),
        np.pad(grid.role, width),
        origin,
    )


def _colour(cells: NDArray[np.int16]) -> int:
    """Return the colour that most cells have, that of hidden ones if there is no other."""
    seen = cells[cells >= 0]
    if not len(seen):
        return int(cells.max())
    codes, count = np.unique(seen, return_counts=True)
    return int(codes[count.argmax()])
