"""Laying small windows anew by exact optimisation, where exchanging bricks no longer joins loose components.

Around a place where a loose component touches another one, the bricks of one
sheet are taken out and laid anew at least cost, such that they join all that is
left below and above them (see :mod:`.window_covers`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from ...arrays import Ints, Mask
from ...model import (
    COLOUR_EMPTY,
    NOBODY,
    Bricks,
    Catalogue,
    ContactGraph,
    Fill,
    Touching,
    UnitGrid,
    agree,
    brick_columns,
    components,
    contact_graph,
    every_plate,
)
from ...progress import Progress
from ...units import PLATES_PER_BRICK
from ..problem import (
    Rows,
    Shapes,
    Sheets,
    brick_table,
    gather,
    placements,
    pose,
    standing,
    with_margins,
)
from .window_covers import first_joined, joining_cover, touched

_REACH: Final = 3
"""Studs around a contact within which bricks are taken out."""

_CONTACTS: Final = 6
"""Most places tried for one loose component."""

_TRIES: Final = (100, 600_000)
"""Most windows in all, and most bricks looked at in all of them together."""

_FAR: Final = (2 * PLATES_PER_BRICK, 22, 22)
"""Plates and studs (z, y, x) beyond which a window laid anew does not change another one."""


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
        Covers the same required cells, in fewer components where windows could
        join them.
    """
    links = contact_graph(bricks, catalogue)
    if links.n_components <= 1:
        return bricks
    required, beside = with_margins(grid.cover >= Fill.REQUIRED, False), _beside(grid)
    model = _Model.of(bricks, links, required)
    places, tried = _contacts(model, beside), set[tuple[int, ...]]()
    tries = min(_TRIES[0], _TRIES[1] // len(bricks))
    for number in range(tries):
        place = next((each for each in places if each not in tried), None)
        if place is None:
            break
        progress("connection", number / tries)
        tried.add(place)
        relaid = (_relaid(model, sheets, among, place, required) for sheets, among in work)
        better = next((each for each in relaid if each is not None), None)
        if better is not None:
            model = _Model.of(better, contact_graph(better, catalogue), required)
            places = _contacts(model, beside)
            tried = {each for each in tried if (np.abs(np.subtract(each, place)) > _FAR).any()}
    return model.bricks


@dataclass(frozen=True, slots=True, eq=False)
class _Model:
    """A model between two windows.

    Attributes
    ----------
    bricks : Bricks
    links : ContactGraph
        The bricks as a graph.
    owner : (n_plates + 2, n_y, n_x) int32 array
        Brick in each cell, ``NOBODY`` or ``GROUND``, with the planes of :func:`with_margins`.
    """

    bricks: Bricks
    links: ContactGraph
    owner: Rows

    @classmethod
    def of(cls, bricks: Bricks, links: ContactGraph, required: Mask) -> _Model:
        """Look up which cells bricks lie in, given those that have to be covered."""
        return cls(bricks, links, standing(links, required))

    def without(self, out: Ints) -> Rows:
        """Return the component of each brick, (n,), when some are left out, each of which has a number of its own."""
        there = np.ones(len(self.bricks), dtype=bool)
        there[out] = False
        return components(self.links.pairs[there[self.links.pairs].all(axis=1)], len(there))


def _beside(grid: UnitGrid) -> Ints:
    """Return the pairs of cells side by side that one part could cover, (2, n), as flat indices among all plates."""
    touching = Touching.of(grid.solid)
    whole = every_plate(brick_columns(grid)[0]).reshape(-1)[touching.cell]
    colour = touching.laid(grid.colour.reshape(-1)[touching.cell], whole)
    a, b = touching.sideways
    meet = agree(colour[a], colour[b]) & (whole[a] == whole[b])
    return touching.cell[touching.sideways[:, meet]]


def _contacts(model: _Model, beside: Ints) -> Iterator[tuple[int, ...]]:
    """Yield cells (plate, y, x) of loose components beside others that one part could cover, smaller ones first."""
    planes = model.owner[1:-1]
    # neither nobody nor the ground has a component
    component = np.append(model.links.component, [NOBODY, NOBODY])[planes.reshape(-1)[beside]]
    meet = (component[0] != component[1]) & (component != NOBODY).all(axis=0)
    (a, b), (of_a, of_b) = beside[:, meet], component[:, meet]
    size = np.bincount(model.links.component)
    order = np.argsort(size, kind="stable")
    for loose in order[:-1]:
        cells = np.concatenate([a[of_a == loose], b[of_b == loose]])
        spread = cells[np.unique(np.linspace(0, len(cells) - 1, _CONTACTS).astype(int))] if len(cells) else cells
        for cell in spread:
            yield tuple(int(each) for each in np.unravel_index(cell, planes.shape))


def _relaid(model: _Model, sheets: Sheets, among: Shapes, place: tuple[int, ...], required: Mask) -> Bricks | None:
    """Lay the bricks of one sheet around a place anew; None if the model is not better for it."""
    level, y, x = place
    sheet = _sheet_at(sheets, level)
    if sheet is None or sheet.colour[0, y, x] == COLOUR_EMPTY:
        return None
    base = int(sheet.level[0])
    box = (slice(max(y - _REACH, 0), y + _REACH + 1), slice(max(x - _REACH, 0), x + _REACH + 1))
    plane = model.owner[base + 1]
    out = np.unique(plane[box])
    out = out[(out > NOBODY) & np.isin(model.bricks.part[out], among.part)]
    window = _window(sheet, plane, out, box)
    problem = pose(window, among, placements(window, among), model.owner, required)
    component = model.without(out)
    # what lies below and above is in other sheets, so none of it was taken out
    around = model.owner[[base, base + sheet.height + 1]].reshape(2, -1)[:, window.cells]
    touches, known = touched(problem.placements, np.append(component, [NOBODY, NOBODY])[around])
    # the component of the model that each of those left was a piece of
    home = np.zeros(len(component), dtype=np.int64)
    home[component] = model.links.component
    chosen = joining_cover(problem, touches, home[known], int(model.links.component[model.owner[level + 1, y, x]]))
    if chosen is None or not _better(model, component, out, known, touches[:, chosen], base):
        return None
    kept = model.bricks.take(np.delete(np.arange(len(model.bricks)), out))
    return gather([kept, brick_table(problem, chosen)])


def _sheet_at(sheets: Sheets, level: int) -> Sheets | None:
    """Return the one of some sheets that holds a plate; None if there is none."""
    rows = np.flatnonzero((sheets.level <= level) & (level < sheets.level + sheets.height))
    return sheets.take(slice(rows[0], rows[0] + 1)) if len(rows) else None


def _window(sheet: Sheets, plane: Rows, out: Ints, box: tuple[slice, slice]) -> Sheets:
    """Return the sheet with nothing but the cells of the bricks taken out, and the free ones of the box."""
    inside = np.isin(plane, out)
    inside[box] |= (plane[box] == NOBODY) & ~sheet.required[0][box]
    return replace(
        sheet,
        colour=np.where(inside, sheet.colour, np.int16(COLOUR_EMPTY)),
        required=sheet.required & inside,
    )


def _better(model: _Model, component: Rows, out: Ints, known: Ints, held: Mask, base: int) -> bool:
    """Return whether fewer bricks float than before, or as many and in fewer components.

    Parameters
    ----------
    model : _Model
        As it was.
    component : (n,) int32 array
        Component of each brick without those taken `out`.
    out : (n_out,) int array
        Rows of the bricks taken out.
    known : (n_known,) int array
        Components below or above the window.
    held : (n_known, n_new) bool array
        Which of them each new brick holds.
    base : int
        Lowest plate of the new bricks.
    """
    level, n_new = model.bricks.corner[:, 2], held.shape[1]
    standing = np.bincount(component, level == level.min()) > 0
    size = np.bincount(component)
    size[component[out]] = 0
    # new bricks count as components that they hold themselves
    member = first_joined(np.concatenate([held, np.eye(n_new, dtype=bool)]))
    stands = np.bincount(member, np.append(standing[known], np.full(n_new, base == level.min()))) > 0
    floating = np.append(size[known], np.ones(n_new))[~stands[member]].sum()
    apart = ~standing
    apart[known] = False
    n_components = np.count_nonzero(size) - len(known) + len(np.unique(member))
    before = model.links.n_floating, model.links.n_components
    return bool((floating + size[apart].sum(), n_components) < before)
