"""How the bricks are connected: cells, collisions, stud contacts, components.

A brick sits on another one when a cell of its underside lies on a cell of the
other's top, and there are studs to clutch: none sits on a tile, and no baseplate
sits on anything. Bricks that are connected by such contacts form a component; a
component that stands on the lowest plate is grounded, every other one floats.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Floats, Mask
from .bricks import NOBODY as NOBODY
from .bricks import Bricks
from .catalogue import Catalogue, footprint

Rows = NDArray[np.int32]


@dataclass(frozen=True, slots=True, eq=False)
class ContactGraph:
    """The bricks of a model as cells and as a graph.

    Attributes
    ----------
    owner : (n_z, n_y, n_x) int32 array
        Row of the brick in each cell (a stud square, a plate high), ``NOBODY``
        where there is none. Where bricks collide the lowest row is named.
    low : (3,) int32 array
        Cell of the grid (x, y, z) that is ``owner[0, 0, 0]``; zero unless a
        brick lies at negative coordinates.
    collisions : int
        Cells that more than one brick fills.
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact, sorted, each pair once.
    studs : (n_pairs,) int32 array
        Studs that the two share.
    component : (n,) int32 array
        Number of the component of each brick.
    grounded : (n,) bool array
        Whether the component of the brick stands on the lowest plate.
    """

    owner: Rows
    low: Rows
    collisions: int
    pairs: Rows
    studs: Rows
    component: Rows
    grounded: Mask

    @property
    def n_components(self) -> int:
        """Number of components."""
        return int(self.component.max(initial=NOBODY)) + 1

    @property
    def n_floating(self) -> int:
        """Number of bricks that hang in the air."""
        return int(np.count_nonzero(~self.grounded))


def contact_graph(bricks: Bricks, catalogue: Catalogue) -> ContactGraph:
    """Find out which bricks touch, collide and stand on the ground.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.

    Returns
    -------
    ContactGraph
        Cells, contacts and components.
    """
    brick, columns = stud_columns(bricks, catalogue)
    heights = catalogue.height[bricks.part].astype(np.int32)
    low = columns.min(axis=0, initial=0).astype(np.int32)
    owner, collisions = _owners(brick, columns - low, heights[brick])
    tops = columns - low
    tops[:, 2] += heights[brick]
    above = owner[tops[:, 2], tops[:, 1], tops[:, 0]]
    pairs, studs = _contacts(brick, np.where(clutches(bricks, catalogue, brick, above), above, NOBODY), len(bricks))
    component = components(pairs, len(bricks))
    return ContactGraph(owner[:-1], low, collisions, pairs, studs, component, _grounded(component, bricks.corner[:, 2]))


def stud_columns(bricks: Bricks, catalogue: Catalogue) -> tuple[Rows, Rows]:
    """List the stud squares that the bricks cover.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.

    Returns
    -------
    brick : (n_columns,) int32 array
        Row of the brick, ascending: a 2 x 4 brick appears eight times.
    columns : (n_columns, 3) int32 array
        Stud square (x, y) and lowest plate z of the brick there.
    """
    squares, size = _squares(catalogue)
    kind = bricks.part.astype(np.intp) * 4 + bricks.turn
    count = size[kind]
    brick = np.repeat(np.arange(len(bricks), dtype=np.int32), count)
    nth = np.arange(len(brick)) - np.repeat(np.cumsum(count) - count, count)
    columns = bricks.corner[brick]
    columns[:, :2] += squares[kind[brick], nth]
    return brick, columns


def clutches(bricks: Bricks, catalogue: Catalogue, lower: Rows, upper: Rows) -> Mask:
    """Return whether the stud squares of a brick would hold another one that lies on it.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.
    lower, upper : (k,) int32 arrays
        Rows of bricks; what ``NOBODY`` gets has no meaning.

    Returns
    -------
    (k,) bool array
    """
    held: Mask = catalogue.studs[bricks.part][lower] & catalogue.sockets[bricks.part][upper]
    return held


def middles(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middle of the stud squares of each brick, x and y in studs, (n, 2) float64."""
    brick, columns = stud_columns(bricks, catalogue)
    n_columns = np.bincount(brick, minlength=len(bricks))
    across = [np.bincount(brick, columns[:, axis] + 0.5, len(bricks)) / n_columns for axis in (0, 1)]
    return np.stack(across, axis=1)


@lru_cache
def _squares(catalogue: Catalogue) -> tuple[Rows, NDArray[np.intp]]:
    """Return the stud squares of every part at every turn, (4 n_parts, most, 2), and how many there are."""
    covered = [footprint(part, turn) for part in catalogue.parts for turn in range(4)]
    size = np.array([len(each) for each in covered])
    squares = np.zeros((len(covered), size.max(), 2), dtype=np.int32)
    for row, each in enumerate(covered):
        squares[row, : len(each)] = each
    return squares, size


def stacked(pairs: Rows, n: int) -> tuple[list[list[int]], list[list[int]]]:
    """List what lies right below and right above each brick.

    Parameters
    ----------
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.
    n : int
        Number of bricks.

    Returns
    -------
    below, above : list of list of int
        Rows of the neighbours of each brick, in the order of the pairs.
    """
    below: list[list[int]] = [[] for _ in range(n)]
    above: list[list[int]] = [[] for _ in range(n)]
    for lower, upper in pairs.tolist():
        below[upper].append(lower)
        above[lower].append(upper)
    return below, above


def components(pairs: Rows, n: int) -> Rows:
    """Label the connected components.

    Parameters
    ----------
    pairs : (n_pairs, 2) int32 array
        Bricks that touch.
    n : int
        Number of bricks.

    Returns
    -------
    (n,) int32 array
        Number of the component of each brick.
    """
    graph = coo_array((np.ones(len(pairs), dtype=bool), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    component: Rows = connected_components(graph, directed=False)[1].astype(np.int32)
    return component


def _owners(brick: Rows, columns: Rows, heights: Rows) -> tuple[Rows, int]:
    """Fill the cells; one empty plate more on top, so that every stud can look upwards."""
    shape = columns[:, ::-1].max(axis=0, initial=-1) + 1
    shape[0] = (columns[:, 2] + heights).max(initial=0) + 1
    owner = np.full(shape, NOBODY, dtype=np.int32)
    flat = owner.reshape(-1)
    above = np.arange(heights.sum()) - np.repeat(np.cumsum(heights) - heights, heights)
    base = np.ravel_multi_index(tuple(columns[:, ::-1].T), tuple(shape))
    cells = np.repeat(base, heights) + above * (shape[1] * shape[2])
    claimant = np.repeat(brick, heights)
    # where bricks collide the order of writing is arbitrary: a brick whose row was overwritten collides
    flat[cells] = claimant
    lost = flat[cells] != claimant
    np.minimum.at(flat, cells[lost], claimant[lost])
    return owner, len(np.unique(cells[lost]))


def _contacts(lower: Rows, upper: Rows, n: int) -> tuple[Rows, Rows]:
    """Count the studs of each pair of a lower and an upper brick."""
    touching = (upper != NOBODY) & (upper != lower)
    # one number a pair, so that equal pairs are counted by a sort
    key = lower[touching].astype(np.int64) * n + upper[touching]
    pair, studs = np.unique(key, return_counts=True)
    return np.stack(np.divmod(pair, max(n, 1)), axis=1).astype(np.int32), studs.astype(np.int32)


def _grounded(component: Rows, level: Rows) -> Mask:
    """Return which bricks are in components that stand on the lowest plate."""
    standing = np.zeros(len(level), dtype=bool)
    standing[component[level == level.min(initial=np.iinfo(np.int32).max)]] = True
    grounded: Mask = standing[component]
    return grounded
