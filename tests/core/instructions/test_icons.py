"""Small signs."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.icons import arrow, turn_sign


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
