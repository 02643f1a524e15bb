"""What the paper's claims need beside its tables: one row a model."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.build import Build
from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.surface_samples import horizontal_samples
from scripts.benchmarks.dense import dense_likeliest, dense_samples
from scripts.benchmarks.hollowing import soundness
from scripts.benchmarks.layout_figures import fewest_singles, single
from scripts.benchmarks.meshes import prepared_mesh
from scripts.benchmarks.tables import Row
from scripts.benchmarks.units import SAMPLES_A_VOXEL, Cut, cut_for_grid
from scripts.research.accuracy import accuracy
from scripts.research.baselines import Lay
from scripts.research.cavities import cavities
from scripts.research.fill_controls import LEARNED, SHUFFLED, in_way, ways

Mask = NDArray[np.bool_]

SAMPLES: Final = Path(__file__).resolve().parents[2] / "assets" / "fill_svm.csv"

CHORD: Final = 0.4
"""Chord deviation in mm at which points are counted: that of the preset for the paper."""

TRUTH: Final = 1024
"""Points in a surface voxel that stand for all of its surface."""

ENOUGH: Final = (SAMPLES_A_VOXEL, 24, 32, 48, 64)
"""Points in a surface voxel of which a voxelization takes the fewest that err no more."""

SCATTERINGS: Final = 4
"""Of the samples, whose errors are averaged."""

PIECES: Final = 3
"""Most pieces of a split model."""

CONTROLS: Final = {
    "largest": "largest first",
    "random": "random placements",
    "chance": "search, chance",
    "rule": "search, rule: least J",
    "logistic": "search, logistic regression",
}
"""With what the machine is compared, beside shuffled labels."""


@dataclass(frozen=True, slots=True)
class Given:
    """What has been made of a model for the tables.

    Attributes
    ----------
    mesh : TriangleMesh
    build : Build
        By default.
    own, required : UnitGrid
        Its cells in bricks, hollowed by our rule, with and without optional cells.
    standard, largest : Lay
        Our layout, and largest first.
    """

    mesh: TriangleMesh
    build: Build
    own: UnitGrid
    required: UnitGrid
    standard: Lay
    largest: Lay


def _named(claim: str, figures: Row) -> Row:
    return {f"{claim}_{name}": value for name, value in figures.items()}


def _plain(given: Given) -> Settings:
    return Settings(width=given.build.settings.width, seed=given.build.settings.seed)


def _accuracy(given: Given) -> Row:
    """Return how near bricks and plates come, beside centre points."""
    return _named("h1", accuracy(given.mesh, _plain(given)))


def _inside(given: Given) -> Row:
    """Return what becomes of cavities, and whether hollowing opens a hole."""
    sound = soundness(given.build.grid, given.build.hollow)
    return _named("h10", cavities(given.build)) | _named("h10", sound)


def _points(given: Given) -> Row:
    """Return the points on trajectories against a voxelization's samples, and how often each gives a wrong colour.

    Of the voxelization, so many samples count that it errs no more, if :data:`ENOUGH` are enough.
    """
    settings = _plain(given)
    cut = cut_for_grid(prepared_mesh("model", given.mesh, settings), replace(settings, chord_deviation=CHORD))
    colour = cut.bricks()
    solid = colour != COLOUR_EMPTY
    seen = visible(solid, outer_air(solid))
    voxels, points = int(seen.sum()), len(cut.trajectories.points)
    truth = _dense(cut, solid, seen, TRUTH * voxels)
    wrong = float((colour[seen] != truth).mean())
    by_samples: dict[int, float] = {}
    for samples in ENOUGH:
        scattered = (_dense(cut, solid, seen, samples * voxels, seed) for seed in range(1, SCATTERINGS + 1))
        by_samples[samples] = float(np.mean([(each != truth).mean() for each in scattered]))
        if by_samples[samples] <= wrong:
            break
    return {
        "h2_points": points,
        "h2_surface_voxels": voxels,
        "h2_wrong": wrong,
        "h2_wrong_by_samples": by_samples[SAMPLES_A_VOXEL],
        "h2_points_share_of_fewest_samples": points / (SAMPLES_A_VOXEL * voxels),
        "h2_samples_a_voxel": samples,
        "h2_points_share": points / (samples * voxels),
        "h2_ray_hits": len(horizontal_samples(cut.model.mesh, cut.model.surface, cut.frame).area),
    }


def _dense(cut: Cut, solid: Mask, seen: Mask, points: int, seed: int = 0) -> NDArray[np.int16]:
    """Return the colours of visible cells by points spread over the surface."""
    samples = dense_samples(cut.model.mesh, cut.model.surface, cut.frame, points, seed=seed)
    return dense_likeliest(samples, solid, seen, cut.model.surface)


def _singles(given: Given) -> Row:
    """Return the 1 x 1 bricks of our layout and of largest first on the same cells, and those that nothing forces."""
    catalogue = load_catalogue()
    ours, largest, own = (
        lay(cells, catalogue, np.random.default_rng(given.build.settings.seed))
        for lay, cells in (
            (given.standard, given.required), (given.largest, given.required), (given.standard, given.own),
        )
    )  # fmt: skip
    count = [int(single(bricks, catalogue).sum()) for bricks in (ours, largest, own)]
    free = max(0, count[2] - fewest_singles(own, given.own, catalogue))
    return {"h6_singles": count[0], "h6_singles_largest_first": count[1], "h6_free_share": free / len(own)}


def _supports(given: Given) -> Row:
    """Return how many supports stay stuck, and what splitting saves of them where it splits."""
    split = legorize(given.mesh, replace(_plain(given), split=PIECES)).supports
    whole = given.build.supports
    saved = 1 - len(split.removed) / len(whole.removed) if len(split.pieces) > 1 and len(whole.removed) else None
    return {"h9_stuck": len(whole.walk.stuck), "h9_pieces": len(split.pieces), "h9_split_saves": saved}


def _learning(given: Given) -> Row:
    """Return which share of J the machine saves of each control."""
    grid = given.own
    fills = ways(SAMPLES.read_text(encoding="utf-8"))
    ours = in_way(fills[LEARNED], grid).cost
    costs: Mapping[str, float] = {name: in_way(fills[way], grid).cost for name, way in CONTROLS.items()}
    shuffled = float(np.mean([in_way(fill, grid).cost for way, fill in fills.items() if way.startswith(SHUFFLED)]))
    return {f"h12_saves_of_{name}": 1 - ours / cost for name, cost in {**costs, "shuffled": shuffled}.items()}


FIGURES: Final[Mapping[str, Callable[[Given], Row]]] = {
    "H1": _accuracy,
    "H2": _points,
    "H6": _singles,
    "H9": _supports,
    "H10": _inside,
    "H12": _learning,
}
"""What measures a model for the claims that the tables do not decide; the names of its figures begin with the claim."""
