"""The honest table of the learned fill: what learning adds to its search, beside chance, rules and linear programmes.

Every way lays the same models from the ground upwards, each layer upon its own
layers below, without the joining that follows in a build.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from scipy.stats import wilcoxon
from sklearn.linear_model import LogisticRegression

from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay import FILLER, check_covered, sheets_and_shapes
from legorize_addon.core.layout.lay_learned import lay_learned
from legorize_addon.core.layout.learning.energies import gauss_normalised
from legorize_addon.core.layout.learning.fill import Choice, decided, fill_upwards, simulated
from legorize_addon.core.layout.learning.grade_training import cheapest
from legorize_addon.core.layout.learning.grading import Graded, Grader, drawn_best, read_graded, relative
from legorize_addon.core.layout.learning.layer import LONELY, Layer
from legorize_addon.core.layout.learning.simulation import Outcome
from legorize_addon.core.layout.problem.problem import Problem
from legorize_addon.core.layout.solvers import linear
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model import contact_graph
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from scripts.benchmarks.tables import Row, Table
from scripts.research.layout_controls import laid
from scripts.research.rules import Index, by_key, largest
from scripts.research.training_models import KINDS, UNSEEN, WIDTHS, built

Fill = Callable[[Layer, np.random.Generator], Index]

HELD_BACK: Final = 4
"""Models of each kind that are made by chance for the report."""

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


def judged_fill(paths: Sequence[Path], *, widths: Sequence[int], text: str, each: int = HELD_BACK) -> Iterator[Table]:
    """Lay models that were not trained on in all ways.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Their sizes in studs.
    text : str
        File of samples.
    each : int
        Models of each kind that are made by chance.

    Yields
    ------
    Table
        What the samples are; all ways over the files of each size, and over the models made by chance; and all models
        as they are joined in a build.
    """
    yield of_samples(text)
    groups: dict[str, dict[str, UnitGrid]] = {}
    for width in widths if paths else ():
        groups[f"model files at {width} studs"] = {f"{path.stem} {width}": laid(path, width)[0] for path in paths}
    # the small ones: sizes follow the seeds
    seeds = range(UNSEEN, UNSEEN + each * len(WIDTHS), len(WIDTHS))
    chance = {f"{kind} {seed}": built(kind, seed)[0] for kind in KINDS for seed in seeds}
    if chance:
        groups[f"held-back models of {WIDTHS[0]} studs made by chance"] = chance
    for title, group in groups.items():
        yield compared(title, group, text)
    every = {name: grid for group in groups.values() for name, grid in group.items()}
    if every:
        yield joined(every)


def of_samples(text: str) -> Table:
    """Return what the samples of a file are: how many differ, and how many have two labels."""
    samples, facts = read_graded(text)
    kinds, kind = np.unique(samples.energies, axis=0, return_inverse=True)
    labels = np.unique(np.column_stack([kind.reshape(-1), samples.grade]), axis=0)
    line: Row = {
        "samples": len(samples.grade),
        "distinct": len(kinds),
        "with_two_labels": len(labels) - len(kinds),
        "models": len(np.unique(samples.model)),
        "C": facts["C"],
        "gamma": facts["gamma"],
        "cross_validation": facts["cross-validation"],
        "confusion": facts["confusion"],
    }
    return Table("fill_samples", "Samples and training", (line,))


def joined(models: Mapping[str, UnitGrid]) -> Table:
    """Return the table of models laid by the shipped machine and joined as in a build; seconds are the processor's."""
    return Table("fill_joined", "Joined, as in a build", tuple(_joined(*each) for each in models.items()))


def _joined(name: str, grid: UnitGrid) -> Row:
    catalogue, start = load_catalogue(), time.process_time()
    bricks = lay_learned(grid, catalogue, rng=np.random.default_rng(0))
    seconds = time.process_time() - start
    bricks, _ = add_ties(bricks, grid, catalogue, plates=True)
    graph = contact_graph(bricks, catalogue)
    return {
        "model": name,
        "bricks": len(bricks),
        "to_bound": len(bricks) / lower_bound(grid, catalogue),
        "components": graph.n_components,
        "in_the_air": graph.n_floating,
        "seconds": seconds,
        "s_per_1000": 1000 * seconds / len(bricks),
    }


def compared(title: str, models: Mapping[str, UnitGrid], text: str) -> Table:
    """Return the table of all ways over some models."""
    catalogue = load_catalogue()
    least = np.array([lower_bound(grid, catalogue) for grid in models.values()])
    results = {name: [in_way(fill, grid) for grid in models.values()] for name, fill in ways(text).items()}
    shuffles = [each for name, each in results.items() if name.startswith(SHUFFLED)]
    results[f"{SHUFFLED}, mean of {SHUFFLES}"] = [mean_of(each) for each in zip(*shuffles, strict=True)]
    rows = [row(name, each, results[LEARNED], least) for name, each in results.items()]
    return Table("fill_controls", f"{len(models)} {title}; J is the cost that the learned fill counts", tuple(rows))


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
