"""Train the machine that chooses exchanges in the fast layout, and judge it.

::

    python scripts/research/train_layout.py [--out FILE]              make assets/layout_svm.csv anew
    python scripts/research/train_layout.py --report [MESH ...]       judge it on models that it never saw

The training models are made by chance (see ``training_models.py``), so the file
needs nothing but this repository; the same versions give the same file. The
report lays the sheets of other models of the same kinds, and of the files
given, in many ways: by rules, by machines that learned nothing, by linear
programmes. The packages of the dependency group ``checks`` are needed for files.
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

from legorize_addon.core.layout.learning.svm_training import N_SAMPLES, TrainedExchanges, samples_of, train, written  # noqa: E402
from legorize_addon.core.model.catalogue import load_catalogue  # noqa: E402 - found through the line above
from scripts.research.layout_controls import SHIPPED, judged  # noqa: E402
from scripts.research.training_models import KINDS, built  # noqa: E402

EACH: Final = 3
"""Training models of each kind; their seeds count from 0, those of the report from ``UNSEEN``."""


def main(arguments: Sequence[str]) -> int:
    """Train or judge; return the exit status."""
    parser = argparse.ArgumentParser(description="Train the support vector machine of the fast layout.")
    parser.add_argument("meshes", metavar="MESH", type=Path, nargs="*", help="model files for the report")
    parser.add_argument("--out", metavar="FILE", type=Path, default=SHIPPED, help="where to write the samples")
    parser.add_argument("--report", action="store_true", help="judge the built-in training instead of training anew")
    parser.add_argument("--width", type=int, default=48, help="studs of the model files (default: %(default)s)")
    options = parser.parse_args(arguments)
    if options.report:
        print(judged(options.meshes, width=options.width))
        return 0
    text = trained(seed=0, each=EACH, n=N_SAMPLES)
    unfinished = options.out.with_suffix(".part")
    unfinished.write_text(text, encoding="utf-8", newline="\n")
    unfinished.replace(options.out)
    print(text.split("\nmodel,")[0])
    return 0


def trained(*, seed: int, each: int, n: int) -> str:
    """Train on models made by chance.

    Parameters
    ----------
    seed : int
        Of the draws; the seeds of the models count from 0.
    each : int
        Models of each kind.
    n : int
        Samples.

    Returns
    -------
    str
        The file to ship.
    """
    rng = np.random.default_rng(seed)
    models = [built(kind, number) for kind in KINDS for number in range(each)]
    return written(result := train(samples_of(models, load_catalogue(), rng, n), rng), facts(seed, each, result))


def facts(seed: int, each: int, result: TrainedExchanges) -> dict[str, str]:
    """Return what the file says of where it is from."""
    tried = ", ".join(f"({c:g}, {gamma:g}) {share:.3f}" for (c, gamma), share in result.grid.items())
    return {
        "what": "samples of the learned choice of exchanges in the fast layout; CC0 1.0",
        "made by": "scripts/research/train_layout.py",
        "formulation": "which placements left over save bricks, by what they would change; gains reckoned exactly",
        "seed": str(seed),
        "models": f"{', '.join(KINDS)}, with seeds 0 to {each - 1} each, in this order",
        "versions": f"numpy {np.__version__}, scipy {scipy.__version__}, scikit-learn {sklearn.__version__}",
        "shares of right answers by (C, gamma)": tried,
    }


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
