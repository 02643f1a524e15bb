"""Whether every model can be built: its order followed from the file, whole and in pieces."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from legorize_addon.core.files.build_order_csv import build_order_csv
from legorize_addon.core.files.ldraw import write_ldr
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from scripts.benchmarks.followed import follow
from scripts.benchmarks.supports import with_fixtures
from scripts.benchmarks.tables import Row, Table


def measure(paths: Sequence[Path], *, widths: Sequence[int], split: int) -> list[Table]:
    """Build every model and four fixtures, whole and in pieces.

    Parameters
    ----------
    paths : sequence of Path
        Model files.
    widths : sequence of int
        Studs along the longer horizontal side.
    split : int
        Most pieces.

    Returns
    -------
    list of Table
        One row a model, width and number of pieces.
    """
    title = "Building orders followed from their files; all faults 0 is wanted, and the model left is that of model.ldr"
    rows = [
        _row(name, mesh, width, most)
        for width in widths
        for name, mesh in with_fixtures(paths)
        for most in dict.fromkeys((1, split))
    ]
    return [Table("building", title, tuple(rows))]


def _row(name: str, mesh: TriangleMesh, width: int, most: int) -> Row:
    print(f"building {name} at {width}", file=sys.stderr)
    catalogue = load_catalogue()
    start = time.process_time()
    build = legorize(mesh, Settings(width=width, split=most))
    total = time.process_time() - start
    supports = build.supports
    faults, left = follow(
        build_order_csv(supports.steps, Assembly(supports.bricks, catalogue), by_hand=supports.by_hand), catalogue
    )
    removed = supports.removed
    return {
        "model": name,
        "studs": width,
        "at_most": most,
        "pieces": len(supports.pieces),
        "bricks": len(build.bricks),
        "ways": " ".join(dict.fromkeys(piece.plan.way for piece in supports.pieces)),
        "removed": len(removed),
        "removed_g": float(catalogue.mass[removed.part].sum()),
        "kept": sum(len(piece.pillars) for piece in supports.pieces),
        "contacts": sum(len(piece.plan.contacts.cells) for piece in supports.pieces),
        "clinging": len(supports.clinging),
        "by_hand": len(supports.unsteady),
        "pressed": int(supports.moves.pressed.sum()),
        "steps": supports.walk.n_steps,
        "in_air": faults.in_air,
        "overlapping": faults.overlapping,
        "squeezed": faults.squeezed,
        "covered": faults.covered,
        "stuck": faults.stuck,
        "loose": faults.loose,
        "components": build.graph.n_components,
        "verdict": build.stability.verdict.value,
        "supports_cpu_s": build.timings["supports"],
        "all_cpu_s": total,
        "built_met": faults.total() == 0 and left == _lines(build.bricks, catalogue),
    }


def _lines(bricks: Bricks, catalogue: Catalogue) -> Counter[str]:
    """Return the lines of the model's own file."""
    text = write_ldr(Assembly(bricks, catalogue), name="model.ldr", title="model")
    return Counter(line for line in text.splitlines() if line.startswith("1 "))
