"""The honest table of the learned fill: what learning adds to its search, beside chance, rules and linear programmes.

Every way lays the same models from the ground upwards, each layer upon its own
layers below, without the joining that follows in a build.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from typing import Final

import numpy as np
from scipy.stats import wilcoxon
from sklearn.linear_model import LogisticRegression

from legorize_addon.core.layout.lay import FILLER, check_covered, sheets_and_shapes
from legorize_addon.core.layout.learning.energies import gauss_normalised
from legorize_addon.core.layout.learning.fill import Choice, decided, fill_upwards, simulated
from legorize_addon.core.layout.learning.grade_training import cheapest
from legorize_addon.core.layout.learning.grading import Graded, Grader, drawn_best, read_graded, relative
from legorize_addon.core.layout.learning.layer import LONELY, Layer
from legorize_addon.core.layout.learning.simulation import Outcome
from legorize_addon.core.layout.problem.problem import Problem
from legorize_addon.core.layout.solvers import linear
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from scripts.benchmarks.tables import Row, Table
from scripts.research.rules import Index, by_key, largest

Fill = Callable[[Layer, np.random.Generator], Index]

LEARNED: Final = "SVM"

SHUFFLED: Final = "search, shuffled labels"
SHUFFLES: Final = 3
"""Times that the labels are shuffled: one machine of chance may prefer few bricks by luck, and another one many."""


@dataclass(frozen=True, slots=True, eq=False)
class Filled:
    """A model laid in one way.

    Attributes
    ----------
    bricks, single : int
        Bricks, and those of one cell.
    cost : float
        J: bricks, and what the learned fill counts besides (see ``layout/learning/layer.py``).
    seconds : float
        Of the processor.
    """

    bricks: int
    single: int
    cost: float
    seconds: float


def compared(title: str, models: Mapping[str, UnitGrid], text: str) -> Table:
    """Return the table of all ways over some models."""
    catalogue = load_catalogue()
    least = [lower_bound(grid, catalogue) for grid in models.values()]
    results = {name: [in_way(fill, grid) for grid in models.values()] for name, fill in ways(text).items()}
    return controls("fill_controls", title, results, least)


def controls(name: str, title: str, results: Mapping[str, Sequence[Filled]], least: Sequence[int]) -> Table:
    """Return the table of all ways, given what came of each on each model, and the bound of each model."""
    results = dict(results)
    shuffles = [each for name, each in results.items() if name.startswith(SHUFFLED)]
    results[f"{SHUFFLED}, mean of {SHUFFLES}"] = [mean_of(each) for each in zip(*shuffles, strict=True)]
    rows = [row(way, each, results[LEARNED], np.array(least)) for way, each in results.items()]
    return Table(name, f"{len(least)} {title}; J is the cost that the learned fill counts", tuple(rows))


def ways(text: str) -> Mapping[str, Fill]:
    """Return the ways of filling a layer, by name, given a file of samples."""
    samples, facts = read_graded(text)
    c, gamma = float(facts["C"]), float(facts["gamma"])
    of_chance = {
        f"{SHUFFLED} {seed}": searched(Grader.of(with_shuffled(samples, seed), c=c, gamma=gamma).choose)
        for seed in range(SHUFFLES)
    }
    return {
        "random placements": lambda layer, rng: by_key(lambda problem, luck: luck.permutation(len(problem.placements)))(
            layer.problem, rng
        ),
        "largest first": lambda layer, rng: by_key(largest)(layer.problem, rng),
        "simulation alone": lambda layer, rng: simulated(layer),
        "search, chance": searched(by_chance),
        **of_chance,
        "search, chance, fills kept by J": lambda layer, rng: decided(layer, by_chance, rng, keep=cheapest),
        "search, rule: least E_e": searched(least_efficiency),
        "search, rule: least J": searched(cheapest),
        "search, logistic regression": searched(logistic(samples)),
        LEARNED: searched(Grader.of(samples, c=c, gamma=gamma).choose),
        "linear programmes": lambda layer, rng: linear.cover(priced(layer), rng),
    }


def with_shuffled(samples: Graded, seed: int) -> Graded:
    """Return samples with each other's labels."""
    return Graded(samples.energies, np.random.default_rng(seed).permutation(samples.grade), samples.model)


def searched(choose: Choice) -> Fill:
    """Return the search of the learned fill with another one to decide."""
    return lambda layer, rng: decided(layer, choose, rng)


def priced(layer: Layer) -> Problem:
    """Return a layer's task with the costs of the learned fill."""
    return replace(layer.problem, cost=layer.cost)


def by_chance(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
    """Choose any candidate."""
    del outcome
    return rng.integers(np.maximum((candidates >= 0).sum(axis=1), 1))


def least_efficiency(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
    """Choose the candidate with the least sum of the efficiency."""
    return drawn_best(-np.round(outcome.energies[..., 3], 6), candidates, rng)


def logistic(samples: Graded) -> Choice:
    """Return the choice of a logistic regression with the same samples."""
    energies = samples.energies.astype(np.float64)
    mean, deviation = energies.mean(axis=0), energies.std(axis=0)
    fitted = LogisticRegression(C=100.0, max_iter=1000).fit(gauss_normalised(energies, mean, deviation), samples.grade)

    def choose(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
        above = relative(outcome, candidates).astype(np.float64)
        chance = fitted.predict_proba(gauss_normalised(above.reshape(-1, 4), mean, deviation))
        score = np.round(chance @ [1.0, 0.2, -1.0], 6).reshape(candidates.shape)
        return drawn_best(score, candidates, rng)

    return choose


def in_way(fill: Fill, grid: UnitGrid) -> Filled:
    """Lay a model in one way."""
    catalogue, rng = load_catalogue(), np.random.default_rng(0)
    total = np.zeros(3)

    def counted(layer: Layer) -> Index:
        start = time.process_time()
        rows = fill(layer, rng)
        lonely = min(np.count_nonzero(~np.isin(images[rows], rows)) for images in layer.mirror)
        total[:] += layer.single[rows].sum(), layer.cost[rows].sum() + LONELY * lonely, time.process_time() - start
        return rows

    bricks = fill_upwards(grid, sheets_and_shapes(grid, catalogue, FILLER), counted, check=check_covered)
    return Filled(len(bricks), int(total[0]), float(total[1]), float(total[2]))


def mean_of(results: Sequence[Filled]) -> Filled:
    """Return the mean of layouts of one model."""
    means = np.mean([astuple(each) for each in results], axis=0)
    return Filled(round(means[0]), round(means[1]), float(means[2]), float(means[3]))


def row(name: str, results: Sequence[Filled], learned: Sequence[Filled], least: Index) -> Row:
    """Return a line of the table."""
    ours, theirs = (np.array([each.cost for each in some]) for some in (learned, results))
    bricks = np.array([each.bricks for each in results])
    same = np.allclose(ours, theirs)
    return {
        "way": name,
        "bricks": int(bricks.sum()),
        "to_bound_median": float(np.median(bricks / least)),
        "1x1": sum(each.single for each in results) / int(bricks.sum()),
        "J": float(theirs.sum()),
        "SVM_J_saves": 1 - float(ours.sum() / theirs.sum()),
        "SVM_wins": int((ours < theirs - 1e-9).sum()),
        "SVM_losses": int((ours > theirs + 1e-9).sum()),
        "p": None if same else float(wilcoxon(ours, theirs).pvalue),
        "ms_per_brick": 1e3 * sum(each.seconds for each in results) / int(bricks.sum()),
    }
