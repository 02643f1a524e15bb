"""The shape and the colours of the rooster that ``make_samples.py`` turns into a file.

The rooster is a distance function of some two dozen limbs, joined smoothly, and
a colour for every point of its surface. Lengths are in cm: one stud when the
model is 48 studs long. It is mirror-symmetric about x = 0, looks towards -y
and stands on z = 0. Limbs and patterns are given as (side, forward, up), that
is (abs(x), -y, z).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]

WALL: Final = 3.2
"""Thickness of the belly round its cavity."""

BOX: Final = np.array([[-14.0, -26.0, -2.0], [14.0, 26.0, 53.0]])
"""Two corners (x, y, z) of a box with the whole rooster inside."""

COLOURS: Final = {
    "white": (244, 244, 244),
    "black": (27, 42, 52),
    "red": (180, 0, 0),
    "orange": (214, 121, 35),
    "amber": (252, 172, 0),
    "yellow": (250, 200, 10),
    "green": (0, 133, 43),
    "lime": (165, 202, 24),
    "azure": (70, 155, 195),
    "blue": (30, 90, 168),
}
"""sRGB bytes, close to colours that bricks are made in."""

PALETTE: Final = np.array(list(COLOURS.values()), dtype=np.uint8)
NUMBER: Final = {name: number for number, name in enumerate(COLOURS)}


@dataclass(frozen=True, slots=True)
class Limb:
    """A chain of balls, and what a skin round them encloses.

    Attributes
    ----------
    name : str
        What it is; the patterns go by it.
    colour : str
        Name in ``COLOURS``.
    balls : tuple of (side, forward, up, radius)
        Centres and radii, with a smooth curve through three or more; a limb
        off the middle stands for a mirrored pair.
    flat : float
        Thickness across (along x) as a share of the thickness in the side view.
    blend : float
        Width of the rounded joint to the limbs before it in the table.
    """

    name: str
    colour: str
    balls: tuple[tuple[float, float, float, float], ...]
    flat: float = 1.0
    blend: float = 1.0


# fmt: off
TRUNK: Final = Limb("body", "white", ((0, 6, 21.5, 8.6), (0, -2, 20.5, 9.2), (0, -9.5, 24.5, 6)))
ROOSTER: Final = (
    TRUNK,
    Limb("body", "white", ((4.9, 0, 16, 4.6), (4.9, 0, 10.5, 2.7)), blend=2),
    Limb("leg", "orange", ((4.9, 0, 10, 1.7), (4.9, 0, 1, 1.7)), blend=0.5),
    Limb("leg", "orange", ((4.9, -4.2, 0.9, 1.4), (4.9, 0, 1.1, 1.8))),
    Limb("leg", "orange", ((4.9, 0, 1.1, 1.8), (1.5, 4.2, 0.9, 1.4))),
    Limb("leg", "orange", ((4.9, 0, 1.1, 1.8), (4.9, 6.4, 0.9, 1.4))),
    Limb("leg", "orange", ((4.9, 0, 1.1, 1.8), (8.3, 4.2, 0.9, 1.4))),
    Limb("body", "white", ((0, 6.5, 24.5, 8), (0, 9.5, 31, 6.4), (0, 11, 36, 6)), blend=3),
    Limb("head", "white", ((0, 11.3, 37.8, 6.4),), blend=1.5),
    Limb("beak", "orange", ((0, 16, 37.2, 3.3), (0, 21, 36.2, 1.8), (0, 23.2, 35.4, 0.9)), flat=0.9, blend=0.5),
    Limb("comb", "red", ((0, 10.5, 39.5, 2.8), (0, 16.2, 45.2, 2.2)), flat=0.6, blend=0.5),
    Limb("comb", "red", ((0, 10.5, 39.5, 2.8), (0, 10.9, 47.6, 2.9)), flat=0.6, blend=0.5),
    Limb("comb", "red", ((0, 10.5, 39.5, 2.8), (0, 5, 45.9, 2.7)), flat=0.6, blend=0.5),
    Limb("wattle", "red", ((1.5, 16.4, 33.2, 1.6), (1.7, 16.8, 30.2, 2.4)), flat=0.8, blend=0.5),
    Limb("wing", "azure", ((7.6, 4.5, 22.5, 4.8), (8.2, -3, 21.3, 4.4), (6.8, -11.5, 23.8, 2.4)), flat=0.6),
    Limb("tail", "green", ((0, -6, 26, 5), (0, -9, 35, 4.6), (0, -13, 41.3, 4), (0, -18, 43, 3.2),
                           (0, -21.6, 39, 2.2), (0, -22.2, 36.2, 1.2)), flat=0.8),
    Limb("tail", "azure", ((0, -6, 25, 5), (0, -12, 33, 4.2), (0, -16, 36.3, 3.6), (0, -19.6, 34.6, 2.6),
                           (0, -20.8, 30.4, 1.4)), flat=0.8),
    Limb("tail", "lime", ((0, -6, 24.5, 5), (0, -13, 29, 4), (0, -17, 30, 3.3), (0, -20.4, 27.6, 2.4),
                          (0, -21.2, 24.2, 1.3)), flat=0.8),
    Limb("tail", "blue", ((0, -6, 23, 5), (0, -12.5, 24.8, 3.6), (0, -16.5, 23.8, 3), (0, -18.6, 19.6, 1.5)),
         flat=0.8),
)
# fmt: on


def limb_distance(limb: Limb, points: Floats) -> Floats:
    """Return how far points are outside a limb (negative inside), about right near its surface.

    Parameters
    ----------
    limb : Limb
        The limb, and its mirror image where it is off the middle.
    points : (n, 3) float64 array
        Points (x, y, z) in cm.

    Returns
    -------
    (n,) float64 array
        Distances in cm.
    """
    stretch = np.array([1 / limb.flat, 1, 1])
    local = np.array([np.abs(points[:, 0]) / limb.flat, -points[:, 1], points[:, 2]])
    balls = chain(limb)
    centres, radii = balls[:, :3] * stretch, balls[:, 3]
    nearest = np.full(len(points), np.inf)
    for start, axis, radius, growth in zip(centres[:-1], np.diff(centres, axis=0), radii, np.diff(radii), strict=False):
        offset = local - start[:, None]
        along = np.clip(axis @ offset / max(axis @ axis, 1e-12), 0, 1)
        offset -= axis[:, None] * along
        nearest = np.minimum(nearest, np.sqrt((offset * offset).sum(axis=0)) - radius - growth * along)
    return nearest * limb.flat


def chain(limb: Limb) -> Floats:
    """Return the balls of a limb, with two more between each two where there is a curve."""
    balls = np.array(limb.balls, dtype=np.float64)
    if len(balls) < 3:
        return np.resize(balls, (2, 4))
    return CubicSpline(np.arange(len(balls)), balls)(np.linspace(0, len(balls) - 1, 3 * len(balls) - 2))


def outer_distance(points: Floats) -> Floats:
    """Return the distance of points to all limbs, joined smoothly."""
    joined = limb_distance(ROOSTER[0], points)
    for limb in ROOSTER[1:]:
        other = limb_distance(limb, points)
        overlap = np.maximum(limb.blend - np.abs(joined - other), 0)
        joined = np.minimum(joined, other) - overlap**2 / (4 * limb.blend)
    return joined


def distance(points: Floats) -> Floats:
    """Return the distance of points to the rooster: flat below, a closed cavity in its belly."""
    cavity = limb_distance(TRUNK, points) + WALL
    return np.maximum.reduce([outer_distance(points), -cavity, -points[:, 2]])


def paint(points: Floats) -> NDArray[np.uint8]:
    """Return the colour of points on the surface, (n, 3) sRGB bytes."""
    distances = np.array([limb_distance(limb, points) for limb in ROOSTER])
    owner = distances.argmin(axis=0)
    name = np.array([limb.name for limb in ROOSTER])[owner]
    colour = np.array([NUMBER[limb.colour] for limb in ROOSTER])[owner]
    side, forward, up = np.abs(points[:, 0]), -points[:, 1], points[:, 2]
    plumage = np.isin(name, ["body", "head"])
    paint_plumage(colour, plumage, side, forward, up)
    paint_wing(colour, name == "wing", forward, up)
    paint_eye(colour, plumage & (side > 3), forward, up)
    colour[distances[ROOSTER.index(TRUNK)] < -WALL / 2] = NUMBER["red"]
    feathered = np.isin(name, ["body", "wing", "tail"]) & (colour != NUMBER["black"])
    drawn = feathered & feather_edge(name == "tail", side, forward, up)
    return np.where(drawn[:, None], 0.86 * PALETTE[colour], PALETTE[colour]).astype(np.uint8)


def saw(values: Floats) -> Floats:
    """Return a triangle wave: 0 at whole numbers, 1 half-way between."""
    return 1 - np.abs(2 * (values % 1) - 1)


def feather_edge(tail: Mask, side: Floats, forward: Floats, up: Floats) -> Mask:
    """Return where the rounded edges of feathers are drawn: rows round the body, rows out from the tail's root."""
    turn = np.where(tail, np.arctan2(up - 24, -6 - forward), np.arctan2(side, forward)) / np.pi
    row, height = np.divmod(np.where(tail, -np.hypot(forward + 6, up - 24) / 3, up / 2.6), 1)
    return np.abs(height - 0.2 - 0.5 * saw(10 * turn + row / 2 + 0.5) ** 2) < 0.07


def paint_plumage(colour: Ints, where: Mask, side: Floats, forward: Floats, up: Floats) -> None:
    """Lay a saddle over the back and a collar of pointed feathers round the leaning neck."""
    saddle = where & (forward < 4)
    hem = 23.5 + 3 * saw(forward / 4)
    colour[saddle & (up > hem)] = NUMBER["orange"]
    colour[saddle & (up > hem + 2.4)] = NUMBER["amber"]
    turn = np.arctan2(side, forward - 6.5 - 0.4 * (up - 24.5)) / np.pi
    collar = 19 + 8 * turn + 5 * saw(4 * turn + 0.5)
    colour[where & (up > collar)] = NUMBER["orange"]
    colour[where & (up > collar + 3.4)] = NUMBER["amber"]
    colour[where & (up > 31 + 3 * saw(4 * turn + 0.5))] = NUMBER["yellow"]


def paint_wing(colour: Ints, where: Mask, forward: Floats, up: Floats) -> None:
    """Band the wing with feather tips across it."""
    along = forward - 0.35 * (up - 21) + 2 * saw(up / 4.4)
    colour[where & (along < 0)] = NUMBER["lime"]
    colour[where & (along < -3.2)] = NUMBER["blue"]


def paint_eye(colour: Ints, where: Mask, forward: Floats, up: Floats) -> None:
    """Give the head two big round eyes."""
    colour[where & (np.hypot(forward - 13.2, up - 38.6) < 3.4)] = NUMBER["white"]
    colour[where & (np.hypot(forward - 13.7, up - 38.6) < 2)] = NUMBER["black"]
