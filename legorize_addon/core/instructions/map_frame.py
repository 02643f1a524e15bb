"""Where layer maps lie on their pages."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from ..arrays import Floats, Ints
from ..building import SIDE
from ..model import Bricks, Catalogue
from ..units import STUD as STUD_MM
from .paper import MARGIN, Paper
from .plans import plan_outlines

TITLE: Final = 14.0
"""mm for the title of a map."""

LABELS: Final = 6.0
"""mm for the numbers of rows and columns on each side."""

FRONT: Final = 5.0
"""mm for the word that says where the front is."""

LARGEST: Final = 12.0
"""mm to which a stud is enlarged at most."""


class Frame(NamedTuple):
    """Where the maps of a model lie on their pages, the same for all layers, so that they lie one over the other.

    Attributes
    ----------
    low, high : (2,) int64 array
        Studs from which and to which the maps go.
    turned : bool
        Whether y goes to the left and x upwards, for models that are deeper than wide.
    stud : float
        mm of a stud on paper.
    left, top : float
        Upper left corner of the maps in mm.
    width, height : float
        Size of the pages in mm.
    first : (2,) int64 array
        Stud from which columns and rows are counted.
    """

    low: Ints
    high: Ints
    turned: bool
    stud: float
    left: float
    top: float
    width: float
    height: float
    first: Ints

    @classmethod
    def of(cls, bricks: Bricks, catalogue: Catalogue, legend: float, paper: Paper, *, actual_size: bool) -> Frame:
        """Return the frame for a model and the width of its widest legend."""
        points, _ = plan_outlines(bricks, catalogue)
        return cls._around(points, legend, paper, actual_size=actual_size)

    @classmethod
    def of_tile(cls, outlines: Floats, tile: tuple[int, int], whole: Frame, legend: float, paper: Paper) -> Frame:
        """Return the frame for a tile of a mosaic, with what lies across its borders, at most as large as the whole."""
        low = whole.low + np.array(tile[::-1]) * SIDE
        box = np.stack([low, np.minimum(low + SIDE, whole.high)])
        found = cls._around(np.concatenate([box, outlines]), legend, paper, actual_size=whole.stud == STUD_MM)
        return found._replace(first=whole.low)

    @classmethod
    def of_box(cls, box: tuple[tuple[int, int], tuple[int, int]], whole: Frame, legend: float, paper: Paper) -> Frame:
        """Return the frame for a part of a model, which lies as the whole does."""
        found = cls._around(np.array(box, dtype=np.float64), legend, paper, actual_size=False, turned=whole.turned)
        return found._replace(first=whole.low)

    @classmethod
    def _around(
        cls, points: Floats, legend: float, paper: Paper, *, actual_size: bool, turned: bool | None = None
    ) -> Frame:
        low, high = (np.floor(points.min(axis=0)).astype(np.int64), np.ceil(points.max(axis=0)).astype(np.int64))
        if turned is None:
            turned = bool((high - low)[1] > (high - low)[0]) and not actual_size
        across, up = (high - low)[:: -1 if turned else 1].tolist()
        beside, above = _besides(legend)
        stud = min((paper.width - beside) / across, (paper.height - above) / up, LARGEST)
        if actual_size:
            stud = STUD_MM
        width, height = max(paper.width, across * stud + beside), max(paper.height, up * stud + above)
        left = MARGIN + LABELS + (width - beside - across * stud) / 2
        top = MARGIN + TITLE + LABELS + (height - above - up * stud) / 2
        return cls(low, high, turned, stud, left, top, width, height, low)

    @property
    def matrix(self) -> tuple[float, float, float, float, float, float]:
        """From studs, y upwards, to mm on the page."""
        (x_low, _), (x_high, y_high) = self.low.tolist(), self.high.tolist()
        if self.turned:
            return (0.0, -self.stud, -self.stud, 0.0, self.left + y_high * self.stud, self.top + x_high * self.stud)
        return (self.stud, 0.0, 0.0, -self.stud, self.left - x_low * self.stud, self.top + y_high * self.stud)

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Return where a place in studs lies on the page."""
        a, b, c, d, e, f = self.matrix
        return a * x + c * y + e, b * x + d * y + f


def map_room(legend: float, paper: Paper) -> tuple[float, float]:
    """Return how many mm a map may be wide and high beside a legend of a width."""
    beside, above = _besides(legend)
    return paper.width - beside, paper.height - above


def _besides(legend: float) -> tuple[float, float]:
    """Return the mm that are taken beside and above the maps."""
    return 2 * MARGIN + 2 * LABELS + FRONT + legend, 2 * MARGIN + 2 * LABELS + FRONT + TITLE
