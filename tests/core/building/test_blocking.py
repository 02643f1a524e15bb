"""Which bricks must be in place before which."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.blocking import column_pairs, of_nodes, tangled, unique_pairs
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
