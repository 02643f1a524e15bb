"""Bricks that lie already, laid again: the same cells and the same colours where they can be seen, in better parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from ..arrays import Ints, Mask
from ..errors import BuildError
from ..geometry import outer_air, visible
from ..model import COLOUR_ANY, COLOUR_EMPTY, NOBODY, Bricks, Catalogue, Fill, UnitGrid, concatenate, contact_graph
from ..units import PLATES_PER_BRICK

Lay = Callable[[UnitGrid], Bricks]
"""Covers cells by bricks."""

Burden = Callable[[Bricks], float]
"""What layouts are compared by, less being better: the number of bricks, or what they cost."""


def cells_of(bricks: Bricks, catalogue: Catalogue, *, below: int = 0) -> UnitGrid:
    """Return the cells that bricks fill.

    Parameters
    ----------
    bricks : Bricks
        At least one; none at negative coordinates.
    catalogue : Catalogue
    below : int, optional
        Empty planes below, by which whole layers begin elsewhere.

    Returns
    -------
    UnitGrid
        Every cell of a brick is required, in the colour of the brick where it
        can be seen from outside, and in any where it cannot.
    """
    owner = contact_graph(bricks, catalogue).owner
    above = -(len(owner) + below) % PLATES_PER_BRICK
    owner = np.pad(owner, ((below, above), (0, 0), (0, 0)), constant_values=NOBODY)
    filled = owner != NOBODY
    colour = np.where(filled, bricks.colour[owner], COLOUR_EMPTY)
    colour[filled & ~visible(filled, outer_air(filled))] = COLOUR_ANY
    shape = (-1, PLATES_PER_BRICK, *owner.shape[1:])
    return UnitGrid(
        colour=colour.astype(np.int16).reshape(shape),
        cover=np.where(filled, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8).reshape(shape),
        role=np.where(filled, bricks.role[owner], 0).astype(np.uint8).reshape(shape),
        origin=np.zeros(3),
    )


def lay_again(bricks: Bricks, catalogue: Catalogue, lay: Lay, burden: Burden = len) -> Bricks:
    """Lay bricks again, in fewer or cheaper parts where that can be done.

    Parameters
    ----------
    bricks : Bricks
        A model without collisions, none at negative coordinates.
    catalogue : Catalogue
    lay : callable
        Returns the bricks that cover a grid.
    burden : callable, optional
        What layouts are compared by.

    Returns
    -------
    Bricks
        The layout of the least burden among those found and the given one, which
        is the same object if none is better. A layout counts if it is faithful,
        see :func:`faithful`, and comes apart nowhere where the given one does not.
        Tiles, baseplates and large plates stay as they are.
    """
    fixed = ~catalogue.used_for("model")[bricks.part]
    free, best = bricks.take(~fixed), bricks
    for below in phases(free, catalogue) if len(free) else ():
        try:
            laid = lay(cells_of(free, catalogue, below=below))
        except BuildError:
            # no part of one cell is made in the colour of a cell; in the given model a larger one is, or none
            continue
        laid = replace(laid, corner=(laid.corner - (0, 0, below)).astype(np.int32))
        laid = concatenate([laid, bricks.take(fixed)])
        if burden(laid) < burden(best) and as_good(laid, bricks, catalogue):
            best = laid
    return best


def phases(bricks: Bricks, catalogue: Catalogue) -> list[int]:
    """Return how many planes to put below so that whole layers begin where bricks of the model do, most bricks first.

    A model of plates alone is tried in all three ways.
    """
    whole = catalogue.height[bricks.part] >= PLATES_PER_BRICK
    level = bricks.corner[whole if whole.any() else slice(None), 2]
    count = np.bincount(-level % PLATES_PER_BRICK, minlength=PLATES_PER_BRICK)
    wanted = count > 0 if whole.any() else np.ones(PLATES_PER_BRICK, bool)
    return [below for below in np.argsort(-count, kind="stable").tolist() if wanted[below]]


def as_good(laid: Bricks, given: Bricks, catalogue: Catalogue) -> bool:
    """Tell whether a layout shows the same as another one, and hangs together as well."""
    one, other = (contact_graph(each, catalogue) for each in (laid, given))
    return (
        one.n_components <= other.n_components
        and one.n_floating <= other.n_floating
        and faithful(laid, given, catalogue)
    )


def faithful(laid: Bricks, given: Bricks, catalogue: Catalogue) -> bool:
    """Tell whether two layouts fill the same cells, and show the same colours from outside."""
    one, other = (_shown(each, catalogue) for each in (laid, given))
    return one.shape == other.shape and bool((one == other).all())


def _shown(bricks: Bricks, catalogue: Catalogue) -> Ints:
    """Return the colour that each cell shows, ``COLOUR_ANY`` of hidden ones, without empty rims."""
    colour = cells_of(bricks, catalogue).colour
    colour = colour.reshape(-1, *colour.shape[2:])
    return colour[_extent(colour != COLOUR_EMPTY)].astype(np.int64)


def _extent(filled: Mask) -> tuple[slice, ...]:
    """Return the rows of each axis from 0 up to the last one that is not empty."""
    return tuple(
        slice(0, int(np.flatnonzero(filled.any(axis=tuple({0, 1, 2} - {axis}))).max(initial=-1)) + 1)
        for axis in range(3)
    )
