"""Hollowing: which cells are required, which are optional, and which stay empty.

A shell of constant thickness around everything empty is required: it can be seen, or it carries what can be seen. The
cells that carry the ceilings inside are required as well. The cells one further in are optional, so that the layout can
use larger bricks that hold the shell together; the rest stays empty.

References
----------
Paper, section on hollowing: its four cases (:mod:`.regions`) applied to the layer
above *and* to the layer below, with contours of eight neighbours, give the same
cells as a shell of one cell measured over all 26 neighbours, so the shell is
computed as an erosion.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..arrays import Mask
from ..model import COLOUR_ANY, COLOUR_EMPTY, Fill, Role, UnitGrid
from ..progress import Progress, part, silent
from ..units import PLATES_PER_BRICK
from .ceilings import Columns, Way, carriers
from .regions import kept

Rule = Literal["both", "upper"]


def hollow(
    grid: UnitGrid,
    *,
    shell: int | None,
    rule: Rule = "both",
    ceilings: Way = "free",
    open_bottom: bool = False,
    pillar_colour: int = COLOUR_ANY,
    progress: Progress = silent,
) -> UnitGrid:
    """Sort the cells of a solid model into required, optional and empty.

    Parameters
    ----------
    grid : UnitGrid
        A solid model; cavities that it encloses are empty cells.
    shell : int or None
        Thickness of the shell that must be built: studs along x and y, bricks
        along z. None leaves the model solid.
    rule : {"both", "upper"}
        Compare each layer with both neighbours, or as the paper does with the
        one above alone, which leaves undersides open.
    ceilings : {"cheaper", "corbels", "pillars", "free"}
        How ceilings inside are carried, see :func:`~.ceilings.carriers`.
    open_bottom : bool
        Leave out cells that only cover the underside on the ground. With "upper" they are left out anyway.
    pillar_colour : int
        LDraw code of pillars inside; by default they take that of their neighbours.
    progress : Progress, optional
        Told between the steps.

    Returns
    -------
    UnitGrid
        ``REQUIRED`` in the shell and in what carries ceilings, ``OPTIONAL`` one cell
        around these, ``EMPTY`` elsewhere; everything ``REQUIRED`` when `shell` is
        None. Full columns of three plates have one cover. Colours stay as they
        are in the cells that remain, but ceilings are carried in any colour, or pillars in theirs.
        Hidden shell cells without a colour of their own and corbels get the role
        ``INSIDE``, pillars ``SUPPORT_INSIDE``.
    """
    cover, colour, role = grid.cover.copy(), grid.colour.copy(), grid.role.copy()
    cover[grid.solid] = Fill.REQUIRED
    if shell is not None:
        deep = peel(grid.solid, shell) if rule == "upper" else erode(grid.solid, shell, open_bottom=open_bottom)
        required = grid.solid & ~deep[:, None]
        progress("hollowing", 0.2)
        corbels, pillars = carriers(
            Columns(required[:, 0], required[:, -1], required.all(axis=1), deep), ceilings, part(progress, 0.2, 0.8)
        )
        progress("hollowing", 0.8)
        inner = deep & ~(corbels | pillars)
        optional = inner & _grown(~inner & grid.solid.any(axis=1))
        _fill(cover, inner, Fill.EMPTY)
        _fill(cover, optional, Fill.OPTIONAL)
        _fill(colour, corbels, COLOUR_ANY)
        _fill(colour, pillars, pillar_colour)
        _fill(role, corbels, Role.INSIDE)
        _fill(role, pillars, Role.SUPPORT_INSIDE)
    colour[cover == Fill.EMPTY] = COLOUR_EMPTY
    role[(colour == COLOUR_ANY) & (role == Role.SHELL)] = Role.INSIDE
    return UnitGrid(colour=colour, cover=cover, role=role, origin=grid.origin)


def _fill(cells: NDArray[np.integer], columns: Mask, value: int) -> None:
    """Give all three plates of some columns a value."""
    np.copyto(cells, cells.dtype.type(value), where=columns[:, None])


def erode(solid: Mask, thickness: int, *, open_bottom: bool = False) -> Mask:
    """Return the columns that lie deeper than a shell of the given thickness.

    Parameters
    ----------
    solid : (n_layers, 3, n_y, n_x) bool array
        Cells of the model; everything outside the array counts as empty.
    thickness : int
        Studs along x and y, bricks along z; two plates do for the last brick.
    open_bottom : bool
        Count the ground below the lowest layer as solid.

    Returns
    -------
    (n_layers, n_y, n_x) bool array
        True where no empty cell lies within `thickness` along x, y and z at once
        (all 26 neighbours for 1). The three plates of a column are deep together
        or not at all, so that hollowing never cuts a brick into plates.
    """
    plates = solid.reshape(-1, *solid.shape[2:])
    height = PLATES_PER_BRICK * thickness - 1
    for axis, reach in enumerate((height, thickness, thickness)):
        plates = _shrunk(plates, axis, reach, open_start=axis == 0 and open_bottom)
    deep: Mask = plates.reshape(solid.shape).all(axis=1)
    return deep


def peel(solid: Mask, thickness: int) -> Mask:
    """Return the columns that remain when the paper's rule is applied to the layers above, time after time.

    Parameters
    ----------
    solid : (n_layers, 3, n_y, n_x) bool array
        Cells of the model; everything outside the array counts as empty.
    thickness : int
        How often the rule is applied.

    Returns
    -------
    (n_layers, n_y, n_x) bool array
        Columns deeper than the literal shell, with contours of four neighbours.
        A column stays in the shell if any of its plates does.
    """
    deep = solid
    for _ in range(thickness):
        if not deep.any():
            break
        plates = deep.reshape(-1, *solid.shape[2:])
        rest = plates & ~kept(plates, upper_only=True)
        deep = np.broadcast_to(rest.reshape(solid.shape).all(axis=1, keepdims=True), solid.shape)
    return deep.all(axis=1)


def _shrunk(mask: Mask, axis: int, reach: int, *, open_start: bool) -> Mask:
    """Keep the cells whose neighbours up to `reach` away along an axis are all True."""
    wide = np.moveaxis(_padded(mask, axis, reach), axis, 0)
    wide[:reach] = open_start
    span = 1
    # windows grow by doubling: a window of 7 cells costs three passes
    while span <= 2 * reach:
        step = min(span, 2 * reach + 1 - span)
        wide = wide[:-step] & wide[step:]
        span += step
    return np.moveaxis(wide, 0, axis)


def _grown(mask: Mask) -> Mask:
    """Add the 26 neighbours of every cell."""
    for axis in range(mask.ndim):
        wide = np.moveaxis(_padded(mask, axis, 1), axis, 0)
        mask = np.moveaxis(wide[:-2] | wide[1:-1] | wide[2:], 0, axis)
    return mask


def _padded(mask: Mask, axis: int, width: int) -> Mask:
    """Put empty cells before and behind along an axis."""
    return np.pad(mask, [(width, width) if each == axis else (0, 0) for each in range(mask.ndim)])
