"""Join loose components to the main one by exchanging bricks.

Bricks lie in columns of cells: stacked bricks are connected. So two
components can be joined only by a brick across columns of both. Such bricks are
offered to :func:`~.exchange.exchange` with a reward, in all sheets that a loose
component reaches; free cells of the second row, under a wide roof or over a
wide floor, count as part of the columns that end there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.ndimage import maximum_filter

from ...arrays import Floats, Mask
from ...model import COLOUR_EMPTY, NOBODY, Bricks, Catalogue, ContactGraph, Fill, UnitGrid, contact_graph
from ...progress import Progress
from ..problem import (
    Index,
    Placements,
    Problem,
    Rows,
    Shapes,
    Sheets,
    brick_table,
    gather,
    owners,
    placements,
    pose,
    spread,
    standing,
    with_margins,
)
from ..solvers import exchange
from .islands import Islands, loose_bricks

_ROUNDS: Final = 16
"""Most rounds of joining; each joins neighbours of neighbours."""

_PROGRESS: Final = 0.95
"""Share of the loose bricks that a round may leave for another one of its kind to follow."""

_PATCH: Final = 2.5
"""What to reckon, in bricks, for the rest of a cut brick that needs several. Such
moves may leave loose bricks themselves, so they are tried when nothing else helps."""

_Way = tuple[float, int | None]
_WAYS: Final[tuple[_Way, ...]] = tuple((patch, half) for patch in (np.inf, _PATCH) for half in (None, 0, 1))
"""Price of a patch, and which sheets may change: all, or every other one. What one
sheet joins the next one may take apart, if both change at once."""

_JOIN: Final = 3.5
"""What it is worth to join two components, in bricks."""

_OFFERS: Final = (4096, 2)
"""Most placements tried in a round: so many, or so many for each brick of the model."""

_REACH: Final = 8
"""Studs around a loose component in which bricks may change."""


def connect_loose(
    bricks: Bricks,
    grid: UnitGrid,
    work: Sequence[tuple[Sheets, Shapes]],
    catalogue: Catalogue,
    rng: np.random.Generator,
    progress: Progress,
) -> Bricks:
    """Join loose bricks to the rest, as far as a few rounds of exchanges can.

    Parameters
    ----------
    bricks : Bricks
        A model without overlaps.
    grid : UnitGrid
        The cells that it covers.
    work : sequence of (Sheets, Shapes)
        The same as sheets, and what may be laid there.
    catalogue : Catalogue
        Whose parts the bricks are.
    rng : numpy.random.Generator
        Decides between equals.
    progress : Progress
        Told before each round.

    Returns
    -------
    Bricks
        Covers the same required cells, with no more loose and no more floating bricks than before.
    """
    links = contact_graph(bricks, catalogue)
    if links.n_components <= 1:
        return bricks
    required = with_margins(grid.cover >= Fill.REQUIRED, False)
    islands = Islands.of(with_margins(grid.colour, COLOUR_EMPTY), owners(links, required.shape), links.component)
    loose = loose_bricks(bricks, links, islands, catalogue)
    cells, way = _Cells.of(bricks, links, required, loose, catalogue), 0
    # what is no part of a sheet stays as it is
    fixed = bricks.take(~np.isin(bricks.part, np.concatenate([among.part for _, among in work])))
    offers: list[_Offer] = []
    for number in range(_ROUNDS):
        if not cells.n_loose or way == len(_WAYS):
            break
        progress("connection", number / _ROUNDS)
        # the possible placements stay the same until the bricks change
        offers = offers or [_Offer.of(bricks, sheets, among, cells, rng) for sheets, among in work]
        relaid = [offer.joined(*_WAYS[way], rng) for offer in offers]
        if all(new is offer.bricks for new, offer in zip(relaid, offers, strict=True)):
            way += 1
            continue
        tried = gather([*relaid, fixed])
        tried_links = contact_graph(tried, catalogue)
        loose = loose_bricks(tried, tried_links, islands, catalogue)
        before, after = cells.n_loose, int(np.count_nonzero(loose))
        if after < before and tried_links.n_floating <= links.n_floating:
            bricks, links, offers = tried, tried_links, []
            cells = _Cells.of(bricks, links, required, loose, catalogue)
        way = 0 if after < _PROGRESS * before else way + 1
    return bricks


@dataclass(frozen=True, slots=True, eq=False)
class _Cells:
    """The cells of a model and what is loose in it.

    Attributes
    ----------
    owner : (n_plates + 2, n_y, n_x) int32 array
        Row of the brick, ``NOBODY`` or ``GROUND``, with one empty plane below and one above.
    required : (n_plates + 2, n_y, n_x) bool array
        Cells that have to be covered.
    label : (n + 2,) int32 array
        For each brick 0 in the main component of its island, a number for each
        loose component; then -1 for the ground and for nobody.
    reached : (n_plates + 2,) bool array
        Planes in which a loose brick is.
    n_loose : int
        Bricks in loose components.
    """

    owner: Rows
    required: Mask
    label: Rows
    reached: Mask
    n_loose: int

    @classmethod
    def of(cls, bricks: Bricks, links: ContactGraph, required: Mask, loose: Mask, catalogue: Catalogue) -> _Cells:
        """Label the bricks of a model, given those that are loose."""
        owner = standing(links, required)
        label = np.append(np.where(loose, links.component + 1, 0), [-1, -1]).astype(np.int32)
        height = catalogue.height[bricks.part[loose]]
        lowest = bricks.corner[loose, 2] + 1
        ends = (np.bincount(plane, minlength=len(owner)) for plane in (lowest, lowest + height))
        return cls(owner, required, label, np.cumsum(np.subtract(*ends)) > 0, int(np.count_nonzero(loose)))

    def labels(self, sheets: Sheets) -> Rows:
        """Return the labels below, above and in the cells of sheets, (3, n_sheets, n_y, n_x)."""
        return self.label[self.owner[[sheets.level, sheets.level + sheets.height + 1, sheets.level + 1]]]


@dataclass(frozen=True, slots=True, eq=False)
class _Offer:
    """Joining bricks for the sheets of one height that a loose component reaches.

    Attributes
    ----------
    bricks : Bricks
        All of this height.
    problem : Problem
        The sheets that are reached.
    here, lying : (n_here,) intp arrays
        Rows of the bricks that may change, and of the placements where they lie.
    row : (n_moves,) intp array
        Placements to try.
    reward : (n_moves,) float64 array
        What the components that each joins are worth, in bricks.
    """

    bricks: Bricks
    problem: Problem | None
    here: Index
    lying: Index
    row: Index
    reward: Floats

    @classmethod
    def of(cls, bricks: Bricks, sheets: Sheets, among: Shapes, cells: _Cells, rng: np.random.Generator) -> _Offer:
        """List what could be laid instead of bricks; some of it at random if it is too much."""
        most = max(_OFFERS[0], _OFFERS[1] * len(bricks))
        bricks = bricks.take(np.isin(bricks.part, among.part))
        sheets = sheets.take(cells.reached[sheets.level[:, None] + [0, 1, sheets.height + 1]].any(axis=1))
        labels = cells.labels(sheets)
        loose = (labels > 0).any(axis=0) & (sheets.colour != COLOUR_EMPTY)
        reached = loose.any(axis=(1, 2))
        if not reached.any():
            none = np.zeros(0, dtype=np.intp)
            return cls(bricks, None, none, none, none, np.zeros(0))
        sheets, labels, loose = sheets.take(reached), labels[:, reached], loose[reached]
        worthwhile = sheets.required | (cells.owner[sheets.level + 1] > NOBODY) | loose
        found = placements(replace(sheets, required=_near(loose) & worthwhile), among)
        problem = pose(sheets, among, found, cells.owner, cells.required)
        at = labels.reshape(3, -1)[:, sheets.cells]
        # a placement that touches nothing above or below would be loose itself
        alone = found.totals(at[:2].max(axis=0) >= 0) == 0
        problem = replace(problem, cost=problem.cost + _JOIN * alone)
        here = np.flatnonzero(np.isin(bricks.corner[:, 2], sheets.level))
        corner = bricks.corner[here]
        corner[:, 2] = np.searchsorted(sheets.level, corner[:, 2])
        # bricks out of reach are not found and do not change
        lying = found.find(among.rows_of(bricks.part[here], bricks.turn[here]), corner)
        row, reward = _offers(found, at, most, rng)
        return cls(bricks, problem, here[lying >= 0], lying[lying >= 0], row, reward)

    def joined(self, patch: float, parity: int | None, rng: np.random.Generator) -> Bricks:
        """Make the moves that pay once, in all sheets or in every other one; the same bricks if none does."""
        if self.problem is None:
            return self.bricks
        sheets = self.problem.sheets
        tried = np.ones(len(self.row), dtype=bool)
        if parity is not None:
            tried = (sheets.level // sheets.height % 2 == parity)[self.problem.placements.corner[self.row, 2]]
        if not tried.any():
            return self.bricks
        row, reward = self.row[tried], self.reward[tried]
        chosen = exchange(self.problem, self.lying, row, rng, reward=reward, patch=patch)
        if chosen is self.lying:
            return self.bricks
        kept = self.bricks.take(np.delete(np.arange(len(self.bricks)), self.here))
        return gather([kept, brick_table(self.problem, chosen)])


def _near(loose: Mask) -> Mask:
    """Tell which cells are near those that are loose, (n_sheets, n_y, n_x)."""
    near = np.zeros_like(loose)
    for sheet, marked in zip(near, loose, strict=True):
        # loose cells are few: only the part of a sheet around them is searched
        box = spread(marked.any(axis=1), _REACH), spread(marked.any(axis=0), _REACH)
        sheet[box] = maximum_filter(marked[box], size=2 * _REACH + 1)
    return near


def _offers(found: Placements, labels: Rows, most: int, rng: np.random.Generator) -> tuple[Index, Floats]:
    """Choose placements that could hold loose components.

    Parameters
    ----------
    found : Placements
        What may be laid.
    labels : (3, n_cells) int32 array
        Labels below, above and in each cell.
    most : int
        How many to choose.
    rng : numpy.random.Generator
        Chooses, if there are more.

    Returns
    -------
    row : (n_moves,) intp array
        Placements through or next to loose components.
    reward : (n_moves,) float64 array
        What the components that each joins are worth.
    """
    rows = found.through((labels > 0).any(axis=0))
    if len(rows) > most:
        rows = np.sort(rng.choice(rows, most, replace=False))
    placement = np.repeat(np.arange(len(rows)), found.size[rows])
    n_labels = int(labels.max()) + 1
    # a placement joins what is below and above it, not what lies in its way
    around = labels[:2, found.cells[found.entries(rows)]]
    touched = np.unique(np.concatenate([(placement * n_labels + label)[label >= 0] for label in around]))
    joins = np.bincount(touched // n_labels, minlength=len(rows)) - 1
    return rows, _JOIN * np.maximum(joins, 0)
