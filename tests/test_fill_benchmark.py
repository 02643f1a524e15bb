"""The honest table of the learned fill, on a model of two layers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.layout.learning.grade_training import train_grades
from legorize_addon.core.model import ASSETS
from scripts.research.fill_controls import LEARNED, compared, ways
from scripts.research.train_fill import facts
from tests.core.layout.cells import brick_grid
from tests.core.layout.learning.test_grading import some

TEXT = (ASSETS / "fill_svm.csv").read_text(encoding="utf-8")


def test_the_table_of_all_ways():
    """Every way lays the model; what is learned lays it for less than chance and at most as many bricks as needed."""
    grid = brick_grid(np.where(np.random.default_rng(0).random((2, 7, 8)) < 0.85, 4, -2))
    rows = {row["way"]: row for row in compared("model", {"sponge": grid}, TEXT).rows}
    assert list(rows) == [*ways(TEXT), "search, shuffled labels, mean of 3"]
    assert all(row["to_bound_median"] >= 1 for row in rows.values())
    assert rows[LEARNED]["SVM_J_saves"] == 0
    assert rows["random placements"]["SVM_J_saves"] > 0.2
    assert rows["search, chance"]["SVM_J_saves"] > 0.05


def test_provenance():
    """The file says how many candidates were judged, and every pair of C and gamma that was tried."""
    trained = train_grades(some(90), np.random.default_rng(0), costs=[1.0], gammas=[0.5])
    told = facts(3, 2, some(30), replace(trained, grid={(1.0, 0.5): 0.7, (8.0, 0.5): 0.8}))
    assert told["judged"].startswith("30 candidates, 10 10 10")
    assert told["shares of right answers by (C, gamma)"] == "(1, 0.5) 0.700, (8, 0.5) 0.800"
    assert told["seed"] == "3"
