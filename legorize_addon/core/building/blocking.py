"""What must be in place before what: bricks come from above, so those below in a stud column come first."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..arrays import Ints
from ..model import Bricks, Catalogue, Rows, stud_columns


def column_pairs(bricks: Bricks, catalogue: Catalogue) -> Rows:
    """List which bricks lie over which, touching or not.

    Parameters
    ----------
    bricks : Bricks
        n rows that do not overlap.
    catalogue : Catalogue

    Returns
    -------
    (m, 2) int32 array
        Lower and upper brick of each two that follow each other in a stud
        column, each pair once. What lies farther below follows from that.
    """
    brick, columns = stud_columns(bricks, catalogue)
    order = np.lexsort((columns[:, 2], columns[:, 1], columns[:, 0]))
    brick, columns = brick[order], columns[order]
    same = (columns[1:, :2] == columns[:-1, :2]).all(axis=1)
    return unique_pairs(np.stack([brick[:-1][same], brick[1:][same]], axis=1), len(bricks))


def tangled(below: Rows, node: Ints) -> bool:
    """Tell whether bricks that are put on together would have to wait for each other.

    Parameters
    ----------
    below : (m, 2) int32 array
        Lower and upper brick of each two in a stud column, see :func:`column_pairs`.
    node : (n,) int64 array
        Number of what each brick is put on with.

    Returns
    -------
    bool
        Whether two of them lie each over the other.
    """
    n = int(node.max(initial=-1)) + 1
    used = len(np.unique(node))
    return len(np.unique(knots(of_nodes(below, node, n), n)[node])) < used


def knots(before: Rows, n: int) -> Ints:
    """Return the same number for all nodes that each must come before the other, (n,) int32."""
    graph = coo_array((np.ones(len(before), dtype=bool), (before[:, 0], before[:, 1])), shape=(n, n))
    found: Ints = connected_components(graph, directed=True, connection="strong")[1]
    return found


def unique_pairs(pairs: Rows, n: int) -> Rows:
    """Return pairs of numbers below n, each once, sorted, without those of one with itself."""
    pairs = pairs[pairs[:, 0] != pairs[:, 1]]
    key = np.unique(pairs[:, 0].astype(np.int64) * n + pairs[:, 1])
    found: Rows = np.stack(np.divmod(key, max(n, 1)), axis=1).astype(np.int32)
    return found


def of_nodes(pairs: Rows, node: Ints, n_nodes: int) -> Rows:
    """Return pairs of bricks as pairs of the nodes that they belong to."""
    return unique_pairs(node[pairs].astype(np.int32).reshape(-1, 2), n_nodes)
