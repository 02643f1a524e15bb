"""Hold loose bricks: join components that float to the rest by exchanging bricks.

Bricks lie in columns of cells: whatever is stacked is connected. So two
components can be joined only by a brick across columns of both. Such bricks are
offered to :func:`~.exchange.exchange` with a reward, in all sheets that a
floating component reaches; free cells of the second row, under a wide roof or
over a wide floor, count as part of the columns that end there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ..catalogue import Catalogue
from ..connection import NOBODY, Connection, connect
from ..model import COLOUR_EMPTY, Bricks, Floats, Mask
from .exchange import exchange
from .placements import Placements, placements
from .problem import GROUND, pose
from .shapes import Index, Rows, Shapes
from .sheets import Sheets
from .table import bricks_of, gathered

_ROUNDS: Final = 4
"""Most rounds of joining; each joins neighbours of neighbours."""

_JOIN: Final = 3.5
"""What it is worth to join two components, in bricks."""

_OFFERS: Final = 2
"""Placements tried in a round, for each brick of the model."""


def connect_loose(
    bricks: Bricks,
    work: Sequence[tuple[Sheets, Shapes]],
    must: Mask,
    catalogue: Catalogue,
    rng: np.random.Generator,
) -> Bricks:
    """Join what floats to what stands, as far as a few rounds of exchanges can.

    Parameters
    ----------
    bricks : Bricks
        A model without overlaps.
    work : sequence of (Sheets, Shapes)
        The sheets it lies on, and what may be laid there.
    must : (n_plates + 2, n_y, n_x) bool array
        Cells that have to be covered; the first plane is below the lowest plate.
    catalogue : Catalogue
        Whose parts the bricks are.
    rng : numpy.random.Generator
        Decides between equals.

    Returns
    -------
    Bricks
        Covers the same must cells with no more floating bricks than before.
    """
    links = connect(bricks, catalogue)
    for _ in range(_ROUNDS):
        if not links.n_floating:
            break
        cells = _Cells.of(bricks, links, must)
        tried = gathered(
            [
                _joined(bricks.take(np.isin(bricks.part, among.part)), sheets, among, cells, rng)
                for sheets, among in work
            ]
        )
        tried_links = connect(tried, catalogue)
        if tried_links.n_floating >= links.n_floating:
            break
        bricks, links = tried, tried_links
    return bricks


@dataclass(frozen=True, slots=True, eq=False)
class _Cells:
    """All cells of a model, shape (n_plates + 2, n_y, n_x): one empty plane below and one above.

    Attributes
    ----------
    owner : int32 array
        Row of the brick, ``NOBODY`` or ``GROUND``.
    label : int32 array
        0 where a brick stands, a number for each floating component, -1 where
        there is no brick.
    must : bool array
        Cells that have to be covered.
    """

    owner: Rows
    label: Rows
    must: Mask

    @classmethod
    def of(cls, bricks: Bricks, links: Connection, must: Mask) -> _Cells:
        """Label the cells of a model."""
        n_z, n_y, n_x = links.owner.shape
        owner = np.full(must.shape, NOBODY, dtype=np.int32)
        owner[1 : n_z + 1, :n_y, :n_x] = links.owner
        label = np.append(np.where(links.grounded, 0, links.component + 1), -1).astype(np.int32)[owner]
        owner[: bricks.corner[:, 2].min() + 1] = GROUND
        return cls(owner, label, must)


def _joined(bricks: Bricks, sheets: Sheets, among: Shapes, cells: _Cells, rng: np.random.Generator) -> Bricks:
    """Offer joining bricks once, in the sheets of one height that a floating component reaches."""
    around = _around(sheets, cells)
    own = cells.label[sheets.level + 1]
    reached = np.maximum(around.max(axis=0), own).max(axis=(1, 2), where=sheets.colour != COLOUR_EMPTY, initial=-1) > 0
    if not reached.any():
        return bricks
    sheets, around, own = sheets.take(reached), around[:, reached], own[reached]
    affected = np.isin(bricks.corner[:, 2], sheets.level)
    # whatever lies there has to be found again, ties between may cells included
    worthwhile = sheets.must | (own >= 0) | (around > 0).any(axis=0)
    found = placements(replace(sheets, must=worthwhile), among)
    problem = pose(
        sheets, among, found, below=cells.owner[sheets.level], above=cells.must[sheets.level + 1 + sheets.height]
    )
    around, own = around.reshape(2, -1)[:, sheets.cells], own.reshape(-1)[sheets.cells]
    alone = found.totals(around.max(axis=0) >= 0) == 0
    problem = replace(problem, cost=problem.cost + _JOIN * alone)
    corner = bricks.corner[affected]
    corner[:, 2] = np.searchsorted(sheets.level, corner[:, 2])
    chosen = found.find(among.rows_of(bricks.part[affected], bricks.turn[affected]), corner)
    offered, reward = _offers(found, np.vstack([around, own]), _OFFERS * len(bricks), rng)
    chosen = exchange(problem, chosen, offered, rng, reward=reward)
    return gathered([bricks.take(~affected), bricks_of(sheets, problem, chosen)])


def _around(sheets: Sheets, cells: _Cells) -> Rows:
    """Return the labels below and above each cell, shape (2, n_sheets, n_y, n_x)."""
    return np.stack([cells.label[sheets.level], cells.label[sheets.level + 1 + sheets.height]])


def _offers(found: Placements, labels: Rows, most: int, rng: np.random.Generator) -> tuple[Index, Floats]:
    """Choose placements that could hold floating components.

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
        Placements through or next to floating components.
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
