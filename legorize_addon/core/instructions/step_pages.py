"""The pages of the steps: as many pictures on each as can be read.

A page is halved again and again, as long as the next pictures fit into the
halves; so each picture has the smallest cell in which it can be seen in its
scale, and the order of reading is that of the steps.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

import numpy as np

from ..building import Kind
from ..progress import Progress, part, silent
from .canvas import Item, Page, Paint, moved, rectangle
from .lots import Callout
from .panel_layout import SUB, header, panel_items
from .panels import Panel, Panels
from .paper import GAP, MARGIN, Cell, Paper, foot, page_cell
from .picture import MM

LARGEST: Final = 0.62
"""mm on paper for a mm of the model at most: a stud is then 3 mm wide."""

READABLE: Final = 0.36
"""The same at least, if two pictures are to be on a page."""

_HEAD: Final = 30.0
"""mm that the parts of a step take, as a rule."""

_INSET: Final = 3.0
"""mm between the rim of a cell and what is in it."""


def step_pages(
    panels: Panels, paper: Paper, first: int, progress: Progress = silent, *, skip: int = 0
) -> Iterator[Page | None]:
    """Draw the steps.

    Parameters
    ----------
    panels : Panels
    paper : Paper
    first : int
        Number of the first page.
    progress : Progress
    skip : int
        Pages from the first one on that are not drawn.

    Yields
    ------
    Page or None
        None for a page that is skipped.
    """
    drawing = part(progress, 0.4, 1.0)
    found = panels.all(part(progress, 0.0, 0.4))
    page = page_cell(paper)
    layout = _Layout(panels, scales(panels, found, paper), page)
    start = 0
    while start < len(found):
        drawing("pictures", start / len(found))
        cells = layout.filled(page, found[start:])
        start, here = start + len(cells), found[start : start + len(cells)]
        first, skip = first + 1, skip - 1
        if skip >= 0:
            yield None
            continue
        items = [item for panel, cell in zip(here, cells, strict=True) for item in layout.items(panel, cell)]
        if len(cells) > 1:
            items.append(_middle(paper))
        number = here[0].shot.step.number
        yield Page(paper.width, paper.height, (*items, *foot(first - 1, paper)), f"Step {number + 1}", number)


def scales(panels: Panels, found: Sequence[Panel], paper: Paper) -> dict[int, float]:
    """Return the scale for each table: the same for all of its steps, so that nothing jumps.

    Parameters
    ----------
    panels : Panels
    found : sequence of Panel
        All pictures.
    paper : Paper

    Returns
    -------
    dict of int to float
        Of each submodel the mm on paper for a mm of the model.
    """
    largest = {each.number: np.ones(2) for each in panels.steps.submodels}
    page = page_cell(paper)
    for panel in found:
        table = panel.shot.submodel
        # a part that is too large to be read, as what is put on as a whole, is drawn smaller by itself
        if panel.window is not None and (panel.size * MM * READABLE > largest_picture(paper)).any():
            continue
        largest[table] = np.maximum(largest[table], panel.size * MM)
    half = page._replace(width=(page.width - GAP) / 2)
    made = {}
    for table, size in largest.items():
        in_half, in_page = (
            float(min((cell.width - 2 * _INSET) / size[0], (cell.height - 2 * _INSET - _HEAD) / size[1]))
            for cell in (half, page)
        )
        made[table] = min(in_half, LARGEST) if in_half >= READABLE else min(in_page, READABLE)
    return made


def largest_picture(paper: Paper) -> tuple[float, float]:
    """Return how many mm a picture may be wide and high on a page."""
    page = page_cell(paper)
    return page.width - 2 * _INSET, page.height - 2 * _INSET - _HEAD


def _middle(paper: Paper) -> Item:
    """Return the line between the halves of a page, of which the left one is read first."""
    page = page_cell(paper)
    return rectangle(paper.width / 2, page.y, 0, page.height, Paint(stroke=(120, 126, 134), width=0.5))


class _Layout:
    def __init__(self, panels: Panels, scale: Mapping[int, float], page: Cell) -> None:
        self._panels, self._scale, self._page = panels, scale, page
        self._headers: dict[tuple[int, float], Callout] = {}

    def filled(self, cell: Cell, panels: Sequence[Panel]) -> list[Cell]:
        """Return the cells of the first panels of a row, inside of one."""
        halves = cell.halves
        if halves and self._fits(panels[0], halves[0]):
            one = self.filled(halves[0], panels)
            rest = panels[len(one) :]
            if rest and self._fits(rest[0], halves[1]):
                return one + self.filled(halves[1], rest)
            # half of a cell stays empty rather than that many small pictures become large ones
            if len(one) > 1:
                return one
        return [cell]

    def items(self, panel: Panel, cell: Cell) -> Iterator[Item]:
        """Yield a picture in its cell, with a colour behind it if it is built by itself."""
        table = panel.shot.submodel
        if self._panels.steps.submodels[table].kind != Kind.MAIN:
            yield rectangle(*cell, Paint(fill=SUB))
        line = Paint(stroke=(205, 208, 212), width=0.25)
        if cell.x > MARGIN:
            yield rectangle(cell.x - GAP / 2, cell.y, 0, cell.height, line)
        if cell.y > MARGIN:
            yield rectangle(cell.x, cell.y - GAP / 2, cell.width, 0, line)
        wide, high = cell.width - 2 * _INSET, cell.height - 2 * _INSET
        # a picture that has a page for itself, as of a large model, is as large as can be read
        scale = max(self._scale[table], READABLE) if cell == self._page else self._scale[table]
        yield moved(panel_items(self._panels, panel, wide, high, scale), cell.x + _INSET, cell.y + _INSET)

    def _fits(self, panel: Panel, cell: Cell) -> bool:
        wide, high = cell.width - 2 * _INSET, cell.height - 2 * _INSET
        across, down = panel.size * MM * self._scale[panel.shot.submodel]
        if across > wide or down > high:
            return False
        key = id(panel), wide
        if key not in self._headers:
            self._headers[key] = header(self._panels, panel, wide)
        top = self._headers[key]
        return bool(top.width <= wide and down <= high - top.height - 3)
