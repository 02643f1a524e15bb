"""Ways to solve the covering problem of a sheet: greedy, linear programmes, branch and bound, exchanges."""

from __future__ import annotations

from .covering_lp import WHOLE, prices
from .exchange import exchange, fewer_small, gains
from .greedy import cover
from .pricing import guessed_prices

__all__ = [
    "WHOLE",
    "cover",
    "exchange",
    "fewer_small",
    "gains",
    "guessed_prices",
    "prices",
]
