"""Where the maps of the method lie on their pages: cells of the grid, the same for all layers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np

from ..arrays import Floats, Mask
from ..instructions import PAPERS, Group, Item, Page, Paint, Path, Text, lines, rectangle

Rgb = tuple[int, int, int]

MARGIN: Final = 10.0
TITLE: Final = 12.0
LEGEND: Final = 62.0
FRONT: Final = 5.0
"""mm around a map, above it, beside it, and below it."""

GREY: Final[Rgb] = (90, 92, 96)
GRID: Final[Rgb] = (222, 224, 228)
BEHIND: Final[Rgb] = (242, 242, 244)

Line = tuple[Paint, str]
"""A line of a legend: how it is painted, and what it says."""


class Sheet(NamedTuple):
    """A page with a map of all cells of a grid.

    Attributes
    ----------
    n_x, n_y : int
        Cells.
    cell : float
        mm of a cell on the page.
    turned : bool
        Whether y goes to the left and x upwards, for models that are deeper than wide.
    """

    n_x: int
    n_y: int
    cell: float
    turned: bool

    @classmethod
    def of(cls, n_x: int, n_y: int) -> Sheet:
        """Return the sheet for a grid, as large as a page of A4 allows."""
        paper, turned = PAPERS["A4"], n_y > n_x
        across, up = paper.width - 2 * MARGIN - LEGEND, paper.height - 2 * MARGIN - TITLE - FRONT
        columns, rows = (n_y, n_x) if turned else (n_x, n_y)
        return cls(n_x, n_y, min(across / columns, up / rows), turned)

    @property
    def matrix(self) -> tuple[float, float, float, float, float, float]:
        """From cells, y upwards, to mm on the page."""
        left, top, cell = MARGIN, MARGIN + TITLE, self.cell
        if self.turned:
            return 0.0, -cell, -cell, 0.0, left + self.n_y * cell, top + self.n_x * cell
        return cell, 0.0, 0.0, -cell, left, top + self.n_y * cell

    @property
    def width(self) -> float:
        """Of the map in mm."""
        return (self.n_y if self.turned else self.n_x) * self.cell

    def page(self, title: str, note: str, drawing: Sequence[Item], legend: Sequence[Line]) -> Page:
        """Return the page of a map, drawn in cells."""
        paper = PAPERS["A4"]
        head = (
            Text(title, MARGIN, MARGIN + 6, 6, bold=True),
            Text(note, paper.width - MARGIN, MARGIN + 6, 3.5, anchor="end", colour=GREY),
        )
        behind = rectangle(0, 0, self.n_x, self.n_y, Paint(fill=BEHIND))
        shown = Group((behind, self._grid(), *drawing), self.matrix)
        return Page(paper.width, paper.height, (*head, shown, self._front(), *self._legend(legend)), title)

    def _front(self) -> Item:
        """Return the word that says where the front of the model is."""
        a, b, _, _, e, f = self.matrix
        x, y = a * self.n_x / 2 + e, b * self.n_x / 2 + f
        way = (0.0, 1.0, -1.0, 0.0, x + 2, y) if self.turned else (1.0, 0.0, 0.0, 1.0, x, y + 4)
        return Group((Text("FRONT", 0, 0, 2.6, bold=True, anchor="middle", colour=GREY),), way)

    def _grid(self) -> Item:
        upright = [[(x, 0), (x, self.n_y)] for x in range(self.n_x + 1)]
        level = [[(0, y), (self.n_x, y)] for y in range(self.n_y + 1)]
        return lines(np.array(upright + level, dtype=np.float64), Paint(stroke=GRID, width=0.1 / self.cell))

    def _legend(self, legend: Sequence[Line]) -> list[Item]:
        left, items = MARGIN + self.width + 8, list[Item]()
        for row, (paint, text) in enumerate(legend):
            y = MARGIN + TITLE + 7 * row
            if paint.fill is None:
                items.append(lines(np.array([[(left, y + 2), (left + 8, y + 2)]]), paint))
            else:
                items.append(rectangle(left, y, 4, 4, paint))
            items.append(Text(text, left + 11, y + 3.2, 3.4))
        return items


def squares(cells: Mask, *paints: Paint) -> Path:
    """Return the cells of a mask, (n_y, n_x), as one path in cells."""
    y, x = np.nonzero(cells)
    around = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float64)
    points: Floats = (np.stack([x, y], axis=1)[:, None] + around).reshape(-1, 2)
    return Path(points, np.full(len(x), 4), True, paints)
