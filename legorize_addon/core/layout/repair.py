"""Hold loose bricks: join components to the main one by exchanging bricks.

Bricks lie in columns of cells: whatever is stacked is connected. So two
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
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from ..catalogue import Catalogue
from ..connection import NOBODY, Connection, connect
from ..model import COLOUR_ANY, COLOUR_EMPTY, Bricks, Cover, Floats, Mask, UnitGrid
from ..progress import Progress
from .exchange import exchange
from .placements import Placements, placements
from .problem import GROUND, owners, pose, with_margins
from .shapes import Index, Plane, Rows, Shapes
from .sheets import Sheets
from .table import bricks_of, gathered

_ROUNDS: Final = 16
"""Most rounds of joining; each joins neighbours of neighbours."""

_PROGRESS: Final = 0.95
"""Share of the loose bricks that a round may leave for another one of its kind to follow."""

_PATCH: Final = 2.5
"""What to reckon, in bricks, for the rest of a cut brick that needs several. Such
moves may leave loose bricks themselves, so they are tried when nothing else helps."""

_WAYS: Final = ((np.inf, None), (np.inf, 0), (np.inf, 1), (_PATCH, None), (_PATCH, 0), (_PATCH, 1))
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
    """Join what is loose to the rest, as far as a few rounds of exchanges can.

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
        Covers the same must cells, with no more loose and no more floating
        bricks than before.
    """
    links = connect(bricks, catalogue)
    if links.n_components <= 1:
        return bricks
    must, island = with_margins(grid.cover == Cover.MUST, False), _islands(with_margins(grid.colour, COLOUR_EMPTY))
    cells, way = _Cells.of(links, must, island), 0
    for number in range(_ROUNDS):
        if not cells.n_loose or way == len(_WAYS):
            break
        progress("connection", number / _ROUNDS)
        patch, parity = _WAYS[way]
        tried = gathered(
            [
                _joined(bricks.take(np.isin(bricks.part, among.part)), sheets, among, cells, patch, parity, rng)
                for sheets, among in work
            ]
        )
        tried_links = connect(tried, catalogue)
        tried_cells = _Cells.of(tried_links, must, island)
        before, after = cells.n_loose, tried_cells.n_loose
        if after < before and tried_links.n_floating <= links.n_floating:
            bricks, links, cells = tried, tried_links, tried_cells
        way = 0 if after < _PROGRESS * before else way + 1
    return bricks


def _islands(colour: Plane) -> Rows:
    """Find the sets of cells that bricks could hold together, by stacking and by lying across one colour.

    Parameters
    ----------
    colour : (n_z, n_y, n_x) int16 array
        LDraw code, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.

    Returns
    -------
    (n_z, n_y, n_x) int32 array
        The island of each cell, of no meaning in empty ones.
    """
    filled = colour != COLOUR_EMPTY
    number = np.cumsum(filled).reshape(colour.shape) - 1
    pairs = []
    for axis in range(3):
        near, far = (np.moveaxis(colour, axis, 0)[part] for part in (slice(None, -1), slice(1, None)))
        one, other = (np.moveaxis(number, axis, 0)[part] for part in (slice(None, -1), slice(1, None)))
        agree = (near != COLOUR_EMPTY) & (far != COLOUR_EMPTY)
        if axis > 0:
            agree &= (near == far) | (near == COLOUR_ANY) | (far == COLOUR_ANY)
        pairs.append(np.stack([one[agree], other[agree]]))
    one, other = np.concatenate(pairs, axis=1)
    n_cells = int(np.count_nonzero(filled))
    graph = coo_array((np.ones(len(one), dtype=bool), (one, other)), shape=(n_cells, n_cells))
    island = np.zeros(colour.shape, dtype=np.int32)
    island[filled] = connected_components(graph, directed=False)[1]
    return island


@dataclass(frozen=True, slots=True, eq=False)
class _Cells:
    """All cells of a model, shape (n_plates + 2, n_y, n_x): one empty plane below and one above.

    Attributes
    ----------
    owner : int32 array
        Row of the brick, ``NOBODY`` or ``GROUND``.
    label : int32 array
        0 in the main component of each island, a number for each loose
        component, -1 where there is no brick.
    must : bool array
        Cells that have to be covered.
    n_loose : int
        Bricks in loose components.
    """

    owner: Rows
    label: Rows
    must: Mask
    n_loose: int

    @classmethod
    def of(cls, links: Connection, must: Mask, island: Rows) -> _Cells:
        """Label the cells of a model, given the islands that it consists of."""
        owner = owners(links, must.shape)
        built = owner != NOBODY
        home = np.zeros(len(links.component), dtype=np.int32)
        home[owner[built]] = island[built]
        loose = _loose(links, home)
        label = np.append(np.where(loose, links.component + 1, 0), -1).astype(np.int32)[owner]
        owner[: built.any(axis=(1, 2)).argmax()] = GROUND
        return cls(owner, label, must, int(np.count_nonzero(loose)))


def _loose(links: Connection, island: Rows) -> Mask:
    """Tell which bricks are not in the main component of their island: the largest one, on the ground if any is."""
    component, first, size = np.unique(links.component, return_index=True, return_counts=True)
    order = np.lexsort((size, links.grounded[first], island[first]))
    main = np.append(np.diff(island[first][order]) > 0, True)
    return ~np.isin(links.component, component[order[main]])


def _joined(
    bricks: Bricks,
    sheets: Sheets,
    among: Shapes,
    cells: _Cells,
    patch: float,
    parity: int | None,
    rng: np.random.Generator,
) -> Bricks:
    """Offer joining bricks once, in the sheets of one height that a loose component reaches."""
    labels = np.stack([cells.label[sheets.level + plate] for plate in (0, sheets.height + 1, 1)])
    loose = (labels > 0).any(axis=0) & (sheets.colour != COLOUR_EMPTY)
    reached = loose.any(axis=(1, 2))
    if parity is not None:
        reached &= sheets.level // sheets.height % 2 == parity
    if not reached.any():
        return bricks
    sheets, labels, loose = sheets.take(reached), labels[:, reached], loose[reached]
    near = maximum_filter(loose, size=(1, 2 * _REACH + 1, 2 * _REACH + 1))
    worthwhile = sheets.must | (cells.owner[sheets.level + 1] > NOBODY) | loose
    found = placements(replace(sheets, must=near & worthwhile), among)
    problem = pose(sheets, among, found, cells.owner, cells.must)
    at = labels.reshape(3, -1)[:, sheets.cells]
    # what touches nothing above or below would be loose itself
    alone = found.totals(at[:2].max(axis=0) >= 0) == 0
    problem = replace(problem, cost=problem.cost + _JOIN * alone)
    here = np.flatnonzero(np.isin(bricks.corner[:, 2], sheets.level))
    corner = bricks.corner[here]
    corner[:, 2] = np.searchsorted(sheets.level, corner[:, 2])
    # bricks out of reach are not found and stay as they are
    row = found.find(among.rows_of(bricks.part[here], bricks.turn[here]), corner)
    offered, reward = _offers(found, at, max(_OFFERS[0], _OFFERS[1] * len(bricks)), rng)
    chosen = exchange(problem, row[row >= 0], offered, rng, reward=reward, patch=patch)
    return gathered([bricks.take(np.delete(np.arange(len(bricks)), here[row >= 0])), bricks_of(problem, chosen)])


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
