"""Samples for the learned fill, and the training.

Samples are taken where they will be used: models are filled by decisions, and some
of these are judged by the exact fill. So samples need no labelling by hand.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ...errors import BuildError
from ...model import Catalogue, UnitGrid
from ..problem import Index, Sheets, shapes, split
from .cross_validation import Trained, cross_validated
from .fill import Choice, decided, fill_upwards
from .grading import COLUMNS, GRADES, Graded, Grader, drawn_best, relative
from .layer import Layer
from .regret import regrets
from .sample_file import text_of
from .simulation import Outcome, Windows

EACH_GRADE: Final = 500
"""Samples of each grade."""

BEST: Final = 0.05
GOOD: Final = 0.8
"""Bricks that a candidate may cost in the end, above the best one, to be of the first and of the second grade."""

_STRAY: Final = 0.3
"""Share of the decisions that are taken by chance, so that bad states are seen as well."""

_JUDGED: Final = 150
"""Candidates judged for each model and round."""

_LIKELY: Final = 3
"""Candidates judged at a decision because the simulation ends cheapest behind them, beside one by chance: bricks of the
first two grades are rare."""

GRADE_COSTS: Final = (1.0, 8.0, 64.0)
GRADE_GAMMAS: Final = (0.125, 0.5, 2.0, 8.0)
"""Grid of C and gamma for the cross-validation."""

Decision = tuple[NDArray[np.int16], Callable[[Mask], Floats]]
"""What candidates end with, (n, 4), and what tells the regret of some of them."""


TrainedGrades = Trained[Graded]
"""The outcome of a training; classes are grades."""


def strayed(choose: Choice) -> Choice:
    """Return a choice that is by chance now and then."""

    def choice(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
        count = np.maximum((candidates >= 0).sum(axis=1), 1)
        stray = rng.random(len(count)) < _STRAY
        return np.where(stray, rng.integers(count), choose(outcome, candidates, rng))

    return choice


def cheapest(outcome: Outcome, candidates: Index, rng: np.random.Generator) -> Index:
    """Choose the candidate behind which the simulation costs least, as :data:`~.fill.Choice`."""
    return drawn_best(-np.round(outcome.cost, 6), candidates, rng)


def graded_of(
    grids: Sequence[UnitGrid],
    catalogue: Catalogue,
    rng: np.random.Generator,
    *,
    choose: Choice = cheapest,
    known: Graded | None = None,
) -> Graded:
    """Judge decisions on models.

    Parameters
    ----------
    grids : sequence of UnitGrid
        Hollowed models.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Draws the decisions.
    choose : callable
        Takes the decisions, but for those that are taken by chance.
    known : Graded, optional
        What is judged already.

    Returns
    -------
    Graded
        Those known, then candidates of further decisions; no two end alike.
    """
    parts = [known] if known else []
    seen = {row.tobytes() for part in parts for row in part.energies}
    for number, grid in enumerate(grids):
        every = _all_decisions(grid, catalogue, rng, strayed(choose))
        judged = 0
        for row in rng.permutation(len(every)):
            above, judge = every[row]
            new = np.array([each.tobytes() not in seen for each in above])
            # the cheapest come first
            new &= (np.cumsum(new) <= _LIKELY) | (np.arange(len(new)) == rng.integers(len(new)))
            if not new.any():
                continue
            seen.update(each.tobytes() for each in above)
            grade = np.searchsorted([BEST, GOOD], judge(new), side="right").astype(np.int16)
            parts.append(Graded(above[new], grade, np.full(len(grade), number, dtype=np.int16)))
            judged += len(grade)
            if judged >= _JUDGED:
                break
    return Graded(*(np.concatenate([getattr(each, name) for each in parts]) for name in Graded.__slots__))


def _all_decisions(grid: UnitGrid, catalogue: Catalogue, rng: np.random.Generator, choose: Choice) -> list[Decision]:
    """Fill a model once, and return the decisions: of candidates that end alike, the first one stands for all."""
    every: list[Decision] = []

    def watch(layer: Layer, windows: Windows, laid: Mask, before: Index, candidates: Index, outcome: Outcome) -> None:
        above = relative(outcome, candidates)
        for window in np.flatnonzero((candidates >= 0).sum(axis=1) > 1).tolist():
            cheapest_first = np.argsort(np.round(outcome.cost[window, candidates[window] >= 0], 6), kind="stable")
            kinds = np.unique(above[window, cheapest_first], axis=0, return_index=True)[1]
            first = cheapest_first[np.sort(kinds)]

            def judge(which: Mask, window: int = window, first: Index = first) -> Floats:
                return regrets(layer, windows, laid, window, before[window], candidates[window, first[which]])

            every.append((above[window, first], judge))

    codes = np.unique(grid.colour[grid.colour >= 0])
    # the colour of what nobody sees does not matter here
    work = [(each, shapes(catalogue, each.height, codes, int(catalogue.codes[0]))) for each in split(grid)]
    fill_upwards(grid, work, lambda layer: decided(layer, choose, rng, passes=1, watch=watch), check=_ignore)
    return every


def _ignore(sheets: Sheets, missing: Mask) -> None:
    """Leave cells bare for which there is no brick: they teach nothing."""
    del sheets, missing


def balanced(pool: Graded, rng: np.random.Generator, each: int = EACH_GRADE) -> Graded:
    """Draw as many samples of every grade, from all models as evenly as can be.

    Parameters
    ----------
    pool : Graded
        As :func:`graded_of` returns.
    rng : numpy.random.Generator
        Draws.
    each : int
        Samples of each grade.

    Returns
    -------
    Graded

    Raises
    ------
    BuildError
        The models have too few of a grade.
    """
    drawn = [_evenly(pool, rng.permutation(np.flatnonzero(pool.grade == grade)), each) for grade in range(len(GRADES))]
    return pool.take(np.sort(np.concatenate(drawn)))


def fewest(pool: Graded) -> int:
    """Return how many samples there are of the grade that has fewest."""
    return int(np.bincount(pool.grade, minlength=len(GRADES)).min())


def _evenly(pool: Graded, rows: Index, n: int) -> Index:
    """Take n of some rows, from all models alike while they last."""
    if len(rows) < n:
        raise BuildError(f"The models give {len(rows)} samples of {n} of a grade: choose more or larger models.")
    rows = rows[np.argsort(pool.model[rows], kind="stable")]
    _, first, size = np.unique(pool.model[rows], return_index=True, return_counts=True)
    turn = np.arange(len(rows)) - np.repeat(first, size)
    return rows[np.argsort(turn, kind="stable")[:n]]


def train_grades(
    samples: Graded,
    rng: np.random.Generator,
    *,
    costs: Sequence[float] = GRADE_COSTS,
    gammas: Sequence[float] = GRADE_GAMMAS,
) -> TrainedGrades:
    """Choose C and gamma by cross-validation; samples of one model are never on both sides.

    Parameters
    ----------
    samples : Graded
        From at least five models.
    rng : numpy.random.Generator
        Deals the models out to the folds.
    costs, gammas : sequence of float
        The grid of C and gamma.

    Returns
    -------
    TrainedGrades

    Raises
    ------
    BuildError
        There are fewer models than folds.
    """

    def said(out: Mask, c: float, gamma: float) -> Index:
        return Grader.of(samples.take(~out), c=c, gamma=gamma).grades(samples.energies[out])

    return cross_validated(samples, samples.grade, samples.model, said, rng, costs=costs, gammas=gammas)


def written_grades(trained: TrainedGrades, facts: Mapping[str, str]) -> str:
    """Write a training down as text that :func:`~.grading.read_graded` reads.

    Parameters
    ----------
    trained : TrainedGrades
    facts : mapping of str to str
        Where the samples are from.

    Returns
    -------
    str
        Lines of ``# name: value``, then a table in CSV.
    """
    samples = trained.samples
    counts = np.bincount(samples.grade, minlength=len(GRADES)).tolist()
    counted = ", ".join(f"{n} {g}" for n, g in zip(counts, GRADES, strict=True))
    rows = np.column_stack([samples.model, samples.grade, samples.energies]).astype(int)
    told = trained.facts(f"{len(samples.grade)}, of which {counted}")
    return text_of({**facts, **told}, COLUMNS, rows.tolist())
