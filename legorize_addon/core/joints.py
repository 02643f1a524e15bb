"""Where brick columns have to be laid as plates, so that parts can hold to each other.

Bricks hold by their studs: what lies beside each other is joined only by a part
that covers both. A part is a brick or a plate, so a plate that sticks out from a
wall of bricks holds to nothing, unless the wall is made of plates where it
enters.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .model import COLOUR_ANY, Ints, Mask, Role, UnitGrid
from .units import PLATES_PER_BRICK

_ROUNDS: Final = 8
"""Most rounds: each joins what touches what the rounds before have joined."""


def brick_columns(grid: UnitGrid) -> tuple[Mask, NDArray[np.int16]]:
    """Tell which cell columns are laid in bricks.

    Parameters
    ----------
    grid : UnitGrid

    Returns
    -------
    brick : (n_layers, n_y, n_x) bool array
        Columns of three solid plates of one colour (cells of any colour agree
        with every other), except those that have the role of plates.
    colour : (n_layers, n_y, n_x) int16 array
        Their colour, or ``COLOUR_ANY``.
    """
    top = grid.colour.max(axis=1)
    lowest = np.where(grid.colour == COLOUR_ANY, np.iinfo(np.int16).max, grid.colour).min(axis=1)
    # free colours are -1 at the top and the greatest at the bottom: they never disagree
    brick: Mask = grid.solid.all(axis=1) & (lowest >= top) & (grid.role != Role.PLATE).all(axis=1)
    return brick, top


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """The solid cells of a grid and which of them touch.

    Attributes
    ----------
    cell : (n,) int64 array
        Flat index of each solid cell among all plates, rising.
    column : (n,) int64 array
        The lowest solid cell of the brick's height that each belongs to, by row of `cell`.
    upright, sideways : (2, m) int64 arrays
        Pairs of rows that are stacked, and that lie side by side.
    """

    cell: Ints
    column: Ints
    upright: Ints
    sideways: Ints

    @classmethod
    def of(cls, solid: Mask) -> Touching:
        """List the solid cells, (n_layers, 3, n_y, n_x), and their neighbours."""
        cell = np.flatnonzero(solid)
        row = np.full(solid.size + solid[0, 0].size, -1, dtype=np.int64)
        row[cell] = np.arange(len(cell))
        n_y, n_x = solid.shape[2:]
        above, behind, right = (row[cell + step] for step in (n_x * n_y, n_x, 1))
        right[(cell + 1) % n_x == 0] = -1
        behind[cell // n_x % n_y == n_y - 1] = -1
        here = np.arange(len(cell))
        upright, *sideways = (np.stack([here, there])[:, there >= 0] for there in (above, behind, right))
        column = here.copy()
        same = upright[:, cell[upright[1]] // (n_x * n_y) % PLATES_PER_BRICK != 0]
        for _ in range(PLATES_PER_BRICK - 1):
            column[same[1]] = column[same[0]]
        return cls(cell, column, upright, np.concatenate(sideways, axis=1))

    def laid(self, colour: NDArray[np.int16], whole: Mask) -> NDArray[np.int16]:
        """Return the colours that cells are laid in: all of a brick in the one that its cells agree on, (n,)."""
        of_column = np.full(len(colour), COLOUR_ANY, dtype=np.int16)
        np.maximum.at(of_column, self.column, colour)
        return np.where(whole, of_column[self.column], colour)


def with_joints(grid: UnitGrid) -> UnitGrid:
    """Lay brick columns in plates where nothing else can hold what touches them.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.

    Returns
    -------
    UnitGrid
        Every cell that is laid in plates has the role ``PLATE``.
    """
    brick, _ = brick_columns(grid)
    if not (grid.solid & ~brick[:, None]).any():
        return grid
    touching = Touching.of(grid.solid)
    colour = grid.colour.reshape(-1)[touching.cell]
    whole = every_plate(brick).reshape(-1)[touching.cell]
    for _ in range(_ROUNDS):
        opened = _opened(touching, colour, whole)
        if not opened.any():
            break
        whole &= ~opened
    role = grid.role.copy()
    role.reshape(-1)[touching.cell[~whole]] = Role.PLATE
    return replace(grid, role=role)


def every_plate(columns: NDArray[Any]) -> NDArray[Any]:
    """Repeat what holds of columns, (n_layers, n_y, n_x), for their plates, (n_layers, 3, n_y, n_x)."""
    layers, rows, across = columns.shape
    return np.broadcast_to(columns[:, None], (layers, PLATES_PER_BRICK, rows, across))


def parts_of(touching: Touching, colour: NDArray[np.int16], whole: Mask) -> tuple[Ints, Mask]:
    """Tell which cells can hold to each other: what is stacked, or side by side and coverable by one brick or plate.

    Parameters
    ----------
    touching : Touching
    colour : (n,) int16 array
        Colour of each cell; a brick has the one that its cells agree on.
    whole : (n,) bool array
        Whether each cell is laid in a brick.

    Returns
    -------
    part : (n,) int64 array
    loose : (n_parts,) bool array
        All parts but the largest.
    """
    node = np.where(whole, touching.column, np.arange(len(whole)))
    upright = node[touching.upright]
    stacked = np.zeros(len(whole), dtype=bool)
    stacked[upright[:, upright[0] != upright[1]].ravel()] = True
    first, second = touching.sideways
    laid = touching.laid(colour, whole)
    cover = (whole[first] == whole[second]) & agree(laid[first], laid[second])
    sideways = node[touching.sideways[:, cover]]
    # a part across two cells holds to both if each has something below or above
    strong = stacked[sideways].all(axis=0)
    ends = np.concatenate([sideways[:, ~strong], sideways[::-1, ~strong]], axis=1)
    hanging = ends[:, ~stacked[ends[0]] & stacked[ends[1]]]
    # what has neither holds to one neighbour and passes nothing on
    hanging = hanging[:, np.unique(hanging[0], return_index=True)[1]]
    pairs = np.concatenate([upright, sideways[:, strong], hanging], axis=1)
    graph = coo_array((np.ones(pairs.shape[1], dtype=bool), tuple(pairs)), shape=(len(whole), len(whole)))
    _, part = connected_components(graph, directed=False)
    _, part = np.unique(part[node], return_inverse=True)
    loose = np.ones(int(part.max(initial=0)) + 1, dtype=bool)
    loose[np.bincount(part.ravel(), minlength=1).argmax()] = False
    return part.ravel(), loose


def _opened(touching: Touching, colour: NDArray[np.int16], whole: Mask) -> Mask:
    """Return the cells of brick columns beside plates of another part, one of both being loose, (n,)."""
    part, loose = parts_of(touching, colour, whole)
    first, second = touching.sideways
    touch = (whole[first] != whole[second]) & (part[first] != part[second])
    touch &= (loose[part[first]] | loose[part[second]]) & agree(colour[first], colour[second])
    found = np.zeros(len(whole), dtype=bool)
    found[touching.column[touching.sideways[:, touch]].ravel()] = True
    opened: Mask = found[touching.column] & whole
    return opened


def agree(first: NDArray[np.int16], second: NDArray[np.int16]) -> Mask:
    """Return which pairs of colours one part can have: equal ones, and any with ``COLOUR_ANY``."""
    same: Mask = (first == second) | (first == COLOUR_ANY) | (second == COLOUR_ANY)
    return same
