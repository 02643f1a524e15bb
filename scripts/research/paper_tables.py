"""The paper's Tables 1 to 4 of the same models in one run: our ways, its own, and those that it compares with.

References
----------
Paper, Table 1 (volumes of bricks), Table 2 (volumes of support bricks), Table 3
(hollow ratio, number of bricks, time) and Table 4 (weight and number of support
bricks).
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay_learned import lay_learned
from legorize_addon.core.layout.problem.problem import owners, with_margins
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY, SUPPORTS, Bricks, Role
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.model.contacts import ContactGraph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.presets import preset_values
from legorize_addon.core.settings import Settings
from legorize_addon.core.shell.cohesion import make_cohesive
from legorize_addon.core.shell.hollowing import hollow
from scripts.benchmarks.kept import Kept
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.supports import BUILT, Supported, kinds_of_bricks, supported
from scripts.benchmarks.tables import Row, Table
from scripts.research.baselines import Lay
from scripts.research.claim_figures import Given, claim_figures
from scripts.research.claims import claims
from scripts.research.laying import Laid, timed
from scripts.research.layout_goals import ANNEALED, GREEDY, SEARCHED, STAGGERED
from scripts.research.layouts import METHODS, OWN, RULES, hollowed, manifest_version, ours
from scripts.research.volumes import volume_rows

PAPER_RULE, NO_OPTIONAL = "paper's rule", "ours, nothing optional"

LEARNED: Final = "learned"

FIELD: Final = (GREEDY, STAGGERED, SEARCHED, ANNEALED)
"""Methods that the paper compares with: B1 to B4."""

TITLES: Final = {
    "tables_1": "Table 1: volumetric percentages of the bricks, by part and colour; default, without supports",
    "tables_2": "Table 2: volumetric percentages of the support bricks as built",
    "tables_2_counts": "Table 2 in numbers of bricks",
    "tables_3": "Table 3: hollow ratio, bricks and CPU seconds of every method; grams and bricks against our rule",
    "tables_4": "Table 4: weight and number of support bricks by kind; models without supports are left out",
    "tables_4_built": "Supports of the finished build: those that are taken out, and those that stay",
    "tables_claim_figures": "What the claims need beside the tables",
    "tables_claims": "The paper's claims H1 to H13 as goals",
    "tables_run": "How it was measured",
}


@dataclass(frozen=True, slots=True)
class Options:
    """What is measured (see :func:`measure`)."""

    width: int
    seed: int
    repeats: int


def measure(paths: Sequence[Path], *, width: int, seed: int, repeats: int, minutes: float, out: Path) -> list[Table]:
    """Make all four tables.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    width : int
        Studs along the longer horizontal side.
    seed : int
        Of everything random.
    repeats : int
        Runs of each method, of which the fastest counts.
    minutes : float
        After which no model is begun; 0 for no limit.
    out : Path
        For what is measured of each model, which the next run of the same program takes over.

    Returns
    -------
    list of Table
        None if there was no time for any model.
    """
    options = Options(width, seed, repeats)
    rows: dict[str, list[Row]] = {name: [] for name in TITLES}
    kept = Kept(out / "tables", minutes)
    for path in paths:
        for [made] in [kept.row(f"{path.stem}-{width}-{seed}-{repeats}", partial(_texts, path, options)) or [{}]]:
            for name, text in made.items():
                rows[name] += json.loads(str(text))
    kept.tell_left()
    if not rows["tables_3"]:
        return []
    rows["tables_run"] = [{"legorize": manifest_version(), "width": width, "seed": seed, "repeats": repeats}]
    rows["tables_claims"] = claims(
        rows["tables_3"], rows["tables_1"], rows["tables_4"], rows["tables_claim_figures"], FIELD
    )
    return [Table(name, TITLES[name], tuple(same_columns(rows[name]))) for name in TITLES if rows[name]]


def same_columns(rows: Sequence[Row]) -> list[Row]:
    """Return rows that all have the columns of all: a model has no supports of the kinds that it does not use."""
    columns = dict.fromkeys(name for row in rows for name in row)
    return [{name: row.get(name, 0) for name in columns} for row in rows]


def _texts(path: Path, options: Options) -> Row:
    """Return the rows of a model as JSON, by table."""
    print(f"{path.stem}, {options.width} studs", file=sys.stderr, flush=True)
    return {name: json.dumps(made) for name, made in case(path.stem, read_mesh(path), options).items()}


def case(name: str, mesh: TriangleMesh, options: Options) -> dict[str, list[Row]]:
    """Return the rows of one model by table."""
    catalogue, start = load_catalogue(), Row(model=name, studs=options.width)
    build = legorize(mesh, Settings(width=options.width, seed=options.seed))
    model = build.bricks.take(~np.isin(build.bricks.role, SUPPORTS))
    rows = {"tables_1": volume_rows(start, model, catalogue), "tables_3": table_3(start, mesh, build, options)}
    made = supported(name, mesh, width=options.width, repeats=options.repeats, catalogue=catalogue)
    if any(len(bricks) for bricks, _ in made.made.values()):
        rows |= {"tables_2": [], "tables_2_counts": [], "tables_4": table_4(start, made, catalogue)}
        counts, shares = kinds_of_bricks([replace(made, made={BUILT: made.made[BUILT]})], catalogue)
        rows["tables_2"], rows["tables_2_counts"] = list(shares), list(counts)
    rows["tables_claim_figures"] = [claim_figures(start, given(mesh, build, options))]
    return rows | {"tables_4_built": built_supports(start, build, catalogue)}


def given(mesh: TriangleMesh, build: Build, options: Options) -> Given:
    """Return what the claims are measured on."""
    settings = in_bricks(options)
    shells = shells_of(legorize(mesh, settings).grid, settings)
    return Given(mesh, build, shells[OWN], shells[NO_OPTIONAL], ours("standard"), METHODS[GREEDY])


def in_bricks(options: Options) -> Settings:
    """Return the settings of the cells that all methods lay."""
    return Settings(width=options.width, seed=options.seed, plates="none", layout="fast")


def table_3(start: Row, mesh: TriangleMesh, build: Build, options: Options) -> list[Row]:
    """Return a row for each method, with what it weighs and how many bricks it has against the standard tier."""
    catalogue = load_catalogue()
    settings = in_bricks(options)
    grid = legorize(mesh, settings).grid
    run = partial(timed, catalogue=catalogue, seed=options.seed, repeats=options.repeats)
    found: list[tuple[Row, Laid]] = []
    shells = shells_of(grid, settings)
    for method, shown, rule in methods():
        found.append(({"method": shown, "hollowing": rule}, run(method, shells[rule])))
    base = found[0][1]
    rows = [
        start | {"parts": "bricks"} | named | figures(laid.bricks, laid.links, grid, catalogue)
        | {"faults": laid.faults, "tc_s": laid.seconds} | against(laid.bricks, base.bricks, catalogue)
        for named, laid in found
    ]  # fmt: skip
    published = legorize(mesh, Settings(**preset_values("paper") | {"width": options.width, "seed": options.seed}))
    return [*rows, *(start | whole_build(name, each, catalogue) for name, each in _builds(build, published))]


def _builds(build: Build, published: Build) -> Iterator[tuple[str, Build]]:
    yield "default, whole build", build
    yield "as published, whole build", published


def methods() -> Iterator[tuple[Lay, str, str]]:
    """Yield what lays, what it is called, and the rule that hollows for it; ours comes first."""
    yield ours("standard"), "standard", OWN
    yield ours("standard"), "standard", NO_OPTIONAL
    yield ours("standard"), "standard", PAPER_RULE
    yield by_machine, LEARNED, OWN
    yield by_machine, LEARNED, PAPER_RULE
    for method in FIELD:
        yield METHODS[method], method, RULES[method]
    # the same cells for all
    for method in FIELD:
        yield METHODS[method], method, NO_OPTIONAL


def by_machine(grid: UnitGrid, catalogue: Catalogue, rng: np.random.Generator) -> Bricks:
    """Return the learned fill, joined as the other tiers."""
    return add_ties(lay_learned(grid, catalogue, rng=rng), grid, catalogue, plates=False)[0]


def shells_of(grid: UnitGrid, settings: Settings) -> dict[str, UnitGrid]:
    """Return a solid model hollowed by each rule."""
    found = hollowed(grid, settings)
    upper = hollow(grid, shell=settings.shell, rule="upper", ceilings=settings.ceilings)
    return found | {
        NO_OPTIONAL: required_alone(found[OWN]),
        PAPER_RULE: make_cohesive(upper, plates=False),
    }


def required_alone(shell: UnitGrid) -> UnitGrid:
    """Return a grid without its optional cells."""
    required = shell.cover == Fill.REQUIRED
    return replace(
        shell,
        cover=np.where(required, shell.cover, np.uint8(Fill.EMPTY)),
        colour=np.where(required, shell.colour, np.int16(COLOUR_EMPTY)),
    )


def figures(bricks: Bricks, links: ContactGraph, grid: UnitGrid, catalogue: Catalogue) -> Row:
    """Return the figures of Table 3: hollow ratio, bricks, grams, and whether it hangs together."""
    solid = with_margins(grid.solid, False)
    filled = int(((owners(links, solid.shape) != NOBODY) & solid).sum())
    return {
        "hor": 1 - filled / int(solid.sum()),
        "nb": len(bricks),
        "mass_g": float(catalogue.mass[bricks.part].sum()),
        "components": links.n_components,
        "floating": links.n_floating,
    }


def against(bricks: Bricks, base: Bricks, catalogue: Catalogue) -> Row:
    """Return how many bricks and grams more there are than in our layout with our rule."""
    mass = [float(catalogue.mass[each.part].sum()) for each in (bricks, base)]
    return {"more_bricks": len(bricks) - len(base), "more_g": mass[0] - mass[1]}


def whole_build(name: str, build: Build, catalogue: Catalogue) -> Row:
    """Return a row of Table 3 for a finished build; its time is that of the layout and of what makes it hold."""
    support = np.isin(build.bricks.role, SUPPORTS)
    model = Assembly(build.bricks.take(~support), catalogue)
    stages = ("layout", "ties", "strengthening", "stability", "bracing")
    rule = PAPER_RULE if build.settings.hollow_rule == "upper" else OWN
    return {
        "parts": "bricks" if build.settings.plates == "none" else "bricks and plates",
        "method": name,
        "hollowing": rule,
        **figures(model.bricks, model.graph, build.grid, catalogue),
        # what stands on supports that stay is not in the air
        "components": build.graph.n_components,
        "floating": build.graph.n_floating,
        "faults": 0,
        "tc_s": sum(build.timings.get(stage, 0.0) for stage in stages),
        "more_bricks": None,
        "more_g": None,
    }


def table_4(start: Row, made: Supported, catalogue: Catalogue) -> list[Row]:
    """Return weight and number of the support bricks of every kind, on the same contacts but for those as built."""
    return [
        start
        | {
            "supports": way,
            "weight_g": float(catalogue.mass[bricks.part].sum()),
            "bricks": len(bricks),
            "cpu_s": seconds,
        }
        for way, (bricks, seconds) in made.made.items()
        if len(bricks)
    ]


def built_supports(start: Row, build: Build, catalogue: Catalogue) -> list[Row]:
    """Return how many support bricks are taken out and how many stay, inside and outside; a row for what there is."""
    stays = {"stay inside": Role.SUPPORT_INSIDE, "stay outside": Role.SUPPORT_KEPT}
    tables = {"taken out": build.supports.removed}
    tables |= {name: build.bricks.take(build.bricks.role == role) for name, role in stays.items()}
    return [
        start | {"supports": name, "weight_g": float(catalogue.mass[bricks.part].sum()), "bricks": len(bricks)}
        for name, bricks in tables.items()
        if len(bricks)
    ]
