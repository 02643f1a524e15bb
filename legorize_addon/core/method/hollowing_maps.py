"""Hollowing drawn layer by layer: what is kept of the solid model, what is left out, and which supports stand there.

References
----------
Paper, section on hollowing; supports inside are red, those outside white.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Mask
from ..instructions import Item, Page, Paint
from ..model import COLOUR_ANY, Assembly, Catalogue, Fill, Role, UnitGrid, column_facts, stud_columns
from ..units import PLATES_PER_BRICK
from .sheet import Line, Rgb, Sheet, squares

CARRYING: Final[Rgb] = (150, 154, 162)
OPTIONAL: Final[Rgb] = (236, 218, 170)
LEFT_OUT: Final[Rgb] = (250, 250, 250)
INSIDE: Final[Rgb] = (201, 26, 9)
OUTSIDE: Final[Rgb] = (255, 255, 255)
OUTSIDE_LINE: Final[Rgb] = (255, 122, 40)
LINE: Final[Rgb] = (60, 62, 66)
LEFT_OUT_LINE: Final[Rgb] = (190, 120, 190)


def hollowing_maps(
    grid: UnitGrid, shell: UnitGrid, supports: Assembly | None, *, sheet: Sheet, catalogue: Catalogue
) -> Iterator[Page]:
    """Draw each layer of a model as hollowing left it.

    Parameters
    ----------
    grid : UnitGrid
        The solid model.
    shell : UnitGrid
        Required and optional cells.
    supports : Assembly or None
        Those that are taken out again.
    sheet : Sheet
    catalogue : Catalogue

    Yields
    ------
    Page
        One a layer, with the number of columns of each kind.
    """
    standing = np.zeros_like(grid.solid[:, 0]) if supports is None else support_cells(supports, grid)
    for layer in range(len(grid.colour)):
        if not (grid.solid[layer].any() or standing[layer].any()):
            continue
        kinds = kinds_of(grid, shell, layer)
        kinds["support outside"] = standing[layer] & ~grid.solid[layer].any(axis=0)
        thin = 0.12 / sheet.cell
        drawing: list[Item] = [*_seen(shell, layer, kinds["seen"], catalogue, thin)]
        drawing += [
            squares(kinds[name], paint._replace(width=2 * thin if name in _BOLD else thin))
            for name, paint in _PAINTS.items()
        ]
        legend: list[Line] = [
            (_PAINTS[name]._replace(width=0.2), f"{name}: {int(cells.sum())}")
            for name, cells in kinds.items()
            if name in _PAINTS and cells.any()
        ]
        solid = int(grid.solid[layer].any(axis=0).sum())
        left_out = int(kinds["left out"].sum()) + int(kinds["may be built"].sum())
        note = f"{int(kinds['seen'].sum())} seen of {solid}, {left_out} not needed"
        yield sheet.page(f"Layer {layer + 1}", note, drawing, legend)


_PAINTS: Final = {
    "carrying": Paint(fill=CARRYING, stroke=LINE),
    "support inside": Paint(fill=INSIDE, stroke=LINE),
    "may be built": Paint(fill=OPTIONAL, stroke=LINE),
    "left out": Paint(fill=LEFT_OUT, stroke=LEFT_OUT_LINE, dash=(0.15, 0.15)),
    "support outside": Paint(fill=OUTSIDE, stroke=OUTSIDE_LINE),
}


_BOLD: Final = ("support outside", "left out")
"""Kinds with broad lines, as their colours could be those of the model."""


def kinds_of(grid: UnitGrid, shell: UnitGrid, layer: int) -> dict[str, Mask]:
    """Sort the columns of a layer, (n_y, n_x) each: no column is of two kinds, and each solid one of one."""
    solid = grid.solid[layer].any(axis=0)
    required = (shell.cover[layer] == Fill.REQUIRED).any(axis=0)
    optional = (shell.cover[layer] == Fill.OPTIONAL).any(axis=0) & ~required
    seen = required & ((shell.colour[layer] != COLOUR_ANY) & shell.solid[layer]).any(axis=0)
    pillar = required & ~seen & (shell.role[layer] == Role.SUPPORT_INSIDE).any(axis=0)
    return {
        "seen": seen,
        "carrying": required & ~seen & ~pillar,
        "support inside": pillar,
        "may be built": optional,
        "left out": solid & ~required & ~optional,
    }


def support_cells(supports: Assembly, grid: UnitGrid) -> Mask:
    """Return the columns of the grid with supports in them, (n_layers, n_y, n_x)."""
    found = np.zeros((len(grid.colour), *grid.colour.shape[2:]), dtype=bool)
    bricks, catalogue = supports.bricks, supports.catalogue
    if not len(bricks):
        return found
    _, columns = stud_columns(bricks, catalogue)
    facts, low = column_facts(bricks, catalogue), columns[:, 2]
    high = low + facts.high - facts.low
    for up in range(int((high - low).max())):
        plane = low + up
        here = (plane < high) & (plane >= 0) & (plane < PLATES_PER_BRICK * len(found))
        x, y = columns[here, 0], columns[here, 1]
        inside = (x >= 0) & (y >= 0) & (x < found.shape[2]) & (y < found.shape[1])
        found[plane[here][inside] // PLATES_PER_BRICK, y[inside], x[inside]] = True
    return found


def _seen(shell: UnitGrid, layer: int, seen: Mask, catalogue: Catalogue, line: float) -> Iterator[Item]:
    """Yield the columns that are seen, by colour: that of their highest cell with one."""
    code: NDArray[np.int16] = np.full(seen.shape, COLOUR_ANY, dtype=np.int16)
    for plate in range(PLATES_PER_BRICK):
        code = np.where(shell.colour[layer, plate] >= 0, shell.colour[layer, plate], code)
    for each in np.unique(code[seen]).tolist():
        red, green, blue = catalogue.rgb[catalogue.colour_row(each)].tolist()
        yield squares(seen & (code == each), Paint(fill=(red, green, blue), stroke=LINE, width=line))
