"""Supports of every kind against full columns under what needs support, and which bricks they take.

References
----------
Paper, Table 2 (bricks of supports) and Table 4 (weight and number of support bricks).
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.supports.beams import beams
from legorize_addon.core.supports.boxes import OUTSIDE_COLOUR, Boxes, bricks_of_boxes, merge_upwards
from legorize_addon.core.supports.columns import columns, pillars
from legorize_addon.core.supports.demand import Demand, support_demand
from legorize_addon.core.supports.tree import tree
from scripts.benchmarks.clock import least_seconds
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table
from scripts.research.full_columns import full_columns
from tests.core.overhanging import overhanging

FIXTURE_SIZE: Final = 400.0
"""Of the four fixtures in mm; they are scaled to the width anyway."""

BRICKS, MASS = 0.45, 0.5
"""Goals: shares of the bricks and of the weight of full columns that trees take in the median."""

QUICK: Final = 1.0
"""Goal: CPU seconds for supports of any kind."""

REFERENCE, SPARSE, BUILT = "full", "sparse", "tree as built"
"""Kinds that are compared: the last is what the product puts under the model, until all stands and bears."""

Made = dict[str, tuple[Bricks, float]]


@dataclass(frozen=True, slots=True, eq=False)
class Supported:
    """One model with supports of every kind.

    Attributes
    ----------
    model : str
    need : Demand
    made : dict
        Bricks of each kind, and the CPU seconds that they took; those of what is
        built take in the building order and all its checks.
    """

    model: str
    need: Demand
    made: Made


def measure(paths: Sequence[Path], *, width: int, repeats: int) -> list[Table]:
    """Put supports of every kind under every model and four fixtures.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    repeats : int
        Runs, of which the least time counts.

    Returns
    -------
    list of Table
        The paper's Table 4, what it says of trees, and Table 2 as counts and as
        percentages of volume.
    """
    catalogue = load_catalogue()
    found = []
    for name, mesh in with_fixtures(paths):
        print(f"{name}, {width} studs", file=sys.stderr, flush=True)
        found.append(supported(name, mesh, width=width, repeats=repeats, catalogue=catalogue))
    facts = [_facts(each, catalogue) for each in found]
    counts, shares = kinds_of_bricks(found, catalogue)
    against = (
        f"Trees as built at {width} studs against full columns under the needed overhang alone: in the median at most "
        f"{BRICKS} of their bricks and {MASS} of their weight, never more bricks than sparse pillars, below {QUICK:g} s"
    )
    return [
        Table("supports_table_4", f"Table 4: supports at {width} studs", tuple(row for rows in facts for row in rows)),
        Table("supports_trees", against, tuple(_against(found, facts))),
        Table("supports_table_2", "Table 2: number of each support brick, studs x studs x plates", counts),
        Table("supports_table_2_volume", "Table 2 in percent of the supports' volume", shares),
    ]


def supported(name: str, mesh: TriangleMesh, *, width: int, repeats: int, catalogue: Catalogue) -> Supported:
    """Build a model, and supports of every kind under it.

    Parameters
    ----------
    name : str
    mesh : TriangleMesh
    width, repeats : int
        As for :func:`measure`.
    catalogue : Catalogue

    Returns
    -------
    Supported
    """
    build = legorize(mesh, Settings(width=width, supports="tree"))
    need = support_demand(Assembly(build.bricks, catalogue), deepest=build.settings.hanging)
    ways = _ways(need, catalogue)
    taken = least_seconds(*ways.values(), repeats=repeats)
    made = {way: (_white(make(), catalogue), s) for (way, make), s in zip(ways.items(), taken, strict=True)}
    return Supported(name, need, made | {BUILT: (build.supports.removed, build.timings["supports"])})


def with_fixtures(paths: Sequence[Path]) -> Iterator[tuple[str, TriangleMesh]]:
    """Yield every model with its name, and the four fixtures with overhangs."""
    for path in paths:
        yield path.stem, read_mesh(path)
    yield from overhanging(FIXTURE_SIZE).items()


def _ways(need: Demand, catalogue: Catalogue) -> dict[str, Callable[[], Boxes]]:
    """Return what makes supports of each kind; all but sparse pillars take tall bricks where they can."""
    contacts = need.contacts.tolist()
    free = np.zeros(len(need.contacts), dtype=bool)

    def tall(boxes: Boxes) -> Boxes:
        return merge_upwards(boxes, catalogue, OUTSIDE_COLOUR)

    return {
        REFERENCE: lambda: tall(full_columns(need.cells, need.room)),
        SPARSE: lambda: pillars(contacts),
        "columns": lambda: tall(columns(contacts, need.room)),
        "beams": lambda: tall(beams(need.cells, need.room)),
        "tree": lambda: tall(tree(need.contacts, need.load, need.room, straight=free)),
    }


def _white(boxes: Boxes, catalogue: Catalogue) -> Bricks:
    return bricks_of_boxes(boxes, catalogue, colour=OUTSIDE_COLOUR, role=Role.SUPPORT_OUTSIDE)


def _facts(each: Supported, catalogue: Catalogue) -> list[Row]:
    """Return weight and number of the bricks of every kind."""
    rows: list[Row] = []
    for way, (bricks, seconds) in each.made.items():
        rows.append(
            {
                "model": each.model,
                "needing_bricks": len(each.need.bricks),
                "needing_cells": len(each.need.cells),
                "contacts": len(each.need.contacts),
                "supports": way,
                "weight_g": float(catalogue.mass[bricks.part].sum()),
                "bricks": len(bricks),
                "cpu_s": seconds,
            }
        )
    return rows


def _against(found: Sequence[Supported], facts: Sequence[list[Row]]) -> list[Row]:
    """Compare what is built with full columns and sparse pillars; add the medians of the models that need any."""
    rows: list[Row] = []
    for each, made in zip(found, facts, strict=True):
        way = {str(row["supports"]): row for row in made}
        needs = len(each.need.contacts) > 0
        shares = {name: way[BUILT][name] / way[REFERENCE][name] if needs else None for name in ("bricks", "weight_g")}
        rows.append(
            {
                "model": each.model,
                "tree_bricks_to_full": shares["bricks"],
                "tree_weight_to_full": shares["weight_g"],
                "tree_bricks_to_sparse": way[BUILT]["bricks"] / way[SPARSE]["bricks"] if needs else None,
                "cpu_s": way[BUILT]["cpu_s"],
                "met": way[BUILT]["bricks"] <= way[SPARSE]["bricks"] and way[BUILT]["cpu_s"] < QUICK,
            }
        )
    wanting = [row for row in rows if row["tree_bricks_to_full"] is not None]
    medians: Row = {
        name: float(np.median([row[name] for row in wanting])) if wanting else None for name in list(rows[0])[1:-1]
    }
    met = None if not wanting else medians["tree_bricks_to_full"] <= BRICKS and medians["tree_weight_to_full"] <= MASS
    return [*rows, {"model": "median", **medians, "met": met}]


def kinds_of_bricks(found: Sequence[Supported], catalogue: Catalogue) -> tuple[tuple[Row, ...], tuple[Row, ...]]:
    """Return the number of each size of brick by model and kind, and its percentage of the volume."""
    # no support is a corner, which has the same sides as a square
    rows = [row for row, part in enumerate(catalogue.parts) if part.use == "model" and not part.corner]
    sizes = np.array([(part.width, part.length, part.height) for part in catalogue.parts])[rows]
    volume, names = sizes.prod(axis=1), ["x".join(map(str, size)) for size in sizes.tolist()]
    counts: list[Row] = []
    shares: list[Row] = []
    for each in found:
        for way, (bricks, _) in each.made.items():
            n = np.bincount(bricks.part, minlength=len(catalogue.parts))[rows]
            percent = (100 * n * volume / max(n @ volume, 1)).tolist() if len(bricks) else [None] * len(names)
            named: Row = {"model": each.model, "supports": way}
            counts.append(named | dict(zip(names, n.tolist(), strict=True)))
            shares.append(named | dict(zip(names, percent, strict=True)))
    taken = ["model", "supports", *(name for name in names if any(row[name] for row in counts))]
    return (
        tuple({name: row[name] for name in taken} for row in counts),
        tuple({name: row[name] for name in taken} for row in shares),
    )
