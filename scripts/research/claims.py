"""The paper's claims as goals: whether its tables, and what is measured beside them, meet them.

References
----------
Paper, abstract and conclusion. Limits are this project's: the paper gives none.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Final

from scripts.benchmarks.tables import Row

FIELD_FASTER, FEWER, LIGHTER, SPARSER = 3.0, 0.06, 0.40, 0.15
"""Times faster than methods that search; shares of fewer bricks than largest first, of less weight than columns."""

NEARER, POINTS, CAVITIES = 0.25, 0.20, 0.90
SMALL, FREE = 0.50, 0.03
SPLIT = 0.20
"""Shares of less distance by plates; of points against samples; of cavities in both of those in either; of 1 x 1
against largest first, and of those that nothing forces; of supports that splitting saves."""

LEARNING: Final = {"largest": 0.08, "random": 0.40, "chance": 0.05, "shuffled": 0.05}
"""Share of the cost J that the machine has to save of what each control takes."""


def claims(
    layouts: Sequence[Row], volumes: Sequence[Row], supports: Sequence[Row], others: Sequence[Row], field: Sequence[str]
) -> list[Row]:
    """Judge the claims.

    Parameters
    ----------
    layouts, volumes, supports : sequence of Row
        Tables 3, 1 and 4.
    others : sequence of Row
        Of :data:`~.claim_figures.FIGURES`.
    field : sequence of str
        Methods of the field, largest first in front and those that search last.

    Returns
    -------
    list of Row
        What is wanted, on how many models it holds, the models on which it does not, and what measures it.
    """
    models = list(dict.fromkeys(str(row["model"]) for row in layouts))
    found = [_claim(*each) for each in (*_decided(models, layouts, volumes, supports, field), *_measured(others))]
    return sorted(found, key=lambda row: int(str(row["claim"])[1:]))


def _measured(others: Sequence[Row]) -> Iterable[tuple[str, str, dict[str, bool]]]:
    """Yield the claims that the rows beside the tables decide."""

    def kept(test: Callable[[dict[str, Any]], bool]) -> dict[str, bool]:
        return {str(row["model"]): test(dict(row)) for row in others}

    yield (
        "H1",
        f"plates lessen the mean distance of bricks by {NEARER:.0%}; neither is worse than cells by centre points",
        kept(_accurate),
    )
    yield (
        "H2",
        f"points at most {POINTS:.0%} of the samples with which a surface voxelization errs no more in colour",
        kept(lambda row: row["h2_points_share"] <= POINTS),
    )
    yield (
        "H6",
        f"{SMALL:.0%} fewer 1 x 1 than largest first, at most {FREE:.0%} that nothing forces",
        kept(
            lambda row: (
                row["h6_singles"] <= (1 - SMALL) * row["h6_singles_largest_first"] and row["h6_free_share"] <= FREE
            )
        ),
    )
    yield (
        "H9",
        f"all outer supports come out; where a model is split, {SPLIT:.0%} fewer",
        kept(lambda row: not row["h9_stuck"] and (row["h9_split_saves"] is None or row["h9_split_saves"] >= SPLIT)),
    )
    yield (
        "H10",
        f"cavities of the trajectories and of the cells agree by {CAVITIES:.0%}; hollowing opens no hole",
        kept(lambda row: row["h10_sound_met"] and (row["h10_iou"] is None or row["h10_iou"] >= CAVITIES)),
    )
    listed = ", ".join(f"{name} {share:.0%}" for name, share in LEARNING.items())
    yield (
        "H12",
        f"the machine saves of the cost J of {listed}",
        kept(lambda row: all(row[f"h12_saves_of_{name}"] >= share for name, share in LEARNING.items())),
    )


def _accurate(row: dict[str, Any]) -> bool:
    """Return whether plates are nearer than bricks, and both as near as centre points, which an open mesh has not."""
    good = bool(row["h1_plates_mm"] <= (1 - NEARER) * row["h1_bricks_mm"])
    for name in ("h1_bricks", "h1_plates"):
        if row[f"{name}_centres_mm"] is not None:
            good &= row[f"{name}_mm"] <= row[f"{name}_centres_mm"] and row[f"{name}_iou"] >= row[f"{name}_centres_iou"]
    return good


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
