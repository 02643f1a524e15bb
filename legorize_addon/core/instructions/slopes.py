"""Slopes, wedge plates and jumpers in pictures: their true faces and studs, drawn over all else.

What falls or is slanted has no place on the lattice of :mod:`.lattice`. So everything else is drawn first, as if no
slope were there, and then the slopes, from the farthest to the nearest, each within the pieces of its cells that
nothing else hides.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Part, columns, lines, outline, turned
from .canvas import Group, Item, Paint, Path, Rgb, moved
from .canvas import lines as segments
from .half_slabs import slabs_of
from .lattice import Cells, Sight, View, look
from .lattice import turned as seen_from
from .picture import ACROSS, DOWN, STROKES, Look, Picture, at, draw, extent, stud_paths
from .regions import outlines
from .shades import DARK, LIGHT_LINE, LINE, PALE_LINE, SIDE_LIGHT, brightness, mixed

_TOWARDS: Final = np.array([1.0, 1.0, 3.0])
"""The way to the viewer, in studs and plates."""

_SMOOTH: Final = 0.94
"""Cosine of the angle, 20 degrees, below which two faces are those of one curve, with no line between them."""


@dataclass(frozen=True, slots=True, eq=False)
class _Shape:
    """A part that falls or has slanted sides, as it is seen from a place, from the corner of its box of cells.

    Attributes
    ----------
    faces : tuple of (k, 2) float64 array
        What is turned to the viewer, in points of the lattice, the farthest first.
    light : (n_faces,) float64 array
        On each of them.
    rims, creases : (m, 2, 2) float64 array
        Its outline and steps, and the edges between its faces.
    pieces : (n, 3) int64 array
        Pieces of the plane that its cells cover: square and half.
    depth : (n,) int64 array
        How near each is: the sum of the places of its cell.
    knobs : (k, 3) float64 array
        Cells under its studs; from below those over its sockets.
    """

    faces: tuple[Floats, ...]
    light: Floats
    rims: Floats
    creases: Floats
    pieces: Ints
    depth: Ints
    knobs: Floats


def draw_all(sight: Sight, looks: Look) -> Picture:
    """Draw what is seen, slopes as slopes, and what lies half a stud off the rest in its place.

    Parameters
    ----------
    sight : Sight
    looks : Look
        Of the same bricks.

    Returns
    -------
    Picture
    """
    found = [(_draw_slab(slab.sight, looks), slab.by) for slab in slabs_of(sight)]
    if len(found) == 1 and not found[0][1].any():
        return found[0][0]
    items = tuple(moved(picture.items, *by.tolist()) for picture, by in found)
    low = np.stack([picture.low + by for picture, by in found]).min(axis=0)
    return Picture(items, low, np.stack([picture.high + by for picture, by in found]).max(axis=0))


def _draw_slab(sight: Sight, looks: Look) -> Picture:
    """Draw what is seen of bricks that are no half studs off each other."""
    cells = sight.cells
    if cells is None or cells.model is None or not len(sight.faces):
        return draw(sight, looks)
    parts = cells.model.catalogue.parts
    sloped = np.array([part.shaped or part.jumper for part in parts])[cells.model.bricks.part]
    seen = np.flatnonzero(sloped & (sight.shares > 0))
    if not len(seen):
        return draw(sight, looks)
    behind = look(cells.take(~sloped[cells.brick]), len(sloped))
    items: list[Item] = [*draw(behind, looks).items]
    low = _corners(cells, seen)
    for number in np.argsort(_depth(cells, seen), kind="stable").tolist():
        row = int(seen[number])
        shape = _shape(parts[cells.model.bricks.part[row]], int(cells.model.bricks.turn[row]) % 4, cells.model.view)
        items += _drawn(shape, low[number], behind, looks, row)
    return Picture(tuple(items), *extent(sight))


def _corners(cells: Cells, rows: Ints) -> Ints:
    """Return the lowest cell of some bricks as they are seen, (k, 3)."""
    low = np.full((int(rows.max()) + 1, 3), np.iinfo(np.int64).max)
    mine = np.isin(cells.brick, rows)
    np.minimum.at(low, cells.brick[mine], cells.place[mine])
    return low[rows]


def _depth(cells: Cells, rows: Ints) -> Floats:
    """Return how near some bricks are, (k,): the mean over their cells."""
    n = int(rows.max()) + 1
    mine = np.isin(cells.brick, rows)
    total = np.bincount(cells.brick[mine], cells.place[mine].sum(axis=1), n)
    depth: Floats = (total / np.maximum(np.bincount(cells.brick[mine], minlength=n), 1))[rows]
    return depth


def _drawn(shape: _Shape, corner: Ints, behind: Sight, looks: Look, row: int) -> Iterator[Item]:
    """Yield a slope, cut off by what stands before it."""
    shift = corner[2] - 3 * corner[1::-1]
    pieces = shape.pieces + np.append(shift, 0)
    free = _free(pieces, shape.depth + int(corner.sum()), behind)
    if not free.any():
        return
    red, green, blue = looks.colour[row].tolist()
    new = bool(looks.new[row])
    items = [*_painted(shape, shift, (red, green, blue), new)]
    knobs = shape.knobs + corner
    if len(knobs):
        items += stud_paths(knobs, (red, green, blue), new, looks.studs)
    if free.all():
        yield from items
        return
    low = pieces[:, :2].min(axis=0) - 1
    region = np.full((*(pieces[:, :2].max(axis=0) - low + 2).tolist(), 2), NOBODY, dtype=np.int64)
    region[(*(pieces[free, :2] - low).T, pieces[free, 2])] = 0
    loops = outlines(region, low)
    yield Group(tuple(items), clip=Path(at(loops.points), loops.count, True, ()))


def _free(pieces: Ints, depth: Ints, behind: Sight) -> Mask:
    """Return which pieces nothing without slopes hides."""
    free = np.ones(len(pieces), dtype=bool)
    m, n = (pieces[:, :2] - behind.low).T
    inside = np.flatnonzero((m >= 0) & (n >= 0) & (m < len(behind.nearest)) & (n < behind.nearest.shape[1]))
    face = behind.nearest[m[inside], n[inside], pieces[inside, 2]]
    there = face != NOBODY
    free[inside[there]] = depth[inside[there]] > behind.faces.place[face[there]].sum(axis=1)
    return free


def _painted(shape: _Shape, shift: Ints, rgb: Rgb, new: bool) -> Iterator[Item]:
    """Yield the faces and lines of a slope in a colour."""
    for face, light in zip(shape.faces, shape.light.tolist(), strict=True):
        fill = mixed((0, 0, 0), rgb, light)
        yield Path(_at(face + shift), np.array([len(face)]), True, (Paint(fill=fill, stroke=fill, width=1.0),))
    dark = brightness(rgb) < DARK
    line = (LIGHT_LINE if dark else LINE) if new else PALE_LINE
    thin, thick = (STROKES[1 + dark], STROKES[3]) if new else (STROKES[0], STROKES[0])
    for edges, paint in ((shape.creases, thin._replace(stroke=line if not new else thin.stroke)), (shape.rims, thick)):
        if len(edges):
            yield segments(_at((edges + shift).reshape(-1, 2)).reshape(-1, 2, 2), paint)


def _at(points: Floats) -> Floats:
    """Return where points between those of the lattice lie in a picture."""
    p, q = points.T
    return np.stack([ACROSS * (q - p), -DOWN * (p + q)], axis=1)


@lru_cache(maxsize=1024)
def _shape(part: Part, turn: int, view: View) -> _Shape:
    """Return how a part looks alone."""
    found = columns(part, turn)
    cells = [(x, y, z) for (x, y), low, high in zip(found.xy.tolist(), found.low, found.high, strict=True)
             for z in range(low, high)]  # fmt: skip
    place = seen_from(np.array(cells, dtype=np.int64), view)
    corner = place.min(axis=0)
    alone = look(Cells(place - corner, np.zeros(len(place), dtype=np.int64)), 1)
    pieces = np.argwhere(alone.nearest != NOBODY)
    depth = alone.faces.place[alone.nearest[tuple(pieces.T)]].sum(axis=1)
    pieces[:, :2] += alone.low
    solid = [_seen(points, part, turn, view) - corner for points in _faces(part)]
    normal = np.array([_normal(points) for points in solid])
    near = np.flatnonzero((normal @ _TOWARDS > 1e-6) & (view.below | ~_steps(part)))
    near = near[np.argsort([solid[row].mean(axis=0) @ (1, 1, 1) for row in near.tolist()], kind="stable")]
    rims, creases = _edges([solid[row] for row in near.tolist()], normal[near])
    knob = found.xy[found.socket if view.below else found.stud].astype(np.float64)
    level = found.low[found.socket] if view.below else found.high[found.stud] - 1
    if part.jumper and not view.below:
        # a place between two squares is a whole number of the units of studs
        knob = (found.xy.max(axis=0) / 2)[None]
    knobs = (seen_from(np.column_stack([knob, level]), view) - corner).astype(np.float64)
    return _Shape(
        tuple(_flat(solid[row]) for row in near.tolist()), _light(normal[near]), rims, creases, pieces, depth, knobs
    )


def _faces(part: Part) -> Iterator[Floats]:
    """Yield the faces of a part at turn 0, counter-clockwise as seen from outside, in studs and plates."""
    if part.wedge:
        yield from _upright(outline(part), float(part.height))
        return
    top, bottom = (np.array(line) for line in lines(part))
    side = np.concatenate([bottom, top[::-1]])
    side = side[(side != np.roll(side, 1, axis=0)).any(axis=1)]
    wide = float(part.width)
    yield np.insert(side, 1, 0.0, axis=1)
    yield np.insert(side[::-1], 1, wide, axis=1)
    for near, far in pairwise([*side, side[0]]):
        yield np.array(
            [(near[0], 0.0, near[1]), (near[0], wide, near[1]), (far[0], wide, far[1]), (far[0], 0.0, far[1])]
        )


def _upright(corners: Floats, height: float) -> Iterator[Floats]:
    """Yield the faces of a part that is its outline drawn up."""
    low, high = (np.insert(corners, 2, z, axis=1) for z in (0.0, height))
    yield low[::-1]
    yield high
    for row in range(len(corners)):
        after = (row + 1) % len(corners)
        yield np.array([low[row], low[after], high[after], high[row]])


def _steps(part: Part) -> Mask:
    """Return which faces are steps of the underside, which the part itself hides from above."""
    inner = [not part.wedge and np.ptp(points[:, 0]) == 0 and 0 < points[0, 0] < part.length for points in _faces(part)]
    return np.array(inner)


def _seen(points: Floats, part: Part, turn: int, view: View) -> Floats:
    """Return points of a part as they are seen."""
    x, y = turned(part, turn, points[:, :2]).T
    z = points[:, 2]
    for _ in range(view.turns % 4):
        x, y = -y, x
    return np.stack([y, x, -z] if view.below else [x, y, z], axis=1)


def _normal(points: Floats) -> Floats:
    """Return the direction in which a face looks, of length 1 in studs and plates."""
    after = np.roll(points, -1, axis=0)
    across: Floats = np.cross(points, after).sum(axis=0)
    return across / np.linalg.norm(across)


def _light(normal: Floats) -> Floats:
    """Return the light on faces: that of the sides they look to, by how much they do."""
    # a plate is 0.4 studs high
    true = normal / (1.0, 1.0, 0.4)
    share = (true / np.linalg.norm(true, axis=1, keepdims=True)) ** 2
    away = np.where(normal > 0, share, 0.0)
    light: Floats = away[:, 2] * SIDE_LIGHT[0] + away[:, 0] * SIDE_LIGHT[1] + away[:, 1] * SIDE_LIGHT[2]
    return np.clip(light + (1 - away.sum(axis=1)) * SIDE_LIGHT[1], 0.0, 1.0)


def _flat(points: Floats) -> Floats:
    """Return where points lie in the lattice."""
    return np.stack([points[:, 2] - 3 * points[:, 1], points[:, 2] - 3 * points[:, 0]], axis=1)


def _edges(faces: list[Floats], normal: Floats) -> tuple[Floats, Floats]:
    """Return the edges of one face alone, and those between two that are no curve, (n, 2, 2) each."""
    of: dict[frozenset[tuple[float, ...]], list[int]] = {}
    for row, points in enumerate(faces):
        for start, end in pairwise([*np.round(points, 6).tolist(), np.round(points[0], 6).tolist()]):
            of.setdefault(frozenset([tuple(start), tuple(end)]), []).append(row)
    found: tuple[list[Floats], list[Floats]] = ([], [])
    for ends, rows in of.items():
        if len(ends) == 2 and (len(rows) == 1 or normal[rows[0]] @ normal[rows[1]] < _SMOOTH):
            found[len(rows) > 1].append(_flat(np.array(sorted(ends))))
    rims, creases = (np.array(each).reshape(-1, 2, 2) for each in found)
    return rims, creases
