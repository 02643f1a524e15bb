"""What parts cost, and which parts a user owns: price files and inventories of other programs, read as they are."""

from __future__ import annotations

from .inventory import Owned, read_owned
from .prices import Prices, read_prices

__all__ = [
    "Owned",
    "Prices",
    "read_owned",
    "read_prices",
]
