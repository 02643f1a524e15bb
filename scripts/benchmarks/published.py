"""Models as the paper would make them, beside those of the default: whether they come out, and their price."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.files import write_ldr
from legorize_addon.core.ldraw import read_ldraw
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.presets import preset_values
from legorize_addon.core.report.checks import failed_checks
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.surface import SeenSurface, likeness, seen_surface
from scripts.benchmarks.tables import Row, Table

WAYS: Final[Mapping[str, Mapping[str, Any]]] = MappingProxyType(
    {"default": {}, "as published": MappingProxyType(preset_values("paper"))}
)
"""What is set; the first is what the other is compared with."""

Facts = dict[str, Any]
PRICES: Final = ("bricks", "grams", "surface_mean", "colour_error", "supports", "cpu_s")


def measure(paths: Sequence[Path], *, widths: Sequence[int]) -> list[Table]:
    """Build every model both ways.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.

    Returns
    -------
    list of Table
        Every build, and what the paper's way costs of the default's.
    """
    rows: list[Row] = []
    ratios: list[Row] = []
    for path in paths:
        mesh = read_mesh(path)
        for width in widths:
            print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
            builds = {way: legorize(mesh, Settings(width=width, **values)) for way, values in WAYS.items()}
            surface = seen_surface(builds["default"])
            found = [facts_of(build, surface) for build in builds.values()]
            # a run takes long, and what is known is shown
            print(
                *(f"{way}: {facts}" for way, facts in zip(builds, found, strict=True)),
                sep="\n",
                file=sys.stderr,
                flush=True,
            )
            start: Row = {"model": path.stem, "studs": width}
            rows += [{**start, "way": way, **facts} for way, facts in zip(builds, found, strict=True)]
            ratios.append({**start, **{name: ratio(*(facts[name] for facts in found)) for name in PRICES}})
    medians: Row = {"model": "median", "studs": 0}
    medians |= {name: float(np.median([float(row[name] or np.nan) for row in ratios])) for name in PRICES}
    return [
        Table("published", "As in the paper: met is no check failed, nothing in the air, and read back", tuple(rows)),
        Table("published_price", "What the published way takes, of what the default takes", (*ratios, medians)),
    ]


def facts_of(build: Build, surface: SeenSurface) -> Facts:
    """Return what a build is, and how like the surface."""
    catalogue, like = load_catalogue(), likeness(surface, build, load_catalogue())
    failed = failed_checks(report(build, catalogue, version="0", mm_per_unit=1.0))
    text = write_ldr(Assembly(build.bricks, catalogue), name="model.ldr", title="model")
    again = len(read_ldraw(text, catalogue).bricks)
    graph = build.graph
    return {
        "bricks": len(build.bricks),
        "grams": float(catalogue.mass[build.bricks.part].sum()),
        "surface_mean": like.mean,
        "surface_lost": like.lost,
        "colour_error": like.colour,
        "supports": len(build.supports.removed),
        "components": graph.n_components,
        "in_the_air": graph.n_floating,
        "stands": build.stability.verdict.name.lower(),
        "cpu_s": sum(build.timings.values()),
        "failed": " ".join(failed) or "none",
        "met": not failed and not graph.n_floating and again == len(build.bricks),
    }


def ratio(ours: float, theirs: float) -> float | None:
    """Return what the second is of the first."""
    return theirs / ours if ours else None
