"""The log of the learned fill: it counts what the machine was asked, and changes nothing."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.lay_learned import lay_learned
from legorize_addon.core.layout.learning.fill_log import FillLog
from legorize_addon.core.layout.learning.grading import Grader
from legorize_addon.core.layout.learning.simulation import Outcome
from tests.core.layout.cells import CATALOGUE, brick_grid
from tests.core.layout.learning.test_grading import some
from tests.core.layout.test_lay import rows

MACHINE = Grader.of(some(), c=8.0, gamma=0.5)


def test_decisions_and_candidates_are_counted():
    """A window with one candidate is no decision; what is chosen is held to be of a grade."""
    log, rng = FillLog(), np.random.default_rng(0)
    energies = np.zeros((3, 4, 4))
    energies[1, 1:] = 5.0
    candidates = np.array([[0, 1, 2, -1], [0, 1, 2, 3], [0, -1, -1, -1]])
    chosen = log.watched(MACHINE)(Outcome(energies, energies[..., 0]), candidates, rng)
    assert chosen[1] == 0
    assert (log.decisions, log.candidates, log.grades.sum()) == (2, 7, 2)
    assert log.vectors == len(MACHINE.vectors)


def test_a_log_changes_no_bricks():
    """With and without it the bricks are the same, and its four sentences have the numbers."""
    grid, log = brick_grid(np.full((2, 5, 6), 4)), FillLog()
    with_log, without = (lay_learned(grid, CATALOGUE, rng=np.random.default_rng(0), log=each) for each in (log, None))
    assert rows(with_log) == rows(without)
    said = log.sentences(grid, 1.25, len(with_log))
    assert [each.split(":")[0] for each in said] == [
        "Step 1, example preparation",
        "Step 2, feature extraction",
        "Step 3, classification model",
        "Step 4, classification",
    ]
    assert "180 cells of 2 layers to be filled and 0 that may be, 1.2 s" in said[0]
    assert f"4 energies of {log.candidates:,} simulated fills" in said[1]
    assert f"{log.decisions:,} decisions for {len(with_log)} bricks" in said[3]
    assert log.decisions > 0
