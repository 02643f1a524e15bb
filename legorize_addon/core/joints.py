"""Where brick columns have to be laid as plates, so that parts can hold to each other.

Bricks hold by their studs: what lies beside each other is joined only by a part
that covers both. A part is a brick or a plate, so a plate that sticks out from a
wall of bricks holds to nothing, unless the wall is made of plates where it
enters.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from .model import COLOUR_ANY, Ints, Mask, Role, UnitGrid
from .units import PLATES_PER_BRICK

_ROUNDS: Final = 8
"""Most rounds: each joins what touches what the rounds before have joined."""


def brick_columns(grid: UnitGrid) -> tuple[Mask, np.ndarray]:
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
    for _ in range(_ROUNDS):
        opened = brick & _opened(grid, brick)
        if not opened.any():
            break
        brick &= ~opened
    role = np.where(grid.solid & ~brick[:, None], np.uint8(Role.PLATE), grid.role)
    return replace(grid, role=role)


def _opened(grid: UnitGrid, brick: Mask) -> Mask:
    """Return the brick columns beside plates of another part, one of both being loose, (n_layers, n_y, n_x)."""
    node, n_nodes = nodes(grid.solid, brick)
    part, loose = parts_of(grid, brick, node, n_nodes)
    shape = node.shape
    colour, plates = grid.colour.reshape(shape), np.repeat(brick, PLATES_PER_BRICK, axis=0)
    found = np.zeros(shape, dtype=bool)
    for axis in (1, 2):
        here, there = beside(shape, axis)
        a, b = node[here], node[there]
        touch = (a >= 0) & (b >= 0) & (plates[here] != plates[there]) & _agree(colour[here], colour[there])
        touch &= (part[a] != part[b]) & (loose[part[a]] | loose[part[b]])
        found[here] |= touch
        found[there] |= touch
    return found.reshape(grid.solid.shape).any(axis=1)


def nodes(solid: Mask, brick: Mask) -> tuple[Ints, int]:
    """Give a number to each thing that is laid apart: brick columns, and single cells elsewhere.

    Parameters
    ----------
    solid : (n_layers, 3, n_y, n_x) bool array
    brick : (n_layers, n_y, n_x) bool array
        Columns that are laid in bricks.

    Returns
    -------
    node : (n_plates, n_y, n_x) int64 array
        -1 where there is nothing.
    n_nodes : int
    """
    first = solid & ~brick[:, None]
    first[:, 0] |= brick
    number = np.cumsum(first.ravel()).reshape(first.shape) - 1
    node = np.where(solid, np.where(brick[:, None], number[:, :1], number), -1)
    return node.reshape(-1, *solid.shape[2:]), int(first.sum())


def parts_of(grid: UnitGrid, brick: Mask, node: Ints, n_nodes: int) -> tuple[Ints, Mask]:
    """Tell which nodes can hold to each other: what is stacked, or side by side and coverable by one brick or plate.

    Parameters
    ----------
    grid : UnitGrid
    brick : (n_layers, n_y, n_x) bool array
    node : (n_plates, n_y, n_x) int64 array
    n_nodes : int

    Returns
    -------
    part : (n_nodes,) int64 array
    loose : (n_parts,) bool array
        All parts but the largest.
    """
    upright, sideways = _contacts(grid, brick, node)
    stacked = np.zeros(n_nodes, dtype=bool)
    stacked[upright.ravel()] = True
    # a part across two cells holds to both if each has something below or above
    strong = stacked[sideways].all(axis=0)
    ends = np.concatenate([sideways[:, ~strong], sideways[::-1, ~strong]], axis=1)
    hanging = ends[:, ~stacked[ends[0]] & stacked[ends[1]]]
    # what has neither holds to one neighbour and passes nothing on
    hanging = hanging[:, np.unique(hanging[0], return_index=True)[1]]
    pairs = np.concatenate([upright, sideways[:, strong], hanging], axis=1)
    graph = coo_array((np.ones(pairs.shape[1], dtype=bool), tuple(pairs)), shape=(n_nodes, n_nodes))
    n_parts, part = connected_components(graph, directed=False)
    loose = np.ones(n_parts, dtype=bool)
    loose[np.bincount(part).argmax()] = False
    return part.astype(np.int64), loose


def _contacts(grid: UnitGrid, brick: Mask, node: Ints) -> tuple[Ints, Ints]:
    """Return the pairs of nodes that are stacked, and those side by side that one part can cover, (2, n) each."""
    colour, plates = grid.colour.reshape(node.shape), np.repeat(brick, PLATES_PER_BRICK, axis=0)
    pairs = []
    for axis in range(3):
        here, there = beside(node.shape, axis)
        a, b = node[here], node[there]
        join = (a >= 0) & (b >= 0) & (a != b)
        if axis > 0:
            join &= (plates[here] == plates[there]) & _agree(colour[here], colour[there])
        pairs.append(np.stack([a[join], b[join]]))
    return pairs[0], np.concatenate(pairs[1:], axis=1)


def _agree(first: np.ndarray, second: np.ndarray) -> Mask:
    agree: Mask = (first == second) | (first == COLOUR_ANY) | (second == COLOUR_ANY)
    return agree


def beside(shape: tuple[int, ...], axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Return the slices of the cells of an array, and of their next cells along an axis."""
    here = tuple(slice(None, -1) if each == axis else slice(None) for each in range(len(shape)))
    there = tuple(slice(1, None) if each == axis else slice(None) for each in range(len(shape)))
    return here, there
