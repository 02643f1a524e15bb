"""Unit bricks: how fast, how near to the exact rule, and how near to dense sampling."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Final

import numpy as np
import trimesh
from numpy.typing import NDArray

from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from legorize_addon.core.settings import Settings
from legorize_addon.core.slicing.coverage import Pieces, covered_area, cut_at_grid
from legorize_addon.core.slicing.lattice import Grid, fit_grid
from legorize_addon.core.slicing.levels import Levels, levels_of
from legorize_addon.core.slicing.slices import adaptive_heights, slice_mesh
from legorize_addon.core.slicing.trajectories import Trajectories, link_loops, linked
from legorize_addon.core.unit_bricks.generation import Raster, Rules, half_covered, unit_bricks
from legorize_addon.core.unit_bricks.surface_samples import (
    SurfaceSamples,
    horizontal_samples,
    standing_pieces,
    trajectory_samples,
)
from legorize_addon.core.units import BRICK, CELL_AREA, PLATE
from scripts.benchmarks.clock import least_seconds, seconds
from scripts.benchmarks.dense import dense_likeliest, dense_longest, dense_samples
from scripts.benchmarks.meshes import Model, as_trimesh, prepared, subdivided, textured
from scripts.benchmarks.tables import Row, Table

Codes = NDArray[np.int16]
Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

RATIO: Final = 15.0
OCCUPANCY: Final = 0.001
CROSSED: Final = 0.98
VISIBLE: Final = 0.97
POINTS: Final = 0.2
"""Goals: times faster, share of cells off the exact rule, shares of equal colours, share of the voxels' samples."""

PLANES_A_LAYER: Final = 48
"""Planes that stand for the exact rule."""

SAMPLES_A_VOXEL: Final = 16
"""Points that a voxelization needs for the surface in a voxel."""


@dataclass(frozen=True, eq=False)
class Cut:
    """A mesh cut for the grid, as the pipeline cuts it."""

    model: Model
    frame: Grid
    heights: Floats
    layer: NDArray[np.int32]
    plate: NDArray[np.int8]
    trajectories: Trajectories

    @property
    def levels(self) -> Levels:
        """What the slices stand for."""
        return levels_of(self.heights, self.layer, self.plate, self.frame)

    @cached_property
    def pieces(self) -> Pieces:
        """The trajectories' edges, cut at the grid."""
        return cut_at_grid(self.trajectories.points, self.trajectories.ends, self.frame.origin[:2])

    @cached_property
    def passed(self) -> SurfaceSamples:
        """The pieces of the trajectories as samples."""
        standing = standing_pieces(self.trajectories, self.pieces, self.levels)
        return trajectory_samples(self.model.mesh, self.trajectories, self.pieces, standing, self.levels, self.frame)

    def bricks(self, *, longest: bool = False) -> Codes:
        """Return the colour of each unit brick, (n_layers, n_y, n_x)."""
        return self._bricks(keep_thin=True, longest=longest, closed=self.model.repairs.watertight)

    def half_covered(self) -> Mask:
        """Return the cells that the half-area rule alone fills, nothing kept or aired beside it."""
        return self._bricks(keep_thin=False, longest=True, closed=True) != COLOUR_EMPTY

    def _bricks(self, *, keep_thin: bool, longest: bool, closed: bool) -> Codes:
        grid = unit_bricks(
            self.model.mesh,
            self.trajectories,
            self.model.surface,
            Raster(self.frame, self.levels),
            Rules(keep_thin=keep_thin, longest=longest, closed=closed),
            catalogue=load_catalogue(),
        )
        # the model's own layers begin with its lowest cells
        below = self.frame.n_layers - len(grid.colour)
        return np.pad(grid.colour[:, 0], ((below, 0), (0, 0), (0, 0)), constant_values=COLOUR_EMPTY)


def measure(paths: Sequence[Path], *, width: int, triangles: Sequence[int], points: int, repeats: int) -> list[Table]:
    """Measure speed and correctness of unit bricks.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    triangles : sequence of int
        About how many triangles the meshes are subdivided to for the speed; 0 for as they are.
    points : int
        Points of the dense sampling.
    repeats : int

    Returns
    -------
    list of Table
    """
    settings = Settings(width=width)
    rows: tuple[list[Row], ...] = ([], [], [], [])
    for path in paths:
        model = prepared(path, settings)
        finer = (replace(model, mesh=subdivided(model.mesh, count)) for count in triangles)
        rows[0].extend(_speed(each, settings, repeats) for each in finer)
        cut = cut_for_grid(model, settings)
        rows[1].append(_occupancy(cut))
        rows[2].extend(_colours(cut, points))
        rows[3].extend(_points(model, settings, deviation) for deviation in (0.0, 0.4))
    titles = {
        "units_speed": f"Unit bricks with colours at {width} studs: at least {RATIO:g} times faster",
        "units_occupancy": f"Occupied cells against {PLANES_A_LAYER} planes a layer: at most {OCCUPANCY:.1%} differ",
        "units_colours": f"Colours as by {points:,} points: {CROSSED:.0%} on trajectories, {VISIBLE:.0%} of all",
        "units_points": f"Points on trajectories against {SAMPLES_A_VOXEL} in a surface voxel: at most {POINTS:.0%}",
    }
    return [Table(name, title, tuple(part)) for (name, title), part in zip(titles.items(), rows, strict=True)]


def cut_for_grid(model: Model, settings: Settings) -> Cut:
    """Lay the grid and cut the mesh for it."""
    frame = fit_grid(model.mesh, symmetric=settings.symmetric)
    heights, layer, plate = adaptive_heights(
        model.mesh,
        ground=float(frame.origin[2]),
        n_layers=frame.n_layers,
        cusp=settings.cusp,
        colour=model.surface.of_faces(model.mesh),
    )
    slices = slice_mesh(model.mesh, heights)
    trajectories = link_loops(model.mesh, slices, model.surface, chord_deviation=settings.chord_deviation)
    return Cut(model, frame, heights, layer, plate, trajectories)


def _speed(model: Model, settings: Settings, repeats: int) -> Row:
    """Time unit bricks from the repaired mesh; Algorithm 1 on the images, which the reference lacks, stands beside."""
    ours, theirs = least_seconds(
        lambda: cut_for_grid(model, settings).bricks(),
        partial(filled_voxels, as_trimesh(model.mesh), PLATE),
        repeats=repeats,
    )
    return {
        "model": model.name,
        "triangles": len(model.mesh.faces),
        "ours_s": ours,
        "trimesh_s": theirs,
        "ratio": theirs / ours,
        "met": theirs >= RATIO * ours,
        "image_colours_s": seconds(partial(textured, model.mesh, settings)),
    }


def filled_voxels(mesh: trimesh.Trimesh, pitch: float) -> trimesh.voxel.VoxelGrid:
    """Return the reference: surface voxels, filled."""
    return mesh.voxelized(pitch).fill()


def _occupancy(cut: Cut) -> Row:
    """Count cells that differ from the exact rule; what is kept or left out on purpose is counted by itself."""
    exact = exact_solid(cut)
    solid = cut.half_covered()
    built = cut.bricks() != COLOUR_EMPTY
    differing = int((solid != exact).sum())
    return {
        "model": cut.model.name,
        "planes": len(cut.heights),
        "grid_cells": exact.size,
        "exact_cells": int(exact.sum()),
        "differing": differing,
        "share_of_grid": differing / exact.size,
        "share_of_model": differing / int(exact.sum()),
        "met": differing <= OCCUPANCY * int(exact.sum()),
        "kept_though_thin": int((built & ~solid).sum()),
        "left_to_the_air": int((solid & ~built).sum()),
    }


def exact_solid(cut: Cut) -> Mask:
    """Return the cells that are half covered on average over many planes of their layer."""
    frame = cut.frame
    layers = []
    for number in range(frame.n_layers):
        share = (np.arange(PLANES_A_LAYER) + 0.5) / PLANES_A_LAYER
        slices = slice_mesh(cut.model.mesh, frame.origin[2] + (number + share) * BRICK)
        outline = linked(cut.model.mesh.faces, slices)
        area = covered_area(outline, PLANES_A_LAYER, frame.origin[:2], frame.n_y, frame.n_x)
        layers.append(half_covered(area.mean(axis=0) / CELL_AREA))
    return np.stack(layers)


def _colours(cut: Cut, points: int) -> list[Row]:
    """Compare the colours of all visible cells, rule by rule."""
    model = cut.model
    solid = cut.bricks() != COLOUR_EMPTY
    seen = visible(solid, outer_air(solid))
    samples = dense_samples(model.mesh, model.surface, cut.frame, points)
    dense = {
        "likeness": dense_likeliest(samples, solid, seen, model.surface),
        "longest": dense_longest(samples, cut.trajectories, cut.pieces, cut.passed, solid, seen),
    }
    return [_agreement(cut, rule, colours, seen) for rule, colours in dense.items()]


def _agreement(cut: Cut, rule: str, dense: Codes, seen: Mask) -> Row:
    equal = cut.bricks(longest=rule == "longest")[seen] == dense
    crossed = np.zeros(seen.shape, dtype=bool)
    crossed[tuple(cut.passed.cell.T)] = True
    on_trajectory = crossed[seen]
    return {
        "model": cut.model.name,
        "rule": rule,
        "visible_cells": len(equal),
        "crossed_cells": int(on_trajectory.sum()),
        "crossed_equal": float(equal[on_trajectory].mean()),
        "crossed_met": bool(equal[on_trajectory].mean() >= CROSSED),
        "visible_equal": float(equal.mean()),
        "visible_met": bool(equal.mean() >= VISIBLE),
    }


def _points(model: Model, settings: Settings, deviation: float) -> Row:
    """Count the points that stand for the surface; the rays for level surface are counted by themselves."""
    cut = cut_for_grid(model, replace(settings, chord_deviation=deviation))
    solid = cut.bricks() != COLOUR_EMPTY
    voxels = int(visible(solid, outer_air(solid)).sum())
    points, rays = len(cut.trajectories.points), len(horizontal_samples(model.mesh, model.surface, cut.frame).area)
    return {
        "model": model.name,
        "chord_deviation_mm": deviation,
        "trajectory_points": points,
        "surface_voxels": voxels,
        "voxel_samples": voxels * SAMPLES_A_VOXEL,
        "share": points / (voxels * SAMPLES_A_VOXEL),
        "met": points <= POINTS * voxels * SAMPLES_A_VOXEL,
        "ray_hits": rays,
        "share_with_rays": (points + rays) / (voxels * SAMPLES_A_VOXEL),
    }
