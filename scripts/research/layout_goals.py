"""The paper's claims on layouts as goals, over all models of a run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from scripts.benchmarks.tables import Row

RANDOM, GREEDY, STAGGERED = "B0 random merge", "B1 largest first", "B2 staggered"
SEARCHED, SEARCHED_FEW, ANNEALED = "B3 A*", "B3 A* for few bricks", "B4 annealing"
BASELINES: Final = (RANDOM, GREEDY, STAGGERED, SEARCHED, SEARCHED_FEW, ANNEALED)
UNLEARNED, FAST, STANDARD = "fast, not learned", "fast", "standard"

FEWER: Final = 0.3
FASTER: Final = 8.0
"""Goals against the peer: share of bricks that we save, and how many times less CPU."""

Model = dict[str, Row]
"""The rows of a model by method."""


@dataclass(frozen=True, slots=True)
class Goal:
    """A figure of every model, and its limit.

    Attributes
    ----------
    name : str
        Claim that it is of.
    text : str
        What is wanted.
    figure : callable
        From the rows of a model to the figure.
    limit : float
        What each model, or the mean, has to reach.
    most : bool
        Whether the limit is the most that is allowed, or the least.
    mean : bool
        Whether the mean over the models counts, or each of them.
    share : float
        Of the models that have to keep it.
    """

    name: str
    text: str
    figure: Callable[[Model], float]
    limit: float
    most: bool = True
    mean: bool = False
    share: float = 1.0


def ratio(column: str, ours: str, *others: str) -> Callable[[Model], float]:
    """Return the figure: ours by the least of others."""
    return lambda model: model[ours][column] / max(min(model[name][column] for name in others), 1e-9)


def singles(model: Model, name: str) -> float:
    """Return the number of bricks of one stud."""
    row = model[name]
    return row["single"] * row.get("bricks", row.get("nb"))


def fewer_singles(model: Model) -> float:
    """Return our bricks of one stud by those of the greedy layout."""
    return singles(model, STANDARD) / max(singles(model, GREEDY), 1)


def hollower_than(method: str) -> Callable[[Model], float]:
    """Return the figure: our hollow ratio less another."""
    return lambda model: model[STANDARD]["hor"] - model[method]["hor"]


def our(column: str) -> Callable[[Model], float]:
    """Return the figure that a column of ours gives."""
    return lambda model: model[STANDARD][column]


def free_singles(model: Model) -> float:
    """Return the share of our bricks that have one stud, beyond the fewest that colours and heights force."""
    row = model[STANDARD]
    return row["single"] - row["forced_single"] / row["nb"]


def least_on_nothing(model: Model) -> float:
    """Return the fewest bricks on nothing that a baseline has."""
    return min(model[name]["nothing_beneath"] for name in BASELINES)


def most_faults(model: Model) -> float:
    """Return the most faults that a method makes."""
    return max(row["faults"] for row in model.values())


SAME: Final = (
    Goal("H3", "time by that of A* or annealing", ratio("tc_s", STANDARD, SEARCHED, SEARCHED_FEW, ANNEALED), 1 / 3),
    Goal("H3", "bricks by those of A* or annealing", ratio("bricks", STANDARD, SEARCHED, SEARCHED_FEW, ANNEALED), 1.0),
    Goal("row 57", "faults of all methods", most_faults, 0),
    Goal("H5", "bricks by the best baseline's", ratio("bricks", STANDARD, *BASELINES), 1.0, share=0.8),
    Goal("H5", "bricks by those of largest first", ratio("bricks", STANDARD, GREEDY), 0.94, mean=True),
    Goal("H5", "bricks by those of random merge", ratio("bricks", STANDARD, RANDOM), 0.6, mean=True),
    Goal("H6", "1 x 1 by those of largest first", fewer_singles, 0.5, mean=True),
    Goal("H12", "bricks of the fast tier by those without learning", ratio("bricks", FAST, UNLEARNED), 1.0, mean=True),
)
"""On the same cells."""

OWN: Final = (
    Goal("H3", "time by that of A* or annealing", ratio("tc_s", STANDARD, SEARCHED, SEARCHED_FEW, ANNEALED), 1 / 3),
    Goal("H4", "hollow ratio less that of B2", hollower_than(STAGGERED), 0, most=False),
    Goal("H4", "hollow ratio less that of B3", hollower_than(SEARCHED), 0, most=False),
    Goal("H4", "hollow ratio less that of B4", hollower_than(ANNEALED), 0, most=False),
    Goal("H4", "visible cells missing or of another colour", our("visible_lost"), 0),
    Goal("H5", "bricks by the best baseline's", ratio("nb", STANDARD, *BASELINES), 1.0, share=0.8),
    Goal("H5", "bricks by those of largest first", ratio("nb", STANDARD, GREEDY), 0.94, mean=True),
    Goal("H5", "bricks by those of random merge", ratio("nb", STANDARD, RANDOM), 0.6, mean=True),
    Goal("H6", "1 x 1 by those of largest first", fewer_singles, 0.5, mean=True),
    Goal("H6", "1 x 1 beyond those that are forced, of all bricks", free_singles, 0.03),
    Goal("H11", "bricks on nothing of the best baseline", least_on_nothing, 1, most=False),
    Goal("H11", "our bricks on nothing", our("nothing_beneath"), 0),
    Goal("row 57", "our bricks that float", our("floating"), 0),
    Goal("row 57", "faults of all methods", most_faults, 0),
)
"""With the hollowing of each method."""


def goals_met(same: Sequence[Row], own: Sequence[Row], volumes: Sequence[Row], peers: Sequence[Row]) -> list[Row]:
    """Return a row for each goal.

    Parameters
    ----------
    same, own : sequence of dict
        Rows of the layouts on the same cells, and of Table 3.
    volumes : sequence of dict
        Rows of Table 1.
    peers : sequence of dict
        Rows of the peer, if it was asked.

    Returns
    -------
    list of dict
        Limit, worst and mean of the models, and which do not keep it.
    """
    rows = [row_of(goal, by_model(same), "same") for goal in SAME]
    rows += [row_of(goal, by_model(own), "own hollowing") for goal in OWN]
    large = Goal("H7", "volume of 2 x 4 and larger by that of 1 x 2 and smaller", larger, 1.0, most=False)
    totals = {row["model"]: {"volume": row} for row in volumes if row["code"] is None}
    rows.append(row_of(large, totals, "own hollowing"))
    for strategy in dict.fromkeys(row["strategy"] for row in peers):
        asked = {row["model"]: {"peer": row} for row in peers if row["strategy"] == strategy}
        rows += [row_of(goal, asked, "same") for goal in peer_goals(strategy)]
    return rows


def larger(model: Model) -> float:
    """Return the volume of the large bricks by that of the small ones."""
    row = model["volume"]
    large = sum(row[f"Brick {name}"] for name in ("2 x 4", "2 x 6", "2 x 8"))
    return large / max(sum(row[f"Brick {name}"] for name in ("1 x 1", "1 x 2")), 1e-9)


def peer_goals(strategy: str) -> list[Goal]:
    """Return the goals against one strategy of the peer, for both of our tiers."""
    wanted = (("fewer", "bricks saved", FEWER), ("faster", "times less CPU", FASTER))
    return [
        Goal("peer", f"{text} by {tier} against {strategy}", of_peer(f"{tier}_{column}"), limit, most=False)
        for tier in (FAST, STANDARD)
        for column, text, limit in wanted
    ]


def of_peer(column: str) -> Callable[[Model], float]:
    """Return the figure that a column of the peer's table gives."""
    return lambda model: model["peer"][column]


def by_model(rows: Sequence[Row]) -> dict[str, Model]:
    """Return the rows by model and method."""
    models: dict[str, Model] = {}
    for row in rows:
        models.setdefault(row["model"], {})[row["method"]] = row
    return models


def row_of(goal: Goal, models: dict[str, Model], cells: str) -> Row:
    """Return the row of a goal."""
    found = {name: float(goal.figure(rows)) for name, rows in models.items()}
    broken = [name for name, value in found.items() if not keeps(goal, value)]
    mean = float(np.mean(list(found.values())))
    met = keeps(goal, mean) if goal.mean else len(broken) <= (1 - goal.share) * len(found) + 1e-9
    return {
        "goal": goal.name,
        "cells": cells,
        "what": goal.text,
        "at_most": goal.limit if goal.most else None,
        "at_least": None if goal.most else goal.limit,
        "counts": "mean" if goal.mean else f"{goal.share:.0%} of models",
        "worst": max(found.values()) if goal.most else min(found.values()),
        "mean": mean,
        "not_by": ", ".join(broken) or None,
        "met": met,
    }


def keeps(goal: Goal, value: float) -> bool:
    """Tell whether a figure keeps a goal."""
    return value <= goal.limit if goal.most else value >= goal.limit
