"""Sheets of paper, and how they are divided."""

from __future__ import annotations

from typing import Final, NamedTuple

from .canvas import Item, Text
from .lots import GREY


class Paper(NamedTuple):
    """Size of a sheet in mm, the long side across."""

    width: float
    height: float


PAPERS: Final = {"A4": Paper(297.0, 210.0), "Letter": Paper(279.4, 215.9)}

MARGIN: Final = 10.0
"""mm around what is printed, as most printers need half of it."""


class Cell(NamedTuple):
    """A part of a sheet, in mm from its upper left corner."""

    x: float
    y: float
    width: float
    height: float

    @property
    def halves(self) -> tuple[Cell, Cell] | None:
        """The two halves of a cell, the first one left or above; None if they would be too small."""
        if self.width >= self.height:
            half = (self.width - GAP) / 2
            return (
                (self._replace(width=half), self._replace(x=self.x + half + GAP, width=half))
                if half >= NARROWEST
                else None
            )
        half = (self.height - GAP) / 2
        return (
            (self._replace(height=half), self._replace(y=self.y + half + GAP, height=half)) if half >= LOWEST else None
        )


def page_cell(paper: Paper) -> Cell:
    """Return the part of a sheet that is printed."""
    return Cell(MARGIN, MARGIN, paper.width - 2 * MARGIN, paper.height - 2 * MARGIN - FOOT)


GAP: Final = 6.0
"""mm between cells."""

FOOT: Final = 5.0
"""mm for the number of the page."""

NARROWEST: Final = 58.0
LOWEST: Final = 54.0
"""mm of the smallest cells."""


def foot(number: int, paper: Paper) -> list[Item]:
    """Return the number of a page."""
    return [Text(str(number), paper.width - MARGIN, paper.height - MARGIN / 2 - 1, 3.2, anchor="end", colour=GREY)]
