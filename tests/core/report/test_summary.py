"""What is printed at the end of a run."""

from __future__ import annotations

from typing import Any

import pytest

from legorize_addon.core.model import Verdict
from legorize_addon.core.report.summary import summary


def facts(*, verdict: str = "stable", failed: int = 0, removed: int = 0, bricks: int = 12) -> dict[str, Any]:
    """Return what the summary reads of a report."""
    return {
        "counts": {"bricks": bricks},
        "grid": {"layers": 3},
        "mass_g": 27.6,
        "size": {"cm": [3.2, 1.6, 2.88]},
        "building_time_s": 120,
        "building": {"steps": 2},
        "supports": {"removed": removed},
        "stability": {"verdict": verdict},
        "failed_checks": ["A check failed."] * failed,
    }


def test_model_files_and_verdict() -> None:
    """Three lines: counts with the right plurals, files with folders counted, and the verdict."""
    files = ["tables/table_1.csv", "model.ldr", "tables/table_2.csv", "build_order.csv"]
    assert summary(facts(bricks=1), "out/box", files) == (
        "Model: 1 brick in 3 layers, 3.2 x 1.6 x 2.9 cm, 28 g, built in 2 steps and about 2 min.",
        "Files in out/box: build_order.csv, model.ldr, tables/ (2).",
        "Verdict: the model is proven to stand; every check passed.",
    )


def test_temporary_supports_are_counted() -> None:
    """They are named where there are any."""
    assert summary(facts(removed=4), "out", [])[0].endswith("2 steps and about 2 min, with 4 temporary support bricks.")


@pytest.mark.parametrize("verdict", [verdict.value for verdict in Verdict])
def test_each_verdict_has_its_words(verdict: str) -> None:
    """Only what is proven is called so, and failed checks are counted."""
    failed = int(verdict != "stable")
    line = summary(facts(verdict=verdict, failed=failed), "out", [])[2]
    assert ("proven to stand; every check passed." in line) == (verdict == "stable")
    assert ("1 check failed." in line) == bool(failed)
    assert ("is not proven" in line) == (verdict == "undecided")
    assert ("collapse" in line) == (verdict == "collapses")
