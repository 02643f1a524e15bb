"""Small signs of the booklet: turn the model, lay it on its back, press from below, hold, take out."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats
from .canvas import Item, Paint, Path, Rgb, polygon, rectangle

SIGN: Final[Rgb] = (0, 104, 183)
_WIDTH: Final = 0.9


def turn_sign(x: float, y: float, size: float, *, over: bool) -> list[Item]:
    """Return an arrow that goes round, about the upright or, to lay a model on its back, about the level.

    Parameters
    ----------
    x, y : float
        Its middle in mm.
    size : float
        Its radius.
    over : bool
    """
    angle = np.linspace(np.radians(-60), np.radians(230), 40)
    wide, high = (0.5, 1.0) if over else (1.0, 0.5)
    points = np.stack([x + size * wide * np.cos(angle), y + size * high * np.sin(angle)], axis=1)
    ring = Path(points, np.array([len(points)]), False, (Paint(stroke=SIGN, width=_WIDTH),))
    return [ring, _head(points[-1], points[-1] - points[-3], 0.55 * size)]


def arrow(start: tuple[float, float], end: tuple[float, float]) -> list[Item]:
    """Return a straight arrow."""
    one, other = np.array(start, dtype=float), np.array(end, dtype=float)
    way = other - one
    length = float(np.hypot(*way))
    head = min(0.45 * length, 2.6)
    shaft = np.array([one, other - way / length * 0.7 * head])
    return [
        Path(shaft, np.array([2]), False, (Paint(stroke=SIGN, width=_WIDTH),)),
        _head(other, way, head),
    ]


def hold_sign(x: float, y: float, size: float) -> list[Item]:
    """Return a brick between two arrows that press on its sides.

    Parameters
    ----------
    x, y : float
        Its middle in mm.
    size : float
        From there to the end of either arrow.
    """
    brick = rectangle(x - 0.25 * size, y - 0.45 * size, 0.5 * size, 0.9 * size, Paint(stroke=SIGN, width=0.6))
    sides = (arrow((x + side * size, y), (x + side * 0.4 * size, y)) for side in (-1, 1))
    return [brick, *(item for side in sides for item in side)]


def _head(tip: Floats, way: Floats, size: float) -> Path:
    ahead = way / np.hypot(*way)
    across = np.array([-ahead[1], ahead[0]])
    corners = [tip + 0.5 * size * ahead, *(tip - 0.5 * size * ahead + side * 0.6 * size * across for side in (1, -1))]
    return polygon([(float(x), float(y)) for x, y in corners], Paint(fill=SIGN))
