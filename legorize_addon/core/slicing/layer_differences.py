"""Which layers need plates: those whose trajectories differ from their neighbours'.

References
----------
Paper, section on local high resolution: the number of polygons of neighbouring
layers, and the lengths and areas of corresponding polygons.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..arrays import Floats, Ints, Mask
from ..mesh import TriangleMesh
from .lattice import Grid
from .loops import loop_areas
from .slices import slice_mesh
from .trajectories import linked


@dataclass(frozen=True, slots=True, eq=False)
class Marks:
    """Layers that differ from one of their neighbours, by criterion.

    Attributes
    ----------
    number, length, area : (n_layers,) bool arrays
        The number of polygons differs, or a polygon has no partner; a polygon
        and its partner differ in length; or in area.
    """

    number: Mask
    length: Mask
    area: Mask

    @property
    def any(self) -> Mask:
        """Layers that differ in any way, shape (n_layers,)."""
        return self.number | self.length | self.area


def differing_layers(mesh: TriangleMesh, grid: Grid, *, tolerance: float) -> Marks:
    """Compare the outlines of neighbouring layers, cut in their middles.

    Parameters
    ----------
    mesh : TriangleMesh
    grid : Grid
        Of bricks.
    tolerance : float
        Share of the greater one by which lengths and areas may differ.

    Returns
    -------
    Marks
        Both layers of a differing pair are marked; nothing lies below the lowest
        layer and above the highest, with which they are not compared.
    """
    middles = grid.origin[2] + (np.arange(grid.n_layers) + 0.5) * grid.height
    outline = linked(mesh.faces, slice_mesh(mesh, middles))
    first = outline.loop_start[:-1]
    layer = outline.slice[first].astype(np.int64)
    area = loop_areas(outline.start, outline.loop_start)
    length = np.add.reduceat(np.linalg.norm(outline.ends - outline.start, axis=1), first) if len(first) else area
    lower, upper = _partners(_boxes(outline.start, first), layer, area)
    number = np.bincount(layer, minlength=grid.n_layers)
    paired = np.bincount(layer[lower], minlength=grid.n_layers)[:-1]
    return Marks(
        number=_both((number[:-1] != paired) | (number[1:] != paired)),
        length=_both(_some(_apart(length[lower], length[upper]) > tolerance, layer[lower], grid.n_layers - 1)),
        area=_both(_some(_apart(area[lower], area[upper]) > tolerance, layer[lower], grid.n_layers - 1)),
    )


def _boxes(points: Floats, first: Ints) -> Floats:
    """Return the bounding boxes of loops, (n_loops, 4)."""
    if len(first) == 0:
        return np.zeros((0, 4))
    return np.concatenate([np.minimum.reduceat(points, first), np.maximum.reduceat(points, first)], axis=1)


def _partners(boxes: Floats, layer: Ints, area: Floats) -> tuple[Ints, Ints]:
    """Return the loops of neighbouring layers that are nearest to each other by their boxes and run the same way."""
    if len(boxes) == 0:
        return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
    # layers, and loops of either way, lie farther apart than any two boxes
    apart = 4 * float(np.ptp(boxes, axis=0).max() + 1)
    key = np.column_stack([boxes, layer * apart, (area > 0) * 4 * apart])
    tree = cKDTree(key)
    above, below = (_nearest(tree, key, step * apart, apart) for step in (1, -1))
    lower = np.flatnonzero(above < len(key))
    upper = above[lower]
    corresponding = (below[upper] == lower) & _overlap(boxes[lower], boxes[upper])
    return lower[corresponding], upper[corresponding]


def _overlap(first: Floats, second: Floats) -> Mask:
    """Return which pairs of boxes share some area."""
    low, high = np.maximum(first[:, :2], second[:, :2]), np.minimum(first[:, 2:], second[:, 2:])
    overlap: Mask = (low < high).all(axis=1)
    return overlap


def _nearest(tree: cKDTree, key: Floats, step: float, apart: float) -> Ints:
    """Return the nearest loop one layer on, or the number of loops where there is none."""
    moved = key.copy()
    moved[:, 4] += step
    nearest: Ints = tree.query(moved, distance_upper_bound=apart / 2)[1]
    return nearest


def _apart(first: Floats, second: Floats) -> Floats:
    """Return the differences of numbers as shares of the greater ones."""
    greater = np.maximum(np.abs(first), np.abs(second))
    share: Floats = np.abs(first - second) / np.maximum(greater, np.finfo(float).tiny)
    return share


def _some(flag: Mask, pair: Ints, n_pairs: int) -> Mask:
    """Return which pairs of layers have a raised flag."""
    some: Mask = np.bincount(pair[flag], minlength=max(n_pairs, 0)) > 0
    return some


def _both(pair: Mask) -> Mask:
    """Return the layers that take part in a pair, given pairs of neighbours."""
    layers: Mask = np.append(pair, False) | np.append(False, pair)
    return layers
