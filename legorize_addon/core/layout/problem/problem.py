"""The problem that every solver gets: sheets, their placements, and the cost of each placement."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from ...arrays import Floats, Mask
from ...model import COLOUR_ANY, NOBODY, ContactGraph, ground_of
from .placements import Placements, segment_sums
from .shapes import Index, Rows, Shapes
from .sheets import Sheets

Cell = TypeVar("Cell", bound=np.generic)

GROUND: Final = NOBODY - 1
"""Owner of the cells under the lowest sheet."""

_SINGLE: Final = 1.0
_HANGING: Final = 2.0
_END: Final = 0.2
BRIDGE: Final = 0.12
_OPTIONAL: Final = 0.004
"""What a placement costs besides itself, in bricks: being a 1 x 1; having nothing
below and nothing above; holding to one brick alone, without which it would be
lost; each seam of the layers below and above that it lies across (a gain); each
cell that need not be covered."""


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """Cover the cells of sheets at least cost, every required cell once, every other one at most once.

    Attributes
    ----------
    sheets : Sheets
        Where to lay.
    shapes : Shapes
        What the rows of ``placements.shape`` mean.
    placements : Placements
        What may be laid.
    required : (n_cells,) bool array
        Cells that have to be covered.
    corner : (n_cells, 3) intp array
        Where the cells are: x and y in studs, number of the sheet.
    cost : (n,) float64 array
        Cost of each placement, in bricks.
    price : (n_cells,) float64 array, optional
        Estimated price of each cell (see :mod:`.pricing`).
    """

    sheets: Sheets
    shapes: Shapes
    placements: Placements
    required: Mask
    corner: Index
    cost: Floats
    price: Floats | None = None

    def owner(self, chosen: Index) -> Index:
        """Return the position in `chosen` of the placement that covers each cell, ``NOBODY`` where there is none."""
        owner = np.full(len(self.required), NOBODY, dtype=np.intp)
        cells = self.placements.cells[self.placements.entries(chosen)]
        owner[cells] = np.repeat(np.arange(len(chosen)), self.placements.size[chosen])
        return owner


def with_margins(cells: NDArray[Cell], fill: Any) -> NDArray[Cell]:
    """Put the plates of a grid one above the other, and an empty plane below and above them.

    Parameters
    ----------
    cells : (n_layers, 3, n_y, n_x) array
        Something about each cell.
    fill : scalar
        What holds for empty cells.

    Returns
    -------
    (3 * n_layers + 2, n_y, n_x) array
        Plate z is plane z + 1: every cell has something under and over it.
    """
    return np.pad(cells.reshape(-1, *cells.shape[2:]), ((1, 1), (0, 0), (0, 0)), constant_values=fill)


def owners(links: ContactGraph, shape: tuple[int, ...]) -> Rows:
    """Return the brick in each cell of a model, with the planes of :func:`with_margins`.

    Parameters
    ----------
    links : ContactGraph
        The bricks as cells.
    shape : tuple of int
        (n_plates + 2, n_y, n_x).

    Returns
    -------
    shape int32 array
        ``NOBODY`` where there is none.
    """
    owner = np.full(shape, NOBODY, dtype=np.int32)
    n_z, n_y, n_x = links.owner.shape
    owner[1 : n_z + 1, :n_y, :n_x] = links.owner
    return owner


def standing(links: ContactGraph, required: Mask) -> Rows:
    """Return the brick in each cell of a model, as :func:`owners`, and ``GROUND`` below the lowest required cell."""
    owner = owners(links, required.shape)
    owner[: ground_of(required)] = GROUND
    return owner


def pose(
    sheets: Sheets, among: Shapes, found: Placements, owner: Rows, required: Mask, bridge: float = BRIDGE
) -> Problem:
    """Put costs on the placements on some sheets.

    Parameters
    ----------
    sheets : Sheets
        The sheets, no two of them in touch.
    among : Shapes
        Shapes of the placements.
    found : Placements
        What may be laid.
    owner : (n_plates + 2, n_y, n_x) int32 array
        Brick in each cell of the model, ``NOBODY`` or ``GROUND``; plane 0 lies
        below the lowest plate, the last one above the highest.
    required : (n_plates + 2, n_y, n_x) bool array
        Cells of the model that have to be covered.
    bridge : float
        What lying across a seam saves, in bricks.

    Returns
    -------
    Problem
        The sheets' cells and costs. A placement costs one brick, or what the
        catalogue says of its part and colour, more if it is a 1 x 1, hangs in
        the air, holds to one brick alone or covers optional cells, and less for the seams that it bridges.
    """
    cells = sheets.cells
    needed = sheets.required.reshape(-1)[cells]
    # bricks that lie there already, and cells that will be built
    around = np.stack([sheets.level, sheets.level + sheets.height + 1])
    held = ((owner[around] != NOBODY) | required[around]).reshape(2, -1)[:, cells]
    n_sides = sum(found.totals(side) > 0 for side in held)
    on_ground = (owner[sheets.level] == GROUND).any(axis=(1, 2))[found.corner[:, 2]]
    bridged = _bridged(found, among, _seams(owner[around])[:, cells])
    cost = (
        part_costs(found, among, sheets)
        + _SINGLE * (found.size == 1)
        + _HANGING * (n_sides == 0)
        + _END * ((n_sides == 1) & (bridged == 0) & ~on_ground)
        + _OPTIONAL * found.totals(~needed)
        - bridge * bridged
    )
    sheet, y, x = np.unravel_index(cells, sheets.colour.shape)
    return Problem(sheets, among, found, needed, np.stack([x, y, sheet], axis=1), cost)


def part_costs(found: Placements, among: Shapes, sheets: Sheets) -> Floats:
    """Return what the parts of placements cost, in bricks: one each unless the catalogue says otherwise.

    Parameters
    ----------
    found : Placements
    among : Shapes
    sheets : Sheets
        Where they lie.

    Returns
    -------
    (n,) float64 array
        Without what their place adds to the cost.
    """
    if (among.cost == 1).all():
        return np.ones(len(found))
    colour = sheets.colour.reshape(-1)[sheets.cells][found.cells]
    coloured = np.maximum.reduceat(colour, found.start[:-1]) if len(found) else colour
    column = np.where(coloured == COLOUR_ANY, -1, np.searchsorted(among.codes, coloured))
    costs: Floats = among.cost[found.shape, column]
    return costs


def _seams(owner: Rows) -> NDArray[np.int8]:
    """Count where two bricks meet, beyond each cell along x and along y, in planes given for below and above.

    Parameters
    ----------
    owner : (2, n_sheets, n_y, n_x) int32 array
        Brick below and above each cell.

    Returns
    -------
    (2, n_sheets * n_y * n_x) int8 array
        Seams beyond the cell along x and along y: 0, 1 or 2.
    """
    there = owner > NOBODY
    seams = np.zeros((2, *owner.shape[1:]), dtype=np.int8)
    seams[0, ..., :-1] = ((owner[..., :-1] != owner[..., 1:]) & there[..., :-1] & there[..., 1:]).sum(axis=0)
    seams[1, :, :-1] = ((owner[:, :, :-1] != owner[:, :, 1:]) & there[:, :, :-1] & there[:, :, 1:]).sum(axis=0)
    return seams.reshape(2, -1)


def _bridged(found: Placements, among: Shapes, seams: NDArray[np.int8]) -> NDArray[np.int64]:
    """Count the seams inside each placement, given those beyond each cell along x and y."""
    along_x, along_y = among.inner[:, found.in_shapes(among)]
    inside = along_x * seams[0, found.cells] + along_y * seams[1, found.cells]
    return segment_sums(inside, found.start[1:])
