"""The jumpers below a plane: which of its squares they cover, and with which of them they hold what is above."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Ints, Mask
from ..colours import ciede2000, lab_from_srgb
from ..model import COLOUR_ANY, COLOUR_EMPTY, Bricks, Catalogue, Fill, Role, UnitGrid, columns, concatenate
from ..units import PLATES_PER_BRICK
from .halves import Halves

Square = tuple[int, int]

_ONE_WAY: Final = "15573"
_BOTH_WAYS: Final = "87580"
_COVER: Final = "3070b"
"""Jumpers for half studs along one side and along both, and the tile where no jumper fits."""

NEEDED: Final = (_ONE_WAY, _BOTH_WAYS, _COVER)
"""What has to be among the parts that may be laid."""

_WAYS: Final = ((False, False), (False, True), (True, False), (True, True))
"""Ends, along y and x, from which squares are filled."""


class _Form(NamedTuple):
    """A part in a turn: its squares as steps (y, x) from the one that counts, which the stud of a jumper is over."""

    part: int
    turn: int
    steps: tuple[Square, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _Site:
    """A plane; all arrays (n_y, n_x).

    Attributes
    ----------
    above : bool array
        Squares that something fills above it.
    below : bool array
        Squares that something fills below it and above lies over, in whole or by half: a stud may stand in none.
    open : bool array
        Empty squares below it that a jumper may reach out into, as something above lies over them.
    held : bool array
        Squares of `below` that stand on something.
    """

    above: Mask
    below: Mask
    open: Mask
    held: Mask


def lay_jumpers(grid: UnitGrid, halves: Halves, catalogue: Catalogue, *, filler: int) -> tuple[Bricks, UnitGrid]:
    """Lay jumpers under everything that lies half a stud off what it stands on.

    Parameters
    ----------
    grid : UnitGrid
        A hollowed model that is drawn together.
    halves : Halves
        The half studs of its cells.
    catalogue : Catalogue
    filler : int
        LDraw code of hidden bricks.

    Returns
    -------
    bricks : Bricks
        Jumpers, and tiles where none fits; they touch nothing but cells that are to be built or open.
    grid : UnitGrid
        The cells under jumpers and over their studs have to be built; what could not be covered is empty.
    """
    tile = _form(catalogue, catalogue.part_row(_COVER), (0, 0))
    laid = [_table(tile, np.zeros((0, 2), np.int64), 0, grid.colour[0, 0], catalogue, filler)]
    for layer in range(1, min(len(grid.cover), len(halves.half))):
        below, above = halves.half[layer - 1], halves.half[layer]
        changes = (below != above) & (grid.cover[layer, 0] != Fill.EMPTY)
        for one, other in np.unique(np.stack([below[changes], above[changes]], axis=1), axis=0).tolist():
            made, grid = _lay(grid, layer, halves, (one, other), catalogue, filler)
            laid.append(made)
    return concatenate(laid), grid


def _lay(
    grid: UnitGrid, layer: int, halves: Halves, kinds: tuple[int, int], catalogue: Catalogue, filler: int
) -> tuple[Bricks, UnitGrid]:
    """Lay the jumpers under what has some half studs in a layer, on what has some others below it."""
    level, step = PLATES_PER_BRICK * layer, _step(*kinds)
    shape, plates = grid.cover.shape, (-1, *grid.cover.shape[2:])
    cover, colour = grid.cover.reshape(plates).copy(), grid.colour.reshape(plates).copy()
    site = _site(cover != Fill.EMPTY, level, step, halves.half[layer - 1] == kinds[0], halves.half[layer] == kinds[1])
    jumper = catalogue.part_row(_BOTH_WAYS if all(step) else _ONE_WAY)
    tile = _form(catalogue, catalogue.part_row(_COVER), (0, 0))
    form = _form(catalogue, jumper, step)
    placed = _placed(site, form)
    there = _covered(site.below.shape, form, placed)
    bare = site.below & ~there
    rest = np.argwhere(bare & site.held)
    cover[level - 1][bare & ~site.held], colour[level - 1][bare & ~site.held] = Fill.EMPTY, COLOUR_EMPTY
    for squares, at in ((there & site.below, level - 2), (_covered(there.shape, tile, placed), level)):
        wanted = squares & (cover[at] == Fill.OPTIONAL)
        cover[at][wanted] = Fill.REQUIRED
    bricks = concatenate(
        [
            _table(each, places, level - 1, colour[level - 1], catalogue, filler)
            for each, places in ((form, placed), (tile, rest))
        ]
    )
    return bricks, replace(grid, cover=cover.reshape(shape), colour=colour.reshape(shape))


def _step(below: int, above: int) -> Square:
    """Return by how many half studs, x and y, what is above lies further on than what is below."""
    return (above & 1) - (below & 1), (above >> 1) - (below >> 1)


def _site(solid: Mask, level: int, step: Square, lower: Mask, upper: Mask) -> _Site:
    """Return what lies at a plane, of cells that are of its kinds below and above."""
    above, below = solid[level] & upper, solid[level - 1] & lower
    over = above.copy()
    for axis, by in ((1, step[0]), (0, step[1])):
        if by:
            # nothing lies at the rim of a grid
            over |= np.roll(over, by, axis)
    # nor under what lies on it as ever
    over &= ~solid[level] | upper
    free = ~solid[level - 1] & lower & over
    return _Site(above, below & over, free, below & over & solid[level - 2])


def _form(catalogue: Catalogue, part: int, step: Square) -> _Form:
    """Return a part in the turn in which the square of its stud has the others some steps (x, y) further on."""
    for turn in range(catalogue.parts[part].turns):
        facts = columns(catalogue.parts[part], turn)
        own = facts.xy[facts.stud][0] if facts.stud.any() else facts.xy[0]
        others = facts.xy - own
        if (others.sum(axis=0) == np.array(step) * len(others) // 2).all():
            return _Form(part, turn, tuple((y, x) for x, y in others.tolist()))
    raise ValueError(f"{catalogue.parts[part].number} has no turn for {step}")


def _placed(site: _Site, form: _Form) -> Ints:
    """Return where jumpers are laid, (n, 2) squares (y, x) under their studs: each area as it is filled best."""
    area, n_areas = ndimage.label(site.below | site.open)
    found = [_filled(site, form, ways) for ways in _WAYS]
    chosen = [np.zeros((0, 2), np.int64)]
    for number in range(1, n_areas + 1):
        mine = [each[area[each[:, 0], each[:, 1]] == number] for each in found]
        chosen.append(
            max(mine, key=lambda each: (int((_covered(area.shape, form, each) & site.below).sum()), -len(each)))
        )
    return np.concatenate(chosen)


def _filled(site: _Site, form: _Form, ways: tuple[bool, bool]) -> Ints:
    """Fill the squares of a plane from one end: first with jumpers that lie on squares all over, then with others."""
    taken, placed = np.zeros_like(site.below), []
    shape = np.array(taken.shape)
    squares = np.argwhere(site.above & (site.below | site.open))
    order = np.lexsort([-squares[:, axis] if back else squares[:, axis] for axis, back in ((1, ways[1]), (0, ways[0]))])
    for whole in (True, False):
        for square in squares[order]:
            y, x = (square + np.array(form.steps)).T
            if ((square + np.array(form.steps) < 0) | (square + np.array(form.steps) >= shape)).any() or taken[
                y, x
            ].any():
                continue
            fits = site.below[y, x] if whole else site.below[y, x] | site.open[y, x]
            if fits.all() and site.held[y, x].any():
                taken[y, x] = True
                placed.append(square)
    return np.array(placed, np.int64).reshape(-1, 2)


def _covered(shape: tuple[int, ...], form: _Form, placed: Ints) -> Mask:
    """Return the squares that parts cover."""
    there = np.zeros(shape, bool)
    for y, x in form.steps:
        there[placed[:, 0] + y, placed[:, 1] + x] = True
    return there


def _table(
    form: _Form, placed: Ints, level: int, colour: NDArray[np.int16], catalogue: Catalogue, filler: int
) -> Bricks:
    """Return parts as bricks in the most frequent colour below each, or the closest one in which they are made."""
    low = np.array(form.steps).min(axis=0)
    corner = np.column_stack([placed + low, np.full(len(placed), level)])[:, [1, 0, 2]].astype(np.int32)
    codes = [_colour(form, colour[tuple((square + np.array(form.steps)).T)], catalogue, filler) for square in placed]
    n = len(placed)
    return Bricks(
        part=np.full(n, form.part, np.int16),
        corner=corner,
        turn=np.full(n, form.turn, np.uint8),
        colour=np.array(codes, np.int16),
        role=np.full(n, Role.PLATE, np.uint8),
        piece=np.zeros(n, np.int16),
        step=corner[:, 2] // np.int32(PLATES_PER_BRICK),
    )


def _colour(form: _Form, seen: NDArray[np.int16], catalogue: Catalogue, filler: int) -> int:
    """Return the colour of a part over squares of some colours."""
    codes, count = np.unique(seen[seen > COLOUR_ANY], return_counts=True)
    wanted = int(codes[count.argmax()]) if len(codes) else filler
    made = np.flatnonzero(catalogue.exists[form.part])
    lab = lab_from_srgb(catalogue.rgb[[catalogue.colour_row(wanted), *made.tolist()]])
    return int(catalogue.codes[made[ciede2000(lab[:1], lab[1:]).argmin()]])
