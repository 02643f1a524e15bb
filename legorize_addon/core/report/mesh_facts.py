"""What became of a mesh on its way to bricks, in plain numbers, for ``report.json``."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import numpy as np

from ..arrays import Floats, Mask
from ..build import Build, Cut
from ..files import ldraw_matrix
from ..measures import colour_errors, corner_windings, pass_through_types
from ..model import NOBODY, SUPPORTS, Fill, UnitGrid, brick_columns
from ..shell import free_bodies, tally_cases
from ..slicing import cut_at_grid
from ..unit_bricks import Offsets, OverhangKind, overhang_kinds
from ..units import PLATES_PER_BRICK


def facts_of_mesh(build: Build, mm_per_unit: float) -> dict[str, Any]:
    """Return what only a model of a mesh has: figures of the mesh, its slices, cells and hollowing."""
    levels = _levels(build)
    return {
        "input": _input(build),
        "mesh_to_ldraw": _mesh_to_ldraw(build, mm_per_unit).tolist(),
        "scale": build.scale,
        "grid": _grid(build.grid),
        "pass_through": _pass_through(build),
        "detail": _detail(build.cut, build.grid),
        "offsets": _offsets(build.offsets),
        "overhangs": _overhangs(levels),
        "hollowing": _hollowing(build, levels),
        "hollow_ratio": round(hollow_ratio(build), 4),
        "bodies": free_bodies(build.hollow),
        "colour_error": _colour_error(build),
        "beyond_paper": dict(build.beyond),
    }


def hollow_ratio(build: Build) -> float:
    """Return the share of a model's cells that no brick fills, supports excluded."""
    return 1 - _filled(build) / int(build.grid.solid.sum())


def _input(build: Build) -> dict[str, Any]:
    repairs = asdict(build.repairs)
    return {
        "triangles": len(build.mesh.faces),
        "images": len(build.mesh.images),
        "watertight": repairs.pop("watertight"),
        "repairs": repairs,
    }


def _mesh_to_ldraw(build: Build, mm_per_unit: float) -> Floats:
    turn = build.turn.copy()
    turn[:3, 3] /= mm_per_unit
    return ldraw_matrix(build.grid.origin, build.scale, mm_per_unit) @ turn


def _grid(grid: UnitGrid) -> dict[str, int]:
    """Return the extent of the model in studs and layers."""
    layer, _, y, x = np.nonzero(grid.solid)
    return {"x": int(np.ptp(x)) + 1, "y": int(np.ptp(y)) + 1, "layers": int(np.ptp(layer)) + 1}


def _pass_through(build: Build) -> dict[str, int]:
    """Return how many cells trajectories pass such that one, two or three corners lie inside, over all slices."""
    loops, corner = build.trajectories, build.grid.origin[:2]
    level = loops.loop_slice[loops.edge_loop].astype(np.int64)
    n_levels, (n_y, n_x) = len(build.cut.slices.heights), build.grid.colour.shape[2:]
    windings = corner_windings(loops.points, loops.ends, level, corner=corner, n_levels=n_levels, n_y=n_y, n_x=n_x)
    pieces = cut_at_grid(loops.points, loops.ends, corner)
    _, inside = pass_through_types(pieces, level[pieces.edge], windings)
    return {f"type_{number}": int((inside == number).sum()) for number in (1, 2, 3)}


def _levels(build: Build) -> Mask:
    """Return the solid model in levels of plates or of bricks, as overhangs were looked for, without empty rims."""
    solid = build.grid.solid
    one_brick = len(build.offsets.ring) == len(solid)
    levels = solid[:, 0] if one_brick else solid.reshape(-1, *solid.shape[2:])
    used = [np.flatnonzero(levels.any(axis=others)) for others in ((0, 2), (0, 1))]
    y, x = (slice(rows.min(initial=0), rows.max(initial=-1) + 1) for rows in used)
    return levels[:, y, x]


def _detail(cut: Cut, grid: UnitGrid) -> dict[str, int | None]:
    """Return how many layers differ, were sliced plate by plate, and have columns that are not one brick."""
    plates = grid.solid.any(axis=1) & ~brick_columns(grid)[0]
    layers = len(grid.colour)
    marked = {
        f"marked_by_{name}": None if cut.marks is None else int(getattr(cut.marks, name).sum())
        for name in ("number", "length", "area")
    }
    return {
        "layers": layers,
        **marked,
        "sliced_in_plates": int((np.bincount(cut.layer, minlength=layers) == PLATES_PER_BRICK).sum()),
        "layers_in_plates": int(plates.any(axis=(1, 2)).sum()),
        "columns_of_plates": int(plates.sum()),
    }


def _offsets(offsets: Offsets) -> dict[str, int]:
    return {
        "trajectories": int(offsets.trajectories.sum()),
        "bricks": int(offsets.cells.sum()),
        "left_alone": int(offsets.left_alone.sum()),
    }


def _overhangs(levels: Mask) -> dict[str, int]:
    found = overhang_kinds(levels)
    return {kind.name.lower(): found.count(kind) for kind in OverhangKind}


def _hollowing(build: Build, levels: Mask) -> dict[str, Any]:
    """Return the cells that must and may be built, those of the solid model, and the cases of the paper's regions."""
    cover = build.hollow.cover
    return {
        "must": int((cover == Fill.REQUIRED).sum()),
        "may": int((cover == Fill.OPTIONAL).sum()),
        "solid": int(build.grid.solid.sum()),
        "cases": asdict(tally_cases(levels, upper_only=build.settings.hollow_rule == "upper")),
    }


def _colour_error(build: Build) -> dict[str, Any]:
    """Return how far colours are from the texture: the mean by surface, the worst brick, and how many were judged."""
    found = colour_errors(build.bricks, build.assembly.catalogue, build.wanted)
    judged = int((~np.isnan(found.error)).sum())
    if not judged:
        return {"mean": None, "worst": None, "brick": None, "judged": 0}
    return {
        "mean": round(found.mean, 2),
        "worst": round(float(found.error[found.worst]), 2),
        "brick": found.worst,
        "judged": judged,
    }


def _filled(build: Build) -> int:
    """Return the number of the model's cells that bricks fill, other than supports; some bricks fill further cells."""
    owner, low = build.graph.owner, build.graph.low
    support = np.isin(build.bricks.role, SUPPORTS)
    cell = np.argwhere(owner != NOBODY)
    cell = cell[~support[owner[tuple(cell.T)]]] + low[::-1]
    solid = build.grid.solid.reshape(-1, *build.grid.solid.shape[2:])
    within = ((cell >= 0) & (cell < solid.shape)).all(axis=1)
    return int(solid[tuple(cell[within].T)].sum())
