"""What the paper's tables and claims need of one model, in parts that are measured one by one."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property, partial
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
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.supports import BUILT, Supported, kinds_of_bricks, supported
from scripts.benchmarks.tables import Row
from scripts.research.baselines import Lay
from scripts.research.claim_figures import FIGURES, Given
from scripts.research.laying import timed
from scripts.research.layout_goals import ANNEALED, GREEDY, SEARCHED, STAGGERED
from scripts.research.layouts import METHODS, OWN, RULES, hollowed, ours
from scripts.research.volumes import volume_rows

PAPER_RULE, NO_OPTIONAL = "paper's rule", "ours, nothing optional"

LEARNED: Final = "learned"

FIELD: Final = (GREEDY, STAGGERED, SEARCHED, ANNEALED)
"""Methods that the paper compares with: B1 to B4."""

Make = Callable[[], dict[str, list[Row]]]
"""Measures rows by table."""


@dataclass(frozen=True, slots=True)
class Options:
    """What is measured (see :func:`~.paper_tables.measure`)."""

    width: int
    seed: int
    repeats: int


@dataclass(frozen=True)
class Case:
    """A model, of which everything is made when it is first needed."""

    path: Path
    options: Options

    @property
    def start(self) -> Row:
        """What every row begins with."""
        return {"model": self.path.stem, "studs": self.options.width}

    @cached_property
    def catalogue(self) -> Catalogue:
        """All parts."""
        return load_catalogue()

    @cached_property
    def mesh(self) -> TriangleMesh:
        """As read."""
        return read_mesh(self.path)

    @cached_property
    def build(self) -> Build:
        """By default."""
        return legorize(self.mesh, Settings(width=self.options.width, seed=self.options.seed))

    @cached_property
    def grid(self) -> UnitGrid:
        """The solid model in bricks, which all methods lay."""
        return legorize(self.mesh, in_bricks(self.options)).grid

    @cached_property
    def shells(self) -> dict[str, UnitGrid]:
        """It hollowed by each rule."""
        return shells_of(self.grid, in_bricks(self.options))

    @cached_property
    def given(self) -> Given:
        """What the claims are measured on."""
        own, required = self.shells[OWN], self.shells[NO_OPTIONAL]
        return Given(self.mesh, self.build, own, required, ours("standard"), METHODS[GREEDY])


def parts(case: Case) -> dict[str, Make]:
    """Return what measures the parts of a model, by name."""
    made: dict[str, Make] = {"bricks": partial(_bricks, case)}
    for method, name, rule in methods():
        made[f"{name}, {rule}"] = partial(_layout, case, method, name, rule)
    made |= {"default": partial(_default, case), "as published": partial(_published, case)}
    made["supports"] = partial(_supports, case)
    for claim, measure in FIGURES.items():
        made[claim] = lambda measure=measure: {"tables_claim_figures": [measure(case.given)]}  # type: ignore[misc]
    return made


def _bricks(case: Case) -> dict[str, list[Row]]:
    """Return Table 1, and the supports as built."""
    model = case.build.bricks.take(~np.isin(case.build.bricks.role, SUPPORTS))
    built = built_supports(case.start, case.build, case.catalogue)
    return {"tables_1": volume_rows(case.start, model, case.catalogue), "tables_4_built": built}


def _layout(case: Case, method: Lay, name: str, rule: str) -> dict[str, list[Row]]:
    """Return a row of Table 3."""
    settings = case.options
    laid = timed(method, case.shells[rule], catalogue=case.catalogue, seed=settings.seed, repeats=settings.repeats)
    found = figures(laid.bricks, laid.links, case.grid, case.catalogue)
    named: Row = {"parts": "bricks", "method": name, "hollowing": rule}
    return {"tables_3": [named | found | {"faults": laid.faults, "tc_s": laid.seconds, "tc_of": "layout"}]}


def _default(case: Case) -> dict[str, list[Row]]:
    return {"tables_3": [whole_build("default, whole build", case.build, case.catalogue)]}


def _published(case: Case) -> dict[str, list[Row]]:
    values = preset_values("paper") | {"width": case.options.width, "seed": case.options.seed}
    build = legorize(case.mesh, Settings(**values))
    return {"tables_3": [whole_build("as published, whole build", build, case.catalogue)]}


def _supports(case: Case) -> dict[str, list[Row]]:
    """Return Tables 2 and 4, of a model with supports."""
    name, options = case.path.stem, case.options
    made = supported(name, case.mesh, width=options.width, repeats=options.repeats, catalogue=case.catalogue)
    if not any(len(bricks) for bricks, _ in made.made.values()):
        return {}
    counts, shares = kinds_of_bricks([replace(made, made={BUILT: made.made[BUILT]})], case.catalogue)
    found = {"tables_2": list(shares), "tables_2_counts": list(counts)}
    return found | {"tables_4": table_4(case.start, made, case.catalogue)}


def in_bricks(options: Options) -> Settings:
    """Return the settings of the cells that all methods lay."""
    return Settings(width=options.width, seed=options.seed, plates="none", layout="fast")


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
        "tc_of": "layout and all that makes it hold",
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
