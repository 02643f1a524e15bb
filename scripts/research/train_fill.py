"""Train the machine of the learned fill.

::

    python scripts/research/train_fill.py [--out FILE]              make assets/fill_svm.csv anew
    python scripts/research/train_fill.py --report [MESH ...]       judge it on models that it never saw

The training models are made by chance (see ``training_models.py``), so the file
needs nothing but this repository; the same versions give the same file. In the first
round the decisions that are judged are taken by the cost of the simulations, in the
others by a machine that learned from those before; three in ten are taken by chance.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Final

import numpy as np
import scipy
import sklearn

ROOT: Final = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from legorize_addon.core.layout.learning.grade_training import (  # noqa: E402 - found through the line above
    EACH_GRADE,
    TrainedGrades,
    balanced,
    cheapest,
    fewest,
    graded_of,
    train_grades,
    written_grades,
)
from legorize_addon.core.layout.learning.grading import Graded, Grader  # noqa: E402
from legorize_addon.core.model.catalogue import load_catalogue  # noqa: E402
from scripts.benchmarks.kept import Kept  # noqa: E402
from scripts.benchmarks.tables import write  # noqa: E402
from scripts.research.fill_report import HELD_BACK, Asked, judged_fill  # noqa: E402
from scripts.research.training_models import KINDS, built  # noqa: E402

SHIPPED: Final = ROOT / "assets" / "fill_svm.csv"

TABLES: Final = ROOT / "out" / "fill"

EACH: Final = 2
"""Training models of each kind; their seeds count from 0."""

_FIRST: Final = (8.0, 0.5)
"""C and gamma of the machine that takes the decisions of further rounds."""

_MOST_ROUNDS: Final = 8


def main(arguments: Sequence[str]) -> int:
    """Train; return the exit status."""
    parser = argparse.ArgumentParser(description="Train the support vector machine of the learned fill.")
    parser.add_argument("--out", metavar="FILE", type=Path, default=SHIPPED, help="where to write the samples")
    parser.add_argument("meshes", metavar="MESH", type=Path, nargs="*", help="model files for the report")
    parser.add_argument("--report", action="store_true", help="judge the built-in training instead of training anew")
    parser.add_argument("--widths", type=int, nargs="*", default=[32], metavar="N", help="studs of the model files")
    parser.add_argument("--joined", type=int, nargs="*", default=[], metavar="N", help="further studs, for time alone")
    parser.add_argument("--held-back", type=int, default=HELD_BACK, help="unseen models of each kind in the report")
    parser.add_argument(
        "--pool", metavar="FILE", type=Path, help="candidates judged so far (.npz), to go on from there"
    )
    parser.add_argument("--tables", metavar="FOLDER", type=Path, default=TABLES, help="for the report as CSV and JSON")
    parser.add_argument("--minutes", type=float, default=0.0, help="after which the report stops; the next run goes on")
    parser.add_argument("--each", type=int, default=EACH, help="models of each kind (default: %(default)s)")
    parser.add_argument("--samples", type=int, default=EACH_GRADE, help="of each grade (default: %(default)s)")
    options = parser.parse_args(arguments)
    if options.report:
        report(options)
        return 0
    text = trained(seed=0, each=options.each, n=options.samples, kept=options.pool)
    unfinished = options.out.with_suffix(".part")
    unfinished.write_text(text, encoding="utf-8", newline="\n")
    unfinished.replace(options.out)
    print(text.split("\nmodel,")[0])
    return 0


def report(options: argparse.Namespace) -> None:
    """Print and write the tables of the report that are whole."""
    asked = Asked(tuple(options.meshes), tuple(options.widths), tuple(options.joined), options.held_back)
    kept = Kept(options.tables / "fill_rows", options.minutes)
    tables = []
    for table in judged_fill(asked, SHIPPED.read_text(encoding="utf-8"), kept):
        # it takes long, and what is known is shown
        print(table.markdown(), flush=True)
        tables.append(table)
    kept.tell_left()
    write(options.tables, "fill", tables)


def trained(*, seed: int, each: int, n: int, kept: Path | None = None) -> str:
    """Train on models made by chance.

    Parameters
    ----------
    seed : int
        Of the draws; the seeds of the models count from 0.
    each : int
        Models of each kind.
    n : int
        Samples of each grade.
    kept : Path, optional
        File of the candidates judged so far: from there a training that was stopped goes on, to the same result.

    Returns
    -------
    str
        The file to ship.
    """
    catalogue = load_catalogue()
    grids = [built(kind, number)[0] for kind in KINDS for number in range(each)]
    pool, done = read_pool(kept) if kept and kept.exists() else (None, 0)
    while pool is None or (fewest(pool) < n and done < _MOST_ROUNDS):
        choose = cheapest if pool is None else Grader.of(pool, c=_FIRST[0], gamma=_FIRST[1]).choose
        # every round has its own numbers, so that it does not matter where a training was stopped
        pool = graded_of(grids, catalogue, np.random.default_rng([seed, done]), choose=choose, known=pool)
        done += 1
        print(np.bincount(pool.grade), "candidates judged of each grade", file=sys.stderr, flush=True)
        if kept:
            np.savez(kept, energies=pool.energies, grade=pool.grade, model=pool.model, done=done)
    rng = np.random.default_rng([seed, _MOST_ROUNDS])
    result = train_grades(balanced(pool, rng, n), rng)
    return written_grades(result, facts(seed, each, pool, result))


def read_pool(kept: Path) -> tuple[Graded, int]:
    """Return the candidates judged so far, and in how many rounds."""
    with np.load(kept) as found:
        return Graded(found["energies"], found["grade"], found["model"]), int(found["done"])


def facts(seed: int, each: int, pool: Graded, result: TrainedGrades) -> dict[str, str]:
    """Return what the file says of where it is from."""
    tried = ", ".join(f"({c:g}, {gamma:g}) {share:.3f}" for (c, gamma), share in result.grid.items())
    return {
        "what": "samples of the learned fill, thousandths of the four energies above the least candidate; CC0 1.0",
        "made by": "scripts/research/train_fill.py",
        "formulation": "how good a brick is, by the energies of the simulation behind it; regret by branch and bound",
        "seed": str(seed),
        "models": f"{', '.join(KINDS)}, with seeds 0 to {each - 1} each, in this order",
        "judged": f"{len(pool.grade)} candidates, {' '.join(map(str, np.bincount(pool.grade)))} of the three grades",
        "versions": f"numpy {np.__version__}, scipy {scipy.__version__}, scikit-learn {sklearn.__version__}",
        "shares of right answers by (C, gamma)": tried,
    }


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
