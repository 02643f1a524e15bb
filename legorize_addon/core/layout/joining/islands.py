"""Which bricks are loose: apart from others to which cells of one colour, or stacking, could join them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...arrays import Mask
from ...model import COLOUR_EMPTY, NOBODY, Bricks, Catalogue, ContactGraph, agree, components, stud_columns
from ..problem import Plane, Rows


@dataclass(frozen=True, slots=True, eq=False)
class Islands:
    """The sets of cells that bricks could hold together, by stacking and by lying across one colour.

    Attributes
    ----------
    node : (n_z, n_y, n_x) int32 array
        What each cell belongs to: a component of bricks, itself, or ``NOBODY``.
    of_node : (n_nodes,) int32 array
        The island of each node.
    """

    node: Rows
    of_node: Rows

    @classmethod
    def of(cls, colour: Plane, owner: Rows, component: Rows) -> Islands:
        """Find the islands of cells, given their colours, the brick in each, and the component of each brick."""
        node = np.append(component, np.int32(NOBODY))[owner]
        free = np.flatnonzero((owner == NOBODY) & (colour != COLOUR_EMPTY))
        n_known = int(component.max(initial=NOBODY)) + 1
        # the cells of one component are joined already
        node.reshape(-1)[free] = np.arange(n_known, n_known + len(free))
        pairs = np.concatenate([_meeting(node.reshape(-1), colour, axis) for axis in range(3)])
        return cls(node, components(pairs, n_known + len(free)))


def _meeting(node: Rows, colour: Plane, axis: int) -> Rows:
    """Return pairs of different nodes, (n, 2), whose cells follow each other along an axis and can be held together."""
    length, step = colour.shape[axis], int(np.prod(colour.shape[axis + 1 :]))
    cell = np.flatnonzero(node[:-step] != node[step:])
    cell = cell[(node[cell] != NOBODY) & (node[cell + step] != NOBODY) & (cell // step % length != length - 1)]
    if axis > 0:
        cell = cell[agree(colour.reshape(-1)[cell], colour.reshape(-1)[cell + step])]
    return np.stack([node[cell], node[cell + step]], axis=1)


def loose_bricks(bricks: Bricks, links: ContactGraph, islands: Islands, catalogue: Catalogue) -> Mask:
    """Return which bricks are not in the main component of their island: the largest one, on the ground if any is."""
    brick, column = stud_columns(bricks, catalogue)
    component, first, size = np.unique(links.component, return_index=True, return_counts=True)
    x, y, z = column[np.searchsorted(brick, first)].T
    island = islands.of_node[islands.node[z + 1, y, x]]
    order = np.lexsort((size, links.grounded[first], island))
    main = np.append(np.diff(island[order]) > 0, True)
    return ~np.isin(links.component, component[order[main]])
