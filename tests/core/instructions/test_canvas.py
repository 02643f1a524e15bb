"""What pages are made of."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.instructions.canvas import Paint, lines, moved, polygon, rectangle

INK = Paint(stroke=(1, 2, 3), width=2.0)


def test_shapes_have_their_corners():
    """A rectangle is a closed polygon of four, a table of segments is lines of two points."""
    box = rectangle(1, 2, 3, 4, INK)
    assert box.closed
    assert box.points.tolist() == [[1, 2], [4, 2], [4, 6], [1, 6]]
    assert polygon([(0, 0), (1, 0), (0, 1)], INK).count.tolist() == [3]
    pair = lines(np.array([[[0, 0], [1, 1]], [[2, 2], [3, 3]]]), INK)
    assert not pair.closed
    assert pair.count.tolist() == [2, 2]
    assert pair.points.shape == (4, 2)


def test_what_is_moved_keeps_its_own_units():
    """Things lie at a point, a unit of theirs as large as is said."""
    group = moved([rectangle(0, 0, 1, 1, INK)], 5, 6, 0.5)
    assert group.matrix == (0.5, 0.0, 0.0, 0.5, 5, 6)
