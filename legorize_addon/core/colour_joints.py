"""Single plates in the neighbour's colour, so that parts of different colours hold to each other.

What touches only sideways is joined by a part that covers both sides, and a part
has one colour. Where nothing else holds a claw to a paw, one plate of the claw
takes the colour of the paw.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np

from .joints import beside, brick_columns, nodes, parts_of
from .model import COLOUR_ANY, COLOUR_EMPTY, Ints, Mask, Role, UnitGrid
from .units import PLATES_PER_BRICK

_ROUNDS: Final = 16
"""Most rounds: in each every loose part is joined to one that it touches."""


def with_colour_joints(grid: UnitGrid) -> UnitGrid:
    """Join loose parts to what they touch, by a plate in the colour of the other side.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model, jointed as far as colours allow.

    Returns
    -------
    UnitGrid
        With the colour of one cell changed for each joint, the one with the
        fewest visible faces; both columns there are laid in plates.
    """
    for _ in range(_ROUNDS):
        brick, _ = brick_columns(grid)
        node, n_nodes = nodes(grid.solid, brick)
        part, loose = parts_of(grid, brick, node, n_nodes)
        if not loose.any():
            break
        changed, other = _joints(grid, brick, node, part, loose)
        if len(changed[0]) == 0:
            break
        grid = _joined(grid, changed, other)
    return grid


def _joints(
    grid: UnitGrid, brick: Mask, node: Ints, part: Ints, loose: Mask
) -> tuple[tuple[Ints, ...], tuple[Ints, ...]]:
    """Return, for each loose part that touches another one, the cell to change and the cell whose colour it takes."""
    shape = node.shape
    colour, whole = grid.colour.reshape(shape), np.repeat(brick, PLATES_PER_BRICK, axis=0)
    stacked = _stacked(node, part)
    price = _visible_faces(colour)
    found = []
    for axis in (1, 2):
        here, there = beside(shape, axis)
        a, b = node[here], node[there]
        touch = np.argwhere((a >= 0) & (b >= 0))
        step = np.eye(3, dtype=np.int64)[axis]
        for first, second in ((touch, touch + step), (touch + step, touch)):
            one, two = part[node[tuple(first.T)]], part[node[tuple(second.T)]]
            # a cell of a whole column stays stacked on its own plates
            usable = (one != two) & (loose[one] | loose[two]) & (stacked | whole)[tuple(first.T)]
            rows = np.flatnonzero(usable)
            found.append(np.column_stack([one[rows], two[rows], first[rows], second[rows]]))
    table = np.concatenate(found)
    for_part = [np.column_stack([table[:, side], table[:, 2:]])[loose[table[:, side]]] for side in (0, 1)]
    offers = np.concatenate(for_part)
    order = np.lexsort((price[tuple(offers[:, 1:4].T)], offers[:, 0]))
    best = offers[order[np.flatnonzero(np.diff(offers[order, 0], prepend=-1))]]
    return tuple(best[:, 1:4].T), tuple(best[:, 4:7].T)


def _stacked(node: Ints, part: Ints) -> Mask:
    """Return the cells with something of their own part right below or above."""
    there = node >= 0
    above = there[:-1] & there[1:]
    stacked = np.zeros(node.shape, dtype=bool)
    stacked[1:] |= above
    stacked[:-1] |= above
    return stacked


def _visible_faces(colour: np.ndarray) -> Ints:
    """Return how many faces of each cell may be seen, doubled; hidden cells come first."""
    around = np.pad(colour == COLOUR_EMPTY, 1, constant_values=True)
    faces = np.zeros(colour.shape, dtype=np.int64)
    for axis in range(3):
        for side in (-1, 1):
            faces += np.roll(around, side, axis)[1:-1, 1:-1, 1:-1]
    faces[colour == COLOUR_ANY] = -1
    return faces


def _joined(grid: UnitGrid, changed: tuple[Ints, ...], other: tuple[Ints, ...]) -> UnitGrid:
    """Give cells the colour of others, and lay both in plates."""
    shape = (-1, *grid.colour.shape[2:])
    colour, role = grid.colour.copy(), grid.role.copy()
    colour.reshape(shape)[changed] = grid.colour.reshape(shape)[other]
    for cells in (changed, other):
        level, y, x = cells
        solid = grid.solid[level // PLATES_PER_BRICK, :, y, x]
        column = role[level // PLATES_PER_BRICK, :, y, x]
        role[level // PLATES_PER_BRICK, :, y, x] = np.where(solid, np.uint8(Role.PLATE), column)
    return replace(grid, colour=colour, role=role)
