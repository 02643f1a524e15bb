"""Moves and the steps of bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.moves import Action, Moves
from legorize_addon.core.model.bricks import NOBODY


def test_step_of_a_brick_is_that_of_its_placing():
    """Removing a brick later does not change its step; one that is never placed has none."""
    moves = Moves(
        action=np.array([Action.PLACE, Action.PLACE, Action.JOIN, Action.REMOVE], np.uint8),
        brick=np.array([2, 0, NOBODY, 2], np.int32),
        piece=np.zeros(4, np.int16),
        submodel=np.zeros(4, np.int32),
        pressed=np.zeros(4, bool),
        step=np.array([0, 1, 2, 3], np.int32),
    )
    assert moves.step_of(4).tolist() == [1, NOBODY, 0, NOBODY]
    assert len(moves) == 4
