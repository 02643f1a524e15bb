"""Which unit bricks close the gap between a trajectory and that of the next level.

Where the outline of the model moves by more than a stud from one level to the
next, bricks on trajectories leave the surface in between open. It is filled by
offsetting a trajectory, stud by stud, up to the other one.

References
----------
Paper, section "Overhang regions judgment and offsetting bricks generation": bricks
p and p' of two adjacent heights that are n bricks apart need offset bricks in
between if ``n W > h tan(beta)``, which goes on until n is 1.
J. Vanek, J. A. G. Galicia, B. Benes, "Clever Support: Efficient Support Structure
Generation for Digital Fabrication", Computer Graphics Forum 33 (2014): point,
edge and face overhangs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import cKDTree

from ..arrays import Ints, Mask
from ..model import ground_of
from ..units import STUD

Numbers = NDArray[np.uint16]

_IN_LEVEL: Final = np.array([[[0, 0, 0]] * 3, [[0, 1, 0], [1, 1, 1], [0, 1, 0]], [[0, 0, 0]] * 3])
"""Neighbours in a level, edge to edge."""


@dataclass(frozen=True, slots=True, eq=False)
class Offsets:
    """The bricks on offset trajectories.

    The visible horizontal faces of a level are those of its outermost bricks
    (with one of four neighbours outside), of `ring` and of `left_alone`.

    Attributes
    ----------
    ring : (n_levels, n_y, n_x) uint16 array
        By how many studs the trajectory is offset that the brick lies on, 0 for
        none. A brick that shows both ways has the number from above.
    left_alone : (n_levels, n_y, n_x) bool array
        Visible bricks so near to both trajectories that they need no offset.
    trajectories : (n_levels,) int64 array
        How often the trajectories of each level are offset, upwards and downwards.
    """

    ring: Numbers
    left_alone: Mask
    trajectories: Ints

    @property
    def cells(self) -> Ints:
        """Offset bricks of each level, shape (n_levels,)."""
        cells: Ints = np.count_nonzero(self.ring, axis=(1, 2))
        return cells


class OverhangKind(IntEnum):
    """The kinds of overhangs."""

    POINT = 0
    EDGE = 1
    FACE = 2


@dataclass(frozen=True, slots=True, eq=False)
class Overhangs:
    """The overhangs of a model.

    Attributes
    ----------
    label : (n_levels, n_y, n_x) int32 array
        Number of the overhang that a brick belongs to, from 1; 0 for none.
    kind : (n_overhangs,) uint8 array
        ``OverhangKind`` of each overhang.
    """

    label: NDArray[np.int32]
    kind: NDArray[np.uint8]

    def count(self, kind: OverhangKind) -> int:
        """Return how many overhangs are of a kind."""
        return int(np.count_nonzero(self.kind == kind))


def offset_rings(solid: Mask, *, height: float, critical_angle: float) -> Offsets:
    """Find the bricks that fill the surface between trajectories of adjacent levels.

    What shows upwards is offset from the level's own trajectory to that of the
    level above, what shows downwards to that of the level below; the two do not
    mix. A brick is offset if the span left from the one before it to the other
    trajectory asks for it; a span of one brick never does. Flat surface, which
    lacks one of the trajectories, is filled whatever the angle: a roof from its
    outline inwards, the floor of a pit from the foot of its walls.

    Studs are counted across corners as well, so that a slanting outline is
    no nearer to its offset than a straight one.

    Parameters
    ----------
    solid : (n_levels, n_y, n_x) bool array
        Bricks of the model from the ground up, enclosed cavities filled: nobody
        sees the walls of these. What faces the ground does not show.
    height : float
        Height of a level in mm.
    critical_angle : float
        Angle beta in degrees, at least 0 and below 90, by which a surface may lean
        away from the vertical without offset.

    Returns
    -------
    Offsets
    """
    around = np.pad(solid, ((0, 0), (1, 1), (1, 1)))
    ground, above, below = ground_of(around), np.zeros_like(around), around.copy()
    above[:-1] = around[1:]
    below[ground + 1 :] = around[ground:-1]
    # a span of one brick stays open even where plates are too low for it
    allowance = max(math.floor(height * math.tan(math.radians(critical_angle)) / STUD + 1e-9), 1)
    shell = around & ~_enclosed(around)
    up, spare_up = _one_way(around, shell, above, allowance)
    down, spare_down = _one_way(around, shell, below, allowance)
    ring = np.where(up > 0, up, down)
    left_alone = (spare_up | spare_down) & (ring == 0)
    times = _rings_a_level(up) + _rings_a_level(down)
    return Offsets(ring[:, 1:-1, 1:-1], left_alone[:, 1:-1, 1:-1], times)


def _enclosed(mask: Mask) -> Mask:
    """Return the bricks whose four neighbours in the level are all True; none counts beyond the rim."""
    enclosed = mask.copy()
    for axis in (1, 2):
        source, target = np.moveaxis(mask, axis, 0), np.moveaxis(enclosed, axis, 0)
        target[1:] &= source[:-1]
        target[:-1] &= source[1:]
    return enclosed


def _one_way(around: Mask, shell: Mask, cover: Mask, allowance: int) -> tuple[Numbers, Mask]:
    """Find the offset bricks among those that show upwards, or among those that show downwards.

    Parameters
    ----------
    around, shell : (n_levels, n_y, n_x) bool arrays
        Bricks of the model, and the outermost ones.
    cover : (n_levels, n_y, n_x) bool array
        Where the next level covers this one.
    allowance : int
        Longest span in bricks that may stay open.

    Returns
    -------
    ring : (n_levels, n_y, n_x) uint16 array
        Number of the offset trajectory, 0 for none.
    left_alone : (n_levels, n_y, n_x) bool array
        Bricks that show, and need no offset.
    """
    shown, covered = around & ~cover, around & cover
    between = shown & ~shell
    ring = _steps_from(shown & shell, between)
    closed = between & (ring == 0)
    ring += _steps_from(covered, closed)
    left = _steps_from(covered, shown, most=allowance)
    # at the corner of an outline that runs at an angle, the trajectory itself passes the brick
    span = left + 1 - _steps_from(~around, between, most=1)
    spare = between & ~closed & (left > 0) & (span <= allowance)
    ring[spare] = 0
    return ring, spare


def _steps_from(start: Mask, region: Mask, most: int | None = None) -> Numbers:
    """Count the steps, to any of eight neighbours, by which the bricks of a region are reached.

    Parameters
    ----------
    start, region : (n_levels, n_y, n_x) bool arrays
        They have nothing in common; the margin is not in the region.
    most : int, optional
        Steps to go at most.

    Returns
    -------
    (n_levels, n_y, n_x) uint16 array
        0 where the start is not connected to within its level.
    """
    width = region.shape[2]
    ways = [y * width + x for y in (-1, 0, 1) for x in (-1, 0, 1) if x or y]
    free, starts = region.ravel().copy(), start.ravel()
    reached = np.zeros(free.size, dtype=np.uint16)
    front = np.flatnonzero(free)
    front = front[np.any([starts[front + way] for way in ways], axis=0)]
    number = 0
    while len(front) and number != most:
        number += 1
        free[front] = False
        reached[front] = number
        front = _next_front(front, free, ways)
    return reached.reshape(region.shape)


def _next_front(front: Ints, free: Mask, ways: list[int]) -> Ints:
    """Return the free neighbours, each once; they are free no longer."""
    found = []
    for way in ways:
        near = front + way
        near = near[free[near]]
        free[near] = False
        found.append(near)
    return np.concatenate(found)


def _rings_a_level(ring: Numbers) -> Ints:
    """Return how many numbers other than 0 each level has, shape (n_levels,)."""
    level, row, column = np.nonzero(ring)
    numbers = int(ring.max(initial=0)) + 1
    pairs = np.unique(level * numbers + ring[level, row, column])
    return np.bincount(pairs // numbers, minlength=len(ring))


def recolour_rings(colour: NDArray[np.int16], left_alone: Mask, source: Mask) -> NDArray[np.int16]:
    """Give visible bricks without a trajectory the colour of the nearest one with.

    Parameters
    ----------
    colour : (n_levels, n_y, n_x) int16 array
    left_alone : (n_levels, n_y, n_x) bool array
        Bricks to recolour.
    source : (n_levels, n_y, n_x) bool array
        Bricks on trajectories or their offsets, with a colour of their own.

    Returns
    -------
    (n_levels, n_y, n_x) int16 array
        A copy. The nearest brick is one of the same level if that has any, and
        of several the first in the grid. Nothing changes without any source.
    """
    result = colour.copy()
    if not left_alone.any() or not source.any():
        return result
    # farther apart than the corners of a level
    between_levels = sum(colour.shape[1:])
    place, wanted = (np.argwhere(each) * (between_levels, 1, 1) for each in (source, left_alone))
    # squares of distances are whole numbers: less than one more for a later brick settles what is equally near
    later = np.sqrt(np.arange(len(place)) / len(place))
    _, nearest = cKDTree(np.column_stack([place, later])).query(np.pad(wanted, [(0, 0), (0, 1)]))
    result[left_alone] = colour[source][nearest]
    return result


def overhang_kinds(solid: Mask) -> Overhangs:
    """Sort bricks with nothing below into point, edge and face overhangs.

    Bricks of a level with nothing below, connected edge to edge, are one
    overhang: a point if nothing beside them rests on the level below, so that they
    begin in mid-air, whatever their number; an edge if they are nowhere two
    bricks wide; a face otherwise. Where all of them lie right beside a brick
    that rests, across a corner as well, the span is one: the model only widens,
    which is no overhang.

    Parameters
    ----------
    solid : (n_levels, n_y, n_x) bool array
        Bricks of the model from the ground up.

    Returns
    -------
    Overhangs
    """
    around = np.pad(solid, ((0, 0), (1, 1), (1, 1)))
    resting = around.copy()
    resting[1:] &= around[:-1]
    hanging = around & ~resting
    label, n_found = ndimage.label(hanging, _IN_LEVEL)
    beside = hanging & ~_enclosed(~resting)
    far = hanging & (_steps_from(resting, hanging, most=1) == 0)
    corner = hanging[:, 1:, 1:] & hanging[:, :-1, 1:] & hanging[:, 1:, :-1] & hanging[:, :-1, :-1]
    island = ~_has(label[beside], n_found)
    kind = np.where(_has(label[:, 1:, 1:][corner], n_found), OverhangKind.FACE, OverhangKind.EDGE)
    kind[island] = OverhangKind.POINT
    kept = island | _has(label[far], n_found)
    number = np.zeros(n_found + 1, dtype=np.int32)
    number[1:][kept] = np.arange(1, int(kept.sum()) + 1)
    return Overhangs(number[label][:, 1:-1, 1:-1], kind[kept].astype(np.uint8))


def _has(label: NDArray[np.int32], n_labels: int) -> Mask:
    """Return which of the labels from 1 on occur, shape (n_labels,)."""
    occurs: Mask = np.bincount(label, minlength=n_labels + 1)[1:] > 0
    return occurs
