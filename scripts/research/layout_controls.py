"""The honest table: what learning adds to the fast layout, beside rules, chance and linear programmes."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.stats import wilcoxon
from sklearn.linear_model import LogisticRegression

from legorize_addon.core.arrays import Mask
from legorize_addon.core.layout.learning.energies import gauss_normalised
from legorize_addon.core.layout.learning.svm import LEVELS, Machine, Samples, changes, improved, read, shipped
from legorize_addon.core.layout.learning.svm_training import tasks
from legorize_addon.core.layout.problem.problem import Problem
from legorize_addon.core.layout.solvers import exact, linear
from legorize_addon.core.layout.solvers.exchange import exchange, fewer_small
from legorize_addon.core.layout.solvers.greedy import cover
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table
from scripts.research.rules import Index, Way, by_key, largest
from scripts.research.training_models import KINDS, UNSEEN, built

Floats = NDArray[np.float64]

SHIPPED: Final = Path(__file__).resolve().parents[2] / "assets" / "layout_svm.csv"

HELD_BACK: Final = 4
"""Models of each kind that are made by chance for the report."""

LEARNED: Final = "SVM"


@dataclass(frozen=True, slots=True, eq=False)
class Result:
    """A model laid in one way.

    Attributes
    ----------
    bricks, single, required : int
        Bricks, those of one cell, cells that have to be covered.
    cost : float
        What the layout costs, with single cells and bonding.
    seconds : float
        Of the processor.
    """

    bricks: int
    single: int
    required: int
    cost: float
    seconds: float


def judged(paths: Sequence[Path], *, width: int) -> str:
    """Lay models that were not trained on in all ways.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Their size in studs.

    Returns
    -------
    str
        Markdown tables, one for the models made by chance and one for the files.
    """
    chance = {f"{kind} {seed}": built(kind, seed) for kind in KINDS for seed in range(UNSEEN, UNSEEN + HELD_BACK)}
    parts = [compared("held-back models made by chance", chance)]
    if paths:
        parts.append(compared(f"model files at {width} studs", {path.stem: laid(path, width) for path in paths}))
    return "\n".join(part.markdown() for part in parts)


def laid(path: Path, width: int) -> tuple[UnitGrid, Bricks]:
    """Return the model of a file: hollowed, and laid by the fast tier without learning."""
    build = legorize(read_mesh(path), Settings(width=width, layout="fast", learned=False))
    return build.hollow, build.bricks


def compared(title: str, models: Mapping[str, tuple[UnitGrid, Bricks]]) -> Table:
    """Return the table of all ways over some models."""
    catalogue = load_catalogue()
    problems = [list(tasks(grid, bricks, catalogue)) for grid, bricks in models.values()]
    least = sum(lower_bound(grid, catalogue) for grid, _ in models.values())
    results = {name: [in_way(way, each) for each in problems] for name, way in ways().items()}
    rows = [row(name, each, results[LEARNED], least) for name, each in results.items()]
    return Table("controls", f"{len(models)} {title}; J is the cost with single cells and bonding", tuple(rows))


def ways() -> Mapping[str, Way]:
    """Return the ways of laying by name."""
    samples, facts = read(SHIPPED.read_text(encoding="utf-8"))
    c, gamma = float(facts["C"]), float(facts["gamma"])
    luck = np.random.default_rng(0)
    shuffled = Samples(samples.levels, luck.permutation(samples.pays), samples.model)
    worth = shipped()
    return {
        "random placements": by_key(lambda problem, rng: rng.permutation(len(problem.placements))),
        "largest first": by_key(largest),
        "prices (greedy)": cover,
        "fast tier, not learned": fewer,
        "+ random exchanges, as many": with_table(lambda rng: rng.random(LEVELS), like=worth, scatter=True),
        "+ SVM, shuffled labels": with_table(lambda _: values(Machine.of(shuffled, c=c, gamma=gamma))),
        "+ rule: freed less own cost": with_table(lambda _: rule(samples)),
        "+ logistic regression": with_table(lambda _: logistic(samples)),
        LEARNED: lambda problem, rng: improved(problem, fewer(problem, rng), rng, worth),
        "+ all exchanges": with_table(lambda _: np.ones(LEVELS)),
        "linear programmes": lambda problem, rng: fewer_small(problem, linear.cover(problem, rng), rng),
        "exact": exact.cover,
    }


def fewer(problem: Problem, rng: np.random.Generator) -> Index:
    """Lay as the fast tier does without learning."""
    return fewer_small(problem, cover(problem, rng), rng)


def with_table(make: Callable[[np.random.Generator], Floats], like: Mask | None = None, scatter: bool = False) -> Way:
    """Return the fast tier with the exchanges that a table proposes; or by chance, as many as another table would."""
    table = make(np.random.default_rng(0)) > 0

    def way(problem: Problem, rng: np.random.Generator) -> Index:
        chosen = fewer(problem, rng)
        if not scatter or like is None:
            return improved(problem, chosen, rng, table)
        for _ in range(2):
            share = like[tuple(changes(problem, chosen).T)].mean()
            chosen = exchange(problem, chosen, np.flatnonzero(rng.random(len(problem.placements)) < share), rng)
        return chosen

    return way


def every_change() -> NDArray[np.int16]:
    """Return all changes that there are, (n, 4)."""
    return np.indices(LEVELS, dtype=np.int16).reshape(len(LEVELS), -1).T


def values(machine: Machine) -> Floats:
    """Return the decision values of a machine for all changes."""
    return machine.decision(every_change()).reshape(LEVELS)


def rule(samples: Samples) -> Floats:
    """Return the cost of the bricks in the way in proportion, less the own, less the best threshold on the samples."""

    def freed(levels: NDArray[np.int16]) -> Floats:
        units, clutch, _, area = levels.astype(float).T
        return units + (clutch - 8) / 8 + area / 6

    steps = np.arange(0, 4, 0.05)
    right = [((freed(samples.levels) > step) == samples.pays).mean() for step in steps]
    return (freed(every_change()) - steps[int(np.argmax(right))]).reshape(LEVELS)


def logistic(samples: Samples) -> Floats:
    """Return the decision values of a logistic regression for all changes."""
    mean, deviation = samples.levels.mean(axis=0), samples.levels.std(axis=0)
    fitted = LogisticRegression(C=100.0).fit(gauss_normalised(samples.levels, mean, deviation), samples.pays)
    return fitted.decision_function(gauss_normalised(every_change(), mean, deviation)).reshape(LEVELS)


def in_way(way: Way, problems: Sequence[Problem]) -> Result:
    """Lay all sheets of a model in one way."""
    rng, start = np.random.default_rng(0), time.process_time()
    chosen = [way(problem, rng) for problem in problems]
    seconds = time.process_time() - start
    pairs = list(zip(problems, chosen, strict=True))
    return Result(
        bricks=sum(map(len, chosen)),
        single=sum(int((problem.placements.size[rows] == 1).sum()) for problem, rows in pairs),
        required=sum(int(problem.required.sum()) for problem in problems),
        cost=sum(float(problem.cost[rows].sum()) for problem, rows in pairs),
        seconds=seconds,
    )


def row(name: str, results: Sequence[Result], learned: Sequence[Result], least: int) -> Row:
    """Return a line of the table."""
    ours, theirs = (np.array([each.cost for each in some]) for some in (learned, results))
    same = np.allclose(ours, theirs)
    bricks = sum(each.bricks for each in results)
    return {
        "way": name,
        "bricks": bricks,
        "to_bound": bricks / least,
        "1x1": sum(each.single for each in results) / bricks,
        "J": float(theirs.sum()),
        "SVM_J_saves": 1 - float(ours.sum() / theirs.sum()),
        "SVM_wins": int((ours < theirs - 1e-9).sum()),
        "SVM_losses": int((ours > theirs + 1e-9).sum()),
        "p": None if same else float(wilcoxon(ours, theirs).pvalue),
        "us_per_must": 1e6 * sum(each.seconds for each in results) / sum(each.required for each in results),
    }
