"""What a model takes from the owned parts, and what is missing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from ..arrays import Floats, Ints
from ..build import Build, Finished
from ..colours import ciede2000, lab_from_srgb
from ..model import NOBODY, Assembly, Catalogue
from ..owned import SMALL
from ..shopping import ShoppingList
from ..stock import Owned


def used_lots(assembly: Assembly) -> Ints:
    """Count the bricks of each lot, (n_parts, n_colours)."""
    bricks, catalogue = assembly.bricks, assembly.catalogue
    used = np.zeros(catalogue.exists.shape, dtype=np.int64)
    np.add.at(used, (bricks.part, catalogue.colour_rows(bricks.colour)), 1)
    return used


def missing_list(wanted: ShoppingList, owned: Owned, catalogue: Catalogue) -> ShoppingList:
    """Return what a list has more of than is owned.

    Parameters
    ----------
    wanted : ShoppingList
        Of everything that is built.
    owned : Owned
    catalogue : Catalogue

    Returns
    -------
    ShoppingList
        May be empty.
    """
    part = {each.number: row for row, each in enumerate(catalogue.parts)}
    colour = {each.code: row for row, each in enumerate(catalogue.colours)}
    left = [(lot, lot.count - int(owned.count[part[lot.part.number], colour[lot.colour.code]])) for lot in wanted.lots]
    return replace(wanted, lots=tuple(replace(lot, count=count) for lot, count in left if count > 0))


def owned_facts(build: Finished, catalogue: Catalogue) -> dict[str, Any] | None:
    """Return what a build takes from the owned parts; None if no inventory was given.

    Returns
    -------
    dict or None
        ``missing`` counts bricks beyond the owned ones, supports included; ``colour_difference`` is the mean
        CIEDE2000 of the cells that have a colour, between brick and model.
    """
    if build.owned is None:
        return None
    used = used_lots(Assembly(build.supports.bricks, catalogue))
    beyond = np.maximum(used - build.owned.count, 0)
    return {
        "use": build.settings.owned_use,
        "owned": int(build.owned.count.sum()),
        "not_usable": build.owned.others,
        "used": int(used.sum() - beyond.sum()),
        "missing": int(beyond.sum()),
        "missing_lots": int(np.count_nonzero(beyond)),
        **_likeness(build, catalogue),
    }


def lot_facts(build: Finished, catalogue: Catalogue) -> dict[str, Any] | None:
    """Return how many lots a model has, and what fewer lots cost in likeness; None unless fewer were asked for."""
    if not build.settings.few_lots:
        return None
    used = used_lots(Assembly(build.bricks, catalogue))
    return {
        "lots": int(np.count_nonzero(used)),
        "small_lots": int(np.count_nonzero((used > 0) & (used <= SMALL))),
        **_likeness(build, catalogue),
    }


def _likeness(build: Finished, catalogue: Catalogue) -> dict[str, float]:
    """Return how many cells with a colour have another one than the model, and the mean difference of all of them."""
    apart = colour_differences(build, catalogue) if isinstance(build, Build) else np.zeros(0)
    return {
        "other_colour_percent": round(100 * float((apart > 0).mean()), 2) if len(apart) else 0.0,
        "colour_difference": round(float(apart.mean()), 3) if len(apart) else 0.0,
    }


def colour_differences(build: Build, catalogue: Catalogue) -> Floats:
    """Return how the bricks differ from the colours of the model, CIEDE2000 of each cell that has a colour, (n,)."""
    graph, colour = build.graph, build.hollow.colour.reshape(-1, *build.hollow.colour.shape[2:])
    cell = np.argwhere(graph.owner != NOBODY)
    owner = graph.owner[tuple(cell.T)]
    at = cell + graph.low[::-1]
    inside = ((at >= 0) & (at < colour.shape)).all(axis=1)
    wanted = colour[tuple(at[inside].T)]
    there = wanted >= 0
    lab = lab_from_srgb(catalogue.rgb)
    own = catalogue.colour_rows(build.bricks.colour[owner[inside][there]])
    return np.asarray(ciede2000(lab[own], lab[catalogue.colour_rows(wanted[there])]))
