"""How the bricks are connected: cells, collisions, stud contacts, components.

A brick sits on another one when a cell of its underside lies on a cell of the
other's top, and there are a stud and a socket: none sits on a tile or on the fall
of a slope, and no baseplate sits on anything. Bricks that are connected by such contacts form a component; a
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
from .catalogue import Catalogue
from .parts import Part
from .profiles import centre
from .squares import Rows as Rows
from .squares import column_facts as column_facts
from .squares import off_square, oriented
from .squares import stud_columns as stud_columns
from .squares import stud_middles as stud_middles


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
        Cells that more than one brick fills; of bricks half a stud off each other quarters of cells, and the studs of
        one that the other stands on.
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
    brick, squares = stud_columns(bricks, catalogue)
    facts = column_facts(bricks, catalogue)
    low = squares.min(axis=0, initial=0).astype(np.int32)
    owner, collisions = _owners(brick, squares - low, facts.high - facts.low)
    tops = squares - low
    tops[:, 2] += facts.high - facts.low
    above = owner[tops[:, 2], tops[:, 1], tops[:, 0]]
    held = clutches(bricks, catalogue, brick, above, squares[:, :2])
    if bricks.halved:
        collisions = collisions_between_grids(bricks, catalogue)
    pairs, studs = _contacts(brick, np.where(held, above, NOBODY), len(bricks))
    component = components(pairs, len(bricks))
    return ContactGraph(
        owner[:-1],
        low,
        collisions,
        pairs,
        studs,
        component,
        _grounded(component, brick[facts.foot], squares[facts.foot, 2]),
    )


def clutches(bricks: Bricks, catalogue: Catalogue, lower: Rows, upper: Rows, squares: Rows) -> Mask:
    """Return whether bricks would hold others that lie on them in a stud square.

    Parameters
    ----------
    bricks : Bricks
        The model.
    catalogue : Catalogue
        Whose parts the bricks are.
    lower, upper : (k,) int32 arrays
        Rows of bricks; what ``NOBODY`` gets has no meaning.
    squares : (k, 2) int32 array
        The stud squares, x and y.

    Returns
    -------
    (k,) bool array
        Whether the lower brick has a stud there and the upper one a socket.
    """
    if not len(bricks):
        return np.zeros(len(lower), dtype=bool)
    stud, socket, place = _places(catalogue.parts)
    held: Mask = np.ones(len(lower), dtype=bool)
    for rows, there in ((lower, stud), (upper, socket)):
        kind = bricks.part[rows].astype(np.intp) * 4 + bricks.turn[rows]
        x, y = (np.asarray(squares) - bricks.corner[rows, :2]).T
        start, wide, deep = place[kind].T
        within = (x >= 0) & (x < wide) & (y >= 0) & (y < deep)
        held &= there[np.where(within, start + x * deep + y, 0)] & within
    if bricks.half is not None:
        beyond = (
            bricks.half[lower].astype(np.int64) + off_square(catalogue.parts)[bricks.part[lower], bricks.turn[lower]]
        )
        held &= (beyond == bricks.half[upper]).all(axis=1)
    return held


def collisions_between_grids(bricks: Bricks, catalogue: Catalogue) -> int:
    """Count the quarters of cells that more than one brick fills, and the studs that stand in a brick of another grid.

    A brick half a stud beyond its corner fills halves of the cells of those that are not.
    """
    brick, squares = stud_columns(bricks, catalogue)
    facts, half = column_facts(bricks, catalogue), bricks.shift[:, :2] * 2
    quarters = 2 * squares[:, None].astype(np.int32)
    quarters = np.repeat(quarters, 4, axis=1)
    quarters[..., :2] += np.array([(0, 0), (1, 0), (0, 1), (1, 1)]) + half[brick].astype(np.int32)[:, None]
    quarters[..., 2] //= 2
    fine = quarters.reshape(-1, 3)
    low = fine.min(axis=0, initial=0)
    owner, collisions = _owners(np.repeat(brick, 4), fine - low, np.repeat(facts.high - facts.low, 4))
    tops = quarters - low
    tops[..., 2] += (facts.high - facts.low)[:, None]
    above = owner[tops[..., 2], tops[..., 1], tops[..., 0]]
    # under the middle of a jumper's stud all is as it should be: its square alone does not say where that is
    plain = facts.stud & ~np.array([part.jumper for part in catalogue.parts])[bricks.part[brick]]
    other = (above != NOBODY) & (half[np.maximum(above, 0)] != half[brick][:, None]).any(axis=2)
    return collisions + int(np.count_nonzero(other.any(axis=1) & plain))


def middles(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middle of the weight of each brick seen from above, x and y in studs, (n, 2) float64."""
    return centres(bricks, catalogue)[:, :2]


def centres(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the centre of mass of each brick, x and y in studs and z in plates, (n, 3) float64."""
    return bricks.corner + bricks.shift + _centres(catalogue.parts)[bricks.part, bricks.turn]


@lru_cache
def _centres(parts: tuple[Part, ...]) -> Floats:
    """Return the centre of every part at every turn from its corner, (n_parts, 4, 3)."""
    return np.array([[centre(part, turn) for turn in range(4)] for part in parts])


@lru_cache
def _places(parts: tuple[Part, ...]) -> tuple[Mask, Mask, NDArray[np.intp]]:
    """Return studs and sockets by place in the boxes of oriented parts, one by one; start and sides of each."""
    studs: list[Mask] = []
    sockets: list[Mask] = []
    place, start = [], 0
    for each in oriented(parts):
        wide, deep = (each.xy.max(axis=0) + 1).tolist()
        for made, there in ((studs, each.stud), (sockets, each.socket)):
            box = np.zeros((wide, deep), bool)
            box[each.xy[:, 0], each.xy[:, 1]] = there
            made.append(box.reshape(-1))
        place.append((start, wide, deep))
        start += wide * deep
    return np.concatenate(studs), np.concatenate(sockets), np.array(place)


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


def _grounded(component: Rows, brick: Rows, level: Rows) -> Mask:
    """Return which bricks are in components that stand on the lowest plate, given bricks and levels of their feet."""
    standing = np.zeros(len(component), dtype=bool)
    standing[component[brick[level == level.min(initial=np.iinfo(np.int32).max)]]] = True
    grounded: Mask = standing[component]
    return grounded
