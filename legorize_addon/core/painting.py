"""Colours that a user replaces: a model is laid in the colours that were found, and painted in the end.

So an update with another colour takes over the layout, the supports and the order of
building. Where two colours become one, which fewer parts may cover, or a part is not
made in the new colour, the cells are painted first, and all is laid in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from .arrays import Mask
from .build import Draft
from .colours import replaced, replacements
from .model import COLOUR_ANY, Bricks, Catalogue, Part, Role, UnitGrid
from .run import Run
from .supports import AssemblyPlan
from .units import PLATES_PER_BRICK

_OWN: Final = (Role.SUPPORT_OUTSIDE, Role.SUPPORT_INSIDE)
"""Roles of bricks and cells whose colours do not come from the surface."""


class NotMadeError(Exception):
    """A part of the model is not made in the colour that it would be painted in."""


def paint_draft(run: Run, made: Draft) -> Draft:
    """Return what is known before the layout in the colours that the user wants."""
    pairs = _pairs(run)
    if not pairs:
        return made
    return replace(
        made,
        # what is mixed from the palette has no other colour that stands for it
        surface=made.surface if run.settings.dithering != "none" else made.surface.replaced(pairs),
        trajectories=replace(made.trajectories, colour=replaced(made.trajectories.colour, pairs)),
        grid=_paint(made.grid, pairs),
        hollow=_paint(made.hollow, pairs),
    )


def paint_cells(run: Run, cells: UnitGrid) -> UnitGrid:
    """Return cells in the colours that the user wants."""
    pairs = _pairs(run)
    return _paint(cells, pairs) if pairs else cells


def cells_to_lay(run: Run, cells: UnitGrid) -> tuple[UnitGrid, bool]:
    """Return cells in the colours that were found, and whether a layout of them may be painted.

    It may where colours stay apart, nothing counts of a part but whether it is made in them, and none of the parts that
    are made in the new colours alone could lie in their cells.
    """
    pairs, parts = _pairs(run), run.parts
    codes = np.unique(cells.colour[cells.colour >= 0])
    apart = len(np.unique(replaced(codes, pairs))) == len(codes)
    plain = parts.owned is None and not parts.cheapest and not parts.few_lots and run.settings.layout != "learned"
    # hidden bricks in the filler's colour would be painted as well
    last = bool(pairs) and apart and plain and run.filler not in pairs and _coverable(codes, parts.catalogue)
    here = {one: other for one, other in pairs.items() if one in codes}
    last = last and not any(_more_fit(run, cells, one, other) for one, other in here.items())
    # another object, because what is laid may depend on all of this
    return replace(cells), last


def paint_bricks(run: Run, bricks: Bricks) -> Bricks:
    """Return bricks in the colours that the user wants.

    Raises
    ------
    NotMadeError
        One of them does not exist in its new colour.
    """
    pairs = _pairs(run)
    if not pairs:
        return bricks
    colour = np.where(np.isin(bricks.role, _OWN), bricks.colour, replaced(bricks.colour, pairs))
    changed = colour != bricks.colour
    if not run.parts.catalogue.exists_in(bricks.part[changed], colour[changed]).all():
        raise NotMadeError
    return replace(bricks, colour=colour)


def paint_plan(run: Run, plan: AssemblyPlan) -> AssemblyPlan:
    """Return a plan of bricks in the colours that the user wants.

    Raises
    ------
    NotMadeError
        A brick does not exist in its new colour.
    """
    if not _pairs(run):
        return plan
    pieces = tuple(replace(each, pillars=paint_bricks(run, each.pillars)) for each in plan.pieces)
    return replace(plan, assembly=replace(plan.assembly, bricks=paint_bricks(run, plan.bricks)), pieces=pieces)


def _pairs(run: Run) -> Mapping[int, int]:
    return replacements(run.settings.replace_colours, run.catalogue)


def _paint(cells: UnitGrid, pairs: Mapping[int, int]) -> UnitGrid:
    own = np.isin(cells.role, _OWN)
    return replace(cells, colour=np.where(own, cells.colour, replaced(cells.colour, pairs)))


def _coverable(codes: NDArray[np.int16], parts: Catalogue) -> bool:
    """Tell whether cells of some colours can be covered, by the smallest parts if by no other."""
    small: Mask = np.array([part.length * part.width * part.height == 1 for part in parts.parts])
    return bool(parts.exists_in(np.flatnonzero(small)[:, None], codes[None]).any(axis=0).all())


def _more_fit(run: Run, cells: UnitGrid, one: int, other: int) -> bool:
    """Tell whether a part that is made in another colour, but not in that of some cells, could lie in these."""
    parts, settings = run.parts.catalogue, run.settings
    rows = np.arange(len(parts.parts))
    more = parts.exists_in(rows, other) & ~parts.exists_in(rows, one)
    laid = parts.used_for("model")
    if (settings.surface != "studs" or settings.half_studs) and (more & ~laid).any():
        return True
    free = cells.solid & ((cells.colour == one) | (cells.colour == COLOUR_ANY))
    own = cells.colour == one
    by_height = {
        1: (free.reshape(-1, *free.shape[2:]), own.reshape(-1, *own.shape[2:])),
        PLATES_PER_BRICK: (free.all(axis=1), own.any(axis=1)),
    }
    found = (parts.parts[row] for row in np.flatnonzero(more & laid))
    return any(_fits(part, *by_height[part.height]) for part in found if part.height in by_height)


def _fits(part: Part, free: Mask, own: Mask) -> bool:
    """Tell whether a part could lie in free cells, (n_levels, n_y, n_x), and cover one of the colour."""
    if part.corner:
        return bool(own.any())
    sizes = {(part.width, part.length), (part.length, part.width)}
    return any(bool((_windows(free, size, np.all) & _windows(own, size, np.any)).any()) for size in sizes)


def _windows(cells: Mask, size: tuple[int, int], of: Callable[..., Mask]) -> Mask:
    """Return for each place of a window along y and x whether all, or any, of its cells are so."""
    for axis, length in zip((1, 2), size, strict=True):
        if cells.shape[axis] < length:
            return np.zeros((0, 0, 0), dtype=bool)
        cells = of(sliding_window_view(cells, length, axis=axis), axis=-1)
    return cells
