"""Samples for the learned choice of exchanges, and the training.

Samples are taken where they will be used: a model's sheets are laid by the fast
tier, and for every placement left over the exact saving is computed. So samples
need no labelling by hand, and users can train on their own models.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from ...arrays import Mask
from ...errors import BuildError
from ...model import NOBODY, Bricks, Catalogue, Fill, UnitGrid, contact_graph, ground_of
from ..problem import GROUND, Index, Problem, owners, placements, pose, shapes, split, with_margins
from ..solvers import cover, fewer_small, gains
from .cross_validation import Trained, cross_validated
from .sample_file import text_of
from .svm import COLUMNS, Machine, Samples, changes

N_SAMPLES: Final = 1500

COSTS: Final = tuple(2.0**power for power in range(-3, 10, 3))
GAMMAS: Final = tuple(2.0**power for power in range(-5, 4, 2))
"""Grid of C and gamma for the cross-validation."""

_FIRST: Final = (8.0, 0.5)
"""C and gamma of the machine that finds the hard samples."""

_GAIN: Final = 1e-6
"""Bricks that a placement has to save to pay."""


TrainedExchanges = Trained[Samples]
"""The outcome of a training; classes are: does not pay, pays."""


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
) -> TrainedExchanges:
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

    def said(out: Mask, c: float, gamma: float) -> Mask:
        kinds = np.unique(samples.pays[~out])
        if len(kinds) == 1:
            # a machine that was trained on one kind alone predicts only this kind
            return np.full(np.count_nonzero(out), kinds[0])
        machine = Machine.of(samples.take(~out), c=c, gamma=gamma)
        return machine.decision(samples.levels[out]) > 0

    return cross_validated(samples, samples.pays, samples.model, said, rng, costs=costs, gammas=gammas)


def written(trained: TrainedExchanges, facts: Mapping[str, str]) -> str:
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
    rows = np.column_stack([samples.model, samples.pays, samples.levels]).astype(int)
    told = trained.facts(f"{len(samples.pays)}, of which {samples.pays.sum()} pay")
    return text_of({**facts, **told}, COLUMNS, rows.tolist())
