"""Which bricks must be in place before which."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.blocking import column_pairs, knots, of_nodes, tangled, unique_pairs
from tests.core.building.heaps import cells_of, heap
from tests.core.standing import CATALOGUE, table


def test_neighbours_in_a_column_touching_or_not():
    """Of three bricks over each other each knows the next, across a gap as well; the third follows from that."""
    bricks = table(("3001", 0, 0, 9), ("3003", 0, 0, 0), ("3004", 2, 0, 0), ("3005", 0, 0, 3))
    assert column_pairs(bricks, CATALOGUE).tolist() == [[1, 0], [1, 3], [2, 0], [3, 0]]


def test_pairs_of_nodes_are_told_once():
    """Pairs of the same nodes fall together, and a node is not before itself."""
    pairs = np.array([[0, 1], [0, 2], [1, 2], [2, 0]], np.int32)
    assert of_nodes(pairs, np.array([0, 1, 1]), 2).tolist() == [[0, 1], [1, 0]]
    assert unique_pairs(pairs[[1, 0, 1]], 3).tolist() == [[0, 1], [0, 2]]


def test_what_waits_for_each_other_is_tangled():
    """Two pieces, of which each lies over the other, wait for each other; one over the other does not."""
    below = np.array([[0, 1], [2, 3], [4, 5]], np.int32)
    assert tangled(below, np.array([0, 4, 4, 0, 2, 3]))
    assert tangled(below, np.array([0, 1, 2, 3, 5, 4])[[0, 1, 1, 0, 5, 4]])
    assert not tangled(below, np.array([0, 4, 0, 4, 2, 3]))
    assert not tangled(below, np.arange(6))
    assert not tangled(below, np.array([0, 0, 1, 1, 9, 9]))


def over(bricks):
    """Return which brick lies somewhere over which, next in a column, cell by cell."""
    at = {cell: row for row, cells in enumerate(cells_of(bricks)) for cell in cells}
    found = set()
    for (x, y, z), row in at.items():
        higher = [at[cell] for cell in ((x, y, k) for k in range(z + 1, 20)) if cell in at]
        found |= {(row, higher[0])} - {(row, row)} if higher else set()
    return found


def before_all(pairs, n):
    """Return what each of n things must be in place before, through others too."""
    after = {each: {each} for each in range(n)}
    for _ in range(n):
        for one, other in pairs:
            after[one] |= after[other]
    return after


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_pairs_are_those_of_the_cells(seed):
    """Each column is walked from below; bricks of some nodes wait for each other if each is over the other."""
    bricks, rng = heap(seed), np.random.default_rng(seed)
    bricks = bricks.take(rng.permutation(len(bricks)))
    found = column_pairs(bricks, CATALOGUE)
    assert [tuple(pair) for pair in found.tolist()] == sorted(over(bricks))
    n = int(rng.integers(1, len(bricks) + 1))
    node = rng.integers(0, n, len(bricks))
    edges = {(int(node[a]), int(node[b])) for a, b in over(bricks)}
    after = before_all(edges, n)
    assert [tuple(pair) for pair in of_nodes(found, node, n).tolist()] == sorted((a, b) for a, b in edges if a != b)
    waiting = [(a, b) for a in set(node.tolist()) for b in after[a] if b != a and a in after[b]]
    assert tangled(found, node) == bool(waiting)
    knot = knots(of_nodes(found, node, n), n)
    assert all((knot[a] == knot[b]) == (b in after[a] and a in after[b]) for a in range(n) for b in range(n))
