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

from legorize_addon.core.mesh import TriangleMesh
from legorize_addon.core.settings import Settings
from legorize_addon.core.slicing import Slices, slice_mesh
from legorize_addon.core.trajectories import Trajectories, link_loops, linked

from .clock import least_seconds
from .meshes import Model, as_trimesh, prepared, subdivided
from .tables import Row, Table

Floats = NDArray[np.float64]

RATIO: Final = 15.0
"""How many times faster than the reference slicing has to be."""

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
    slices, trajectories, areas = _cut(model, heights)
    gap = widest_gap(model.mesh, slices)
    error = area_error(trajectories, areas)
    return {
        "model": model.name,
        "planes": where,
        "triangles": len(model.mesh.faces),
        "closed_mesh": model.repairs.watertight,
        "n_planes": len(heights),
        "loops": len(areas),
        "gaps_closed": trajectories.gaps,
        "widest_gap_mm": gap,
        "area_error": error,
        "met": (trajectories.gaps == 0 or not model.repairs.watertight) and gap == 0 and error <= AREA_ERROR,
    }


def widest_gap(mesh: TriangleMesh, slices: Slices) -> float:
    """Return the greatest distance between the end of a segment and the start of the one after it.

    Parameters
    ----------
    mesh : TriangleMesh
    slices : Slices

    Returns
    -------
    float
        In mm, 0 if all loops close to the last bit. Segments that bridge an
        opening of the mesh, and where they begin, are not looked at.
    """
    outline = linked(mesh.faces, slices)
    real = outline.face >= 0
    segment = slices.first[outline.face[real]] + outline.slice[real]
    ends = np.abs(slices.segments[segment, 1] - outline.ends[real])
    starts = np.abs(slices.segments[segment, 0] - outline.start[real])
    return float(max(ends.max(initial=0.0), starts.max(initial=0.0)))


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
