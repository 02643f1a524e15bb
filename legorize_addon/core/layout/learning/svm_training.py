"""Samples for the learned choice of exchanges, and the training.

Samples are taken where they will be used: a model's sheets are laid by the fast
tier, and for every placement left over the exact saving is computed. So samples
need no labelling by hand, and users can train on their own models.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ...arrays import Mask
from ...errors import BuildError
from ...model import NOBODY, Bricks, Catalogue, Fill, UnitGrid, contact_graph, ground_of
from ..problem import GROUND, Index, Problem, owners, placements, pose, shapes, split, with_margins
from ..solvers import cover, fewer_small, gains
from .svm import COLUMNS, Machine, Samples, changes

N_SAMPLES: Final = 1500
FOLDS: Final = 5

COSTS: Final = tuple(2.0**power for power in range(-3, 10, 3))
GAMMAS: Final = tuple(2.0**power for power in range(-5, 4, 2))
"""Grid of C and gamma for the cross-validation."""

_FIRST: Final = (8.0, 0.5)
"""C and gamma of the machine that finds the hard samples."""

_GAIN: Final = 1e-6
"""Bricks that a placement has to save to pay."""


@dataclass(frozen=True, slots=True, eq=False)
class Trained:
    """The outcome of a training.

    Attributes
    ----------
    samples : Samples
    c, gamma : float
        The best of the grid; ``Machine.of`` wants them.
    grid : mapping of (C, gamma) to float
        Share of right answers in the cross-validation (the micro-average F1).
    micro, macro : float
        F1 of the best, averaged over samples and over classes.
    confusion : (2, 2) intp array
        Rows: does not pay, pays; columns: what the machine held it for.
    """

    samples: Samples
    c: float
    gamma: float
    grid: Mapping[tuple[float, float], float]
    micro: float
    macro: float
    confusion: Index


def tasks(grid: UnitGrid, bricks: Bricks, catalogue: Catalogue) -> Iterator[Problem]:
    """Yield the sheets of a model much as the fast tier meets them: every other one alone, then those between.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    bricks : Bricks
        Its layout, which the sheets between meet.
    catalogue : Catalogue
        Whose parts the bricks are.

    Yields
    ------
    Problem
        All sheets of one height and one half.
    """
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    codes = np.unique(grid.colour[grid.colour >= 0])
    built = owners(contact_graph(bricks, catalogue), required.shape)
    ground = ground_of(built != NOBODY)
    for sheets in split(grid):
        # the colour of what nobody sees does not matter here
        among = shapes(catalogue, sheets.height, codes, int(catalogue.codes[0]))
        odd = sheets.level // sheets.height % 2 == 1
        for half, around in ((~odd, np.full_like(built, NOBODY)), (odd, built.copy())):
            around[:ground] = GROUND
            if half.any():
                part = sheets.take(half)
                yield pose(part, among, placements(part, among), around, required)


def samples_of(
    models: Sequence[tuple[UnitGrid, Bricks]], catalogue: Catalogue, rng: np.random.Generator, n: int = N_SAMPLES
) -> Samples:
    """Take samples from models, as evenly as can be, half of them of placements that pay.

    Half of the others are drawn from all, half from those that a machine trained on the first half predicts to pay:
    near the border it matters most.

    Parameters
    ----------
    models : sequence of (UnitGrid, Bricks)
        Hollowed models and their layouts.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Draws.
    n : int
        How many, a multiple of four.

    Returns
    -------
    Samples

    Raises
    ------
    BuildError
        The models have too few placements that pay.
    """
    every = [_all_samples(grid, bricks, number, catalogue, rng) for number, (grid, bricks) in enumerate(models)]
    pool = Samples(*(np.concatenate([getattr(each, name) for each in every]) for name in Samples.__slots__))
    pays, others = np.flatnonzero(pool.pays), np.flatnonzero(~pool.pays)
    pays, easy = _drawn(pool, pays, n // 2, rng), _drawn(pool, others, n // 4, rng)
    first = Machine.of(pool.take(np.concatenate([pays, easy])), c=_FIRST[0], gamma=_FIRST[1]).table()
    others = np.setdiff1d(others, easy)
    hard = _drawn(pool, others[first[tuple(pool.levels[others].T)]], n // 4, rng)
    return pool.take(np.sort(np.concatenate([pays, easy, hard])))


def _all_samples(
    grid: UnitGrid, bricks: Bricks, number: int, catalogue: Catalogue, rng: np.random.Generator
) -> Samples:
    """Lay the sheets of a model anew and compute what each placement left over saves."""
    levels, pays = [], []
    for problem in tasks(grid, bricks, catalogue):
        chosen = fewer_small(problem, cover(problem, rng), rng)
        left = np.delete(np.arange(len(problem.placements)), chosen)
        levels.append(changes(problem, chosen)[left])
        pays.append(gains(problem, chosen, left) > _GAIN)
    found = np.concatenate(pays)
    return Samples(np.concatenate(levels), found, np.full(len(found), number, dtype=np.int16))


def _drawn(pool: Samples, rows: Index, n: int, rng: np.random.Generator) -> Index:
    """Draw n of the rows of a pool, from all models alike while they last."""
    if len(rows) < n:
        raise BuildError(f"The models give {len(rows)} samples of {n}: choose more or larger models to train on.")
    order = rng.permutation(rows)
    order = order[np.argsort(pool.model[order], kind="stable")]
    _, first, size = np.unique(pool.model[order], return_index=True, return_counts=True)
    turn = np.arange(len(order)) - np.repeat(first, size)
    return order[np.argsort(turn, kind="stable")[:n]]


def train(
    samples: Samples, rng: np.random.Generator, *, costs: Sequence[float] = COSTS, gammas: Sequence[float] = GAMMAS
) -> Trained:
    """Choose C and gamma by cross-validation.

    Parameters
    ----------
    samples : Samples
        From at least five models; those of one model are never on both sides.
    rng : numpy.random.Generator
        Deals the models out to the folds.
    costs, gammas : sequence of float
        The grid of C and gamma.

    Returns
    -------
    Trained

    Raises
    ------
    BuildError
        There are fewer models than folds.
    """
    # loading it takes longer than building a small model, which does not need it
    from sklearn.metrics import confusion_matrix, f1_score

    fold = folds(samples.model, rng)
    answers = {(c, gamma): _answers(samples, fold, c, gamma) for c in costs for gamma in gammas}
    grid = {pair: float(np.mean(each == samples.pays)) for pair, each in answers.items()}
    # the first of equal ones: the smoothest machine
    c, gamma = max(grid, key=lambda pair: grid[pair])
    best = answers[c, gamma]
    return Trained(
        samples=samples,
        c=c,
        gamma=gamma,
        grid=grid,
        micro=float(f1_score(samples.pays, best, average="micro")),
        macro=float(f1_score(samples.pays, best, average="macro")),
        confusion=confusion_matrix(samples.pays, best),
    )


def folds(model: NDArray[np.int16], rng: np.random.Generator) -> Index:
    """Deal models out to folds, (n,): the fold of each sample.

    Parameters
    ----------
    model : (n,) int16 array
        Number of the model that each sample is from.
    rng : numpy.random.Generator
        Shuffles.

    Returns
    -------
    (n,) intp array
        From 0 to below ``FOLDS``.

    Raises
    ------
    BuildError
        There are fewer models than folds.
    """
    numbers, row = np.unique(model, return_inverse=True)
    if len(numbers) < FOLDS:
        raise BuildError(f"The samples are from {len(numbers)} models: train on at least {FOLDS} models.")
    dealt: Index = rng.permutation(len(numbers))[row] % FOLDS
    return dealt


def _answers(samples: Samples, fold: Index, c: float, gamma: float) -> Mask:
    """Return what machines say of the samples of each fold when trained on the others."""
    said = np.zeros(len(fold), dtype=bool)
    for number in range(FOLDS):
        inside = fold == number
        kinds = np.unique(samples.pays[~inside])
        if len(kinds) == 1:
            # a machine that was trained on one kind alone predicts only this kind
            said[inside] = kinds[0]
            continue
        machine = Machine.of(samples.take(~inside), c=c, gamma=gamma)
        said[inside] = machine.decision(samples.levels[inside]) > 0
    return said


def written(trained: Trained, facts: Mapping[str, str]) -> str:
    """Write a training down as text that :func:`~.svm.read` reads.

    Parameters
    ----------
    trained : Trained
    facts : mapping of str to str
        Where the samples are from.

    Returns
    -------
    str
        Lines of ``# name: value``, then a table in CSV.
    """
    samples = trained.samples
    results = {
        "samples": f"{len(samples.pays)}, of which {samples.pays.sum()} pay",
        "C": repr(trained.c),
        "gamma": repr(trained.gamma),
        "cross-validation": f"{FOLDS} folds by model, micro F1 {trained.micro:.3f}, macro F1 {trained.macro:.3f}",
        "confusion": " ".join(map(str, trained.confusion.ravel())),
    }
    lines = [f"# {name}: {value}" for name, value in {**facts, **results}.items()]
    rows = np.column_stack([samples.model, samples.pays, samples.levels]).astype(int)
    table = [",".join(COLUMNS), *(",".join(map(str, row)) for row in rows)]
    return "\n".join([*lines, *table, ""])
