"""What models cost, and building with owned parts: a made-up price file and a made-up box, both plausible.

No price list may be copied, so the prices follow what is known of them: a part costs the more the larger it is, but
less for each stud; parts of many sets are cheap, colours of few sets are dear, and shops differ. The box has the mix
of a classic box of 1500 pieces: mostly bricks up to 2 x 4, few plates, 13 colours.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np

from legorize_addon.core.build import Build
from legorize_addon.core.errors import PartsError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import silent
from legorize_addon.core.report.money import price_facts
from legorize_addon.core.report.ownership import owned_facts, used_lots
from legorize_addon.core.safe_text import csv_text
from legorize_addon.core.settings import Settings
from scripts.benchmarks.meshes import read_mesh
from scripts.benchmarks.tables import Row, Table

_POPULAR: Final = {
    "3001": 0.75,
    "3003": 0.8,
    "3004": 0.8,
    "3010": 0.85,
    "3023": 0.7,
    "3020": 0.8,
    "3022": 0.8,
    "3710": 0.85,
}
_RARE: Final = {
    "3007": 1.6,
    "3008": 1.4,
    "2357": 1.3,
    "2456": 1.25,
    "3034": 1.2,
    "3460": 1.2,
    "3002": 1.15,
    "2420": 1.1,
}
_COMMON: Final = (0, 1, 2, 4, 14, 15, 19, 25, 70, 71, 72)
"""Factors on prices by part, and colours that most sets have."""

_UNKNOWN: Final = 0.1
"""Share of the lots that the price file does not have."""

_BOX: Final = {
    "3003": 0.18, "3004": 0.16, "3001": 0.15, "3005": 0.11, "3002": 0.09, "3010": 0.08, "3622": 0.05, "3009": 0.03,
    "2456": 0.02, "3008": 0.01, "3023": 0.04, "3022": 0.025, "3020": 0.02, "3024": 0.02, "3710": 0.015,
}  # fmt: skip
_COLOURS: Final = {
    15: 1.4, 0: 1.0, 4: 1.3, 1: 1.3, 14: 1.3, 2: 1.0, 10: 0.8, 25: 1.0, 71: 0.7, 72: 0.5, 19: 0.7, 70: 0.6, 322: 0.5,
}  # fmt: skip
_PIECES: Final = 1500


def measure_prices(paths: Sequence[Path], *, widths: Sequence[int]) -> list[Table]:
    """Compare the cheapest models with those of the fewest bricks, and with the bound."""
    rows: list[Row] = []
    with TemporaryDirectory() as folder:
        prices = str(price_file(Path(folder) / "prices.csv", load_catalogue()))
        for path in paths:
            for width in widths:
                fewest, usual = _built(path, Settings(width=width, prices=prices))
                cheapest, taken = _built(path, Settings(width=width, prices=prices, goal="cheapest"))
                before, after = (price_facts(each, load_catalogue(), silent) or {} for each in (fewest, cheapest))
                rows.append({
                    "model": path.stem, "studs": width, "fewest": before["model"], "cheapest": after["model"],
                    "saved_percent": 100 * (1 - after["model"] / before["model"]),
                    "parts_fewest": len(fewest.bricks), "parts_cheapest": len(cheapest.bricks),
                    "bound": after["least_possible"], "above_bound_percent": after["at_most_more_percent"],
                    "seconds_ratio": taken / usual, "seconds_met": taken <= 2 * usual,
                    "stands": cheapest.stability.stands, "components": cheapest.graph.n_components,
                })  # fmt: skip
    return [Table("prices", "The cheapest model beside the fewest bricks, in EUR", tuple(rows))]


def measure_owned(paths: Sequence[Path], *, widths: Sequence[int], times: Sequence[int]) -> list[Table]:
    """Build with one or several classic boxes, and compare with a free choice of parts."""
    rows: list[Row] = []
    with TemporaryDirectory() as folder:
        for path in paths:
            for width in widths:
                free, usual = _built(path, Settings(width=width))
                for many in times:
                    owned = str(box_file(Path(folder) / "box.csv", load_catalogue(), times=many))
                    rows.append(
                        {"model": path.stem, "studs": width, "boxes": many, "bricks_free": len(free.bricks)}
                        | _with_box(path, Settings(width=width, owned=owned), free, usual)
                    )
    return [Table("owned", "Built of classic boxes of 1500 pieces alone: nothing may be overdrawn", tuple(rows))]


def _with_box(path: Path, settings: Settings, free: Build, usual: float) -> Row:
    """Return what comes out if only owned parts are used."""
    try:
        build, taken = _built(path, settings)
    except PartsError as error:
        return {"bricks": None, "supports": None, "overdrawn": None, "other_colour_percent": None,
                "colour_difference": None, "shape_percent": None, "components": None, "stands": None,
                "seconds_ratio": None, "overdrawn_met": True, "said": str(error)}  # fmt: skip
    facts = owned_facts(build, load_catalogue()) or {}
    used = used_lots(Assembly(build.supports.bricks, load_catalogue()))
    over = int(np.maximum(used - (build.owned.count if build.owned else 0), 0).sum())
    return {
        "bricks": len(build.bricks), "supports": len(build.supports.removed), "overdrawn": over,
        "other_colour_percent": facts["other_colour_percent"], "colour_difference": facts["colour_difference"],
        "shape_percent": _same_shape(build, free), "components": build.graph.n_components,
        "stands": build.stability.stands, "seconds_ratio": taken / usual, "overdrawn_met": over == 0, "said": "",
    }  # fmt: skip


def _same_shape(build: Build, free: Build) -> float:
    """Return the share of cells that both solid models fill, of those that one of them fills, in percent."""
    one, other = build.grid.solid, free.grid.solid
    if one.shape != other.shape:
        low = tuple(slice(min(a, b)) for a, b in zip(one.shape, other.shape, strict=True))
        one, other = one[low], other[low]
    return float(100 * (one & other).sum() / (one | other).sum())


def measure_sizes(paths: Sequence[Path], *, parts: Sequence[int]) -> list[Table]:
    """Make models as large as numbers of parts allow."""
    rows: list[Row] = []
    for path in paths:
        for most in parts:
            build, taken = _built(path, Settings(size_by="parts", parts=most))
            share = len(build.bricks) / most
            rows.append({
                "model": path.stem, "most": most, "parts": len(build.bricks), "percent": 100 * share,
                "share_met": 0.97 <= share <= 1, "seconds": taken, "said": build.notes[-1],
            })  # fmt: skip
    return [Table("sizes", "The largest model of at most so many parts: at least 97 % of them", tuple(rows))]


def measure_masses(paths: Sequence[Path], *, width: int, weights: Sequence[float]) -> list[Table]:
    """Weigh mass against the number of bricks."""
    rows: list[Row] = []
    for path in paths:
        for weight in weights:
            build, _ = _built(path, Settings(width=width, mass_weight=weight, supports="none"))
            grams = float(load_catalogue().mass[build.bricks.part].sum())
            rows.append({
                "model": path.stem, "studs": width, "mass_weight": weight, "bricks": len(build.bricks), "grams": grams,
                "stands": build.stability.stands, "components": build.graph.n_components,
            })  # fmt: skip
    return [Table("masses", "Grams against bricks", tuple(rows))]


def _built(path: Path, settings: Settings) -> tuple[Build, float]:
    """Return a build, and the seconds of the processor that it took."""
    mesh, start = read_mesh(path), time.process_time()
    build = legorize(mesh, replace(settings, limit_bricks=10**8), silent)
    return build, time.process_time() - start


def price_file(path: Path, catalogue: Catalogue, *, seed: int = 1) -> Path:
    """Write a price file in the form of a European shop: semicolons, decimal commas, euros."""
    rng = np.random.default_rng(seed)
    rows = []
    for part in catalogue.parts:
        studs = part.length * part.width - part.corner
        height = {1: 0.6, 3: 1.0, 9: 2.2}[part.height]
        base = (0.025 + 0.028 * studs**0.75) * height * (_POPULAR | _RARE).get(part.number, 1.0)
        for colour in catalogue.colours:
            price = base * (1.0 if colour.code in _COMMON else 1.5) * np.exp(rng.normal(0, 0.25))
            if rng.random() > _UNKNOWN:
                rows.append((part.number, colour.bricklink, f"{price:.4f}".replace(".", ","), "EUR"))
    path.write_text(csv_text(("Item No", "Color ID", "Price", "Currency"), rows), encoding="utf-8")
    return path


def box_file(path: Path, catalogue: Catalogue, *, times: int = 1) -> Path:
    """Write the inventory of so many classic boxes as Rebrickable does."""
    colour = {each.code: each.rebrickable for each in catalogue.colours}
    total = sum(_COLOURS.values())
    rows = [
        (part, colour[code], times * max(1, round(_PIECES * share * weight / total)))
        for part, share in _BOX.items()
        for code, weight in _COLOURS.items()
    ]
    path.write_text(csv_text(("Part", "Color", "Quantity"), rows), encoding="utf-8")
    return path
