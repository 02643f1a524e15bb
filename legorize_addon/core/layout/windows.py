"""Exact re-laying of small windows, where exchanging bricks no longer joins what is loose.

Around a place where a loose component touches another one, the bricks of one
sheet are taken out and laid anew at least cost, such that they join all that is
left below and above them. Sets of components that a solution leaves apart are
cut off by a constraint each, as subtours are in the travelling salesman problem
(Dantzig, Fulkerson and Johnson 1954).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array
from scipy.sparse.csgraph import connected_components

from ..catalogue import Catalogue
from ..connection import NOBODY, Connection, connect
from ..joints import Touching, agree, brick_columns, every_plate
from ..model import COLOUR_EMPTY, Bricks, Cover, Floats, Ints, Mask, UnitGrid
from ..progress import Progress
from .placements import Placements, placements
from .problem import GROUND, Problem, owners, pose, with_margins
from .shapes import Index, Rows, Shapes
from .sheets import Sheets
from .table import bricks_of, gathered

_REACH: Final = 3
"""Studs around a contact within which bricks are taken out."""

_ALONE: Final = 3.5
"""What a brick costs that holds to nothing below or above, in bricks."""

_CUTS: Final = 12
"""Most times that a window is solved again because components were left apart."""

_CONTACTS: Final = 6
"""Most places tried for one loose component."""

_TRIES: Final = (60, 150_000)
"""Most windows in all, and most bricks looked at in all of them together."""


def join_by_windows(
    bricks: Bricks,
    grid: UnitGrid,
    work: Sequence[tuple[Sheets, Shapes]],
    catalogue: Catalogue,
    progress: Progress,
) -> Bricks:
    """Join loose components to others that they touch, window by window.

    Parameters
    ----------
    bricks : Bricks
        A model without overlaps.
    grid : UnitGrid
        The cells that it covers.
    work : sequence of (Sheets, Shapes)
        The same as sheets, and what may be laid there.
    catalogue : Catalogue
    progress : Progress
        Told before each window.

    Returns
    -------
    Bricks
        Covers the same must cells, in fewer components where windows could join them.
    """
    must = with_margins(grid.cover == Cover.MUST, False)
    touching = Touching.of(grid.solid)
    tried: set[tuple[int, ...]] = set()
    links = connect(bricks, catalogue)
    tries = min(_TRIES[0], _TRIES[1] // len(bricks))
    for number in range(tries):
        if links.n_components <= 1:
            break
        place = next((each for each in _contacts(links, grid, touching) if each not in tried), None)
        if place is None:
            break
        progress("connection", number / tries)
        tried.add(place)
        for sheets, among in work:
            relaid = _relaid(bricks, links, sheets, among, place, must, catalogue)
            found = connect(relaid, catalogue)
            if (found.n_floating, found.n_components) < (links.n_floating, links.n_components):
                bricks, links = relaid, found
                tried.clear()
                break
    return bricks


def _contacts(links: Connection, grid: UnitGrid, touching: Touching) -> Iterator[tuple[int, ...]]:
    """Yield cells (plate, y, x) of loose components beside others that one part could cover, smaller ones first."""
    n_z, n_y, n_x = links.owner.shape
    owner = np.full((len(grid.colour) * grid.colour.shape[1], *grid.colour.shape[2:]), NOBODY)
    owner[:n_z, :n_y, :n_x] = links.owner
    component = np.append(links.component, NOBODY)[owner.reshape(-1)[touching.cell]]
    whole = every_plate(brick_columns(grid)[0]).reshape(-1)[touching.cell]
    colour = touching.laid(grid.colour.reshape(-1)[touching.cell], whole)
    a, b = touching.sideways
    meet = (
        agree(colour[a], colour[b])
        & (whole[a] == whole[b])
        & (component[a] != component[b])
        & (component[[a, b]] != NOBODY).all(axis=0)
    )
    a, b = a[meet], b[meet]
    size = np.bincount(links.component)
    order = np.argsort(size, kind="stable")
    for loose in order[:-1]:
        cells = np.concatenate([a[component[a] == loose], b[component[b] == loose]])
        spread = cells[np.unique(np.linspace(0, len(cells) - 1, _CONTACTS).astype(int))] if len(cells) else cells
        for cell in touching.cell[spread]:
            yield tuple(int(each) for each in np.unravel_index(cell, owner.shape))


def _relaid(
    bricks: Bricks,
    links: Connection,
    sheets: Sheets,
    among: Shapes,
    place: tuple[int, ...],
    must: Mask,
    catalogue: Catalogue,
) -> Bricks:
    """Lay the bricks of one sheet around a place anew."""
    level, y, x = place
    rows = np.flatnonzero((sheets.level <= level) & (level < sheets.level + sheets.height))
    if len(rows) == 0 or sheets.colour[rows[0], y, x] == COLOUR_EMPTY:
        return bricks
    sheet = sheets.take(slice(rows[0], rows[0] + 1))
    base = int(sheet.level[0])
    box = (slice(max(y - _REACH, 0), y + _REACH + 1), slice(max(x - _REACH, 0), x + _REACH + 1))
    plane = links.owner[base] if base < len(links.owner) else np.zeros((0, 0), dtype=np.int32)
    out = np.unique(plane[box])
    out = out[(out != NOBODY) & np.isin(bricks.part[out], among.part)]
    kept = bricks.take(np.delete(np.arange(len(bricks)), out))
    left = connect(kept, catalogue)
    window = _window(sheet, plane, out, box)
    owner = owners(left, must.shape)
    owner[: must.any(axis=(1, 2)).argmax()] = GROUND
    problem = pose(window, among, placements(window, among), owner, must)
    labels = np.append(left.component, [-1, -1])[owner[[base, base + sheet.height + 1]]].reshape(2, -1)[:, window.cells]
    touches, known = _touches(problem.placements, labels)
    # the component of the model that each of those left was a piece of
    home = np.zeros(left.n_components, dtype=np.int64)
    home[left.component] = np.delete(links.component, out)
    chosen = _solved(problem, touches, home[known], int(links.component[links.owner[place]]))
    return bricks if chosen is None else gathered([kept, bricks_of(problem, chosen)])


def _window(sheet: Sheets, plane: Rows, out: Ints, box: tuple[slice, slice]) -> Sheets:
    """Return the sheet with nothing but the cells of the bricks taken out, and the free ones of the box."""
    inside = np.zeros(sheet.colour.shape[1:], dtype=bool)
    n_y, n_x = plane.shape
    inside[:n_y, :n_x] = np.isin(plane, out)
    free = np.zeros_like(inside)
    free[box] = True
    free[:n_y, :n_x] &= plane == NOBODY
    inside |= free & ~sheet.must[0]
    return replace(
        sheet,
        colour=np.where(inside, sheet.colour, np.int16(COLOUR_EMPTY)),
        must=sheet.must & inside,
    )


def _touches(found: Placements, labels: Rows) -> tuple[csr_array, Ints]:
    """Return which components are below or above each placement, (n_known, n), and their numbers, (n_known,)."""
    entry = np.tile(np.repeat(np.arange(len(found)), found.size), 2)
    label = labels[:, found.cells].ravel()
    known, row = np.unique(label[label >= 0], return_inverse=True)
    table = csr_array((np.ones(len(row)), (row, entry[label >= 0])), shape=(len(known), len(found)))
    table.data[:] = 1
    return table, known.astype(np.int64)


def _solved(problem: Problem, touches: csr_array, home: Ints, loose: int) -> Index | None:
    """Return the placements of least cost that cover the cells and join what they must; None if none do.

    Pieces of one component must come together again, and the loose one must be joined to another.
    """
    found = problem.placements
    if len(found) == 0:
        return None
    cover = _covering(problem)
    alone = touches.sum(axis=0) == 0
    constraints = [LinearConstraint(cover, problem.must.astype(np.float64), 1.0)]
    for _ in range(_CUTS):
        result = milp(
            problem.cost + _ALONE * alone,
            integrality=np.ones(len(found)),
            bounds=Bounds(0, 1),
            constraints=constraints,
        )
        if result.x is None:
            return None
        chosen = np.flatnonzero(result.x > 0.5)
        cuts = _cuts(touches, chosen, home, loose)
        if len(cuts) == 0:
            return chosen
        constraints.append(LinearConstraint(cuts, 1.0))
    return None


def _covering(problem: Problem) -> csr_array:
    """Return which cells each placement covers, (n_cells, n)."""
    found = problem.placements
    entry = np.repeat(np.arange(len(found)), found.size)
    return csr_array((np.ones(len(entry)), (found.cells, entry)), shape=(len(problem.must), len(found)))


def _cuts(touches: csr_array, chosen: Index, home: Ints, loose: int) -> Floats:
    """Return, for each set of components wrongly left apart, which placements would join it to others."""
    if touches.shape[0] == 0:
        return np.zeros((0, touches.shape[1]))
    held = touches[:, chosen]
    n_sets, member = connected_components(held @ held.T, directed=False)
    inside = member == np.arange(n_sets)[:, None]
    torn = np.array([np.isin(home[~each], home[each]).any() or (home[each] == loose).all() for each in inside])
    reached = inside[torn].astype(np.float64) @ touches.toarray()
    cuts: Floats = ((reached > 0) & (reached < touches.sum(axis=0))).astype(np.float64)
    return cuts
