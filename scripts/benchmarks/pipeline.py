"""Every stage on every model: CPU seconds, and what comes out."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from scipy import ndimage

from legorize_addon.core.build import Build
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.model.unit_grid import Fill
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from legorize_addon.core.units import BRICK, STUD
from scripts.benchmarks.clock import seconds
from scripts.benchmarks.meshes import as_trimesh, read_mesh
from scripts.benchmarks.tables import Row, Table
from scripts.benchmarks.units import filled_voxels

LIMITS: Final = {48: 2.0, 96: 10.0}
"""CPU seconds allowed by width in studs."""

TRIANGLES: Final = 20_000
"""Larger meshes may take longer."""


def measure(paths: Sequence[Path], *, widths: Sequence[int], repeats: int) -> list[Table]:
    """Run the whole pipeline.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    repeats : int
        Runs, of which the fastest counts.

    Returns
    -------
    list of Table
    """
    times: list[Row] = []
    results: list[Row] = []
    for path in paths:
        mesh = read_mesh(path)
        for width in widths:
            print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
            builds = (legorize(mesh, Settings(width=width)) for _ in range(repeats))
            build = min(builds, key=lambda each: sum(each.timings.values()))
            yardstick = _voxels(build.mesh)
            start: Row = {"model": path.stem, "studs": width}
            times.append(start | _times(build, len(mesh.faces), width, yardstick))
            results.append(start | _results(build, load_catalogue()))
    allowed = ", ".join(f"{limit:g} s at {width} studs" for width, limit in LIMITS.items())
    return [
        Table("pipeline_times", f"CPU seconds by stage: {allowed}, below {TRIANGLES:,} triangles", tuple(times)),
        Table("pipeline_results", "What comes out", tuple(results)),
    ]


def _voxels(mesh: TriangleMesh) -> tuple[float, int]:
    """Return the seconds and the cells of the reference on the same grid: cells of 8 x 8 x 9.6 mm, filled."""
    squeezed = as_trimesh(mesh)
    squeezed.apply_scale([1.0, 1.0, STUD / BRICK])
    found: list[int] = []
    taken = seconds(lambda: found.append(int(filled_voxels(squeezed, STUD).filled_count)))
    return taken, found[0]


def _times(build: Build, triangles: int, width: int, yardstick: tuple[float, int]) -> Row:
    total = sum(build.timings.values())
    limit = LIMITS.get(width) if triangles < TRIANGLES else None
    row: Row = {"triangles": triangles, **build.timings, "total_s": total, "limit_s": limit}
    row["met"] = None if limit is None else total < limit
    return row | {"trimesh_voxels_s": yardstick[0], "trimesh_cells": yardstick[1]}


def _results(build: Build, catalogue: Catalogue) -> Row:
    facts = report(build, catalogue, version="", mm_per_unit=1.0)
    single = np.array([part.length == part.width == 1 for part in catalogue.parts])
    cover, solid = build.hollow.cover, build.grid.solid
    return {
        "unit_bricks": facts["counts"]["unit_bricks_before"],
        # no layout can join what the cells leave apart
        "cell_components": int(ndimage.label(solid.reshape(-1, *solid.shape[2:]))[1]),
        "must_plates": int((cover == Fill.REQUIRED).sum()),
        "may_plates": int((cover == Fill.OPTIONAL).sum()),
        "bricks": len(build.bricks),
        "share_1x1": float(single[build.bricks.part].mean()),
        **facts["connection"],
        "not_made": facts["unavailable_part_colours"]["bricks"],
        "hollow_ratio": facts["hollow_ratio"],
        "mass_g": facts["mass_g"],
    }
