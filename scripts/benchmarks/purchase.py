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
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import Catalogue, load_catalogue
from legorize_addon.core.owned.few_lots import SMALL
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.progress import silent
from legorize_addon.core.report.money import price_facts
from legorize_addon.core.report.ownership import colour_differences, owned_facts, used_lots
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
                fewest, usual = built(path, Settings(width=width, prices=prices))
                cheapest, taken = built(path, Settings(width=width, prices=prices, goal="cheapest"))
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
                free, usual = built(path, Settings(width=width))
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
        build, taken = built(path, settings)
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


def measure_masses(paths: Sequence[Path], *, widths: Sequence[int], weights: Sequence[float]) -> list[Table]:
    """Weigh mass against the number of bricks."""
    rows: list[Row] = []
    for path in paths:
        for width in widths:
            usual: tuple[int, float, float] | None = None
            for weight in weights:
                build, taken = built(path, Settings(width=width, mass_weight=weight))
                grams = float(load_catalogue().mass[build.bricks.part].sum())
                usual = usual or (len(build.bricks), grams, taken)
                rows.append({
                    "model": path.stem, "studs": width, "mass_weight": weight, "bricks": len(build.bricks),
                    "bricks_percent": 100 * (len(build.bricks) / usual[0] - 1), "grams": grams,
                    "grams_percent": 100 * (grams / usual[1] - 1), "seconds_ratio": taken / usual[2],
                    "kept": int((build.bricks.role == Role.SUPPORT_KEPT).sum()),
                    "stands": build.stability.stands, "components": build.graph.n_components,
                })  # fmt: skip
    return [Table("masses", "Grams against bricks, compared with the first weight", tuple(rows))]


def measure_lots(paths: Sequence[Path], *, width: int, limits: Sequence[float]) -> list[Table]:
    """Merge small lots into close colours and other parts."""
    rows: list[Row] = []
    for path in paths:
        for limit in limits:
            build, taken = built(path, Settings(width=width, few_lots=limit))
            used = used_lots(Assembly(build.bricks, load_catalogue()))
            apart = colour_differences(build, load_catalogue())
            rows.append({
                "model": path.stem, "studs": width, "few_lots": limit, "lots": int(np.count_nonzero(used)),
                "small_lots": int(np.count_nonzero((used > 0) & (used <= SMALL))), "bricks": len(build.bricks),
                "other_colour_percent": 100 * float((apart > 0).mean()), "colour_difference": float(apart.mean()),
                "components": build.graph.n_components, "stands": build.stability.stands, "seconds": taken,
                "said": next((note for note in build.notes if note.startswith("For fewer lots")), ""),
            })  # fmt: skip
    return [Table("lots", "Fewer lots: what they cost in likeness and in bricks", tuple(rows))]


def built(path: Path, settings: Settings) -> tuple[Build, float]:
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
        height = round(0.4 + 0.2 * part.height, 1)
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
