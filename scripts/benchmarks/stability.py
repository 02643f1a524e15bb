"""Whether models stand: the certificate against a linear programme by HiGHS, and against the StableLego cases."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
from scipy.optimize import linprog

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.statics.collapse import least_clutch
from legorize_addon.core.statics.forces import CAUTIOUS_HOLD, HOLD, Ground, Statics, statics
from legorize_addon.core.statics.stability import stability
from scripts.benchmarks.clock import least_seconds, seconds
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.stablelego import CASES, Case, placed, stair
from scripts.benchmarks.tables import Row, Table

LIMITS: Final = ((2500, 0.5), (10_000, 4.0))
"""Goals: bricks, and CPU seconds of the certificate of so many."""

FASTER: Final = 20.0
"""Goal: how many times faster than the linear programme, from ``FASTER_FROM`` bricks on."""

FASTER_FROM: Final = 1000


def measure(paths: Sequence[Path], *, widths: Sequence[int], repeats: int, programme: int) -> list[Table]:
    """Build models and decide whether they stand.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    repeats : int
        Runs of the certificate.
    programme : int
        Bricks up to which the linear programme is timed.

    Returns
    -------
    list of Table
        The models, and the cases of the StableLego article with its stair at
        every height.
    """
    rows: list[Row] = []
    for path in paths:
        mesh = read_mesh(path)
        for width in widths:
            print(f"{path.stem}, {width} studs", file=sys.stderr, flush=True)
            bricks = legorize(mesh, Settings(width=width)).bricks
            rows.append({"model": path.stem, "studs": width, **judged(bricks, repeats=repeats, programme=programme)})
    goals = ", ".join(f"{count} bricks within {limit} s" for count, limit in LIMITS)
    title = f"Do the models stand: {goals}, {FASTER:.0f} times faster than HiGHS from {FASTER_FROM} bricks on"
    published = "The nine cases published with StableLego, on a baseplate: the least hold by HiGHS, and both verdicts"
    stairs = "Where a stair of 2 x 4 bricks falls; StableLego: 19 levels stand, 20 fall"
    return [
        Table("stability", title, tuple(rows)),
        Table("stability_cases", published, tuple(map(case_row, CASES))),
        Table("stability_stairs", stairs, tuple(stair_row(levels) for levels in range(14, 23))),
    ]


def judged(bricks: Bricks, *, repeats: int, programme: int) -> Row:
    """Return verdicts, proof and times of one model."""
    catalogue = load_catalogue()
    assembly = Assembly(bricks, catalogue)
    found = stability(assembly)
    [taken] = least_seconds(lambda: stability(Assembly(bricks, catalogue)), repeats=repeats)
    limit = next((limit for count, limit in LIMITS if len(bricks) <= count), None)
    highs = None
    if len(bricks) <= programme:
        highs = seconds(lambda: solved(statics(assembly)))
    faster = None if highs is None else highs / taken
    return {
        "bricks": len(bricks),
        "floating": len(found.unsupported),
        "verdict": found.verdict.value,
        "standing": found.standing.value,
        "cautious": stability(Assembly(bricks, catalogue), clutch=CAUTIOUS_HOLD).standing.value,
        "check_met": found.check(),
        "worst_margin": float(found.margin[assembly.graph.grounded].min()),
        "failing": int(np.count_nonzero(found.margin < 0)),
        "tipping_mm": float(np.nanmin(found.tipping)),
        "residual": found.residual,
        "iterations": found.iterations,
        "certificate_s": taken,
        "time_met": None if limit is None else taken <= limit,
        "highs_s": highs,
        "faster": faster,
        "faster_met": None if faster is None or len(bricks) < FASTER_FROM else faster >= FASTER,
    }


def solved(equations: Statics) -> bool:
    """Return whether HiGHS finds forces in balance."""
    least = equations.contacts.least
    bounds = np.column_stack([least, np.full(len(least), np.inf)])
    found = linprog(np.zeros(len(least)), A_eq=equations.matrix, b_eq=-equations.loads, bounds=bounds, method="highs")
    return bool(found.status == 0)


def case_row(case: Case) -> Row:
    """Return the article's verdict on a case and ours."""
    catalogue = load_catalogue()
    bricks, loads = case.bricks(catalogue), case.loads(catalogue)
    found = stability(Assembly(bricks, catalogue), ground=Ground.BASEPLATE, loads=loads)
    expected = Verdict.STABLE if case.stands else Verdict.COLLAPSES
    return {
        "case": case.name,
        "bricks": len(bricks),
        "least_hold_n": least_clutch(found.statics),
        "share_of_hold": least_clutch(found.statics) / HOLD,
        "article": expected.value,
        "ours": found.verdict.value,
        "iterations": found.iterations,
        "residual": found.residual,
        "met": found.stands == case.stands and found.check(),
    }


def stair_row(levels: int) -> Row:
    """Return the verdicts on a stair."""
    catalogue = load_catalogue()
    bricks = placed(stair(levels), catalogue)
    verdicts = [
        stability(Assembly(bricks, catalogue), ground=Ground.BASEPLATE, clutch=clutch)
        for clutch in (HOLD, CAUTIOUS_HOLD)
    ]
    return {
        "levels": levels,
        "least_hold_n": least_clutch(verdicts[0].statics),
        f"at_{HOLD}": verdicts[0].verdict.value,
        f"at_{CAUTIOUS_HOLD}": verdicts[1].verdict.value,
    }
