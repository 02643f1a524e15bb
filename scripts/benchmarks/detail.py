"""What plates gain, surface nearer to the bricks and colours more alike, and at which price."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.judge import judged
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.surface import likeness, seen_surface
from scripts.benchmarks.tables import Row, Table

GAIN: Final = 0.25
KEPT: Final = 2 / 3
PLATES: Final = 0.5
"""Goals in the mean: share of the distance that all plates take away; share of that which plates where they pay
keep, and with which share of the plates."""

WAYS: Final = ("none", "pays", "all")
"""Where plates may lie; the first is what the others are compared with."""

STAGES: Final = ("slicing", "trajectories", "unit bricks", "overhangs", "hollowing")
"""Whose CPU seconds detail may change."""

Facts = dict[str, Any]


def measure(paths: Sequence[Path], *, widths: Sequence[int], judge: Path | None, out: Path) -> list[Table]:
    """Measure every model without plates, with plates where they pay, and with all plates.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    judge : Path or None
        Folder with ``judge.py``; None measures by what is known of the alignment, which is quick.
    out : Path
        Folder for the judge's bricks and judgements.

    Returns
    -------
    list of Table
    """
    rows: list[Row] = []
    gains: list[Facts] = []
    for path in paths:
        mesh = read_mesh(path)
        for width in widths:
            print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
            # pillars that stay would be judged as shape
            builds = {way: legorize(mesh, Settings(width=width, plates=way, supports="none")) for way in WAYS}
            said = _judged(builds, judge, path, width, out / "detail") if judge else _compared(builds)
            start: Row = {"model": path.stem, "studs": width}
            found = {way: said[way] | _price(build) for way, build in builds.items()}
            rows += [{**start, "allowed": way, **facts} for way, facts in found.items()]
            gains.append(start | _gains(found))
    whose = "the judge" if judge else "the known alignment"
    return [
        Table("detail", f"Where plates are allowed, by {whose}", tuple(rows)),
        Table(
            "detail_gains",
            f"Shares of the distance and error of colour that plates take away, by {whose}: on no model less than "
            f"nothing; in the mean, all take {GAIN:.0%} of the distance, and plates where they pay keep {KEPT:.0%} of "
            f"that with {PLATES:.0%} of the plates",
            (*gains, _means(gains)),
        ),
    ]


def _judged(builds: Mapping[str, Build], judge: Path, path: Path, width: int, folder: Path) -> dict[str, Facts]:
    """Return what the external judge says, who reads the bricks from files."""
    folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for way, build in builds.items():
        bricks = folder / f"{path.stem}-{width}-{way}.ldr"
        text = write_ldr(Assembly(build.bricks, load_catalogue()), name=bricks.name, title=bricks.stem)
        bricks.write_text(text, encoding="utf-8", newline="")
        said = judged(judge, path, bricks, width, bricks.with_suffix(".json"))
        found[way] = {
            "surface_mean": said["surface_to_brick_mean"],
            "surface_p95": said["surface_to_brick_p95"],
            "surface_lost": said["surface_lost_share"],
            "colour_error": said["colour_error_mean"],
            "components": said["components"],
            "floating": said["floating_bricks"],
        }
    return found


def _compared(builds: Mapping[str, Build]) -> dict[str, Facts]:
    """Return what the bricks are to the surface where they lie in it; all builds meet the same points."""
    surface = seen_surface(builds[WAYS[0]])
    found = {}
    for way, build in builds.items():
        like = likeness(surface, build, load_catalogue())
        found[way] = {
            # to the digits of a judge: what lies behind them is neither better nor worse
            "surface_mean": round(like.mean, 3),
            "surface_p95": round(like.p95, 3),
            "surface_lost": round(like.lost, 4),
            "colour_error": round(like.colour, 2),
            "components": build.graph.n_components,
            "floating": build.graph.n_floating,
        }
    return found


def _price(build: Build) -> Facts:
    plate = np.array([part.height == 1 for part in load_catalogue().parts])
    return {
        "parts": len(build.bricks),
        "plates": int(plate[build.bricks.part].sum()),
        "cpu_s": sum(build.timings[stage] for stage in STAGES),
    }


def _gains(found: Mapping[str, Facts]) -> Facts:
    """Compare the three ways for one model in one size."""
    none, pays, every = (found[way] for way in WAYS)
    row: Facts = {}
    for column in ("mean", "p95"):
        for way in WAYS[1:]:
            row[f"{way}_{column}"] = 1 - _ratio(found[way], none, f"surface_{column}")
    for way in WAYS[1:]:
        row[f"{way}_colour"] = 1 - _ratio(found[way], none, "colour_error")
    return row | {
        "kept_share": _kept(row),
        "plates_share": pays["plates"] / every["plates"] if every["plates"] else None,
        "parts_ratio": _ratio(pays, none, "parts"),
        "cpu_ratio": _ratio(pays, none, "cpu_s"),
        "distance_met": min(row[name] for name in ("pays_mean", "pays_p95", "all_mean", "all_p95")) >= 0,
        "colour_met": min(row["pays_colour"], row["all_colour"]) >= 0,
        "pays_met": None,
    }


def _ratio(facts: Facts, others: Facts, column: str) -> float:
    return float(facts[column] / others[column]) if others[column] else 1.0


def _kept(row: Facts) -> float | None:
    """Return which share of what all plates take off the distance those take off that pay."""
    return float(row["pays_mean"] / row["all_mean"]) if row["all_mean"] > 0 else None


def _means(gains: Sequence[Facts]) -> Facts:
    """Return the means over models and sizes, of which more is wanted than of each."""
    row: Facts = {"model": "mean", "studs": None}
    for column in list(gains[0])[2:]:
        values = [each[column] for each in gains if each[column] is not None]
        row[column] = float(np.mean(values)) if values else None
    kept, share = _kept(row), row["plates_share"]
    return row | {
        "kept_share": kept,
        "distance_met": min(row["all_mean"], row["all_p95"]) >= GAIN,
        "colour_met": min(row["pays_colour"], row["all_colour"]) > 0,
        "pays_met": None if kept is None or share is None else kept >= KEPT and share <= PLATES,
    }
