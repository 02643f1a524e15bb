"""What the parts of a model cost by the user's price file."""

from __future__ import annotations

from typing import Any

from ..arrays import Floats
from ..build import Build, Finished
from ..measures import least_cost
from ..model import Catalogue
from ..progress import Progress
from ..shopping import Lot, priced
from ..stock import Prices


def with_prices(lots: tuple[Lot, ...], prices: Prices | None, catalogue: Catalogue) -> tuple[Lot, ...]:
    """Return lots with what one brick costs; as they are if there is no price file."""
    if prices is None:
        return lots
    part = {each.number: row for row, each in enumerate(catalogue.parts)}
    colour = {each.code: row for row, each in enumerate(catalogue.colours)}
    return priced(lots, lambda one, other: float(prices.price[part[one.number], colour[other.code]]))


def price_facts(build: Finished, catalogue: Catalogue, proving: Progress | None) -> dict[str, Any] | None:
    """Return what the model and its supports cost, and how near the model is to the proven bound.

    Parameters
    ----------
    build : Finished
    catalogue : Catalogue
    proving : Progress or None
        Told how far the proof of the bound is; None if nobody waits for it.

    Returns
    -------
    dict or None
        None without a price file. The bound holds for every layout of the same cells and colours, with the same
        columns laid in bricks and in plates, whatever colours hidden bricks have.
    """
    prices = build.prices
    if prices is None:
        return None
    model, supports = prices.each(build.bricks, catalogue), prices.each(build.supports.removed, catalogue)
    estimated = ~prices.known(build.bricks, catalogue)
    least = None
    if proving is not None and isinstance(build, Build):
        least = least_cost(build.hollow, catalogue, prices.price, progress=proving)
    return {
        "currency": prices.currency,
        "goal": build.settings.goal,
        "model": _rounded(model.sum()),
        "supports": _rounded(supports.sum()),
        "estimated": _rounded(model[estimated].sum()),
        "estimated_bricks": int(estimated.sum()),
        "rows_not_used": prices.unknown,
        "least_possible": None if least is None else _rounded(least),
        "at_most_more_percent": None if least is None else _more(float(model.sum()), least),
    }


def _more(cost: float, least: float) -> float | None:
    """Return by how many percent a cost may be above the least one; None if that is nothing."""
    return round(100 * (cost / least - 1), 2) if least > 0 else None


def _rounded(amount: float | Floats) -> float:
    return round(float(amount), 4)
