"""The learned choice of exchanges: the shipped samples, what a placement changes, the table, and that it pays."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.lay import lay
from legorize_addon.core.layout.learning.energies import gauss_normalised
from legorize_addon.core.layout.learning.svm import (
    LEVELS,
    NAMES,
    NO_EXCHANGES,
    Machine,
    changes,
    improved,
    read,
    shipped,
)
from legorize_addon.core.layout.learning.svm_training import tasks
from legorize_addon.core.layout.solvers.exchange import fewer_small, gains
from legorize_addon.core.layout.solvers.greedy import cover
from legorize_addon.core.model.catalogue import ASSETS
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from scripts.research.training_models import KINDS, UNSEEN, built
from tests.core.layout.cells import CATALOGUE, RED, WHITE, assert_covers, problem_of

CORNER = 3
"""Cells of a corner part."""

NEUTRAL = 8
"""Level at which the bonding stays as it is."""


@pytest.fixture(scope="module")
def shipped_file():
    """Return the samples and the facts of the shipped file."""
    return read((ASSETS / "layout_svm.csv").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def held_back():
    """Return the sheets of models that were not trained on, one model of each kind."""
    return [problem for kind in KINDS for problem in tasks(*built(kind, UNSEEN), CATALOGUE)]


@pytest.fixture(scope="module")
def laid(held_back):
    """Return the same sheets, laid without learning."""
    rng = np.random.default_rng(0)
    return [fewer_small(problem, cover(problem, rng), rng) for problem in held_back]


def test_shipped_samples(shipped_file):
    """There are 1,500 samples of four changes, half of them pay, from five kinds of models at least."""
    samples, _ = shipped_file
    assert samples.levels.shape == (1500, len(NAMES))
    assert samples.pays.sum() == 750
    assert len(np.unique(samples.model)) >= 5
    assert (samples.levels >= 0).all()
    assert (samples.levels < LEVELS).all()


def test_shipped_facts(shipped_file):
    """The file says where it is from: script, seed, models, versions, formulation; C and gamma; micro and macro F1."""
    _, facts = shipped_file
    assert {"made by", "seed", "models", "versions", "formulation", "C", "gamma", "cross-validation"} <= facts.keys()
    assert all(kind in facts["models"] for kind in KINDS)
    (neither, falsely), (missed, found) = np.array(facts["confusion"].split(), int).reshape(2, 2)
    assert neither + falsely == missed + found == 750
    assert f"micro F1 {(neither + found) / 1500:.3f}" in facts["cross-validation"]


def test_normalised_samples(shipped_file):
    """The mean becomes 0.5, three standard deviations away 0 and 1, and all samples lie between."""
    samples, _ = shipped_file
    levels = samples.levels.astype(float)
    mean, deviation = levels.mean(axis=0), levels.std(axis=0)
    normalised = gauss_normalised(levels, mean, deviation)
    assert normalised.min() >= 0
    assert normalised.max() <= 1
    ends = gauss_normalised(mean + np.array([[-3], [0], [3]]) * deviation, mean, deviation)
    np.testing.assert_allclose(ends, np.array([[0], [0.5], [1]]) * np.ones(4), atol=1e-12)


def test_table_equals_machine(shipped_file):
    """At every point the table says what the rebuilt machine predicts."""
    samples, facts = shipped_file
    machine = Machine.of(samples, c=float(facts["C"]), gamma=float(facts["gamma"]))
    points = np.indices(LEVELS).reshape(4, -1).T
    said = machine.svc.predict(gauss_normalised(points.astype(float), machine.mean, machine.deviation))
    np.testing.assert_array_equal(shipped()[tuple(points.T)], said)


def test_machine_knows_its_samples(shipped_file):
    """The machine is right about four samples in five at least, and about more than half of either class."""
    samples, _ = shipped_file
    right = shipped()[tuple(samples.levels.T)] == samples.pays
    assert right.mean() >= 0.8
    assert min(right[samples.pays].mean(), right[~samples.pays].mean()) > 0.5


def rows_of(problem, *placed):
    """Return the rows of the placements that cover exactly these sets of cells (x, y), on one sheet."""
    number = {(x, y): each for each, (x, y, _) in enumerate(problem.corner.tolist())}
    found = problem.placements
    wanted = [frozenset(number[cell] for cell in cells) for cells in placed]
    every = [frozenset(found.cells[start:end]) for start, end in zip(found.start[:-1], found.start[1:], strict=True)]
    return np.array([every.index(cells) for cells in wanted])


def test_changes_of_a_pair():
    """One brick over two of one cell: both go, no part is left behind, and the area of two bricks is freed."""
    problem = problem_of([[RED, RED]])
    one, other, both = rows_of(problem, [(0, 0)], [(1, 0)], [(0, 0), (1, 0)])
    assert changes(problem, np.array([one, other]))[both].tolist() == [2, NEUTRAL, 0, 12]


def test_changes_of_a_cut():
    """A brick of two across the middle of two bricks of four leaves a part of both: one brick and a half."""
    problem = problem_of(np.full((1, 8), RED))
    left, right, middle = rows_of(problem, *([(x, 0) for x in cells] for cells in (range(4), range(4, 8), (3, 4))))
    assert changes(problem, np.array([left, right]))[middle].tolist() == [0, NEUTRAL, 3, 3]


def test_changes_of_what_lies_there():
    """A brick in its own place changes nothing."""
    problem = problem_of(np.full((5, 7), RED))
    chosen = cover(problem, np.random.default_rng(0))
    found = changes(problem, chosen)[chosen[problem.placements.size[chosen] > 1]]
    assert (found == [0, NEUTRAL, 0, 6]).all()


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=30)
def test_parts_left_behind(seed):
    """The changes agree with a count brick by brick, whatever the colours, the holes and the corner parts below."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, RED, RED, RED, WHITE], (5, 6))
    colour[0, 0] = RED
    wanted = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED], (5, 6)))
    wanted[0, 0] = Fill.REQUIRED
    problem = problem_of(colour, wanted)
    chosen = cover(problem, rng)
    owner, found = problem.owner(chosen), problem.placements
    # two corner parts can be hooked into each other, and then meet in two places
    row = int(rng.choice(np.flatnonzero(found.size != CORNER)))
    under, shared = np.unique(owner[found.cells[found.start[row] : found.start[row + 1]]], return_counts=True)
    under, shared = under[under >= 0], shared[under >= 0]
    area = int((48 // found.size[chosen[under]] * shared).sum())
    singles = int((found.size[chosen[under]] == 1).sum())
    expected = np.minimum([singles, (48 * len(under) - area) // 24, area // 8], [3, 15, 23])
    assert changes(problem, chosen)[row, [0, 2, 3]].tolist() == expected.tolist()


def test_learned_exchanges_pay(held_back, laid):
    """On models never seen, one brick in 200 is saved at least, with no required cell lost and no layout dearer."""
    before = after = 0
    for problem, chosen in zip(held_back, laid, strict=True):
        better = improved(problem, chosen, np.random.default_rng(0))
        cells = problem.placements.cells[problem.placements.entries(better)]
        assert len(np.unique(cells)) == len(cells)
        assert np.isin(np.flatnonzero(problem.required), cells).all()
        assert problem.cost[better].sum() <= problem.cost[chosen].sum() + 1e-6
        before, after = before + len(chosen), after + len(better)
    assert after <= 0.995 * before


def test_the_right_ones_are_chosen(held_back, laid):
    """Of all that could be saved, nine tenths lie in the tenth of the placements that the table proposes."""
    worth, offered, total, n = 0.0, 0, 0.0, 0
    for problem, chosen in zip(held_back, laid, strict=True):
        left = np.delete(np.arange(len(problem.placements)), chosen)
        gain = np.maximum(gains(problem, chosen, left), 0)
        proposed = shipped()[tuple(changes(problem, chosen)[left].T)]
        worth, total = worth + gain[proposed].sum(), total + gain.sum()
        offered, n = offered + proposed.sum(), n + len(left)
    assert worth >= 0.9 * total
    assert offered <= 0.1 * n


def test_fast_tier_runs_without():
    """Switched off, the fast tier covers a model of each kind as well; switched on, it takes fewer bricks in all."""
    bricks = {True: 0, False: 0}
    for kind in KINDS:
        grid, _ = built(kind, UNSEEN + 1)
        for learned in bricks:
            laid = lay(
                grid, CATALOGUE, rng=np.random.default_rng(0), tier="fast", exchanges=None if learned else NO_EXCHANGES
            )
            assert_covers(laid, grid)
            bricks[learned] += len(laid)
    assert bricks[True] < bricks[False]
