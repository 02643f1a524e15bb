"""From the cells of a model to its bricks, sheet after sheet.

Bricks prefer to lie across the seams of what lies below and above already; none
may hang in the air. No sheet touches the sheets two levels further, so every
other one is laid at once: first quickly, for the sheets between to have
something to lie across, and again when those are laid.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Final, Literal

import numpy as np

from ..arrays import Floats, Mask
from ..errors import BuildError
from ..model import COLOUR_EMPTY, NOBODY, Bricks, Catalogue, Fill, UnitGrid, ground_of
from ..progress import Progress, silent
from ..units import PLATES_PER_BRICK, count_of
from .fixed import owners_of
from .joining import connect_loose, join_by_windows
from .learning import improved, shipped
from .problem import (
    BRIDGE,
    GROUND,
    Bar,
    Index,
    Placements,
    Problem,
    Rows,
    Shapes,
    Sheets,
    brick_table,
    gather,
    placements,
    pose,
    shapes,
    split,
    with_margins,
    without_barred,
)
from .solvers import exact, fewer_small, greedy, guessed_prices, linear
from .symmetric import Fold

FILLER: Final = 71
"""LDraw code of Light Bluish Gray, in which nearly every part is made: for hidden bricks."""

_SLAB: Final = 1 << 15
"""Cells that are laid together: enough to drown the cost of a numpy call, few
enough for the memory (147 placements go through a cell in a wide area)."""

_BATCH: Final = 5000
"""Placements up to which sheets are put into one linear programme."""

Tier = Literal["fast", "standard", "exact"]
Way = Callable[[Problem, np.random.Generator], Index]
Work = Sequence[tuple[Sheets, Shapes]]

_PASSES: Final[Mapping[Tier, tuple[tuple[Way, float], ...]]] = MappingProxyType(
    {
        "fast": ((greedy.cover, BRIDGE), (greedy.cover, BRIDGE)),
        "standard": ((greedy.cover, BRIDGE), (linear.cover, 0.05), (linear.cover, 0.1)),
        "exact": ((greedy.cover, BRIDGE), (exact.cover, 0.05), (exact.cover, 0.05)),
    }
)
"""How the even sheets are laid, then the odd ones, and then the even ones again;
and what lying across a seam saves then, in bricks: little across seams that do
not stay, and for the fewest bricks less than a brick in most places."""


@dataclass(frozen=True, slots=True, eq=False)
class Manner:
    """How sheets are laid.

    Attributes
    ----------
    tier : str
        How much work goes into few bricks, see :func:`lay`.
    exchanges : (4, 16, 16, 24) bool array, optional
        What the fast tier exchanges, see :func:`lay`.
    fold : Fold, optional
        Where the grid is folded, if it is one half of a symmetric one.
    beside : (n_plates + 2, n_y, n_x) int32 array, optional
        Bricks that lie in other cells already, see :func:`~.problem.owners`.
    bars : tuple of Bar
        Parts that may not lie at some places.
    """

    tier: Tier
    exchanges: Mask | None = None
    fold: Fold | None = None
    beside: Rows | None = None
    bars: tuple[Bar, ...] = ()


def lay(
    grid: UnitGrid,
    catalogue: Catalogue,
    *,
    rng: np.random.Generator,
    tier: Tier = "standard",
    exchanges: Mask | None = None,
    filler: int = FILLER,
    progress: Progress = silent,
) -> Bricks:
    """Cover a model by bricks.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    catalogue : Catalogue
        Parts and colours.
    rng : numpy.random.Generator
        Decides between equals; the same state gives the same bricks.
    tier : str
        How much work goes into few bricks: ``"fast"`` (see :mod:`.greedy`),
        ``"standard"`` (see :mod:`.linear`) or ``"exact"`` (see :mod:`.exact`).
    exchanges : (4, 16, 16, 24) bool array, optional
        What the fast tier exchanges, as :meth:`~.svm.Machine.table`; by default those of the built-in training; none if
        all are False.
    filler : int
        LDraw code of hidden bricks.
    progress : Progress
        Told before each batch of sheets.

    Returns
    -------
    Bricks
        Every required cell lies in one brick, every optional cell in one or none,
        and each brick has the colour of its cells and is made in it. By ascending
        level, one step a layer.

    Raises
    ------
    BuildError
        There is nothing to build, or a required cell cannot be covered, because no part of one cell is made in its
        colour.
    """
    work = sheets_and_shapes(grid, catalogue, filler)
    bricks = cover(grid, work, rng, Manner(tier, exchanges), progress)
    return join_loose(bricks, grid, catalogue, work, rng, progress)


def lay_fixed(
    grid: UnitGrid,
    catalogue: Catalogue,
    fixed: Bricks,
    manner: Manner,
    *,
    rng: np.random.Generator,
    filler: int = FILLER,
    progress: Progress = silent,
) -> Bricks:
    """Cover a model by bricks as :func:`lay` does, around those that lie in its fixed cells; return both."""
    work = sheets_and_shapes(grid, catalogue, filler)
    beside = owners_of(fixed, grid, catalogue)
    bricks = gather([fixed, cover(grid, work, rng, replace(manner, beside=beside), progress)])
    return join_loose(bricks, grid, catalogue, work, rng, progress)


def join_loose(
    bricks: Bricks, grid: UnitGrid, catalogue: Catalogue, work: Work, rng: np.random.Generator, progress: Progress
) -> Bricks:
    """Join what is loose, as far as other layouts can."""
    bricks = connect_loose(bricks, grid, work, catalogue, rng, progress)
    return join_by_windows(bricks, grid, work, catalogue, progress)


def lay_unjoined(
    grid: UnitGrid, catalogue: Catalogue, *, rng: np.random.Generator, tier: Tier = "standard", filler: int = FILLER
) -> Bricks:
    """Like :func:`lay`, but leave loose bricks where they are."""
    return cover(grid, sheets_and_shapes(grid, catalogue, filler), rng, Manner(tier), silent)


def sheets_and_shapes(grid: UnitGrid, catalogue: Catalogue, filler: int) -> Work:
    """Return the sheets of each height, and the shapes that may lie there."""
    codes = np.unique(grid.colour[grid.colour >= 0])
    return [(each, shapes(catalogue, each.height, codes, filler)) for each in split(grid)]


def cover(grid: UnitGrid, work: Work, rng: np.random.Generator, manner: Manner, progress: Progress) -> Bricks:
    """Cover the sheets of a model, a slab of layers after the other."""
    required = with_margins(grid.cover == Fill.REQUIRED, False)
    if not required.any():
        raise BuildError("The model has no cells to build: make it larger.")
    owner = np.full(required.shape, NOBODY, dtype=np.int32) if manner.beside is None else manner.beside.copy()
    owner[: ground_of(required | (owner != NOBODY))] = GROUND
    slab_of_layer = np.cumsum(grid.solid.any(axis=1).sum(axis=(1, 2))) // _SLAB
    tier, exchanges = manner.tier, manner.exchanges
    worth = (shipped() if exchanges is None else exchanges) if tier == "fast" else None
    laid: list[Bricks] = []
    slabs = np.unique(slab_of_layer)
    for turn, slab in enumerate(slabs):
        listed = _listed(work, slab_of_layer == slab, owner, required, manner)

        def tell(share: float, turn: int = turn) -> None:
            progress("layout", (turn + share) / len(slabs))

        laid += _passed(listed, _PASSES[tier], owner, required, worth, rng, tell)
    return gather(laid)


@dataclass(frozen=True, slots=True, eq=False)
class _Listed:
    """Sheets of one height, their placements, where they are folded, and estimated prices of their cells."""

    sheets: Sheets
    among: Shapes
    found: Placements
    fold: Fold | None
    price: Floats | None = None

    def take(self, which: Index) -> _Listed:
        """Return some of the sheets."""
        sheet = np.repeat(np.arange(len(self.sheets)), self.sheets.n_cells)
        price = None if self.price is None else self.price[np.isin(sheet, which)]
        found = self.found.on(which, self.sheets.n_cells)
        return _Listed(self.sheets.take(which), self.among, found, self.fold, price)

    def pose(self, owner: Rows, required: Mask, bridge: float = BRIDGE) -> Problem:
        """Put costs on the placements."""
        problem = replace(pose(self.sheets, self.among, self.found, owner, required, bridge), price=self.price)
        return problem if self.fold is None else self.fold.priced(problem)


def _listed(work: Work, layers: Mask, owner: Rows, required: Mask, manner: Manner) -> list[_Listed]:
    """List what may lie on the sheets of some layers."""
    listed = []
    for sheets, among in work:
        inside = sheets.take(layers[sheets.level // PLATES_PER_BRICK])
        if len(inside):
            found = without_barred(placements(inside, among), among, inside, manner.bars)
            found = found if manner.fold is None else manner.fold.possible(found, among)
            each = _Listed(inside, among, found, manner.fold)
            guessed = manner.tier == "standard"
            listed.append(replace(each, price=guessed_prices(each.pose(owner, required))) if guessed else each)
    return listed


def _passed(
    listed: Sequence[_Listed],
    passes: Sequence[tuple[Way, float]],
    owner: Rows,
    required: Mask,
    worth: Mask | None,
    rng: np.random.Generator,
    tell: Callable[[float], None],
) -> list[Bricks]:
    """Lay sheets in passes, every other one at once; write their bricks into `owner`; tell the share of passes done."""
    halves: list[list[Bricks]] = [[], []]
    first = int(owner.max()) + 1
    for number, (way, bridge) in enumerate(passes):
        halves[number % 2] = half = []
        for each in _batches(listed, number % 2, np.inf if way is greedy.cover else _BATCH):
            tell(number / len(passes))
            half.append(_laid(each.pose(owner, required, bridge), owner, first, way, worth, rng))
            first += len(half[-1])
    return halves[0] + halves[1]


def _batches(listed: Sequence[_Listed], half: int, most: float) -> Iterator[_Listed]:
    """Yield every other sheet, as many at once as have at most so many placements."""
    for each in listed:
        which = np.flatnonzero(each.sheets.level // each.sheets.height % 2 == half)
        count = np.bincount(each.found.corner[:, 2], minlength=len(each.sheets))[which]
        for batch in np.split(which, _ends(count, most)) if len(which) else ():
            yield each.take(batch)


def _ends(count: Index, most: float) -> list[int]:
    """Return where runs of numbers have to end so that no sum is above the most, unless one number is."""
    ends, total = [], 0
    for row, number in enumerate(count.tolist()):
        total += number
        if total > most and total > number:
            ends.append(row)
            total = number
    return ends


def _laid(problem: Problem, owner: Rows, first: int, way: Way, worth: Mask | None, rng: np.random.Generator) -> Bricks:
    """Lay sheets that do not touch; write the numbers of their bricks, from `first`, into `owner`."""
    sheets = problem.sheets
    chosen = fewer_small(problem, way(problem, rng), rng)
    if worth is not None:
        chosen = improved(problem, chosen, rng, worth)
    covering = problem.owner(chosen)
    check_covered(sheets, problem.required & (covering == NOBODY))
    here = np.full(sheets.colour.shape, NOBODY, dtype=np.int32)
    here.reshape(-1)[sheets.cells] = np.where(covering == NOBODY, NOBODY, first + covering)
    # bricks and plates of a layer share its planes
    for plate in range(1, sheets.height + 1):
        planes = owner[sheets.level + plate]
        owner[sheets.level + plate] = np.where(sheets.colour == COLOUR_EMPTY, planes, here)
    return brick_table(problem, chosen)


def check_covered(sheets: Sheets, missing: Mask) -> None:
    """Refuse cells, (n_cells,), that nothing covers."""
    if not missing.any():
        return
    code = sheets.colour.reshape(-1)[sheets.cells[missing]][0]
    cells = count_of(int(np.count_nonzero(missing)), "cell", "cells")
    raise BuildError(
        f"{cells} cannot be covered, because no part of one cell is made in such a colour: leave colour {code} out of "
        "the palette."
    )
