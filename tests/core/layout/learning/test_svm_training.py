"""Samples from models and the training: balanced, grouped by model, the same file from the same seed."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.layout.lay import lay
from legorize_addon.core.layout.learning.svm import Samples, read
from legorize_addon.core.layout.learning.svm_training import (
    COSTS,
    GAMMAS,
    samples_of,
    tasks,
    train,
    written,
)
from scripts.research.train_layout import facts, trained
from scripts.research.training_models import KINDS, built, made
from tests.core.layout.cells import CATALOGUE, brick_grid

N = 60


@pytest.fixture(scope="module")
def models():
    """Return a small model of each kind."""
    return [built(kind, 0) for kind in KINDS]


@pytest.fixture(scope="module")
def samples(models):
    """Return a few samples of them."""
    return samples_of(models, CATALOGUE, np.random.default_rng(1), N)


@pytest.mark.parametrize("kind", KINDS)
def test_models_are_closed_and_of_few_colours(kind):
    """Every edge of a model has a face on both sides, and it has one to four colours."""
    mesh = made(kind, 7)
    edges = np.stack([mesh.faces, np.roll(mesh.faces, -1, axis=1)], axis=2).reshape(-1, 2)
    one, times = np.unique(edges, axis=0, return_counts=True)
    assert times.max() == 1
    np.testing.assert_array_equal(one, np.unique(edges[:, ::-1], axis=0))
    assert 1 <= len(np.unique(mesh.face_image)) <= 4


def test_samples_are_balanced(samples):
    """Half of the samples pay, and every model gives some of either class."""
    assert len(samples.pays) == N
    assert samples.pays.sum() == N // 2
    for pays in (True, False):
        assert len(np.unique(samples.model[samples.pays == pays])) == len(KINDS)


def test_tasks_are_the_whole_model(models):
    """The sheets together have as many required cells as the model, bricks counting three plates."""
    for grid, bricks in models:
        cells = sum(problem.sheets.height * int(problem.required.sum()) for problem in tasks(grid, bricks, CATALOGUE))
        assert cells == (grid.cover == 2).sum()


def test_too_little_to_learn_from():
    """A model in which nothing can be saved is refused, with the number found and the number wanted."""
    grid = brick_grid(np.full((1, 2, 4), 4))
    bricks = lay(grid, CATALOGUE, rng=np.random.default_rng(0))
    with pytest.raises(BuildError, match="0 samples of 30"):
        samples_of([(grid, bricks)], CATALOGUE, np.random.default_rng(0), N)


def test_what_can_be_told_apart_is():
    """Samples whose class is plain to see are all told apart; with labels by chance about half are."""
    rng = np.random.default_rng(5)
    model, pays = np.repeat(np.arange(5), 20).astype(np.int16), np.tile([True, False], 50)
    levels = np.column_stack([np.where(pays, 3, 0), rng.integers(0, 16, (100, 2)), np.where(pays, 20, 2)])
    plain = train(Samples(levels.astype(np.int16), pays, model), rng)
    assert plain.micro == plain.macro == 1
    assert plain.confusion.tolist() == [[50, 0], [0, 50]]
    chance = train(Samples(levels.astype(np.int16), rng.permutation(pays), model), rng)
    assert 0.3 < chance.micro < 0.7


def test_written_and_read(samples):
    """What is written can be read; C and gamma are the best of the grid; the counts stand in the file."""
    result = train(samples, np.random.default_rng(2))
    again, said = read(written(result, {"seed": "2"}))
    np.testing.assert_array_equal(again.levels, samples.levels)
    np.testing.assert_array_equal(again.pays, samples.pays)
    np.testing.assert_array_equal(again.model, samples.model)
    assert said["seed"] == "2"
    assert result.grid[float(said["C"]), float(said["gamma"])] == max(result.grid.values()) == result.micro
    assert len(result.grid) == len(COSTS) * len(GAMMAS)
    assert result.confusion.sum() == N


def test_same_seed_same_file(models):
    """The command gives byte by byte what its steps give one after the other from the same seed."""
    rng = np.random.default_rng(1)
    result = train(samples_of(models, CATALOGUE, rng, N), rng)
    assert trained(seed=1, each=1, n=N) == written(result, facts(1, 1, result))


def test_other_seed_other_samples(models, samples):
    """The seed decides which samples are drawn."""
    others = samples_of(models, CATALOGUE, np.random.default_rng(3), N)
    assert not np.array_equal(others.levels, samples.levels)
