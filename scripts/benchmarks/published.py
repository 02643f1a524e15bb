"""Models as the paper would make them, beside those of the default: whether they come out, and their price."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from functools import partial
from itertools import product
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
from scripts.benchmarks.kept import Kept
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.surface import SeenSurface, likeness, seen_surface
from scripts.benchmarks.tables import Row, Table

WAYS: Final[Mapping[str, Mapping[str, Any]]] = MappingProxyType(
    {"default": {}, "as published": MappingProxyType(preset_values("paper"))}
)
"""What is set; the first is what the other is compared with."""

Facts = dict[str, Any]
FACTS: Final = (
    "bricks", "grams", "surface_mean", "surface_lost", "colour_error", "supports", "components", "in_the_air", "stands",
    "cpu_s", "failed", "met",
)  # fmt: skip
PRICES: Final = ("bricks", "grams", "surface_mean", "colour_error", "supports", "cpu_s")


def measure(paths: Sequence[Path], *, widths: Sequence[int], minutes: float, out: Path) -> list[Table]:
    """Build every model both ways.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    minutes : float
        After which no build is begun; 0 for no limit.
    out : Path
        For rows, which the next run of the same program takes over.

    Returns
    -------
    list of Table
        Every build, and what the paper's way costs of the default's; none if there was no time for any.
    """
    kept, rows, ratios = Kept(out / "published", minutes), list[Row](), list[Row]()
    for width, path in product(widths, paths):
        start: Row = {"model": path.stem, "studs": width}
        for both in kept.row(f"{path.stem}-{width}", partial(_both, path, width)):
            found = [{name: both[f"{way}: {name}"] for name in FACTS} for way in WAYS]
            rows += [{**start, "way": way, **facts} for way, facts in zip(WAYS, found, strict=True)]
            ratios.append(start | {name: ratio(*(float(str(facts[name])) for facts in found)) for name in PRICES})
    kept.tell_left()
    return (
        [
            Table(
                "published", "As in the paper: met is no check failed, nothing in the air, and read back", tuple(rows)
            ),
            Table(
                "published_price", "What the published way takes, of what the default takes", (*ratios, medians(ratios))
            ),
        ]
        if rows
        else []
    )


def medians(ratios: Sequence[Row]) -> Row:
    """Return the medians over all builds."""
    row: Row = {"model": "median", "studs": None}
    for name in PRICES:
        values = [float(str(each[name])) for each in ratios if each[name] is not None]
        row[name] = float(np.median(values)) if values else None
    return row


def _both(path: Path, width: int) -> Row:
    """Build a model both ways."""
    print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
    mesh = read_mesh(path)
    builds = {way: legorize(mesh, Settings(**{"width": width, **values})) for way, values in WAYS.items()}
    surface = seen_surface(builds[next(iter(WAYS))])
    return {
        f"{way}: {name}": value for way, build in builds.items() for name, value in facts_of(build, surface).items()
    }


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
