"""What an update takes, as a share of a full run, and what a live preview takes."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.memo import Memo, Trial
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.preview import load_tables, preview
from legorize_addon.core.settings import Settings
from scripts.benchmarks.clock import seconds
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table

COLOURS: Final = 0.3
SUPPORTS: Final = 0.15
"""Goals for the share of a full run after a change of colours, and of supports."""

PREVIEW: Final = 0.5
"""Goal for a preview in CPU seconds."""

STUDS: Final = 32
"""Of previews."""

FEW: Final = 7
"""Dominant colours of the first run."""


def measure(paths: Sequence[Path], *, width: int, repeats: int) -> list[Table]:
    """Change one setting after a full run.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    repeats : int
        Runs, of which the fastest counts.

    Returns
    -------
    list of Table
    """
    load_tables()
    updates: list[Row] = []
    previews: list[Row] = []
    for path in paths:
        print(path.stem, file=sys.stderr, flush=True)
        mesh = read_mesh(path)
        updates += _updates(path.stem, mesh, Settings(width=width, colours=FEW), repeats)
        previews += _previews(path.stem, mesh, repeats)
    return [
        Table(
            "updates",
            f"Updates at {width} studs: within {COLOURS:.0%} of a run after colours, {SUPPORTS:.0%} after supports",
            tuple(updates),
        ),
        Table("previews", f"Live previews at {STUDS} studs: within {PREVIEW} CPU seconds", tuple(previews)),
    ]


def _updates(model: str, mesh: TriangleMesh, settings: Settings, repeats: int) -> list[Row]:
    """Return a row for each change."""
    # whatever is loaded by it is there afterwards
    first = _run(mesh, settings, None)
    full = min(seconds(lambda: _run(mesh, settings, None)) for _ in range(repeats))
    memo = Memo()
    trial = memo.trial()
    _run(mesh, settings, trial)
    memo.keep(trial)
    rows: list[Row] = []
    for name, change, goal in _changes(first):
        changed = replace(settings, **change)
        found = _run(mesh, changed, memo.trial())
        taken = min(seconds(partial(_run, mesh, changed, memo.trial())) for _ in range(repeats))
        row: Row = {"model": model, "change": name, "bricks": len(found.bricks), "full_s": full, "update_s": taken}
        rows.append(row | {"share": taken / full, "goal": goal, "goal_met": taken <= goal * full})
    return rows


def _run(mesh: TriangleMesh, settings: Settings, trial: Trial | None) -> Build:
    return legorize(mesh, settings, trial=trial)


def _changes(build: Build) -> list[tuple[str, Mapping[str, Any], float]]:
    """Return changes of settings: name, settings and goal."""
    codes, count = np.unique(build.grid.colour[build.grid.colour >= 0], return_counts=True)
    order = codes[np.argsort(-count)].tolist()
    catalogue = load_catalogue()
    made = catalogue.exists.sum(axis=0)
    usual = [int(code) for code in catalogue.codes[np.argsort(-made, kind="stable")] if code not in order]
    found: list[tuple[str, Mapping[str, Any], float]] = [
        ("supports none", {"supports": "none"}, SUPPORTS),
        ("supports columns", {"supports": "columns"}, SUPPORTS),
        (f"colours {FEW} to {FEW - 2}", {"colours": FEW - 2}, COLOURS),
        ("a colour replaced by a new one", {"replace_colours": f"{order[0]}={usual[0]}"}, COLOURS),
    ]
    if len(order) > 1:
        found.append(("a colour replaced by another", {"replace_colours": f"{order[1]}={order[0]}"}, COLOURS))
    return found


def _previews(model: str, mesh: TriangleMesh, repeats: int) -> list[Row]:
    """Return a row for the first preview, and one for another size after it."""
    rows: list[Row] = []
    for name, before in (("the first", ()), ("another size", (STUDS - 1,))):
        taken = []
        for _ in range(repeats):
            memo = Memo()
            for width in before:
                _show(mesh, width, memo)
            start = time.process_time()
            _show(mesh, STUDS, memo)
            taken.append(time.process_time() - start)
        rows.append({"model": model, "preview": name, "cpu_s": min(taken), "goal_met": min(taken) <= PREVIEW})
    return rows


def _show(mesh: TriangleMesh, width: int, memo: Memo) -> None:
    for _ in preview(mesh, Settings(width=width), memo):
        pass
