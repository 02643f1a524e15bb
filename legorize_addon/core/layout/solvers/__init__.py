"""Ways to solve the covering problem of a sheet: greedy, linear programmes, branch and bound, exchanges."""

from __future__ import annotations

from . import exact, greedy, linear
from .covering_lp import WHOLE, prices
from .exchange import exchange, fewer_small, gains
from .greedy import cover
from .pricing import guessed_prices

__all__ = [
    "WHOLE",
    "cover",
    "exact",
    "exchange",
    "fewer_small",
    "gains",
    "greedy",
    "guessed_prices",
    "linear",
    "prices",
]
