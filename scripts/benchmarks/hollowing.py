"""What hollowing leaves, against a shell of two cells that the same layout builds."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from legorize_addon.core.build import Build
from legorize_addon.core.geometry.neighbourhoods import outer_air
from legorize_addon.core.layout.lay import FILLER, lay
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from legorize_addon.core.shell.cohesion import make_cohesive
from legorize_addon.core.shell.hollowing import hollow
from legorize_addon.core.shopping import count_lots, mass_of
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table

Mask = NDArray[np.bool_]

SHELL: Final = 2
"""Cells of the fixed shell."""

SAVED: Final = 0.2
"""Goal: share of its bricks and of its mass that hollowing saves."""


def measure(paths: Sequence[Path], *, width: int) -> list[Table]:
    """Build every model hollowed, and with the fixed shell.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.

    Returns
    -------
    list of Table
    """
    catalogue = load_catalogue()
    rows: list[Row] = []
    for path in paths:
        print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
        build = legorize(read_mesh(path), Settings(width=width))
        fixed = lay(fixed_shell(build.grid), catalogue, rng=np.random.default_rng(build.settings.seed), filler=FILLER)
        facts = _cells(build) | _saved(build, fixed, catalogue) | soundness(build.grid, build.hollow)
        rows.append({"model": path.stem, **facts, "hollowing_s": build.timings["hollowing"]})
    title = (
        f"Hollowing at {width} studs, against a shell of {SHELL} cells: at least {SAVED:.0%} fewer bricks and less "
        "mass, no hole in what must be built, and no cell cut off from the ground"
    )
    return [Table("hollowing", title, (*rows, _means(rows)))]


def fixed_shell(grid: UnitGrid) -> UnitGrid:
    """Return a grid whose shell of two cells must be built, and nothing else may.

    Parameters
    ----------
    grid : UnitGrid
        The solid model.

    Returns
    -------
    UnitGrid
        Ready to be laid.
    """
    shell = hollow(grid, shell=SHELL)
    left_out = shell.cover == Fill.OPTIONAL
    shell = replace(
        shell,
        cover=np.where(left_out, np.uint8(Fill.EMPTY), shell.cover),
        colour=np.where(left_out, np.int16(COLOUR_EMPTY), shell.colour),
    )
    # as the pipeline prepares what hollowing leaves, plates and all
    return make_cohesive(shell, plates=True)


def _cells(build: Build) -> Row:
    """Return the model's cells, which shares of them must and may be built, and how many more there must be."""
    solid, cover = build.grid.solid, build.hollow.cover
    within = cover[solid]
    return {
        "solid": len(within),
        "must_share": float((within == Fill.REQUIRED).mean()),
        "may_share": float((within == Fill.OPTIONAL).mean()),
        "added_share": int((cover[~solid] == Fill.REQUIRED).sum()) / len(within),
    }


def _saved(build: Build, fixed: Bricks, catalogue: Catalogue) -> Row:
    facts = report(build, catalogue, version="", mm_per_unit=1.0)
    mass = mass_of(count_lots(Assembly(fixed, catalogue)))
    fewer, lighter = 1 - len(build.bricks) / len(fixed), 1 - facts["mass_g"] / mass
    return {
        "hollow_ratio": facts["hollow_ratio"],
        "bricks": len(build.bricks),
        "fixed_bricks": len(fixed),
        "bricks_saved": fewer,
        "mass_g": facts["mass_g"],
        "fixed_mass_g": mass,
        "mass_saved": lighter,
        "saved_met": min(fewer, lighter) >= SAVED,
        "floating": build.graph.n_floating,
    }


def soundness(grid: UnitGrid, left: UnitGrid) -> Row:
    """Look for holes, and for cells that only the solid model joins to the ground.

    Parameters
    ----------
    grid : UnitGrid
        The solid model.
    left : UnitGrid
        What hollowing leaves of it.

    Returns
    -------
    dict
        ``behind_holes``: cells of the model that the outer air reaches where
        nothing is built that may be left out; ``cut_off``: cells that must be
        built and are not joined, face to face, to the lowest level by what must
        or may be, though they were in the solid model.
    """
    solid, required = _levels(grid.solid), _levels(left.cover == Fill.REQUIRED)
    behind_holes = int((outer_air(required) & solid).sum())
    cut_off = int((required & _standing(solid) & ~_standing(_levels(left.solid))).sum())
    return {"behind_holes": behind_holes, "cut_off": cut_off, "sound_met": behind_holes == cut_off == 0}


def _levels(cells: Mask) -> Mask:
    return cells.reshape(-1, *cells.shape[2:])


def _standing(solid: Mask) -> Mask:
    """Return the cells that are joined, face to face, to the lowest level of the model."""
    label, _ = ndimage.label(solid)
    lowest = np.flatnonzero(solid.any(axis=(1, 2)))[0]
    standing: Mask = np.isin(label, np.unique(label[lowest][solid[lowest]]))
    return standing


def _means(rows: Sequence[Row]) -> Row:
    """Return the mean shares over the models."""
    shares = ("must_share", "may_share", "added_share", "hollow_ratio", "bricks_saved", "mass_saved")
    means: Row = {name: float(np.mean([row[name] for row in rows])) for name in shares}
    return dict.fromkeys(rows[0]) | {"model": "mean"} | means
