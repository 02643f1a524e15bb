"""Whether hands can follow the building steps: how large and how alike they are, and whether all stands."""

from __future__ import annotations

import hashlib
import sys
import time
from collections.abc import Sequence
from functools import partial
from itertools import product
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.build import Build
from legorize_addon.core.building.check import ROOM
from legorize_addon.core.building.items import MOST, REACH, TILE_MOST
from legorize_addon.core.building.mirror import boxes, mirror_images
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.steps import Kind, Step
from legorize_addon.core.building.tiles import tiles_of
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.kept import Kept
from scripts.benchmarks.supports import with_fixtures
from scripts.benchmarks.tables import Row, Table
from tests.core.files.flattened import afloat
from tests.core.unit_bricks.test_backing import photograph, slab

MOSAIC: Final = "mosaic"
"""A picture that lies."""

WALL: Final = "wall"
"""The same picture, upright."""

SINGLE: Final = 0.05
"""Goal: share of the steps in which one brick is put on, and nothing else, at most."""

NEAR: Final = 0.95
"""Goal: share of the steps whose bricks lie within 16 studs at least."""

LOTS: Final = 6
"""Goal: parts and colours of a step at most, in the median."""

MIRRORED: Final = 0.9
"""Goal: share of the mirrored parts that come in the step of their image or in a neighbouring one at least."""

PRESSED: Final = 0.02
"""Goal: share of the bricks that are pressed from below at most."""


def measure(paths: Sequence[Path], *, widths: Sequence[int], split: int, minutes: float, out: Path) -> list[Table]:
    """Build every model, four fixtures and a picture, lying and upright, whole and in pieces.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    split : int
        Most pieces.
    minutes : float
        After which no build is begun; 0 for no limit.
    out : Path
        For rows, which the next run of the same program takes over.

    Returns
    -------
    list of Table
        One row a model, width and number of pieces; none if there was no time for any.
    """
    title = (
        f"Building steps: at most {SINGLE:.0%} with one brick, none above {MOST} ({TILE_MOST} in a mosaic), {NEAR:.0%} "
        f"within {REACH} studs, {LOTS} lots in the median, {MIRRORED:.0%} mirrored together, {PRESSED:.0%} pressed "
        f"from below and none with less than {ROOM // 3} bricks of room, nothing afloat, pieces of one component"
    )
    pictures = [(name, slab(photograph(), standing=standing)) for name, standing in ((MOSAIC, False), (WALL, True))]
    meshes = [*with_fixtures(paths), *pictures]
    kept, rows = Kept(out / "steps", minutes), list[Row]()
    for width, (name, mesh), most in product(widths, meshes, dict.fromkeys((1, split))):
        rows += kept.row(f"{name}-{_digest(mesh)}-{width}-{most}", partial(_row, name, mesh, width, most))
    kept.tell_left()
    return [Table("steps", title, tuple(rows))] if rows else []


def _digest(mesh: TriangleMesh) -> str:
    """Return what tells meshes of one name apart."""
    return hashlib.sha256(mesh.vertices.tobytes() + mesh.faces.tobytes() + mesh.uvs.tobytes()).hexdigest()[:8]


def _row(name: str, mesh: TriangleMesh, width: int, most: int) -> Row:
    print(f"steps of {name} at {width}", file=sys.stderr)
    start = time.process_time()
    build = legorize(mesh, Settings(width=width, split=most, backing=int(name in (MOSAIC, WALL))))
    total = time.process_time() - start
    row = {"model": name, "studs": width, "at_most": most, **figures(build)}
    return row | {"supports_cpu_s": build.timings["supports"], "all_cpu_s": total}


def figures(build: Build) -> Row:
    """Return the figures of the steps of a build."""
    supports, catalogue = build.supports, load_catalogue()
    steps, bricks = supports.steps, supports.bricks
    placed = [step for step in steps if step.action == Action.PLACE]
    box = boxes(bricks, catalogue)
    sizes = np.array([len(step.bricks) for step in placed])
    mosaic = tiles_of(box, bricks.corner[:, 2].astype(np.int64)).any()
    near = [_span(box[step.bricks]) <= REACH for step in placed]
    kind = bricks.part.astype(np.int64) * 2**16 + bricks.colour
    lots = [len(np.unique(kind[step.bricks])) for step in placed]
    document = write_mpd(Assembly(bricks, catalogue), steps, name="model.ldr", title="model")
    final = supports.final
    pieces = [final.take(final.bricks.piece == piece) for piece in np.unique(final.bricks.piece)]
    found = {
        "pieces": len(supports.pieces),
        "bricks": len(final.bricks),
        "supports": len(supports.removed),
        "steps": len(steps),
        "sub_assemblies": sum(each.kind == Kind.SUBASSEMBLY for each in steps.submodels),
        "median": float(np.median(sizes)),
        "median_of_model": float(np.median([len(step.bricks) for step in placed if _large(build, step)] or [0])),
        "five_to_ten": float(np.mean((sizes >= 5) & (sizes <= 10))),
        "single": float(np.mean([len(step.bricks) + len(step.joined) == 1 for step in placed])),
        "most": int(max(_arriving(build, step) for step in placed)),
        "near": float(np.mean(near)),
        "lots": float(np.median(lots)),
        "mirrored": mirrored(bricks.take(~supports.temporary), steps.moves.step_of(len(bricks))[~supports.temporary]),
        "pressed": float(steps.moves.pressed.sum() / len(final.bricks)),
        "cramped": len(supports.walk.cramped),
        "afloat": sum(afloat(document).values()),
        "components": max(each.graph.n_components for each in pieces),
        "by_hand": len(supports.unsteady),
        "buildable": supports.walk.buildable,
    }
    return found | {"steps_met": _met(found, mosaic=bool(mosaic))}


def mirrored(bricks: Bricks, step: NDArray[np.int32]) -> float | None:
    """Return the share of bricks with an image in their piece that are placed at most a step before or after it."""
    image = mirror_images(bricks, load_catalogue())
    # pieces are built one after the other
    paired = np.flatnonzero((image != NOBODY) & (image != np.arange(len(image))))
    paired = paired[bricks.piece[paired] == bricks.piece[image[paired]]]
    return float((np.abs(step[paired] - step[image[paired]]) <= 1).mean()) if len(paired) else None


def _met(found: Row, *, mosaic: bool) -> bool:
    return bool(
        found["single"] <= SINGLE
        and found["most"] <= (TILE_MOST if mosaic else MOST)
        and found["near"] >= NEAR
        and found["lots"] <= LOTS
        and (found["mirrored"] is None or found["mirrored"] >= MIRRORED)
        and found["pressed"] <= PRESSED
        and found["cramped"] == found["afloat"] == 0
        and found["components"] == 1
        and found["buildable"]
    )


def _large(build: Build, step: Step) -> bool:
    """Whether a step is one of the model or of a piece, not of a sub-assembly."""
    return build.supports.steps.submodels[step.submodel].kind != Kind.SUBASSEMBLY


def _arriving(build: Build, step: Step) -> int:
    """Return the bricks that a step brings, those of sub-assemblies included."""
    steps = build.supports.steps
    small = [steps.all_rows(each) for each in step.joined if steps.submodels[each].kind == Kind.SUBASSEMBLY]
    return len(np.unique(np.concatenate([step.bricks, *small])))


def _span(box: NDArray[np.int64]) -> int:
    return int(max(box[:, 1].max() - box[:, 0].min(), box[:, 3].max() - box[:, 2].min())) + 1
