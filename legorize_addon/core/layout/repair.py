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

from ..catalogue import Catalogue
from ..connection import NOBODY, Connection, components, connect, stud_columns
from ..joints import agree
from ..model import COLOUR_EMPTY, Bricks, Cover, Floats, Mask, UnitGrid, ground_of
from ..progress import Progress
from .exchange import exchange
from .placements import Placements, placements
from .planes import spread
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
    must = with_margins(grid.cover == Cover.MUST, False)
    islands = _Islands.of(with_margins(grid.colour, COLOUR_EMPTY), owners(links, must.shape), links.component)
    loose = _loose(bricks, links, islands, catalogue)
    cells, way = _Cells.of(bricks, links, must, loose, catalogue), 0
    for number in range(_ROUNDS):
        if not cells.n_loose or way == len(_WAYS):
            break
        progress("connection", number / _ROUNDS)
        patch, parity = _WAYS[way]
        parts = [bricks.take(np.isin(bricks.part, among.part)) for _, among in work]
        relaid = [
            _joined(part, sheets, among, cells, patch, parity, rng)
            for part, (sheets, among) in zip(parts, work, strict=True)
        ]
        if all(new is part for new, part in zip(relaid, parts, strict=True)):
            way += 1
            continue
        tried = gathered(relaid)
        tried_links = connect(tried, catalogue)
        loose = _loose(tried, tried_links, islands, catalogue)
        before, after = cells.n_loose, int(np.count_nonzero(loose))
        if after < before and tried_links.n_floating <= links.n_floating:
            bricks, links = tried, tried_links
            cells = _Cells.of(bricks, links, must, loose, catalogue)
        way = 0 if after < _PROGRESS * before else way + 1
    return bricks


@dataclass(frozen=True, slots=True, eq=False)
class _Islands:
    """The sets of cells that bricks could hold together, by stacking and by lying across one colour.

    Attributes
    ----------
    node : (n_z, n_y, n_x) int32 array
        What each cell belongs to: a component of bricks, itself, or ``NOBODY``.
    of_node : (n_nodes,) int32 array
        The island of each node.
    """

    node: Rows
    of_node: Rows

    @classmethod
    def of(cls, colour: Plane, owner: Rows, component: Rows) -> _Islands:
        """Find the islands of cells, given their colours, the brick in each, and the component of each brick."""
        node = np.append(component, np.int32(NOBODY))[owner]
        free = np.flatnonzero((owner == NOBODY) & (colour != COLOUR_EMPTY))
        n_known = int(component.max(initial=NOBODY)) + 1
        # what the bricks of a component cover is held together already
        node.reshape(-1)[free] = np.arange(n_known, n_known + len(free))
        pairs = np.concatenate([_meeting(node.reshape(-1), colour, axis) for axis in range(3)])
        return cls(node, components(pairs, n_known + len(free)))


def _meeting(node: Rows, colour: Plane, axis: int) -> Rows:
    """Return pairs of different nodes, (n, 2), whose cells follow each other along an axis and can be held together."""
    length, step = colour.shape[axis], int(np.prod(colour.shape[axis + 1 :]))
    cell = np.flatnonzero(node[:-step] != node[step:])
    cell = cell[(node[cell] != NOBODY) & (node[cell + step] != NOBODY) & (cell // step % length != length - 1)]
    if axis > 0:
        cell = cell[agree(colour.reshape(-1)[cell], colour.reshape(-1)[cell + step])]
    return np.stack([node[cell], node[cell + step]], axis=1)


@dataclass(frozen=True, slots=True, eq=False)
class _Cells:
    """The cells of a model and what is loose in it.

    Attributes
    ----------
    owner : (n_plates + 2, n_y, n_x) int32 array
        Row of the brick, ``NOBODY`` or ``GROUND``, with one empty plane below and one above.
    must : (n_plates + 2, n_y, n_x) bool array
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
    must: Mask
    label: Rows
    reached: Mask
    n_loose: int

    @classmethod
    def of(cls, bricks: Bricks, links: Connection, must: Mask, loose: Mask, catalogue: Catalogue) -> _Cells:
        """Label the bricks of a model, given those that are loose."""
        owner = owners(links, must.shape)
        owner[: ground_of(must)] = GROUND
        label = np.append(np.where(loose, links.component + 1, 0), [-1, -1]).astype(np.int32)
        height = np.array([part.height for part in catalogue.parts])[bricks.part[loose]]
        lowest = bricks.corner[loose, 2] + 1
        ends = (np.bincount(plane, minlength=len(owner)) for plane in (lowest, lowest + height))
        return cls(owner, must, label, np.cumsum(np.subtract(*ends)) > 0, int(np.count_nonzero(loose)))

    def labels(self, sheets: Sheets) -> Rows:
        """Return the labels below, above and in the cells of sheets, (3, n_sheets, n_y, n_x)."""
        return self.label[self.owner[[sheets.level, sheets.level + sheets.height + 1, sheets.level + 1]]]


def _loose(bricks: Bricks, links: Connection, islands: _Islands, catalogue: Catalogue) -> Mask:
    """Tell which bricks are not in the main component of their island: the largest one, on the ground if any is."""
    brick, column = stud_columns(bricks, catalogue)
    component, first, size = np.unique(links.component, return_index=True, return_counts=True)
    x, y, z = column[np.searchsorted(brick, first)].T
    island = islands.of_node[islands.node[z + 1, y, x]]
    order = np.lexsort((size, links.grounded[first], island))
    main = np.append(np.diff(island[order]) > 0, True)
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
    reached = cells.reached[sheets.level[:, None] + [0, 1, sheets.height + 1]].any(axis=1)
    if parity is not None:
        reached &= sheets.level // sheets.height % 2 == parity
    sheets = sheets.take(reached)
    labels = cells.labels(sheets)
    loose = (labels > 0).any(axis=0) & (sheets.colour != COLOUR_EMPTY)
    reached = loose.any(axis=(1, 2))
    if not reached.any():
        return bricks
    sheets, labels, loose = sheets.take(reached), labels[:, reached], loose[reached]
    worthwhile = sheets.must | (cells.owner[sheets.level + 1] > NOBODY) | loose
    found = placements(replace(sheets, must=_near(loose) & worthwhile), among)
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
    lying = row[row >= 0]
    chosen = exchange(problem, lying, offered, rng, reward=reward, patch=patch)
    if chosen is lying:
        return bricks
    return gathered([bricks.take(np.delete(np.arange(len(bricks)), here[row >= 0])), bricks_of(problem, chosen)])


def _near(loose: Mask) -> Mask:
    """Tell which cells are near those that are loose, (n_sheets, n_y, n_x)."""
    near = np.zeros_like(loose)
    for sheet, marked in zip(near, loose, strict=True):
        # loose cells are few: only the part of a sheet around them is looked at
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
