"""The honest table of the learned fill, on a model of two layers."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from legorize_addon.core.layout.learning.grade_training import train_grades
from legorize_addon.core.model import ASSETS
from scripts.benchmarks.kept import Kept
from scripts.research import fill_report
from scripts.research.fill_controls import LEARNED, compared, ways
from scripts.research.fill_report import Asked, judged_fill, summary
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


def test_a_report_goes_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """A report that has no time leaves tables out; what was measured once is never measured again."""
    small, made = brick_grid(np.full((2, 3, 4), 4)), []
    monkeypatch.setattr(fill_report, "of_file", lambda path, width: made.append((path.stem, width)) or small)
    asked = Asked((Path("small.obj"),), (24,), (32,), 0)
    first = [table.name for table in judged_fill(asked, TEXT, Kept(tmp_path, 1e-9))]
    assert first == ["fill_samples"]
    assert not made
    whole = list(judged_fill(asked, TEXT, Kept(tmp_path, 0)))
    assert [table.name for table in whole] == [
        "fill_samples", "fill_files_24", "fill_files", "fill_joined", "fill_summary",
    ]  # fmt: skip
    assert made == [("small", 24), ("small", 32)]
    assert list(judged_fill(asked, TEXT, Kept(tmp_path, 0))) == whole
    assert len(made) == 2


def test_the_summary_of_a_report():
    """Medians over all models, the worst of each, and what the largest takes."""
    row = {"components": 1, "in_the_air": 0}
    rows = [row | {"bricks": n, "to_bound": n / 10, "seconds": 2.0 * n, "s_per_1000": 5.0} for n in (10, 11, 30)]
    found = summary(rows, rows[2])
    assert (found["models"], found["to_bound_median"], found["to_bound_most"]) == (3, 1.1, 3.0)
    assert (found["most_bricks"], found["their_seconds"]) == (30, 60.0)
