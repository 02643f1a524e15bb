"""Pages that are larger than a sheet of paper, cut into sheets that are glued side by side."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from .canvas import Group, Page, Paint, Text, moved, rectangle
from .lots import GREY
from .paper import MARGIN, Paper

_CUT = Paint(stroke=GREY, width=0.15, dash=(2.0, 1.5))


class Sheets(NamedTuple):
    """How a page is cut.

    Attributes
    ----------
    columns, rows : int
        Sheets side by side, and below each other.
    paper : Paper
        Of each, the long side across or upwards.
    """

    columns: int
    rows: int
    paper: Paper

    @property
    def room(self) -> tuple[float, float]:
        """Width and height in mm of what is on a sheet: a printer does not reach its rim."""
        return self.paper.width - 2 * MARGIN, self.paper.height - 2 * MARGIN


def sheets_for(page: Page, paper: Paper) -> Sheets:
    """Return how a page is cut into the fewest sheets of a size, lying or upright; one if it fits as it is."""
    if page.width <= paper.width and page.height <= paper.height:
        return Sheets(1, 1, paper)
    found = []
    for turned in (paper, Paper(paper.height, paper.width)):
        wide, high = Sheets(1, 1, turned).room
        found.append(Sheets(math.ceil(page.width / wide), math.ceil(page.height / high), turned))
    return min(found, key=lambda each: each.columns * each.rows)


def sheets(page: Page, paper: Paper) -> Iterator[tuple[str, Page]]:
    """Cut a page.

    Parameters
    ----------
    page : Page
    paper : Paper

    Yields
    ------
    (str, Page)
        Row and column of each sheet, "A1" at the upper left, and the sheet, with a dashed line along which it is cut
        and glued; "" and the page itself if it fits on one.
    """
    cut = sheets_for(page, paper)
    if cut.columns * cut.rows == 1:
        yield "", page
        return
    wide, high = cut.room
    for row in range(cut.rows):
        for column in range(cut.columns):
            name = f"{chr(ord('A') + row)}{column + 1}"
            shown = moved(page.items, MARGIN - column * wide, MARGIN - row * high)
            frame = rectangle(MARGIN, MARGIN, wide, high)
            note = f"{page.title}, sheet {name} of {cut.rows * cut.columns}: print at 100 %, cut along the dashed line"
            items = (
                Group((shown,), clip=frame),
                rectangle(MARGIN, MARGIN, wide, high, _CUT),
                Text(note, MARGIN, MARGIN - 3, 3, colour=GREY),
            )
            yield name, Page(cut.paper.width, cut.paper.height, items, page.title)
