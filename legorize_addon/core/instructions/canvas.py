"""What a page shows, before it is written as SVG or PDF: paths, texts, groups.

A page is in mm, x to the right and y downwards from its upper left corner. A
group has units of its own, so that a picture keeps the small whole numbers of
its lattice; widths of lines are in the units of their group.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Final, Literal, NamedTuple

import numpy as np

from ..arrays import Floats, Ints

Rgb = tuple[int, int, int]

BLACK: Final[Rgb] = (0, 0, 0)
WHITE: Final[Rgb] = (255, 255, 255)


class Paint(NamedTuple):
    """How a path is painted: filled, drawn along, or both.

    Attributes
    ----------
    fill, stroke : tuple of three int or None
        Colours in sRGB bytes.
    width : float
        Of the line.
    dash : tuple of float
        Lengths of strokes and gaps, empty for a whole line.
    """

    fill: Rgb | None = None
    stroke: Rgb | None = None
    width: float = 0.0
    dash: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """Polylines or polygons, painted once or several times, one over the other.

    Attributes
    ----------
    points : (n, 2) array
        All corners.
    count : (n_lines,) int64 array
        Corners of each line.
    closed : bool
        Whether each ends where it begins.
    paints : tuple of Paint
    """

    points: Floats | Ints
    count: Ints
    closed: bool
    paints: tuple[Paint, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Text:
    """One line of text.

    Attributes
    ----------
    text : str
    x, y : float
        Of its base line, at the side of the anchor.
    size : float
        Height of the font.
    bold : bool
    anchor : {"start", "middle", "end"}
    colour : tuple of three int
    """

    text: str
    x: float
    y: float
    size: float
    bold: bool = False
    anchor: Literal["start", "middle", "end"] = "start"
    colour: Rgb = BLACK


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """Things in units of their own.

    Attributes
    ----------
    items : tuple
        Paths, texts and groups, each over those before it.
    matrix : tuple of six float
        (a, b, c, d, e, f): a point (x, y) lies at (a x + c y + e, b x + d y + f) outside.
    clip : Path or None
        Nothing is seen outside of it; in the units of the group.
    """

    items: tuple[Item, ...]
    matrix: tuple[float, float, float, float, float, float] = (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
    clip: Path | None = None


Item = Path | Text | Group


@dataclass(frozen=True, slots=True, eq=False)
class Page:
    """One page.

    Attributes
    ----------
    width, height : float
        In mm.
    items : sequence of Item
    title : str
        Of a bookmark, empty for none.
    step : int or None
        The first step that it shows, from 0.
    """

    width: float
    height: float
    items: Sequence[Item] = field(default_factory=tuple)
    title: str = ""
    step: int | None = None


def polygon(points: Sequence[tuple[float, float]], *paints: Paint) -> Path:
    """Return one closed polygon."""
    return Path(np.array(points, dtype=np.float64), np.array([len(points)]), True, paints)


def rectangle(x: float, y: float, width: float, height: float, *paints: Paint) -> Path:
    """Return a rectangle by its upper left corner and its size."""
    return polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], *paints)


def lines(segments: Floats | Ints, *paints: Paint) -> Path:
    """Return straight lines, (n, 2, 2): of each its two points."""
    return Path(segments.reshape(-1, 2), np.full(len(segments), 2), False, paints)


def moved(items: Sequence[Item], x: float, y: float, scale: float = 1.0) -> Group:
    """Return things in units of `scale` of those outside, with their origin at a point."""
    return Group(tuple(items), (scale, 0.0, 0.0, scale, x, y))
