"""Which side of a surface is outside: consistent winding, bodies turned outwards.

A *patch* is connected through edges of exactly two faces; within a patch the winding of one face decides that of all
others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from .topology import Edges, components, open_rim, rim_fans, rim_loops, spread

BULKY: Final = 0.02
"""Volume over area^1.5 from which an open patch has a clear inside; a dish 1/28 as deep as wide (ball: 0.094)."""

ROUNDING: Final = 1e-9
"""Volume over area, a thickness in diagonals of the mesh, that is zero but for rounding."""

SAMPLES: Final = 16
"""Points of a patch that must all lie inside others before it counts as a cavity or a lining."""

RAYS_AT_ONCE: Final = 1 << 22
"""Pairs of a point and a face that are tested at once, which bounds the memory."""


@dataclass(frozen=True, slots=True, eq=False)
class Winding:
    """The faces to turn so that neighbours agree.

    Attributes
    ----------
    flip : (n_f,) bool array
        Faces to turn.
    patch : (n_f,) int64 array
        Patch of every face, counting up in the order of their first faces.
    one_sided : (n_p,) bool array
        Patches that cannot be made consistent, such as a Moebius strip.
    """

    flip: Mask
    patch: Ints
    one_sided: Mask


def consistent_winding(edges: Edges, area: Floats) -> Winding:
    """Decide which faces to turn so that every patch is wound one way.

    The winding that most of a patch's area already has is kept. Faces that agree
    as they are get merged first; what is left is a small graph whose nodes are
    doubled, (group as it is) and (group turned).

    Parameters
    ----------
    edges : Edges
        Of the faces.
    area : (n_f,) float64 array
        Area of the faces.
    """
    begin = edges.start[:-1][edges.count == 2]
    left, right = edges.order[begin], edges.order[begin + 1]
    agree = edges.forward[left] != edges.forward[right]
    group = components(len(area), left[agree] // 3, right[agree] // 3)
    n = int(group.max()) + 1
    if agree.all():
        return Winding(np.zeros(len(area), bool), group, np.zeros(n, bool))
    left, right = group[left[~agree] // 3], group[right[~agree] // 3]
    node = components(2 * n, np.concatenate([left, left + n]), np.concatenate([right + n, right]))
    kept = np.bincount(node[:n], weights=np.bincount(group, weights=area), minlength=2 * n)
    as_is, turned = node[:n], node[n:]
    flip = (kept[as_is] < kept[turned]) | ((kept[as_is] == kept[turned]) & (as_is > turned))
    _, patch = np.unique(np.minimum(as_is, turned), return_inverse=True)
    one_sided = np.zeros(int(patch.max()) + 1, bool)
    one_sided[patch[as_is == turned]] = True
    return Winding(flip[group], patch.reshape(-1)[group], one_sided)


def inside_out(
    points: Floats, faces: NDArray[np.int32], edges: Edges, patch: Ints, mended: Mask, one_sided: Mask
) -> Mask:
    """Tell which patches have to be turned to face outwards.

    A patch with a clear inside (see ``BULKY``) is turned when its signed volume
    is negative; an open one is measured with its openings capped. A patch that
    runs against the rest of the model and lies inside an odd number of others
    stays as it is: a closed one in closed ones is a cavity, an open one in open
    ones a lining, such as the inner side of a van. This holds only for a patch
    whose winding did not need repair. Sheets without a clear inside follow the
    greater area of the rest.

    Parameters
    ----------
    points : (n_v, 3) float64 array
        Vertices, in diagonals of the mesh.
    faces : (n_f, 3) int32 array
        Vertex numbers, wound consistently within a patch.
    edges : Edges
        Of these faces.
    patch : (n_f,) int64 array
        Patch of every face.
    mended : (n_p,) bool array
        Patches in which some faces had to be turned.
    one_sided : (n_p,) bool array
        Patches without a consistent winding.

    Returns
    -------
    (n_p,) bool array
    """
    rim, owner = open_rim(faces, edges, patch)
    caps, _ = rim_fans(points, rim, rim_loops(rim, owner)[0])
    corners, is_open = points[faces], np.bincount(owner, minlength=len(mended)) > 0
    area, volume = _areas_and_volumes(corners, patch, caps, owner)
    clear = (np.abs(volume) > np.where(is_open, BULKY * area**1.5, ROUNDING * area)) & ~one_sided
    # a repaired patch says nothing about the model: its winding was arbitrary
    model = (np.where(mended, np.abs(volume), volume) * clear).sum()
    against = clear & ~mended & ((volume < 0) != (model < 0))
    inner = np.zeros(len(mended), bool)
    for kind in (~is_open, is_open):
        if (against & kind).any():
            face, cap = (kind & clear)[patch], (kind & clear)[owner]
            shells, label = np.concatenate([corners[face], caps[cap]]), np.append(patch[face], owner[cap])
            inner |= _inside_others(*_samples(corners, patch, against & kind), shells, label, len(inner))
    turned: Mask = clear & ((volume < 0) ^ inner)
    if area[turned].sum() > area[clear & ~turned].sum():
        turned |= ~clear & ~one_sided
    return turned


def _inside_others(points: Floats, own: Ints, shells: Floats, label: Ints, n: int) -> Mask:
    """Tell which of n patches have sample points, and all of them inside an odd number of other shells."""
    odd = surrounding(points, own, shells, label) % 2 == 1
    inside: Mask = (np.bincount(own[odd], minlength=n) > 0) & (np.bincount(own[~odd], minlength=n) == 0)
    return inside


def _areas_and_volumes(corners: Floats, patch: Ints, caps: Floats, owner: Ints) -> tuple[Floats, Floats]:
    """Return the area of every patch and its signed volume with the caps."""
    # from a corner of its own, so that a small body far from the centre is exact
    origin = corners[np.unique(patch, return_index=True)[1], 0]
    n = len(origin)
    volumes = np.zeros(n)
    for triangles, label in ((caps, owner), (corners, patch)):
        normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        parts = np.einsum("ij,ij->i", triangles[:, 0] - origin[label], normal) / 6
        volumes += np.bincount(label, weights=parts, minlength=n)
    sizes: Floats = np.linalg.norm(normal, axis=1) / 2
    return np.bincount(patch, weights=sizes, minlength=n).astype(np.float64), volumes


def _samples(corners: Floats, patch: Ints, wanted: Mask) -> tuple[Floats, Ints]:
    """Return points spread over the faces of every wanted patch, and their patch."""
    rows = np.flatnonzero(wanted[patch])
    rows = rows[np.argsort(patch[rows], kind="stable")]
    size = np.bincount(patch[rows])
    rank = np.arange(len(rows)) - (np.cumsum(size) - size)[patch[rows]]
    rows = rows[rank % -(-size // SAMPLES)[patch[rows]] == 0]
    # off the centre, where the edges of other bodies of a symmetric model would be met
    points: Floats = np.einsum("ijk,j->ik", corners[rows], [0.51, 0.3, 0.19])
    return points, patch[rows]


def surrounding(points: Floats, own: Ints, corners: Floats, patch: Ints) -> Ints:
    """Count, for every point, the closed patches other than its own that it lies in.

    A ray goes up from the point; a patch that it crosses more often from
    inside than from outside, or the reverse, surrounds the point.

    Parameters
    ----------
    points : (k, 3) float64 array
    own : (k,) int64 array
        Patch to leave out.
    corners : (n, 3, 3) float64 array
        Triangles of closed patches.
    patch : (n,) int64 array
        Their patch.

    Returns
    -------
    (k,) int64 array
    """
    by_x = np.argsort(points[:, 0], kind="stable")
    x = points[by_x, 0]
    first = np.searchsorted(x, corners[..., 0].min(axis=1), side="left")
    last = np.searchsorted(x, corners[..., 0].max(axis=1), side="right")
    total = np.cumsum(last - first)
    cuts = np.searchsorted(total, np.arange(RAYS_AT_ONCE, total[-1] if len(total) else 0, RAYS_AT_ONCE))
    found = []
    for rows in np.split(np.arange(len(corners)), cuts):
        face, place = spread(first[rows], last[rows])
        face, point = rows[face], by_x[place]
        keep = patch[face] != own[point]
        point, face = point[keep], face[keep]
        sign = _crossing(points[point], corners[face])
        hit = sign != 0
        found.append(np.column_stack([point[hit], patch[face[hit]], sign[hit]]))
    crossed = np.concatenate(found)
    pair, inverse = np.unique(crossed[:, :2], axis=0, return_inverse=True)
    around = np.bincount(inverse.reshape(-1), weights=crossed[:, 2], minlength=len(pair)) != 0
    return np.bincount(pair[around, 0], minlength=len(points))


def _crossing(points: Floats, corners: Floats) -> Ints:
    """Tell whether the ray up from a point leaves (1), enters (-1) or misses (0) its triangle."""
    near = (corners[..., 1].min(axis=1) <= points[:, 1]) & (corners[..., 1].max(axis=1) >= points[:, 1])
    near &= corners[..., 2].max(axis=1) >= points[:, 2]
    sign = np.zeros(len(points), np.int64)
    rows = np.flatnonzero(near)
    a = corners[rows]
    b = a[:, [1, 2, 0]]
    p = points[rows, None]
    # an edge is always tested from its lower end, so that both its triangles find the ray on the same side
    swap = (a[..., 0] > b[..., 0]) | ((a[..., 0] == b[..., 0]) & (a[..., 1] > b[..., 1]))
    low, high = np.where(swap[..., None], b, a), np.where(swap[..., None], a, b)
    run, way = high - low, p - low
    side = run[..., 0] * way[..., 1] - run[..., 1] * way[..., 0]
    left = (side >= 0) != swap
    weight = np.where(swap, -side, side)[:, [1, 2, 0]]
    size = weight.sum(axis=1)
    hit = (left.all(axis=1) | ~left.any(axis=1)) & (size != 0)
    height = np.einsum("ij,ij->i", weight[hit], a[hit, :, 2]) / size[hit]
    above = height > points[rows[hit], 2]
    sign[rows[hit]] = np.where(above, np.sign(size[hit]), 0)
    return sign
