"""Features: where a surface has edges of colour that face each other, or bends within a stud.

An eye, a letter or a logo has edges on all sides within a stud or two; of a large patch on a flank
only one is near. A horn, an ear, a beak or a rim turns within a stud, a flank does not. All of it is
seen on cells of half a stud, so that the grain of a texture is a mean, as it is for an eye some
way off.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final, Literal

import numpy as np
from scipy import ndimage

from ..arrays import Floats, Ints
from ..colours import ciede2000, lab_from_srgb, texels_at
from ..mesh import TriangleMesh, WeightField, surface_hits
from ..units import STUD

Kinds = Literal["none", "colours", "shapes", "all"]

_PITCH: Final = STUD / 2
"""Size of the lattice's cells: edges of colour are what differs between both sides of a cell, a stud apart."""

_FINE: Final = 2
"""Cells of the lattice in a stud."""

_SOFT: Final = 1.0
"""Width in cells of the Gaussian that colours are seen through: half a stud."""

_AROUND: Final = 1.0
_TURN: Final = 0.75
"""Widths in studs of those within which edges of colour belong together, and within which a surface bends."""

_CUT: Final = 3.0
"""Multiples of its width at which a Gaussian is cut off."""

_REACH: Final = 6
"""Studs beyond which nothing counts: 1.5 of the first Gaussian, half a stud of edges, 3 of the second Gaussian, one
of spreading."""

_PATTERNS: Final = (4.0, 10.0)
"""CIEDE2000 of a pattern where weight begins and is full. At 24 studs half of the cells have more than 9 at the eyes of
a cow, and than 6 at a letter and between its strokes; nine in ten have less than 1 on a horse and 4 on a dragon."""

_BENDS: Final = (0.15, 0.5)
"""Lost length of the mean normal around where weight begins and is full: .29 at a right angle, 1 on a thin wall."""

_MOST: Final = 0.25
"""Mean weight of all surface at most: what bends everywhere has no features, and flanks are not starved."""

_NOTHING: Final = 1e-9
"""Surface in mm² below which there is none: what a Gaussian leaves of some far away is rounding."""

_CELLS: Final = 500_000
"""Studs that are looked at together, some 500 MB."""


def with_features(mesh: TriangleMesh, kinds: Kinds, times: float) -> TriangleMesh:
    """Let features count more.

    Parameters
    ----------
    mesh : TriangleMesh
        In the size of the model, in mm.
    kinds : {"none", "colours", "shapes", "all"}
        What makes a feature.
    times : float
        How many times more than elsewhere likeness counts on a full feature.

    Returns
    -------
    TriangleMesh
        With a field of weights, unless there are no features.
    """
    if kinds == "none" or times == 0:
        return mesh
    low = mesh.vertices.min(axis=0) - STUD
    n_z, n_y, n_x = (int(each) for each in np.ceil(np.ptp(mesh.vertices, axis=0) / STUD)[::-1] + 2)
    values, totals = np.zeros((n_z, n_y, n_x), np.float32), np.zeros(2)
    hits = _Hits.of(mesh, low, (_FINE * n_z, _FINE * n_y, _FINE * n_x), colours=kinds != "shapes")
    deep = max(_CELLS // (n_y * n_x) - 2 * _REACH, 1)
    for begin in range(0, n_z, deep):
        end = min(begin + deep, n_z)
        first, last = max(begin - _REACH, 0), min(end + _REACH, n_z)
        area, weight = _weights(*hits.binned(_FINE * first, _FINE * last), kinds)
        inner = slice(begin - first, end - first)
        totals += (area * weight)[inner].sum(), area[inner].sum()
        values[begin:end] = _spread(area, weight)[inner]
    if totals[0] == 0:
        return mesh
    values *= np.float32(times * min(1.0, _MOST * totals[1] / totals[0]))
    return replace(mesh, features=WeightField(low + STUD / 2, STUD, values))


@dataclass(frozen=True, slots=True, eq=False)
class _Hits:
    """Where rays meet the surface, by ascending cell.

    Attributes
    ----------
    shape : tuple of int
        Cells along z, y and x.
    cell : (n,) int64 array
        Flat index of the cell of each hit.
    sums : (1, 4 or 7, n) float64 array
        Area of each, times its unit normal, and times its L*a*b* colour.
    """

    shape: tuple[int, int, int]
    cell: Ints
    sums: Floats

    @classmethod
    def of(cls, mesh: TriangleMesh, low: Floats, shape: tuple[int, int, int], *, colours: bool) -> _Hits:
        """Look for them."""
        length = np.maximum(np.linalg.norm(mesh.normals, axis=1), np.finfo(float).tiny)
        unit = mesh.normals / length[:, None]
        cells, sums = [], []
        for face, points, uvs, amount in surface_hits(mesh, low):
            cells.append(np.ravel_multi_index(tuple(np.floor((points - low) / _PITCH).astype(np.int64).T[::-1]), shape))
            columns = [np.ones(len(face))[:, None], unit[face]]
            if colours:
                columns.append(lab_from_srgb(texels_at(mesh, mesh.face_image[face], uvs)))
            sums.append(amount[:, None] * np.concatenate(columns, axis=1))
        cell = np.concatenate(cells)
        order = np.argsort(cell, kind="stable")
        return cls(shape, cell[order], np.concatenate(sums).T[:, order])

    def binned(self, first: int, last: int) -> tuple[Floats, Floats, Floats]:
        """Return area, (n_layers, n_y, n_x), and its normals and colours, (3, ...), by cell of some layers."""
        _, n_y, n_x = self.shape
        begin, end = np.searchsorted(self.cell, np.array([first, last]) * n_y * n_x)
        cell, size = self.cell[begin:end] - first * n_y * n_x, (last - first) * n_y * n_x
        total = np.stack([np.bincount(cell, each[begin:end], size) for each in self.sums])
        area, *rest = total.reshape(-1, last - first, n_y, n_x)
        return area, np.array(rest[:3]), np.array(rest[3:])


def _weights(area: Floats, normal: Floats, colour: Floats, kinds: Kinds) -> tuple[Floats, Floats]:
    """Return the area in each stud of some small cells, and how much of a feature it is, 0 to 1, (n_z, n_y, n_x)."""
    cells = np.flatnonzero(area)
    studs = tuple(each // _FINE for each in area.shape)
    stud = np.ravel_multi_index(tuple(each // _FINE for each in np.unravel_index(cells, area.shape)), studs)

    def summed(each: Floats) -> Floats:
        """Return the sums of something by stud."""
        return np.bincount(stud, each, int(np.prod(studs))).reshape(studs)

    own = area.reshape(-1)[cells]
    total = summed(own)
    weight = np.zeros(studs)
    if kinds != "shapes":
        edges = own * _edges(area, colour, cells)
        every = _blur(summed(np.sqrt((edges**2).sum(axis=0))), _AROUND)
        alone = np.sqrt(sum(_blur(summed(each), _AROUND) ** 2 for each in edges))
        weight = _ramp(_ratio(np.maximum(every - alone, 0), _blur(total, _AROUND)), *_PATTERNS)
    if kinds != "colours":
        mean = np.sqrt(sum(_blur(summed(each.reshape(-1)[cells]), _TURN) ** 2 for each in normal))
        weight = np.maximum(weight, _ramp(1 - _ratio(mean, _blur(total, _TURN)), *_BENDS))
    return total, np.where(total > 0, weight, 0)


def _edges(area: Floats, colour: Floats, cells: Ints) -> Floats:
    """Return the edges of colour at cells as vectors, (9, n): along z, y and x what changes in L*, a* and b*.

    Each is as long as the CIEDE2000 difference of both sides. The length of the mean of such vectors is what a single
    straight edge has; what the mean of their lengths has more comes from edges that face each other, as those on both
    sides of a stroke do.
    """
    near = _blur(area, _SOFT)
    lab = np.stack([_ratio(_blur(each, _SOFT), near).reshape(-1) for each in colour], axis=-1)
    there = (near > _NOTHING).reshape(-1)
    edges = np.zeros((3, len(cells), 3))
    place = np.unravel_index(cells, area.shape)
    for axis in range(3):
        step = int(np.prod(area.shape[axis + 1 :]))
        # at the ends of what is looked at together nothing is asked for
        row = np.flatnonzero((place[axis] > 0) & (place[axis] < area.shape[axis] - 1))
        row = row[there[cells[row] + step] & there[cells[row] - step]]
        one, other = lab[cells[row] + step], lab[cells[row] - step]
        length = np.maximum(np.linalg.norm(one - other, axis=1), np.finfo(float).tiny)
        edges[axis, row] = (one - other) * (ciede2000(one, other) / length)[:, None]
    found: Floats = edges.transpose(0, 2, 1).reshape(9, -1)
    return found


def _spread(area: Floats, weight: Floats) -> Floats:
    """Return weights also beside the surface: the mean of those in the cells around."""
    own = (area > 0).astype(np.float64)
    beside, many = weight, own
    for axis in range(3):
        beside, many = (ndimage.correlate1d(each, np.ones(3), axis, mode="constant") for each in (beside, many))
    return np.where(own > 0, weight, _ratio(beside, many))


def _ramp(amount: Floats, low: float, high: float) -> Floats:
    return np.clip((amount - low) / (high - low), 0, 1)


def _ratio(amount: Floats, total: Floats) -> Floats:
    there = total > _NOTHING
    return np.where(there, amount / np.where(there, total, 1), 0)


def _blur(amount: Floats, cells: float) -> Floats:
    """Blur by a Gaussian of some cells; beyond what is given there is nothing."""
    blurred: Floats = ndimage.gaussian_filter(amount, cells, mode="constant", truncate=_CUT)
    return blurred
