"""A picture of bricks as a few paths: faces, lines, studs.

Studs need no search of their own. A stud as seen from the corner lies within the
picture of the stud square that it stands on, and in a cell that is empty; so it
is seen exactly where the top below it is seen.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY
from .canvas import Group, Item, Paint, Path, Rgb, lines
from .lattice import PER_TOP, SIDES, TOP, Sight
from .regions import borders, neighbours, outlines
from .shades import DARK, LIGHT_LINE, LINE, PALE_LINE, brightness, lit, mixed

ACROSS: Final = 14
DOWN: Final = 9
"""Units of a picture to the left for p and to the right for q, and upwards for both; 14 : 9 is 1.556, and the true
proportion of the projection 1.546."""

STUD: Final = (3 * ACROSS, 3 * DOWN)
"""Way in units of a picture for one stud: along x to the left, along y to the right, along both downwards."""

PLATE: Final = 2 * DOWN
"""Way upwards for one plate."""

MM: Final = 8 / (2**0.5) / (3 * ACROSS)
"""Length of a unit on the model in mm."""

_STUD_UNITS: Final = 6
"""Units of the drawing of studs for one stud; studs of all levels have whole numbers in them."""

_STUD_MATRIX: Final = (-STUD[0] / 6, STUD[1] / 6, STUD[0] / 6, STUD[1] / 6, 0.0, 0.0)
_STUD_WIDTH: Final = 3.6
"""A stud is 4.8 mm wide, 0.6 of the pitch."""

_RIM: Final = 0.34
"""How much smaller the bright top of a stud is drawn than the stud, for a line around it."""


@dataclass(frozen=True, slots=True, eq=False)
class Look:
    """How the bricks of a picture look.

    Attributes
    ----------
    colour : (n_bricks, 3) uint8 array
        Of each brick.
    new : (n_bricks,) bool array
        Which bricks have strong lines.
    studs : bool
        Whether tops have studs; undersides have sockets.
    smooth : (n_bricks,) bool array, optional
        Which bricks have neither on top.
    """

    colour: Ints
    new: Mask
    studs: bool = True
    smooth: Mask | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A picture, in units in which studs are ``STUD`` apart.

    Attributes
    ----------
    items : tuple of Item
    low, high : (2,) float64 array
        Its upper left and lower right corner.
    """

    items: tuple[Item, ...]
    low: Floats
    high: Floats

    @property
    def size(self) -> Floats:
        """Width and height."""
        return self.high - self.low


def draw(sight: Sight, look: Look) -> Picture:
    """Draw what is seen.

    Parameters
    ----------
    sight : Sight
    look : Look
        Of the same bricks.

    Returns
    -------
    Picture
    """
    if not len(sight.faces):
        return Picture((), np.zeros(2), np.zeros(2))
    styles, style = np.unique(np.column_stack([look.colour, look.new]), axis=0, return_inverse=True)
    style = style.reshape(-1)
    items: list[Item] = [*_fills(sight, styles, style), *_lines(sight, look)]
    items += _stud_items(sight, styles, style, look)
    low, high = extent(sight)
    return Picture(tuple(items), low, high)


def at(points: Ints) -> Ints:
    """Return where points of the lattice, (n, 2), lie in a picture, (n, 2) with y downwards."""
    p, q = points.T
    return np.stack([ACROSS * (q - p), -DOWN * (p + q)], axis=1)


def extent(sight: Sight, seen: Mask | None = None) -> tuple[Floats, Floats]:
    """Return the upper left and the lower right corner of a picture, or of some of its pieces."""
    m, n, half = np.nonzero(sight.nearest != NOBODY if seen is None else seen)
    # a half has the two corners of the diagonal, and one beside it
    beside = np.stack([m + half, n + 1 - half], axis=1)
    corners = at(np.concatenate([np.stack([m, n], axis=1), np.stack([m, n], axis=1) + 1, beside]) + sight.low)
    return corners.min(axis=0).astype(float), corners.max(axis=0).astype(float)


def _fills(sight: Sight, styles: Ints, style: Ints) -> Iterator[Item]:
    """Yield the faces, those of one colour and side in one path."""
    faces = sight.faces
    region = np.append(style[faces.brick] * SIDES + faces.side, NOBODY)[sight.nearest]
    loops = outlines(region, sight.low)
    ends = np.cumsum(loops.count)
    points = at(loops.points)
    kinds, first = np.unique(loops.of, return_index=True)
    for kind, low, high in zip(kinds.tolist(), first, [*first[1:], len(loops.of)], strict=True):
        rows = slice(ends[low] - loops.count[low], ends[high - 1])
        rgb = lit(_rgb(styles[kind // SIDES]), kind % SIDES)
        # a hair of its own colour closes the seam to the next face
        yield Path(points[rows], loops.count[low:high], True, (Paint(fill=rgb, stroke=rgb, width=1.0),))


def _rgb(row: Ints) -> Rgb:
    red, green, blue = row[:3].tolist()
    return red, green, blue


STROKES: Final = (
    Paint(stroke=PALE_LINE, width=2.4),
    Paint(stroke=mixed(LINE, (255, 255, 255), 0.25), width=2.6),
    Paint(stroke=LIGHT_LINE, width=2.6),
    Paint(stroke=LINE, width=4.2),
    Paint(stroke=LIGHT_LINE, width=4.2),
    Paint(stroke=LINE, width=7.5),
)
"""Lines of what was built before; edges of new bricks, on bright and on dark ones; lines between new bricks, the same
two; outlines of what is new."""


def _lines(sight: Sight, look: Look) -> Iterator[Item]:
    """Yield the lines, those of one kind in one path."""
    faces = sight.faces
    left, right = neighbours(np.append(np.arange(len(faces)), NOBODY)[sight.nearest])
    kind = _kinds(left, right, faces.brick, faces.side, look)
    found = borders(kind, sight.low)
    ends = np.stack([at(found.start), at(found.end)], axis=1)
    for number, paint in enumerate(STROKES):
        mine = found.of == number
        if mine.any():
            yield lines(ends[mine], paint)


def _kinds(left: Ints, right: Ints, brick: Ints, side: Ints, look: Look) -> Ints:
    """Return the kind of line on each edge between two faces, ``NOBODY`` where there is none."""
    brick, side = np.append(brick, NOBODY), np.append(side, NOBODY)
    one, other = brick[left], brick[right]
    # the ground is not new, and neither bright nor dark
    new = np.append(look.new, False)
    dark = np.append([brightness(_rgb(row)) < DARK for row in look.colour], True)
    same = one == other
    kind = np.where(same, 1, 3)
    both_dark = dark[one] & dark[other]
    kind += both_dark
    kind = np.where(new[one] != new[other], 5, kind)
    kind = np.where(new[one] | new[other], kind, 0)
    return np.where(same & (side[left] == side[right]), NOBODY, kind)


def _stud_items(sight: Sight, styles: Ints, style: Ints, look: Look) -> Iterator[Item]:
    """Yield the studs, whole ones by colour, others cut off by what stands before them."""
    seen = sight.per_face
    tops = sight.faces.side == TOP
    if look.studs and look.smooth is not None:
        tops &= ~look.smooth[sight.faces.brick]
    whole = np.flatnonzero(tops & (seen == PER_TOP))
    yield from _stud_paths(sight, whole, styles, style, look.studs)
    partly = np.flatnonzero(tops & (seen > 0) & (seen < PER_TOP))
    # tops of one level never lie one over the other
    level = np.full(len(sight.faces) + 1, NOBODY)
    level[partly] = sight.faces.place[partly, 2] - sight.faces.place[:, 2].min(initial=0)
    loops = outlines(level[sight.nearest], sight.low)
    ends = np.cumsum(loops.count)
    points = at(loops.points)
    for number in np.unique(level[partly]).tolist():
        mine = np.flatnonzero(loops.of == number)
        rows = slice(ends[mine[0]] - loops.count[mine[0]], ends[mine[-1]])
        clip = Path(points[rows], loops.count[mine], True, ())
        yield Group(tuple(_stud_paths(sight, partly[level[partly] == number], styles, style, look.studs)), clip=clip)


def stud_paths(tops: Ints | Floats, rgb: Rgb, new: bool, studs: bool) -> Iterator[Item]:
    """Yield the studs, or sockets, of one colour on cells, (n, 3)."""
    yield Group(tuple(_studs(_feet(tops), rgb, new) if studs else _sockets(_feet(tops), rgb)), _STUD_MATRIX)


def _feet(tops: Ints | Floats) -> Ints:
    """Return the middles of the tops of cells, shifted along the diagonal by the height of the level."""
    x, y, z = tops.T
    feet = np.stack([_STUD_UNITS * each + _STUD_UNITS // 2 - 2 * (z + 1) for each in (x, y)], axis=1)
    return feet.astype(np.int64)


def _stud_paths(sight: Sight, tops: Ints, styles: Ints, style: Ints, studs: bool) -> Iterator[Item]:
    foot = _feet(sight.faces.place[tops])
    of = style[sight.faces.brick[tops]]
    items: list[Item] = []
    for number in np.unique(of).tolist():
        rgb, new = _rgb(styles[number]), bool(styles[number][3])
        mine = foot[of == number]
        items += _studs(mine, rgb, new) if studs else _sockets(mine, rgb)
    if items:
        yield Group(tuple(items), _STUD_MATRIX)


def _studs(foot: Ints, rgb: Rgb, new: bool) -> Iterator[Item]:
    """Yield studs half a plate high: the side, and the top with a line around it."""
    dark = brightness(rgb) < DARK
    line = (LIGHT_LINE if dark else LINE) if new else PALE_LINE
    side = mixed(lit(rgb, 1), line, 0.0)
    top = np.stack([foot - 1, foot - 1], axis=1).astype(float)
    top[:, 1, 0] += 0.01
    whole = np.stack([foot, foot - 1], axis=1)
    yield lines(whole, Paint(stroke=line, width=_STUD_WIDTH + _RIM), Paint(stroke=side, width=_STUD_WIDTH - _RIM / 2))
    yield lines(top, Paint(stroke=line, width=_STUD_WIDTH), Paint(stroke=rgb, width=_STUD_WIDTH - _RIM))


def _sockets(foot: Ints, rgb: Rgb) -> Iterator[Item]:
    """Yield the hollows of an underside."""
    dot = np.stack([foot, foot], axis=1).astype(float)
    dot[:, 1, 0] += 0.01
    yield lines(dot, Paint(stroke=mixed(rgb, (0, 0, 0), 0.35), width=3.9), Paint(stroke=lit(rgb, 1), width=3.2))
