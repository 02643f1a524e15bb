"""Single plates in the neighbour's colour, so that parts of different colours hold to each other.

What touches only sideways is joined by a part that covers both sides, and a part
has one colour. Where nothing else holds a claw to a paw, one plate of the claw
takes the colour of the paw.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from .joints import Touching, brick_columns, every_plate, parts_of
from .model import COLOUR_ANY, Ints, Mask, Role, UnitGrid

_ROUNDS: Final = 16
"""Most rounds: in each every loose part is joined to one that it touches."""


def with_colour_joints(grid: UnitGrid, *, plates: bool) -> UnitGrid:
    """Join loose parts to what they touch, by a plate in the colour of the other side.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model, jointed as far as colours allow.
    plates : bool
        Whether brick columns may be laid in plates for it; else whole columns
        change their colour.

    Returns
    -------
    UnitGrid
        With the colour of one cell changed for each joint, the one with the
        fewest visible faces; both columns there are laid in plates.
    """
    brick, _ = brick_columns(grid)
    touching = Touching.of(grid.solid)
    colour = grid.colour.reshape(-1)[touching.cell]
    whole = every_plate(brick).reshape(-1)[touching.cell]
    price = _visible_faces(touching, colour)
    joined = False
    for _ in range(_ROUNDS):
        changed, other = _joints(touching, colour, whole, price, plates=plates)
        if len(changed) == 0:
            break
        joined = True
        if plates:
            # what agrees already only has to be laid in plates
            colour[changed] = np.where(colour[other] == COLOUR_ANY, colour[changed], colour[other])
            whole &= ~np.isin(touching.column, touching.column[np.concatenate([changed, other])])
        else:
            of_column = touching.laid(colour, whole)
            taken = np.arange(len(colour))
            taken[touching.column[changed]] = other
            colour = np.where(
                np.isin(touching.column, touching.column[changed]), of_column[taken[touching.column]], colour
            )
    if not joined:
        return grid
    codes, role = grid.colour.copy(), grid.role.copy()
    codes.reshape(-1)[touching.cell] = colour
    role.reshape(-1)[touching.cell[~whole]] = Role.PLATE
    return replace(grid, colour=codes, role=role)


def _joints(
    touching: Touching, colour: NDArray[np.int16], whole: Mask, price: Ints, *, plates: bool
) -> tuple[Ints, Ints]:
    """Return, for each loose part that touches another one, the cell to change and the cell whose colour it takes."""
    part, loose = parts_of(touching, colour, whole)
    pairs = touching.sideways
    one, two = part[pairs]
    pairs = pairs[:, (one != two) & (loose[one] | loose[two])]
    pairs = np.concatenate([pairs, pairs[::-1]], axis=1)
    # a cell that changes must stay on something of its own: a whole column stays on its other plates
    stacked = np.zeros(len(colour), dtype=bool)
    upright = touching.upright if plates else touching.column[touching.upright]
    stacked[upright[:, upright[0] != upright[1]].ravel()] = True
    pairs = pairs[:, stacked[pairs[0] if plates else touching.column[pairs[0]]]]
    parts = part[pairs]
    offers = np.concatenate([np.vstack([each, pairs])[:, loose[each]] for each in parts], axis=1)
    order = np.lexsort((offers[1], price[offers[1]], offers[0]))
    best = offers[:, order[np.flatnonzero(np.diff(offers[0][order], prepend=-1))]]
    # two parts that choose each other would only swap their colours
    best = best[:, ~np.isin(best[1], best[2]) | (best[0] <= part[best[2]])]
    return best[1], best[2]


def _visible_faces(touching: Touching, colour: NDArray[np.int16]) -> Ints:
    """Return how many faces of each cell nothing touches, -1 for hidden cells, (n,)."""
    touched = np.concatenate([touching.upright.ravel(), touching.sideways.ravel()])
    faces = 6 - np.bincount(touched, minlength=len(colour))
    return np.where(colour == COLOUR_ANY, -1, faces)
