"""Layouts of the field and ours: on the same cells, with the hollowing of each, and against a living peer.

References
----------
Paper, Table 1 (volumetric percentages of the bricks) and Table 3 (hollow ratio,
number of bricks and time of each method).
"""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import Final

import numpy as np

from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay import lay, lay_unjoined
from legorize_addon.core.layout.learning.svm import NO_EXCHANGES
from legorize_addon.core.layout.problem.problem import owners, with_margins
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.shell.cohesion import make_cohesive
from legorize_addon.core.shell.hollowing import hollow
from scripts.benchmarks.clock import least_seconds
from scripts.benchmarks.layout_figures import colours_lost, fewest_singles
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table
from scripts.research import annealing, merging, staggering, tiling
from scripts.research.baselines import Lay, at_once, shell_of, upwards
from scripts.research.laying import Laid, cells_of, figures, timed
from scripts.research.layout_goals import (
    ANNEALED,
    FAST,
    FASTER,
    FEWER,
    GREEDY,
    RANDOM,
    SEARCHED,
    SEARCHED_FEW,
    STAGGERED,
    STANDARD,
    UNLEARNED,
    goals_met,
)
from scripts.research.peer import STRATEGIES, laid_by_peer
from scripts.research.rules import by_key, largest_in_rows
from scripts.research.seams import EQUAL, FEW
from scripts.research.volumes import count_rows, volume_rows

MANIFEST: Final = Path(__file__).resolve().parents[2] / "blender_manifest.toml"

LEAN: Final = "no_corners"
"""Standard without corner parts, which the peer does not have."""

SHELL, COLUMNS, OWN = "shell of 2", "shell of 1 and columns", "ours"


def ours(tier: str, *, learned: bool = True, join: bool = True) -> Lay:
    """Return our own way of laying, perhaps without joining what floats in the end."""

    def laid(grid: UnitGrid, catalogue: Catalogue, rng: np.random.Generator) -> Bricks:
        if not join:
            return lay_unjoined(grid, catalogue, rng=rng, tier=tier)
        bricks = lay(grid, catalogue, rng=rng, tier=tier, exchanges=None if learned else NO_EXCHANGES)
        return add_ties(bricks, grid, catalogue, plates=False)[0]

    return laid


METHODS: Final[Mapping[str, Lay]] = MappingProxyType(
    {
        RANDOM: at_once(merging.merged),
        GREEDY: at_once(by_key(largest_in_rows)),
        STAGGERED: upwards(staggering.staggered),
        SEARCHED: upwards(tiling.tiled),
        SEARCHED_FEW: upwards(partial(tiling.tiled, weights=FEW)),
        ANNEALED: upwards(annealing.annealed),
        UNLEARNED: ours("fast", learned=False),
        FAST: ours("fast"),
        STANDARD: ours("standard"),
    }
)

RULES: Final[Mapping[str, str]] = MappingProxyType(
    {name: SHELL for name in METHODS if name != UNLEARNED} | {ANNEALED: COLUMNS, FAST: OWN, STANDARD: OWN}
)
"""Hollowing of each method in Table 3."""


TITLES: Final = MappingProxyType(
    {
        "layouts": "The same cells (a shell of two), colours and parts by every method; tc_s with verification",
        "table_3": "Table 3: hollow ratio, number of bricks and time of every method, hollowed by its own rule",
        "table_1": "Table 1: volumetric percentages of the bricks, standard tier",
        "table_1_counts": "Table 1 in numbers of bricks",
        "layouts_peer": f"The peer on the same cells, laying alone, and with all that makes it hold (whole, joined): "
        f"at least {FEWER:.0%} fewer bricks and {FASTER:g} times less CPU",
    }
)


@dataclass(frozen=True, slots=True)
class Options:
    """What is measured (see :func:`measure`)."""

    width: int
    repeats: int
    seed: int
    peer: Path | None
    peer_limit: float


def measure(
    paths: Sequence[Path], *, width: int, repeats: int, seed: int, peer: Path | None, peer_limit: float
) -> list[Table]:
    """Lay every model by every method.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    repeats : int
        Runs of each method, of which the fastest counts.
    seed : int
        Of everything random.
    peer : Path or None
        Python of the environment with the peer, which else is left out.
    peer_limit : float
        Seconds that the whole run of the peer may take; 0 leaves it out.

    Returns
    -------
    list of Table
        The same cells by every method; Table 3 and Table 1 with counts; the
        peer; goals; and how all of it was measured.
    """
    options = Options(width, repeats, seed, peer, peer_limit)
    cases = [case(path, options) for path in paths]
    rows = {name: tuple(row for each in cases for row in each[name]) for name in cases[0]}
    tables = [Table(name, TITLES[name], rows[name]) for name in rows if rows[name]]
    goals = goals_met(rows["layouts"], rows["table_3"], rows["table_1"], rows["layouts_peer"])
    return [
        *tables,
        Table("layouts_goals", "The goals; worst and mean over all models", tuple(goals)),
        Table("layouts_run", "How it was measured", (parameters(options),)),
    ]


def case(path: Path, options: Options) -> dict[str, list[Row]]:
    """Return the rows of one model by table."""
    print(f"{path.stem}, {options.width} studs", file=sys.stderr, flush=True)
    catalogue = load_catalogue()
    settings = Settings(width=options.width, layout="fast", seed=options.seed, plates="none")
    grid = legorize(read_mesh(path), settings).grid
    shells = hollowed(grid, settings)
    run = partial(timed, catalogue=catalogue, seed=options.seed, repeats=options.repeats)
    same = {name: run(way, shells[SHELL]) for name, way in METHODS.items()}
    own = {name: same[name] if rule == SHELL else run(METHODS[name], shells[rule]) for name, rule in RULES.items()}
    start: Row = {"model": path.stem, "studs": options.width}
    fewest = lower_bound(shells[SHELL], catalogue)
    head: Row = start | {"cells": cells_of(shells[SHELL]), "bound": fewest}
    best = own[STANDARD].bricks
    peers = against_peer(shells[SHELL], same[STANDARD], options) if options.peer else []
    return {
        "layouts": [head | {"method": name} | compared(each, fewest, catalogue) for name, each in same.items()],
        "table_3": [start | table_3(name, own[name], grid, shells[RULES[name]], catalogue) for name in RULES],
        "table_1": volume_rows(start, best, catalogue),
        "table_1_counts": count_rows(start, best, catalogue),
        "layouts_peer": [start | row for row in peers],
    }


def hollowed(grid: UnitGrid, settings: Settings) -> dict[str, UnitGrid]:
    """Return a solid model hollowed by each rule."""
    own = hollow(grid, shell=settings.shell, rule=settings.hollow_rule, ceilings=settings.ceilings)
    return {
        SHELL: shell_of(grid, 2, columns=False),
        COLUMNS: shell_of(grid, 1, columns=True),
        OWN: make_cohesive(own, plates=False),
    }


def compared(laid: Laid, fewest: int, catalogue: Catalogue) -> Row:
    """Return how good a layout is."""
    n = len(laid.bricks)
    return {"bricks": n, "to_bound": n / fewest} | figures(laid, catalogue)


def table_3(name: str, laid: Laid, grid: UnitGrid, shell: UnitGrid, catalogue: Catalogue) -> Row:
    """Return a row of the paper's Table 3, with the figures that tell what its numbers are worth."""
    solid = with_margins(grid.solid, False)
    filled = int(((owners(laid.links, solid.shape) != NOBODY) & solid).sum())
    _, lost = colours_lost(grid, laid.bricks, laid.links)
    return {
        "method": name,
        "hollowing": RULES[name],
        "hor": 1 - filled / int(solid.sum()),
        "nb": len(laid.bricks),
        **figures(laid, catalogue),
        "forced_single": fewest_singles(laid.bricks, shell, catalogue),
        "visible_lost": lost,
    }


def without_corners(catalogue: Catalogue) -> Catalogue:
    """Return the catalogue as if corner parts were made in no colour."""
    corner = np.array([part.corner for part in catalogue.parts])
    return replace(catalogue, exists=catalogue.exists & ~corner[:, None])


def against_peer(shell: UnitGrid, joined: Laid, options: Options) -> list[Row]:
    """Return a row for each strategy of the peer, beside what we take for the same.

    Parameters
    ----------
    shell : UnitGrid
        Cells to build.
    joined : Laid
        The standard tier, with everything that makes it hold.
    options : Options

    Returns
    -------
    list of dict
        Bricks and CPU seconds of the bare laying, and with what makes the bricks hold.
    """
    catalogue = load_catalogue()
    rows: Row = {}
    for name, tier, parts in (
        (FAST, FAST, catalogue),
        (STANDARD, STANDARD, catalogue),
        (LEAN, STANDARD, without_corners(catalogue)),
    ):
        n, seconds = alone(ours(tier, join=False), shell, parts, options)
        rows |= {f"{name}_bricks": n, f"{name}_s": seconds}
    rows |= {"joined_bricks": len(joined.bricks), "joined_s": joined.seconds}
    return [peer_row(strategy, shell, rows, options) for strategy in STRATEGIES]


def alone(way: Lay, shell: UnitGrid, catalogue: Catalogue, options: Options) -> tuple[int, float]:
    """Return the number of bricks that a method lays, and its seconds without any verification."""
    counts: list[int] = []
    rng = partial(np.random.default_rng, options.seed)
    [seconds] = least_seconds(lambda: counts.append(len(way(shell, catalogue, rng()))), repeats=options.repeats)
    return counts[-1], seconds


def peer_row(strategy: str, shell: UnitGrid, own: Row, options: Options) -> Row:
    """Return what the peer made of the cells, and how much less we take."""
    bare = laid_by_peer(options.peer, shell, strategy, "bare")
    limit = options.peer_limit
    whole = laid_by_peer(options.peer, shell, strategy, "whole", limit) if limit else None
    row: Row = {"cells": cells_of(shell), "strategy": strategy, "peer": bare["version"]}
    row |= {f"peer_{name}": bare[name] for name in ("bricks", "seconds", "floating")} | own
    for name in (FAST, STANDARD, LEAN):
        row[f"{name}_fewer"] = 1 - own[f"{name}_bricks"] / bare["bricks"]
        row[f"{name}_faster"] = bare["seconds"] / own[f"{name}_s"]
    row |= {f"whole_{name}": whole and whole[name] for name in ("bricks", "seconds", "floating")}
    row["joined_fewer"] = whole and 1 - own["joined_bricks"] / whole["bricks"]
    return row | {"joined_faster": whole and whole["seconds"] / own["joined_s"]}


def manifest_version() -> str:
    """Return the version of the add-on."""
    return str(tomllib.loads(MANIFEST.read_text(encoding="utf-8"))["version"])


def parameters(options: Options) -> Row:
    """Return what the figures depend on."""
    return {
        "legorize": manifest_version(),
        "width": options.width,
        "repeats": options.repeats,
        "seed": options.seed,
        "open_tilings": tiling.OPEN,
        "weights": str(EQUAL),
        "weights_few": str(FEW),
        "annealing_moves": annealing.MOVES,
        "annealing_temperatures": f"{annealing.HOT} to {annealing.COLD}",
        "bridge": staggering.BRIDGE,
        "coincide": staggering.COINCIDE,
        "peer_limit_s": options.peer_limit if options.peer else None,
    }
