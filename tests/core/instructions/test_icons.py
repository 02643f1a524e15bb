"""Small signs."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.icons import arrow, hold_sign, turn_sign


@pytest.mark.parametrize("over", [False, True])
def test_arrows_that_go_round_stay_in_their_place(over):
    """The ring lies within its radius, longer along the axis that it turns things about."""
    ring, head = turn_sign(10, 20, 4, over=over)
    wide, high = np.ptp(ring.points, axis=0)
    assert (wide < high) == over
    assert (np.abs(ring.points - (10, 20)) <= 4 + 1e-9).all()
    assert head.closed


def test_straight_arrows_point_to_their_end():
    """The tip of the head lies beyond the shaft, in its direction."""
    shaft, head = arrow((0, 10), (0, 0))
    assert shaft.points[0].tolist() == [0, 10]
    assert head.points[0, 1] < shaft.points[1, 1] < 10
    assert head.points[0, 0] == pytest.approx(0)


def test_two_arrows_hold_a_brick():
    """They point to each other, and end outside of the brick between them."""
    brick, _, left, _, right = hold_sign(10, 20, 5)
    assert left.points[0, 0] < brick.points[:, 0].min() < 10 < brick.points[:, 0].max() < right.points[0, 0]
    assert left.points[:, 0].argmax() == right.points[:, 0].argmin() == 0
