"""Ties: plates across seams, laid last, where no layout of the cells holds together.

Bricks that are still loose after the layout are joined to what they touch by a
plate across the seam, a *tie*, for which the bricks on both sides are cut. The
tie has the colour of one side: where that would show, a plate is added below an
edge, and only where there is no room for one are a cell or two in the neighbour's
colour. Where there is nothing to cut, a plate is added below or above. The
cheapest joints come first, as in a least spanning tree (Kruskal 1956).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from ...arrays import Ints
from ...model import (
    COLOUR_EMPTY,
    NOBODY,
    Bricks,
    Catalogue,
    ContactGraph,
    Fill,
    Role,
    UnitGrid,
    components,
    contact_graph,
)
from ...units import PLATES_PER_BRICK
from ..problem import Plane, Rows, owners, with_margins
from .contacts import RECOLOURED, NearContacts, near_contacts
from .cutting import Bench, Laid, Seam, Square

_TRIED: Final = 16
"""Most ties tried at one place."""

_MOST_WRONG: Final = 2
"""Most stud squares of a tie that have to show another colour."""

_FREE: Final = 0.6
_DEAR: Final = RECOLOURED + 0.6
"""Prices below which a second tie shows nowhere, and below which it shows in one cell of another colour."""

_BRICKS_A_STRAP: Final = 6
_MOST_STRAPS: Final = 6
_BRICKS_A_COLOUR: Final = 40
_MOST_COLOURS: Final = 1
"""Bricks that hang on a joint for each further tie that does not show, and how many at most; and that does show."""


def add_ties(bricks: Bricks, grid: UnitGrid, catalogue: Catalogue, *, plates: bool) -> tuple[Bricks, UnitGrid]:
    """Join the components of a layout by ties.

    Parameters
    ----------
    bricks : Bricks
        A layout without collisions.
    grid : UnitGrid
        The cells that it covers.
    catalogue : Catalogue
    plates : bool
        Whether bricks may be cut into plates, and plates be added; else ties
        are bricks.

    Returns
    -------
    bricks : Bricks
        Cover the same cells, and a few more where there is nothing to cut, in
        fewer components where ties could join them.
    grid : UnitGrid
        With the cells that were added, which must be built and have the role of
        plates, and the colours that ties show.
    """
    links = contact_graph(bricks, catalogue)
    colour = with_margins(grid.colour, COLOUR_EMPTY)
    before = links.n_components + 1
    # each round looks for joints between what the rounds before have joined: a row after row, if need be
    while 1 < links.n_components < before:
        bench, before = Bench(bricks, owners(links, colour.shape), catalogue), links.n_components
        if _joined(bench, links.component, colour, plates=plates):
            bricks = bench.bricks()
            links = contact_graph(bricks, catalogue)
            grid = as_laid(grid, bricks, links)
    return bricks, grid


def as_laid(grid: UnitGrid, bricks: Bricks, links: ContactGraph) -> UnitGrid:
    """Return the grid in the colours of the bricks that lie in cells of another colour or in none.

    Parameters
    ----------
    grid : UnitGrid
        Before ties were laid.
    bricks : Bricks
        Ties included.
    links : ContactGraph
        Of these bricks.

    Returns
    -------
    UnitGrid
        Cells that were added must be built and have the role of plates.
    """
    owner = owners(links, with_margins(grid.colour, COLOUR_EMPTY).shape)[1:-1].reshape(grid.colour.shape)
    added = (owner != NOBODY) & ~grid.solid
    shown = (owner != NOBODY) & (grid.colour >= 0) | added
    return replace(
        grid,
        colour=np.where(shown, bricks.colour[owner], grid.colour),
        cover=np.where(added, np.uint8(Fill.REQUIRED), grid.cover),
        role=np.where(added, np.uint8(Role.PLATE), grid.role),
    )


def _joined(bench: Bench, component: Rows, colour: Plane, *, plates: bool) -> int:
    """Lay ties between components, more of them where they carry more; return how many were laid."""
    found = near_contacts(bench.owner, component, colour, plates=plates, fixed=bench.fixed)
    height = 1 if plates else PLATES_PER_BRICK
    pairs = component[found.bricks]
    seams = seams_of(found)
    home = np.arange(component.max() + 1)
    laid = []
    # no colour is changed where another place costs less
    for rows, most_wrong in ((found.price < RECOLOURED, 0), (found.price > -np.inf, _MOST_WRONG)):
        for row in np.flatnonzero(rows).tolist():
            one, other = pairs[row]
            if home[one] != home[other] and tie_seam(bench, seams[row], colour, height, most_wrong):
                home[home == home[one]] = home[other]
                laid.append(row)
    for row in _more(found, pairs, laid, _hanging(pairs[laid], np.bincount(component))):
        tie_seam(bench, seams[row], colour, height, 0 if found.price[row] < RECOLOURED else _MOST_WRONG)
    return len(laid)


def seams_of(found: NearContacts) -> list[Seam]:
    """Return the seams of places, as many, in the same order."""
    plane, y, x = found.place.T
    ends = np.stack([x, y, x + (found.axis == 2), y + (found.axis == 1)], axis=1).tolist()
    return [
        Seam(level, ((x0, y0), (x1, y1))) for level, (x0, y0, x1, y1) in zip((plane - 1).tolist(), ends, strict=True)
    ]


def _hanging(joints: Rows, size: Ints) -> list[int]:
    """Count the bricks that hang on each joint of a forest of components: those on its smaller side."""
    beside: list[dict[int, int]] = [{} for _ in size]
    for row, (one, other) in enumerate(joints.tolist()):
        beside[one][other] = beside[other][one] = row
    weight, hanging = size.tolist(), [0] * len(joints)
    whole = np.bincount(components(joints, len(size)), size)[components(joints, len(size))]
    leaves = [node for node, others in enumerate(beside) if len(others) == 1]
    # leaves are removed until none is left; each passes its weight on
    for leaf in leaves:
        if beside[leaf]:
            other, row = beside[leaf].popitem()
            hanging[row] = min(weight[leaf], int(whole[leaf]) - weight[leaf])
            weight[other] += weight[leaf]
            del beside[other][leaf]
            if len(beside[other]) == 1:
                leaves.append(other)
    return hanging


def _more(found: NearContacts, pairs: Rows, laid: list[int], hanging: list[int]) -> Iterator[int]:
    """Yield the places for more ties at joints that carry much: free ones, and a few of another colour."""
    pairs = np.sort(pairs, axis=1)
    for joint, bricks in zip(laid, hanging, strict=True):
        if bricks >= _BRICKS_A_STRAP:
            same = joint + 1 + np.flatnonzero((pairs[joint + 1 :] == pairs[joint]).all(axis=1))
            free = same[found.price[same] < _FREE][: min(bricks // _BRICKS_A_STRAP, _MOST_STRAPS)]
            dear = same[(found.price[same] >= _FREE) & (found.price[same] < _DEAR)]
            yield from (
                *free.tolist(),
                *dear[: min(max(0, bricks // _BRICKS_A_COLOUR - len(free)), _MOST_COLOURS)].tolist(),
            )


def tie_seam(bench: Bench, seam: Seam, colour: Plane, height: int, most_wrong: int) -> bool:
    """Lay a tie across a seam; return whether there is one that holds and is in the wrong colour in few squares.

    Parameters
    ----------
    bench : Bench
        Changed if a tie is laid.
    seam : Seam
    colour : (n_plates + 2, n_y, n_x) int16 array
        What has to be seen: LDraw code, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    height : int
        Of the tie in plates.
    most_wrong : int
        Stud squares of it that may show another colour.

    Returns
    -------
    bool
    """
    ends = [bench.at(seam.level, end) for end in seam.ends]
    cut = sorted({number for number in ends if number != NOBODY})
    # a tie laid before may reach across this seam already
    if (NOBODY not in ends and len(cut) == 1) or not bench.fixed.isdisjoint(cut):
        return False
    for tie in _ties(bench, seam, cut, colour, height, most_wrong)[:_TRIED]:
        pieces = bench.cut(cut, tie)
        if pieces is not None and bench.reaches(tie, seam) and bench.holds([tie, *pieces]):
            bench.put(cut, [tie, *pieces])
            return True
    return False


def _ties(bench: Bench, seam: Seam, cut: list[int], colour: Plane, height: int, most_wrong: int) -> list[Laid]:
    """Return what may lie across a seam, in the place of bricks or added: what shows least, then what lies on most."""
    bricks = [bench.laid[number] for number in cut or bench.over_and_under(seam)]
    level = seam.level if height == 1 else bricks[0].level
    sides = [{end}.union(*(brick.squares for brick in bricks if end in brick.squares and cut)) for end in seam.ends]
    role = min((brick.role for brick in bricks), key=lambda each: (each == Role.INSIDE, each)) if cut else Role.PLATE
    offers = []
    for code in sorted({brick.colour for brick in bricks}):
        for form, corner in bench.forms.within(sides[0] | sides[1], seam.ends[0], height, code):
            tie = Laid(form, corner, level, code, int(role))
            wrong = _wrong(tie, colour)
            if seam.ends[1] in tie.squares and len(wrong) <= most_wrong * height and (not wrong or _rests(bench, tie)):
                faces = sum(bench.open_faces(each_level, square) for each_level, square in wrong)
                rests = min(len(tie.squares & side) for side in sides)
                offers.append((len(wrong), faces, -rests, -len(form.squares), corner, tie))
    return [tie for *_, tie in sorted(offers, key=lambda offer: offer[:-1])]


def _rests(bench: Bench, tie: Laid) -> bool:
    """Tell whether there is something below or above a tie, as there is nothing for the pixels of a picture."""
    levels = (tie.level - 1, tie.level + tie.form.height)
    return any(bench.at(level, square) != NOBODY for level in levels for square in tie.squares)


def _wrong(tie: Laid, colour: Plane) -> list[tuple[int, Square]]:
    """Return the level and square of each cell of a tie that has to show another colour."""
    levels = range(tie.level, tie.level + tie.form.height)
    cells = [(level, square) for level in levels for square in sorted(tie.squares)]
    shown = [int(colour[level + 1, y, x]) for level, (x, y) in cells]
    return [cell for cell, code in zip(cells, shown, strict=True) if code >= 0 and code != tie.colour]
