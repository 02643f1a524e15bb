"""Bodies that move as one."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.statics.lumps import grown, lumps_around, stiff_lumps, touching
from tests.core.standing import equations, table


def test_lumps_hang_together() -> None:
    """Of a column with one loose brick in it and a brick beside it, what is below, above and beside are lumps."""
    bricks = table(*(("3003", 0, 0, 3 * level) for level in range(5)), ("3003", 8, 0, 0))
    near = touching(equations(bricks))
    assert lumps_around(near, np.arange(6) == 2).tolist() == [0, 0, 1, 2, 2, 3]
    assert grown(near, np.arange(6) == 2).tolist() == [False, True, True, True, False, False]
    assert len(np.unique(lumps_around(near, np.ones(6, dtype=bool)))) == 6


def test_what_does_not_move_against_each_other_is_a_lump() -> None:
    """A column whose upper half turns is two lumps; at rest it is one."""
    whole = equations(table(*(("3003", 0, 0, 3 * level) for level in range(4))))
    turning = np.zeros((4, 6))
    assert stiff_lumps(whole, turning.reshape(-1)).tolist() == [0, 0, 0, 0]
    # about an axis along x through the origin
    turning[2:, 3] = 1
    turning[2:, :3] = np.cross((1, 0, 0), whole.middle[2:])
    assert stiff_lumps(whole, turning.reshape(-1)).tolist() == [0, 0, 1, 1]
