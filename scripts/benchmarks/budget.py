"""What a build comes to against what was estimated before it: bricks, CPU seconds and memory."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np

from legorize_addon.core.estimate import estimate
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table

ROOT: Final = Path(__file__).resolve().parents[2]

RUN: Final = """
import json, resource, sys
from pathlib import Path
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
build = legorize(read_mesh(Path(sys.argv[1])), Settings(width=int(sys.argv[2])))
peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
print(json.dumps({"bricks": len(build.bricks), "seconds": sum(build.timings.values()), "megabytes": peak}))
"""
"""A process of its own for each build, for the peak of its memory."""


def measure(paths: Sequence[Path], *, widths: Sequence[int]) -> list[Table]:
    """Build models and compare what they took with the estimates.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.

    Returns
    -------
    list of Table
        Each build, and the median and worst of estimate to measurement.
    """
    rows: list[Row] = []
    for path in paths:
        mesh = read_mesh(path)
        for width in widths:
            line = [sys.executable, "-c", RUN, str(path.resolve()), str(width)]
            done = subprocess.run(line, cwd=ROOT, check=True, capture_output=True, text=True)
            found, expected = json.loads(done.stdout), estimate(mesh, Settings(width=width))
            row: Row = {"model": path.stem, "studs": width}
            for name in ("bricks", "seconds", "megabytes"):
                told = getattr(expected, name)
                row |= {name: found[name], f"{name}_expected": told, f"{name}_ratio": told / found[name]}
            rows.append(row)
    return [
        Table("budget", "Builds and their estimates", tuple(rows)),
        Table("budget_errors", "Estimate to measurement", tuple(_errors(rows))),
    ]


def _errors(rows: Sequence[Row]) -> list[Row]:
    """Return the median and the extremes of each ratio."""
    found: list[Row] = []
    for name in ("bricks", "seconds", "megabytes"):
        ratio = np.array([row[f"{name}_ratio"] for row in rows], dtype=np.float64)
        found.append({"what": name, "median": float(np.median(ratio)), "least": ratio.min(), "most": ratio.max()})
    return found
