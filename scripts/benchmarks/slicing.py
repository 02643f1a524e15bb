"""Slices with loops, colours and areas: how fast, and whether every loop is closed and right."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np
import shapely
from numpy.typing import NDArray

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.settings import Settings
from legorize_addon.core.slicing.slices import Slices, slice_mesh
from legorize_addon.core.slicing.trajectories import Trajectories, link_loops
from scripts.benchmarks.clock import least_seconds
from scripts.benchmarks.meshes import Model, as_trimesh, prepared, subdivided
from scripts.benchmarks.tables import Row, Table

Floats = NDArray[np.float64]

RATIO: Final = 15.0
"""How many times faster than the reference slicing has to be."""

STRAY: Final = 1e-9
"""Distance in mm from the surface that is rounding."""

AREA_ERROR: Final = 1e-9
"""Largest relative difference of a loop's area from the reference's."""


def measure(
    paths: Sequence[Path], *, width: int, triangles: Sequence[int], planes: Sequence[int], repeats: int
) -> list[Table]:
    """Measure speed and correctness of slicing.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    triangles : sequence of int
        About how many triangles the meshes are subdivided to; 0 for as they are.
    planes : sequence of int
        Numbers of planes, evenly over the height.
    repeats : int

    Returns
    -------
    list of Table
    """
    speeds: list[Row] = []
    checks: list[Row] = []
    for path in paths:
        model = prepared(path, Settings(width=width))
        for count in triangles:
            finer = replace(model, mesh=subdivided(model.mesh, count))
            speeds += [_speed(finer, even_heights(finer.mesh, n), repeats) for n in planes]
            checks.append(_checked(finer, "even", even_heights(finer.mesh, max(planes))))
            checks.append(_checked(finer, "through vertices", vertex_heights(finer.mesh, max(planes))))
    return [
        Table("slicing_speed", f"Slices, loops, colours and areas: at least {RATIO:g} times faster", tuple(speeds)),
        Table("slicing_checks", f"Loops: closed, areas within {AREA_ERROR:g} of shapely's", tuple(checks)),
    ]


def even_heights(mesh: TriangleMesh, n: int) -> Floats:
    """Return the middles of n slabs of equal height in mm."""
    low, high = mesh.vertices[:, 2].min(), mesh.vertices[:, 2].max()
    heights: Floats = low + (np.arange(n) + 0.5) / n * (high - low)
    return heights


def vertex_heights(mesh: TriangleMesh, n: int) -> Floats:
    """Return at most n heights of vertices, evenly among all there are but the highest and the lowest."""
    heights = np.unique(mesh.vertices[:, 2])[1:-1]
    chosen: Floats = heights[np.unique(np.linspace(0, len(heights), n, endpoint=False).astype(int))[: len(heights)]]
    return chosen


def _speed(model: Model, heights: Floats, repeats: int) -> Row:
    """Time one cut; the reference gets neither colours nor areas to do."""
    reference = as_trimesh(model.mesh)
    slices, trajectories, _ = _cut(model, heights)
    ours, theirs = least_seconds(
        partial(_cut, model, heights),
        partial(reference.section_multiplane, np.zeros(3), [0.0, 0.0, 1.0], heights),
        repeats=repeats,
    )
    return {
        "model": model.name,
        "triangles": len(model.mesh.faces),
        "planes": len(heights),
        "segments": len(slices),
        "loops": len(trajectories.loop_slice),
        "ours_ms": 1000 * ours,
        "trimesh_ms": 1000 * theirs,
        "ratio": theirs / ours,
        "met": theirs >= RATIO * ours,
    }


def _cut(model: Model, heights: Floats) -> tuple[Slices, Trajectories, Floats]:
    slices = slice_mesh(model.mesh, heights)
    trajectories = link_loops(model.mesh, slices, model.surface)
    return slices, trajectories, trajectories.areas()


def _checked(model: Model, where: str, heights: Floats) -> Row:
    _, trajectories, areas = _cut(model, heights)
    missing = left_out(model.mesh, heights, trajectories)
    stray = farthest_stray(model.mesh, heights, trajectories)
    error = area_error(trajectories, areas)
    closed = trajectories.gaps == 0 or not model.repairs.watertight
    return {
        "model": model.name,
        "planes": where,
        "triangles": len(model.mesh.faces),
        "closed_mesh": model.repairs.watertight,
        "n_planes": len(heights),
        "loops": len(areas),
        "gaps_closed": trajectories.gaps,
        "left_out": missing,
        "stray_mm": stray,
        "area_error": error,
        "met": closed and missing == 0 and stray <= STRAY and error <= AREA_ERROR,
    }


def left_out(mesh: TriangleMesh, heights: Floats, trajectories: Trajectories) -> int:
    """Return how many pairs of a triangle and a plane that meet are in no loop.

    Parameters
    ----------
    mesh : TriangleMesh
    heights : (n,) float64 array
        Rising. A vertex on a plane counts as above it.
    trajectories : Trajectories

    Returns
    -------
    int
    """
    z = mesh.vertices[mesh.faces, 2]
    above, below = (np.searchsorted(heights, end, side="right") for end in (z.max(axis=1), z.min(axis=1)))
    real = trajectories.face >= 0
    level = trajectories.loop_slice[trajectories.edge_loop]
    found = np.unique(trajectories.face[real].astype(np.int64) * len(heights) + level[real])
    return int((above - below).sum()) - len(found)


def farthest_stray(mesh: TriangleMesh, heights: Floats, trajectories: Trajectories) -> float:
    """Return how far the ends of any edge lie from the line in which its triangle meets the plane.

    Each edge begins where the one before it ends: if both lie on the lines of
    their own triangles, the loop follows the surface and closes.

    Parameters
    ----------
    mesh : TriangleMesh
    heights : (n,) float64 array
    trajectories : Trajectories

    Returns
    -------
    float
        In mm. Edges that bridge an opening of the mesh are not looked at.
    """
    real = trajectories.face >= 0
    height = heights[trajectories.loop_slice[trajectories.edge_loop]][real]
    start, end = _triangle_cuts(mesh.vertices[mesh.faces[trajectories.face[real]]], height)
    along = end - start
    length = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)
    farthest = 0.0
    for points in (trajectories.points[real], trajectories.ends[real]):
        share = np.clip(((points - start) * along).sum(axis=1) / length, 0, 1)
        distance = np.linalg.norm(points - start - share[:, None] * along, axis=1)
        farthest = max(farthest, float(distance.max(initial=0.0)))
    return farthest


def _triangle_cuts(corners: Floats, height: Floats) -> tuple[Floats, Floats]:
    """Return the two ends of the line in which each triangle, (k, 3, 3), meets the plane at its height."""
    order = np.argsort(corners[:, :, 2], axis=1)
    low, middle, high = np.take_along_axis(corners, order[:, :, None], axis=1).transpose(1, 0, 2)
    lower = height <= middle[:, 2]
    first = np.where(lower[:, None], low, middle)
    second = np.where(lower[:, None], middle, high)
    return _crossing(low, high, height), _crossing(first, second, height)


def _crossing(low: Floats, high: Floats, height: Floats) -> Floats:
    share = (height - low[:, 2]) / (high[:, 2] - low[:, 2])
    crossing: Floats = low[:, :2] + share[:, None] * (high - low)[:, :2]
    return crossing


def area_error(trajectories: Trajectories, areas: Floats) -> float:
    """Return the greatest difference of the loops' areas from shapely's, relative to each area.

    Parameters
    ----------
    trajectories : Trajectories
    areas : (n_loops,) float64 array
        Signed, in mm^2.

    Returns
    -------
    float
        Loops below 1e-6 mm^2 count as if they had this area: it is below what coordinates can tell.
    """
    size = np.diff(trajectories.loop_start)
    polygon = size >= 3
    if areas[~polygon].any():
        return float("inf")
    kept = polygon[trajectories.edge_loop]
    loop = np.repeat(np.arange(int(polygon.sum())), size[polygon])
    rings = shapely.linearrings(trajectories.points[kept], indices=loop)
    reference = shapely.area(shapely.polygons(rings))
    return float((np.abs(np.abs(areas[polygon]) - reference) / np.maximum(reference, 1e-6)).max(initial=0.0))
