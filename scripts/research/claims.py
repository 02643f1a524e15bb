"""The paper's claims as goals: those that its tables decide, and where the others are measured.

References
----------
Paper, abstract and conclusion. Limits are this project's: the paper gives none.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

from scripts.benchmarks.tables import Row

FIELD_FASTER, FEWER, LIGHTER, SPARSER = 3.0, 0.06, 0.40, 0.15
"""Times faster than methods that search; shares of fewer bricks than largest first, of less weight than columns."""

ELSEWHERE: Final = (
    ("H1", "accuracy by adaptive slicing and plates: mean distance 25 % less than in bricks", "benchmark.py detail"),
    (
        "H2",
        "points at most 20 % of a surface voxelization's samples at equal colour error",
        "benchmark.py units",
    ),
    ("H9", "all outer supports come out; splitting saves 20 % on the vehicle", "benchmark.py building"),
    ("H10", "cavities and tunnels stay", "benchmark.py hollowing"),
    ("H12", "the machine guides quality", "scripts/research/fill_controls.py"),
)
"""Claims that the tables do not decide: what is wanted, and what measures it."""


def claims(layouts: Sequence[Row], volumes: Sequence[Row], supports: Sequence[Row], field: Sequence[str]) -> list[Row]:
    """Judge the claims.

    Parameters
    ----------
    layouts, volumes, supports : sequence of Row
        Tables 3, 1 and 4.
    field : sequence of str
        Methods of the field, largest first in front and those that search last.

    Returns
    -------
    list of Row
        What is wanted, on how many models it holds, the models on which it does not, and what measures it.
    """
    models = list(dict.fromkeys(str(row["model"]) for row in layouts))
    found = [_claim(*each) for each in _decided(models, layouts, volumes, supports, field)]
    found += [
        {"claim": name, "goal": goal, "kept_by": None, "not_by": None, "met": None, "measured_by": command}
        for name, goal, command in ELSEWHERE
    ]
    return sorted(found, key=lambda row: int(str(row["claim"])[1:]))


def _decided(
    models: Sequence[str], layouts: Sequence[Row], volumes: Sequence[Row], supports: Sequence[Row], field: Sequence[str]
) -> Iterable[tuple[str, str, dict[str, bool]]]:
    """Yield the claims that the tables decide, with whether each model keeps them."""

    def ours(model: str, rule: str = "ours") -> Row:
        return next(
            row for row in layouts if (row["model"], row["method"], row["hollowing"]) == (model, "standard", rule)
        )

    def others(model: str, names: Sequence[str]) -> list[Row]:
        return [row for row in layouts if row["model"] == model and row["method"] in names]

    searching = field[2:]
    yield (
        "H3",
        f"{FIELD_FASTER:g} times faster than the methods that search, with no more bricks",
        {
            model: all(
                row["tc_s"] >= FIELD_FASTER * ours(model)["tc_s"] and row["nb"] >= ours(model)["nb"]
                for row in others(model, searching)
            )
            for model in models
        },
    )
    yield "H4", "as hollow as the methods of the field by their rules, with the paper's rule", {
        model: all(
            ours(model, "paper's rule")["hor"] >= row["hor"] - 1e-9
            for row in others(model, field) if row["hollowing"].startswith("shell")
        )
        for model in models
    }  # fmt: skip
    yield "H5", f"{FEWER:.0%} fewer bricks than largest first on the same cells", {
        model: all(
            ours(model, row["hollowing"])["nb"] <= (1 - FEWER) * row["nb"]
            for row in others(model, field[:1]) if not row["hollowing"].startswith("shell")
        )
        for model in models
    }  # fmt: skip
    large = {str(row["model"]): _large_share(row) for row in volumes if row["colour"] == "all"}
    yield "H7", "bricks of 2 x 4 and more have a larger share of the volume than 1 x 1 and 1 x 2", large
    yield (
        "H8",
        f"trees {LIGHTER:.0%} lighter than full columns, {SPARSER:.0%} lighter than sparse ones",
        _trees(supports),
    )
    yield (
        "H11",
        "methods of the field leave bricks without hold; a default build has none",
        {
            model: any(row["floating"] for row in others(model, field)) and _whole(layouts, model)["floating"] == 0
            for model in models
        },
    )
    yield (
        "H13",
        "one component, nothing in the air",
        {
            model: _whole(layouts, model)["components"] == 1 and _whole(layouts, model)["floating"] == 0
            for model in models
        },
    )


def _whole(layouts: Sequence[Row], model: str) -> Row:
    return next(row for row in layouts if row["model"] == model and str(row["method"]).startswith("default"))


def _large_share(row: Row) -> bool:
    large = sum(float(row[f"Brick {size}"]) for size in ("2 x 4", "2 x 6", "2 x 8"))
    return large > sum(float(row[f"Brick {size}"]) for size in ("1 x 1", "1 x 2"))


def _trees(supports: Sequence[Row]) -> dict[str, bool]:
    """Return whether trees are lighter, for models with contacts."""
    weight = {(str(row["model"]), str(row["supports"])): float(row["weight_g"]) for row in supports}
    return {
        model: weight[model, "tree"] <= min((1 - LIGHTER) * full, (1 - SPARSER) * weight[model, "sparse"])
        for (model, way), full in weight.items()
        if way == "full" and (model, "tree") in weight
    }


def _claim(name: str, goal: str, kept: dict[str, bool]) -> Row:
    broken = [model for model, good in kept.items() if not good]
    return {
        "claim": name,
        "goal": goal,
        "kept_by": f"{len(kept) - len(broken)} of {len(kept)}",
        "not_by": ", ".join(broken) or None,
        "met": not broken if kept else None,
        "measured_by": "benchmark.py tables",
    }
