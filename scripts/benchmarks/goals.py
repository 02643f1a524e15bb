"""The goals of the layout, all in one run: what comes out of every model at every size, and what it costs."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from typing import Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.layout.lay import lay_unjoined
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import SUPPORTS, Bricks
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.model.contacts import ContactGraph, contact_graph
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.remarks import remarks
from legorize_addon.core.settings import Settings
from legorize_addon.core.shell.near_bodies import free_bodies
from legorize_addon.core.shopping import count_lots, not_made
from legorize_addon.core.statics.forces import CAUTIOUS_HOLD, HOLD
from legorize_addon.core.statics.stability import stability
from scripts.benchmarks.layout_figures import (
    articulations,
    coinciding_seams,
    colours_lost,
    edges_to_bridge,
    fewest_singles,
    forced_singles,
    must_cells,
    single,
)
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table, Value

TRIANGLES: Final = 20_000
"""Meshes of so many triangles and more have no limit of time, and are not built wider than ``WIDE`` studs."""

WIDE: Final = 96

SECONDS: Final = {48: 2.0, 96: 12.0, 192: 60.0}
"""Goals: CPU seconds of the whole way, by width in studs."""

RATIO_SIZES: Final = (48, 96)
"""Widths at which the number of bricks has a goal."""

LAYOUT: Final = 100.0
CELLS: Final = 100_000
"""Goal: CPU microseconds of the layout a must cell, in models of at most so many."""

GROWTH: Final = 1.15
"""Goal: power of the must cells that the CPU of the layout grows with."""


@dataclass(frozen=True, slots=True)
class Goal:
    """A figure of the table, and what it may be at most.

    Attributes
    ----------
    text : str
        What is wanted.
    figure : str
        Column of the table.
    most : float
        The limit.
    widths : tuple of int
        Sizes that it is wanted at; all if there are none.
    """

    text: str
    figure: str
    most: float
    widths: tuple[int, ...] = ()


GOALS: Final = (
    Goal("one component", "components", 1),
    Goal("bricks that float", "floating", 0),
    Goal("impossible pairs of part and colour", "not_made", 0),
    Goal("visible cells in another colour", "colours_lost", 0),
    Goal("bricks to the bound, before repair", "ratio_laid", 1.03, RATIO_SIZES),
    Goal("bricks to the bound, after repair", "ratio", 1.04, RATIO_SIZES),
    Goal("1 x 1 beyond the fewest that are proven to be forced", "single_free", 0.025),
    Goal("articulation bricks", "articulation", 0.10),
    Goal("articulation bricks, 1 x 1 where no other part fits left out", "articulation_free", 0.10),
    Goal("coinciding seams", "seams", 0.25),
    Goal("coinciding seams that a part could bridge", "seams_free", 0.25),
)


def measure(paths: Sequence[Path], *, widths: Sequence[int]) -> list[Table]:
    """Build every model at every size, each in a process of its own, one after the other.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side. What is wider than ``WIDE`` is
        built of meshes below ``TRIANGLES`` alone.

    Returns
    -------
    list of Table
        What comes out; what it costs; the goals; and what cannot stand by
        itself, with the reason, if anything cannot.
    """
    cases = [(path, width) for path in paths for width in sorted(widths)]
    # a new process for each, whose peak of memory is its own; this one stays small, as its peak is inherited
    with ProcessPoolExecutor(1, mp_context=get_context("spawn"), max_tasks_per_child=1) as alone:
        found = [_told(path, width, alone.submit(case, path, width).result()) for path, width in cases]
    rows = [row for row in found if row]
    results, costs = ([row[part] for row in rows] for part in ("results", "costs"))
    allowed = ", ".join(f"{limit:g} s at {width} studs" for width, limit in SECONDS.items())
    title = f"CPU seconds by stage: {allowed}, below {TRIANGLES:,} triangles; layout in microseconds a must cell"
    tables = [
        Table("goals", "What comes out of every model", tuple(results)),
        Table("goals_costs", title, tuple(costs)),
        Table("goals_met", "The goals, and the worst of all models", tuple(goals_met(results, costs))),
    ]
    fallen = tuple(row["fallen"] for row in rows if row["fallen"]["reason"])
    return [*tables, Table("goals_fallen", "What cannot stand without pillars, and why", fallen)] if fallen else tables


def _told(path: Path, width: int, row: dict[str, Row]) -> dict[str, Row]:
    taken = f"{row['costs']['total_s']:.1f} s" if row else "left out"
    print(f"{path.stem}, {width} studs: {taken}", file=sys.stderr, flush=True)
    return row


def case(path: Path, width: int) -> dict[str, Row]:
    """Build one model, unless it is wide and its mesh large.

    Parameters
    ----------
    path : Path
        Model file.
    width : int
        Studs along the longer horizontal side.

    Returns
    -------
    dict of str to Row
        ``results``, ``costs`` and ``fallen``: a row of three tables, or nothing.
    """
    mesh, catalogue = read_mesh(path), load_catalogue()
    small = len(mesh.faces) < TRIANGLES
    if width > WIDE and not small:
        return {}
    build = legorize(mesh, Settings(width=width))
    memory = peak_memory()
    start: Row = {"model": path.stem, "studs": width}
    required = must_cells(build.hollow)
    costs = _costs(build, required, memory, limit=SECONDS.get(width) if small else None)
    bricks = build.bricks.take(~np.isin(build.bricks.role, SUPPORTS))
    links = contact_graph(bricks, catalogue)
    alone = stability(Assembly(bricks, catalogue))
    return {
        "results": start | _results(build, bricks, links, required, catalogue) | {"by_itself": alone.verdict.value},
        "costs": start | {"triangles": len(mesh.faces)} | costs,
        "fallen": start | {"reason": "" if alone.stable else " ".join(remarks(Assembly(bricks, catalogue), alone))},
    }


def peak_memory() -> float | None:
    """Return the most memory that this process had so far in MB, or None where the system does not tell."""
    if sys.platform == "win32":
        return None
    import resource

    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak / 2**20 if sys.platform == "darwin" else peak / 2**10


def _results(build: Build, bricks: Bricks, links: ContactGraph, required: int, catalogue: Catalogue) -> Row:
    """Return what came out: of the model without the pillars that stay in it, but for whether it stands."""
    fewest = lower_bound(build.hollow, catalogue)
    before = lay_unjoined(build.hollow, catalogue, rng=np.random.default_rng(build.settings.seed))
    singles, forced = single(bricks, catalogue).mean(), fewest_singles(bricks, build.hollow, catalogue) / len(bricks)
    left_out = forced_singles(bricks, build.hollow, catalogue)
    seen, lost = colours_lost(build.grid, bricks, links)
    verdicts = {
        f"at_{clutch}": stability(Assembly(build.bricks, catalogue), clutch=clutch).verdict.value
        for clutch in (HOLD, CAUTIOUS_HOLD)
    }
    return {
        "must": required,
        "bricks": len(bricks),
        "pillars": len(build.bricks) - len(bricks),
        "bound": fewest,
        "ratio_laid": len(before) / fewest,
        "ratio": len(bricks) / fewest,
        "single": float(singles),
        "single_forced": forced,
        "single_free": float(singles) - forced,
        "articulation": articulations(bricks, links) / len(bricks),
        "articulation_free": articulations(bricks, links, left_out) / len(bricks),
        "seams": coinciding_seams(links),
        "seams_free": coinciding_seams(links, edges_to_bridge(build.hollow, links, catalogue)),
        "bodies": free_bodies(build.hollow),
        "components": links.n_components,
        "floating": links.n_floating,
        "not_made": sum(lot.count for lot in not_made(count_lots(Assembly(bricks, catalogue)))),
        "colours_seen": seen,
        "colours_lost": lost,
        **verdicts,
    }


def _costs(build: Build, required: int, memory: float | None, limit: float | None) -> Row:
    """Return what it cost from mesh to proof; supports that are taken out again are not part of it."""
    laid = build.timings["layout"] + build.timings["ties"]
    total = sum(seconds for stage, seconds in build.timings.items() if stage != "supports")
    return {
        "must": required,
        **build.timings,
        "total_s": total,
        "limit_s": limit,
        "time_met": None if limit is None else total <= limit,
        "layout_us": 1e6 * laid / required,
        "layout_met": None if required > CELLS else 1e6 * laid / required <= LAYOUT,
        "memory_mb": memory,
    }


def goals_met(results: Sequence[Row], costs: Sequence[Row]) -> list[Row]:
    """Return a row for each goal: what is wanted, the worst of all models, and how many keep it."""
    rows = [_goal(goal, results) for goal in GOALS]
    rows += [_standing(results, clutch, wanted) for clutch, wanted in ((HOLD, True), (CAUTIOUS_HOLD, False))]
    rows.append(_cost("CPU seconds of the whole way, by their limit", costs, "time_met", _share_of_limit, 1.0))
    rows.append(_cost("layout in microseconds a must cell", costs, "layout_met", lambda row: row["layout_us"], LAYOUT))
    rows += [_growth(costs, width, goal) for width, goal in ((0, GROWTH), (RATIO_SIZES[0], None))]
    memory = [row["memory_mb"] for row in costs if row["memory_mb"] is not None]
    return [*rows, _goal_row("peak memory in MB", None, max(memory, default=None), None, None, None)]


def _growth(costs: Sequence[Row], from_width: int, most: float | None) -> Row:
    power = exponent([row for row in costs if row["studs"] >= from_width])
    text = "exponent of the CPU of the layout in must cells" + (f", from {from_width} studs on" if from_width else "")
    return _goal_row(text, most, power, None, None, None if power is None or most is None else power <= most)


def _goal_row(
    goal: str, most: float | None, worst: Value, kept: str | None, where: str | None, met: bool | None
) -> Row:
    return {"goal": goal, "at_most": most, "worst": worst, "kept_by": kept, "not_by": where, "met": met}


def _goal(goal: Goal, results: Sequence[Row]) -> Row:
    rows = [row for row in results if not goal.widths or row["studs"] in goal.widths]
    broken = [row for row in rows if row[goal.figure] > goal.most]
    at = f" at {' and '.join(map(str, goal.widths))} studs" if goal.widths else ""
    worst = max((row[goal.figure] for row in rows), default=None)
    kept = f"{len(rows) - len(broken)} of {len(rows)}"
    return _goal_row(goal.text + at, goal.most, worst, kept, _names(broken), not broken if rows else None)


def _standing(results: Sequence[Row], clutch: float, wanted: bool) -> Row:
    fallen = [row for row in results if row[f"at_{clutch}"] != Verdict.STABLE.value]
    kept = f"{len(results) - len(fallen)} of {len(results)}"
    return _goal_row(f"certified at {clutch} N", None, None, kept, _names(fallen), not fallen if wanted else None)


def _cost(text: str, costs: Sequence[Row], met: str, figure: Callable[[Row], float], most: float) -> Row:
    rows = [row for row in costs if row[met] is not None]
    broken = [row for row in rows if not row[met]]
    worst = max(map(figure, rows), default=None)
    kept = f"{len(rows) - len(broken)} of {len(rows)}"
    return _goal_row(text, most, worst, kept, _names(broken), not broken if rows else None)


def _share_of_limit(row: Row) -> float:
    return row["total_s"] / row["limit_s"]


def _names(rows: Sequence[Row]) -> str | None:
    return ", ".join(f"{row['model']} {row['studs']}" for row in rows) or None


def exponent(costs: Sequence[Row]) -> float | None:
    """Fit the power of the must cells that the CPU seconds of the layout grow with.

    Parameters
    ----------
    costs : sequence of Row
        ``model``, ``required`` and ``layout`` of each case.

    Returns
    -------
    float or None
        The same power for all models, each with a factor of its own; None
        where no model was built at two sizes.
    """
    models, row = np.unique([each["model"] for each in costs], return_inverse=True)
    cells = np.log([each["must"] for each in costs])
    seconds = np.log([each["layout"] for each in costs])
    count = np.bincount(row, minlength=len(models))
    cells, seconds = (each - (np.bincount(row, each) / count)[row] for each in (cells, seconds))
    spread = float(cells @ cells)
    return float(cells @ seconds) / spread if spread > 0 else None
