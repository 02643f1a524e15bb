"""Where brick columns must be laid as plates, so that parts can be joined.

Bricks are joined by their studs: cells side by side are joined only by a part that covers both. So a plate that sticks
out from a wall of bricks is joined to nothing, unless the wall is made of plates where the plate enters.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Ints, Mask
from ..model import Role, Touching, UnitGrid, agree, brick_columns, every_plate

_ROUNDS: Final = 8
"""Largest number of rounds: each joins what touches the parts joined before."""


def add_plate_seams(grid: UnitGrid) -> UnitGrid:
    """Lay brick columns in plates where nothing else can join what touches them.

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


def parts_of(touching: Touching, colour: NDArray[np.int16], whole: Mask) -> tuple[Ints, Mask]:
    """Return which cells can be joined: stacked ones, or cells side by side that one brick or plate can cover.

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
    # a part across two cells joins both if each has something below or above
    strong = stacked[sideways].all(axis=0)
    ends = np.concatenate([sideways[:, ~strong], sideways[::-1, ~strong]], axis=1)
    hanging = ends[:, ~stacked[ends[0]] & stacked[ends[1]]]
    # a cell that has neither is joined to one neighbour and passes nothing on
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
