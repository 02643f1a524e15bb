"""Models as large as a number of parts or an amount of money allows."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from legorize_addon.core.fitting import CLOSE, measured
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.settings import Settings
from scripts.benchmarks.purchase import built, price_file
from scripts.benchmarks.tables import Row, Table

_SAID: Final = "at most"
"""In the remark on the search."""


def measure(paths: Sequence[Path], *, parts: Sequence[int], budgets: Sequence[float]) -> list[Table]:
    """Make models as large as numbers of parts, and amounts of money in euros, allow."""
    with TemporaryDirectory() as folder:
        prices = str(price_file(Path(folder) / "prices.csv", load_catalogue()))
        asked = [
            *((float(most), Settings(size_by="parts", parts=most)) for most in parts),
            *((most, Settings(size_by="budget", budget=most, prices=prices)) for most in budgets),
        ]
        rows = tuple(_row(path, most, settings) for path in paths for most, settings in asked)
    return [Table("sizes", "The largest model of at most so many parts or so much money: at least 97 % of it", rows)]


def _row(path: Path, most: float, settings: Settings) -> Row:
    """Return how near a model comes."""
    build, taken = built(path, settings)
    share = measured(build, settings) / most
    return {
        "model": path.stem, "by": settings.size_by, "most": most, "found": measured(build, settings),
        "percent": 100 * share, "share_met": CLOSE <= share <= 1, "seconds": taken,
        "said": next(note for note in build.notes if _SAID in note),
    }  # fmt: skip
