"""The report of the learned fill: what its samples are, what learning adds, and what comes of it in a build.

Every figure is kept as it comes (see :mod:`scripts.benchmarks.kept`), so that a report
that was stopped goes on where it was.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache, partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from legorize_addon.core.drafting import draft_model
from legorize_addon.core.layout.joining.ties import add_ties
from legorize_addon.core.layout.lay_learned import lay_learned
from legorize_addon.core.layout.learning.grading import read_graded
from legorize_addon.core.measures.lower_bound import lower_bound
from legorize_addon.core.model import contact_graph
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.settings import Settings
from scripts.benchmarks.kept import Kept
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table
from scripts.research.fill_controls import Fill, Filled, controls, in_way, ways
from scripts.research.training_models import KINDS, UNSEEN, WIDTHS, built

HELD_BACK: Final = 4
"""Models of each kind that are made by chance for the report."""

Make = Callable[[], UnitGrid]
"""Makes a model when it is needed, and only once."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What is reported.

    Attributes
    ----------
    paths : tuple of Path
        Model files.
    widths : tuple of int
        Sizes in studs in which all ways lay them.
    joined : tuple of int
        Further sizes in which the learned fill alone lays them.
    each : int
        Models of each kind that are made by chance.
    """

    paths: tuple[Path, ...]
    widths: tuple[int, ...]
    joined: tuple[int, ...]
    each: int


def judged_fill(asked: Asked, text: str, kept: Kept) -> Iterator[Table]:
    """Lay models that were not trained on in all ways.

    Parameters
    ----------
    asked : Asked
    text : str
        File of samples.
    kept : Kept
        For what is measured.

    Yields
    ------
    Table
        What the samples are; all ways over the files of each size, over all files, and over the models made by chance;
        and all models as they are joined in a build. A table of which something is missing is left out.
    """
    yield of_samples(text)
    files = {width: {f"{path.stem} {width}": cache(partial(of_file, path, width)) for path in asked.paths}
             for width in (*asked.widths, *asked.joined)}  # fmt: skip
    # the small ones: sizes follow the seeds
    seeds = range(UNSEEN, UNSEEN + asked.each * len(WIDTHS), len(WIDTHS))
    chance = {f"{kind} {seed}": cache(partial(of_chance, kind, seed)) for kind in KINDS for seed in seeds}
    every = {name: make for width in asked.widths for name, make in files[width].items()}
    groups = {("chance", f"held-back models of {WIDTHS[0]} studs made by chance"): chance}
    groups |= {(f"files_{width}", f"model files at {width} studs"): files[width] for width in asked.widths}
    groups["files", f"model files at {', '.join(map(str, asked.widths))} studs"] = every
    fills = ways(text)
    for (name, title), group in groups.items():
        rows = [kept.row(f"{model} bound", partial(_bound, make)) for model, make in group.items()]
        found = {way: [_kept(kept, model, way, make, fill) for model, make in group.items()]
                 for way, fill in fills.items()}  # fmt: skip
        if group and all(rows) and all(map(all, found.values())):
            results = {way: [Filled(**_plain(each)) for [each] in several] for way, several in found.items()}
            yield controls(f"fill_{name}", title, results, [int(str(each["bound"])) for [each] in rows])
    alone = {name: make for width in asked.joined for name, make in files[width].items()}
    yield from joined({**chance, **every, **alone}, kept)


def _plain(row: Row) -> dict[str, Any]:
    return dict(row)


def _kept(kept: Kept, model: str, way: str, make: Make, fill: Fill) -> list[Row]:
    return kept.row(f"{model} {way}".replace(":", ""), lambda: dict(asdict(in_way(fill, make()))))


def of_file(path: Path, width: int) -> UnitGrid:
    """Return the model of a file as the layout meets it."""
    return draft_model(read_mesh(path), Settings(width=width)).hollow


def of_chance(kind: str, seed: int) -> UnitGrid:
    """Return a model made by chance as the layout meets it."""
    return built(kind, seed)[0]


def _bound(make: Make) -> Row:
    return {"bound": lower_bound(make(), load_catalogue())}


def of_samples(text: str) -> Table:
    """Return what the samples of a file are: how many differ, and how many have two labels."""
    samples, facts = read_graded(text)
    kinds, kind = np.unique(samples.energies, axis=0, return_inverse=True)
    labels = np.unique(np.column_stack([kind.reshape(-1), samples.grade]), axis=0)
    line: Row = {
        "samples": len(samples.grade),
        "distinct": len(kinds),
        "with_two_labels": len(labels) - len(kinds),
        "models": len(np.unique(samples.model)),
        "C": facts["C"],
        "gamma": facts["gamma"],
        "cross_validation": facts["cross-validation"],
        "confusion": facts["confusion"],
    }
    return Table("fill_samples", "Samples and training", (line,))


def joined(models: Mapping[str, Make], kept: Kept) -> Iterator[Table]:
    """Yield the tables of models laid by the shipped machine and joined as in a build; seconds are the processor's."""
    found = [row for name, make in models.items() for row in kept.row(f"{name} joined", partial(_joined, name, make))]
    if not found or len(found) < len(models):
        return
    yield Table("fill_joined", "Joined, as in a build", tuple(found))
    most = max(found, key=_bricks)
    yield Table("fill_summary", "The learned fill over all models, joined as in a build", (summary(found, most),))


def _bricks(row: Row) -> int:
    return int(str(row["bricks"]))


def summary(rows: Sequence[Row], most: Row) -> Row:
    """Return the figures of all models in one line."""
    ratio, pace = (np.array([float(str(row[name])) for row in rows]) for name in ("to_bound", "s_per_1000"))
    return {
        "models": len(rows),
        "to_bound_median": float(np.median(ratio)),
        "to_bound_most": float(ratio.max()),
        "in_the_air": sum(int(str(row["in_the_air"])) for row in rows),
        "s_per_1000_median": float(np.median(pace)),
        "s_per_1000_most": float(pace.max()),
        "most_bricks": most["bricks"],
        "their_seconds": most["seconds"],
    }


def _joined(name: str, make: Make) -> Row:
    grid, catalogue = make(), load_catalogue()
    start = time.process_time()
    bricks = lay_learned(grid, catalogue, rng=np.random.default_rng(0))
    seconds = time.process_time() - start
    bricks, _ = add_ties(bricks, grid, catalogue, plates=True)
    graph = contact_graph(bricks, catalogue)
    return {
        "model": name,
        "bricks": len(bricks),
        "to_bound": len(bricks) / lower_bound(grid, catalogue),
        "components": graph.n_components,
        "in_the_air": graph.n_floating,
        "seconds": seconds,
        "s_per_1000": 1000 * seconds / len(bricks),
    }
