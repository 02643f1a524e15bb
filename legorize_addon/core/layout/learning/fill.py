"""The learned fill: layer by layer, polygon by polygon, a machine decides every brick.

A layer is first filled by the simulation alone, so that its polygons can be divided
into windows of bricks that lie together. Then the bricks of all windows are taken
up, and the machine decides anew: in each window the cell with the fewest ways left
comes next; behind every brick that may lie there the window is filled to its end;
and the machine chooses by the energies that come out. The first time what it
decides counts in any case; later, in other windows, it decides as well which of
the two fills is kept. What a layout costs is never looked at: all that is known of
that is in the labels that the machine learned from.

References
----------
Paper, section on the larger sized bricks: the machine "directly controls the
classification system ... according to the feedback from the filling simulation for
every polygon".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Final, Protocol

import numpy as np

from ...arrays import Mask
from ...model import COLOUR_EMPTY, NOBODY, Bricks, Fill, UnitGrid, ground_of
from ...progress import Progress, silent
from ..problem import (
    GROUND,
    Candidates,
    Index,
    Problem,
    Rows,
    Shapes,
    Sheets,
    brick_table,
    gather,
    placements,
    pose,
    with_margins,
)
from .layer import Layer
from .simulation import NONE, Outcome, Windows, measured, simulate
from .windows import Lists, grouped

PASSES: Final = 3
"""How often the windows are filled: once in each order of the simulation. Six times save 1 % and take twice as long."""

Choice = Callable[[Outcome, Index, np.random.Generator], Index]
"""From what came out behind the candidates (columns, -1 where there are fewer) to the number of one, (n_windows,)."""


class Watcher(Protocol):
    """Sees what the machine is asked."""

    def __call__(
        self, layer: Layer, windows: Windows, laid: Mask, before: Index, candidates: Index, outcome: Outcome
    ) -> None:
        """Look at decisions."""


def fill_upwards(
    grid: UnitGrid,
    work: Sequence[tuple[Sheets, Shapes]],
    fill: Callable[[Layer], Index],
    *,
    check: Callable[[Sheets, Mask], None],
    progress: Progress = silent,
) -> Bricks:
    """Lay a model from the ground upwards, each layer upon the one below.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model, with at least one cell to build.
    work : sequence of (Sheets, Shapes)
        The same as sheets, and what may be laid there.
    fill : callable
        From a layer to the rows of the placements that cover its required cells.
    check : callable
        Refuses cells of a sheet for which there is no placement.
    progress : Progress
        Told before each layer.

    Returns
    -------
    Bricks
    """
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    owner = np.full(required.shape, NOBODY, dtype=np.int32)
    owner[: ground_of(required)] = GROUND
    tables: list[Bricks] = []
    steps = list(_upwards(work))
    for number, (sheet, among) in enumerate(steps):
        progress("layout", number / len(steps))
        found = placements(sheet, among)
        if not len(found):
            check(sheet, sheet.required.reshape(-1)[sheet.cells])
            continue
        problem = pose(sheet, among, found, owner, required)
        [below], [above] = sheet.level, sheet.level + sheet.height + 1
        chosen = fill(Layer.of(problem, owner[below], (owner[above] != NOBODY) | required[above]))
        _write(problem, chosen, owner, sum(map(len, tables)))
        tables.append(brick_table(problem, chosen))
    return gather(tables)


def _upwards(work: Sequence[tuple[Sheets, Shapes]]) -> Iterator[tuple[Sheets, Shapes]]:
    """Yield single sheets from the lowest to the highest, bricks before plates."""
    places = [
        (int(level), number, row) for number, (sheets, _) in enumerate(work) for row, level in enumerate(sheets.level)
    ]
    for _, number, row in sorted(places):
        sheets, among = work[number]
        yield sheets.take(np.array([row])), among


def _write(problem: Problem, chosen: Index, owner: Rows, first: int) -> None:
    """Write the numbers of bricks, from `first`, into the planes of their sheet."""
    [sheet] = problem.sheets.colour
    [level] = problem.sheets.level
    covering = problem.owner(chosen)
    here = np.full(sheet.size, NOBODY, dtype=np.int32)
    here[problem.sheets.cells] = np.where(covering == NOBODY, NOBODY, first + covering)
    planes = owner[level + 1 : level + problem.sheets.height + 1]
    # bricks and plates of a layer share its planes
    planes[:] = np.where(sheet == COLOUR_EMPTY, planes, here.reshape(sheet.shape))


def simulated(layer: Layer) -> Index:
    """Fill a layer by the simulation alone: always the first placement in its order that fits.

    Parameters
    ----------
    layer : Layer

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements.
    """
    covered = np.zeros(len(layer.colour), dtype=bool)
    candidates = Candidates.of(layer.problem.placements)
    chosen = [candidates.rows[:0]]
    while len(candidates.rows):
        won = candidates.only(candidates.winners(-layer.ranks[0, candidates.rows], len(covered)))
        chosen.append(won.rows)
        covered[won.cells] = True
        candidates = candidates.clear_of(covered)
    return np.concatenate(chosen)


def decided(
    layer: Layer,
    choose: Choice,
    rng: np.random.Generator,
    *,
    passes: int = PASSES,
    keep: Choice | None = None,
    watch: Watcher | None = None,
) -> Index:
    """Fill a layer by decisions.

    Parameters
    ----------
    layer : Layer
    choose : callable
        The machine, or what stands for it.
    rng : numpy.random.Generator
        Draws the windows.
    passes : int
        How often the windows are filled.
    keep : callable, optional
        Chooses between what lies in a window and its new fill, in this order; by default whoever chooses bricks.
    watch : callable, optional
        Sees every decision.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements, ascending.
    """
    lists, chosen = Lists(layer), simulated(layer)
    for turn in range(passes):
        cells, window = grouped(layer, chosen, rng.permutation(len(chosen)))
        windows = lists.windows(cells, turn)
        laid = np.zeros(len(layer.cost), dtype=bool)
        laid[chosen] = True
        found = refilled(layer, windows, laid, choose, rng, watch)
        better = _preferred(
            measured(layer, windows, laid, _beside(_columns(windows, laid), found)), keep or choose, rng
        )
        better |= turn == 0
        rows = windows.rows_of(found, len(laid))[better]
        chosen = np.concatenate([chosen[~better[window]], rows[rows < len(laid)]])
    return np.sort(chosen)


def _preferred(outcome: Outcome, choose: Choice, rng: np.random.Generator) -> Mask:
    """Return for which windows the second of two fills is chosen."""
    preferred: Mask = choose(outcome, np.zeros(outcome.cost.shape, dtype=np.intp), rng) == 1
    return preferred


def _beside(one: Index, other: Index) -> Index:
    """Return two fills of each window, (n_windows, 2, n_bricks)."""
    width = max(one.shape[1], other.shape[1])
    return np.stack(
        [np.pad(each, ((0, 0), (0, width - each.shape[1])), constant_values=NONE) for each in (one, other)], axis=1
    )


def _columns(windows: Windows, laid: Mask) -> Index:
    """Return the columns of what lies in windows, -1 where there is less, (n_windows, n_most)."""
    window, column = np.nonzero(np.append(laid, False)[windows.rows])
    count = np.bincount(window, minlength=len(windows))
    table = np.full((len(windows), count.max()), NONE, dtype=np.intp)
    table[window, np.arange(len(window)) - np.repeat(np.cumsum(count) - count, count)] = column
    return table


def refilled(
    layer: Layer,
    windows: Windows,
    laid: Mask,
    choose: Choice,
    rng: np.random.Generator,
    watch: Watcher | None = None,
) -> Index:
    """Fill windows brick by brick, always as a machine decides.

    Parameters
    ----------
    layer : Layer
    windows : Windows
    laid : (n,) bool array
        Placements that lie in the layer.
    choose, rng, watch
        As for :func:`decided`.

    Returns
    -------
    (n_windows, n_bricks) intp array
        Columns of the placements, -1 where there are fewer.
    """
    before = np.full((len(windows), 0), NONE, dtype=np.intp)
    covered = ~windows.free
    while True:
        candidates = windows.candidates(covered)
        if (candidates < 0).all():
            return before
        outcome = simulate(layer, windows, laid, before, candidates)
        if watch:
            watch(layer, windows, laid, before, candidates, outcome)
        column = np.take_along_axis(candidates, choose(outcome, candidates, rng)[:, None], axis=1)
        before = np.concatenate([before, column], axis=1)
        covered |= windows.covered(column)[:, 0]
