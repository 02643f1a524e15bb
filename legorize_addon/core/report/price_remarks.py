"""What a model costs, in sentences."""

from __future__ import annotations

import numpy as np

from ..model import Bricks, Catalogue
from ..stock import Prices
from ..units import count_of


def remarks_on_prices(prices: Prices | None, bricks: Bricks, removed: Bricks, catalogue: Catalogue) -> tuple[str, ...]:
    """Say what a model costs, and how much of that is an estimate.

    Parameters
    ----------
    prices : Prices or None
        None if there is no price file.
    bricks, removed : Bricks
        The model, and the supports that are taken out of it again.
    catalogue : Catalogue

    Returns
    -------
    tuple of str
        One or two sentences, none without a price file.
    """
    if prices is None:
        return ()
    each, known = prices.each(bricks, catalogue), prices.known(bricks, catalogue)
    below = prices.each(removed, catalogue).sum()
    more = f", and its temporary supports {prices.money(below)}" if len(removed) else ""
    sentences = [f"By the price file the model costs {prices.money(each.sum())}{more}."]
    if not known.all():
        lots = np.unique(np.column_stack([bricks.part, bricks.colour])[~known], axis=0)
        sentences.append(
            f"The price file has no price for {len(lots)} of the model's lots "
            f"({count_of(int(np.count_nonzero(~known)), 'brick', 'bricks')}): "
            f"{prices.money(each[~known].sum())} of the sum are estimated from the same parts in other colours, or "
            "from their mass."
        )
    return tuple(sentences)
