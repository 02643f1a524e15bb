"""How few bricks a model could be built of, or how little it could cost: proven lower bounds for every layout.

Every cell gets a price, so that the cells of no placement are worth more than
one brick together, or more than its part costs. Then no layout has fewer bricks,
or costs less, than all cells are worth (weak duality), whoever lays it. The dual of the linear programme finds the best
prices. On very wide sheets it finds those around the middle alone, whose cells keep
an equal share of the largest part, or else block after block, the others staying
as they are.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from ..arrays import Floats, Mask
from ..layout.problem import (
    Candidates,
    Index,
    Placements,
    Shapes,
    Sheets,
    blocks,
    dominated,
    part_costs,
    placements,
    shapes,
    split,
)
from ..layout.solvers import prices
from ..model import Catalogue, UnitGrid
from ..progress import Progress, silent

_BATCH: Final = 3000
"""Placements from which no more sheets are put into one linear programme."""

_SLAB: Final = 1 << 14
"""Cells whose placements are listed at once."""

_LARGE: Final = 30_000
_WIDE: Final = 60_000
_SIDE: Final = 32
"""Placements above which the middle of wide areas keeps its prices, which loses up to
two percent there; above which the rest is priced block after block; studs along a block."""

_ROUNDING: Final = 1e-6
"""What the prices of a component may lose by rounding."""

_FREE: Final = 1e-6
"""Bricks below which a part counts as free: what its cells are worth is then within the rounding."""


def lower_bound(grid: UnitGrid, catalogue: Catalogue, *, progress: Progress = silent) -> int:
    """Return a number of bricks that no layout of a model falls below.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model. Which columns are laid in bricks and which in
        plates is part of it; other layouts of it do not exist.
    catalogue : Catalogue
        Parts and colours.
    progress : Progress
        Told before each batch of sheets.

    Returns
    -------
    int
        At least one brick for each required cell that none shares with another one,
        and so on: the sum over all components of the linear programme's bound,
        rounded up.
    """
    plain = replace(catalogue, cost=None)
    return sum(int(np.ceil(worth - _ROUNDING).sum()) for worth in _worths(grid, plain, progress))


def least_cost(grid: UnitGrid, catalogue: Catalogue, price: Floats, *, progress: Progress = silent) -> float:
    """Return an amount of money that no layout of a model falls below.

    Parameters
    ----------
    grid : UnitGrid
        As for :func:`lower_bound`.
    catalogue : Catalogue
        Parts and colours.
    price : (n_parts, n_colours) float64 array
        Of one part in a colour, not below 0. Hidden parts may have any colour.
    progress : Progress
        Told before each batch of sheets.

    Returns
    -------
    float
        In the unit of the prices.
    """
    # prices of the size of bricks, for the solver's tolerances
    mean = float(price[catalogue.exists].mean()) or 1.0
    paid = replace(catalogue, cost=price / mean)
    return mean * sum(float(np.maximum(worth - _ROUNDING, 0).sum()) for worth in _worths(grid, paid, progress))


def _worths(grid: UnitGrid, catalogue: Catalogue, progress: Progress) -> Iterator[Floats]:
    """Yield what the cells of each component of some sheets are worth together, in what parts cost."""
    codes = np.unique(grid.colour[grid.colour >= 0])
    for sheets in split(grid):
        among = shapes(catalogue, sheets.height, codes, int(catalogue.codes[0]))
        for share, part in _slabs(sheets):
            found = placements(part, among)
            for which in _batches(found, len(part)):
                progress("bound", share)
                yield _worth_of_components(part.take(which), among, found.on(which, part.n_cells))


def _slabs(sheets: Sheets) -> Iterator[tuple[float, Sheets]]:
    """Yield sheets that are listed at once, and the share of those before."""
    slab = np.cumsum(sheets.n_cells) // _SLAB
    for number in np.unique(slab):
        yield float(np.mean(slab < number)), sheets.take(slab == number)


def _batches(found: Placements, n_sheets: int) -> list[Index]:
    """Divide sheets into batches of few placements."""
    batch = np.cumsum(np.bincount(found.corner[:, 2], minlength=n_sheets)) // _BATCH
    return [np.flatnonzero(batch == number) for number in np.unique(batch)]


def _worth_of_components(sheets: Sheets, among: Shapes, found: Placements) -> Floats:
    """Return the bound of each component of some sheets."""
    cells = sheets.cells
    required = sheets.required.reshape(-1)[cells]
    everything = Candidates.of(found)
    cost = part_costs(found, among, sheets)
    candidates = everything.only(~dominated(found, among, required, cost))
    sheet, y, x = np.unravel_index(cells, sheets.colour.shape)
    price = cell_prices(candidates, required, np.stack([x, y, sheet], axis=1), cost)
    group = everything.groups(len(required))
    of_cell = np.zeros(len(required), dtype=np.intp)
    of_cell[found.cells] = np.repeat(group, found.size)
    return np.bincount(of_cell, weights=price)


def cell_prices(candidates: Candidates, required: Mask, corner: Index, cost: Floats | None = None) -> Floats:
    """Price cells so that no placement is worth more than it costs.

    Parameters
    ----------
    candidates : Candidates
        Placements that are not dominated.
    required : (n_cells,) bool array
        Cells that have to be covered.
    corner : (n_cells, 3) intp array
        Where the cells are: x and y in studs, number of the sheet.
    cost : (n_placements,) float64 array, optional
        Of every placement of the problem, not below 0; one brick each by default.

    Returns
    -------
    (n_cells,) float64 array
        Prices in bricks, not above 0 where a cell need not be covered.
    """
    limit = np.ones(len(candidates.rows)) if cost is None else cost[candidates.rows]
    # to begin with, a brick is worth what it costs if all of its required cells have no better one
    needed = np.repeat(candidates.totals(required[candidates.cells]), candidates.size)
    share = np.full(len(required), np.inf)
    np.minimum.at(share, candidates.cells, np.repeat(limit, candidates.size) / np.maximum(needed, 1))
    price = np.where(required & np.isfinite(share), share, 0.0)
    for part in _parts(candidates, corner):
        inside = candidates.within(part)
        touching = np.isin(candidates.rows, inside.rows, assume_unique=True)
        room = (limit - _worth(candidates, np.where(part, 0.0, price)))[touching]
        cell, better = prices(inside, required, room)
        price[cell] = better
    worth = _worth(candidates, price)
    # rounding errors of the solver, for which all prices pay
    over = np.divide(worth, limit, out=np.ones(len(worth)), where=limit > _FREE).max(initial=0.0)
    priced: Floats = price / max(1.0, over)
    return priced


def _parts(candidates: Candidates, corner: Index) -> Iterator[Mask]:
    """Yield the cells that are priced together, again and again where they are not all of them."""
    choice = np.bincount(candidates.cells, minlength=len(corner))
    # the middle of a wide area can hardly be worth more
    part = choice < (choice.max() if len(candidates.rows) > _LARGE else np.inf)
    if len(candidates.within(part).rows) <= _WIDE:
        # on a checkerboard all cells are alike, and well priced to begin with
        yield from [part] if part.any() else []
        return
    for shift in (0, _SIDE // 2):
        yield from (core & part for _, core in blocks(corner, shift, _SIDE) if (core & part).any())


def _worth(candidates: Candidates, price: Floats) -> Floats:
    """Sum the prices of the cells of each placement."""
    return np.bincount(np.repeat(np.arange(len(candidates.rows)), candidates.size), weights=price[candidates.cells])
