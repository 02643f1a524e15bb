"""Samples of the learned fill from models, and the training."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.layout.learning.grade_training import (
    balanced,
    cheapest,
    graded_of,
    strayed,
    train_grades,
    written_grades,
)
from legorize_addon.core.layout.learning.grading import GRADES, read_graded
from legorize_addon.core.layout.learning.simulation import Outcome
from tests.core.layout.cells import CATALOGUE, brick_grid
from tests.core.layout.learning.test_grading import some


def test_samples_of_a_model():
    """Every decision judged has a best candidate, and seeds repeat."""
    rng = np.random.default_rng(2)
    grid = brick_grid(np.where(rng.random((1, 6, 7)) < 0.8, 4, -2))
    one, other = (graded_of([grid], CATALOGUE, np.random.default_rng(1)) for _ in range(2))
    np.testing.assert_array_equal(one.energies, other.energies)
    assert set(one.grade) <= set(range(len(GRADES)))
    assert (one.grade == 0).any()
    assert (one.energies.min(axis=0) == 0).all()
    assert len(np.unique(one.energies, axis=0)) == len(one.grade)
    more = graded_of([grid], CATALOGUE, np.random.default_rng(5), known=one)
    np.testing.assert_array_equal(more.energies[: len(one.grade)], one.energies)
    assert len(np.unique(more.energies, axis=0)) == len(more.grade)


def test_balanced_samples():
    """As many of each grade, from all models; too few are refused."""
    pool = some(900)
    drawn = balanced(pool, np.random.default_rng(0), 200)
    assert np.bincount(drawn.grade).tolist() == [200] * 3
    assert np.bincount(drawn.model).min() >= 5
    with pytest.raises(BuildError, match="samples of 400 of a grade"):
        balanced(pool, np.random.default_rng(0), 400)


def test_training_and_its_file():
    """C and gamma are those of the grid with most right answers; the file gives the samples back."""
    samples = some(180)
    result = train_grades(samples, np.random.default_rng(0), costs=[1.0, 8.0], gammas=[0.5, 2.0])
    assert result.grid[result.c, result.gamma] == max(result.grid.values()) == result.micro
    assert result.confusion.sum() == 180
    again, facts = read_graded(written_grades(result, {"what": "a test"}))
    np.testing.assert_array_equal(again.energies, samples.energies)
    assert float(facts["C"]) == result.c


def test_some_decisions_are_taken_by_chance():
    """Three in ten, all others as they would be."""
    outcome = Outcome(np.zeros((2000, 2, 4)), np.tile([0.0, 1.0], (2000, 1)))
    choice = strayed(cheapest)(outcome, np.zeros((2000, 2), np.intp), np.random.default_rng(0))
    assert choice.mean() == pytest.approx(0.15, abs=0.03)
