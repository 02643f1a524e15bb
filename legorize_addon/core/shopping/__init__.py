"""What to buy: the lots of a model, and the lists that people and shops read."""

from __future__ import annotations

from .formats import FORMATS, list_texts
from .lots import Lot, count_lots, mass_of, not_made, priced
from .shopping_list import SECONDS_A_BRICK, ShoppingList, shopping_list

__all__ = [
    "FORMATS",
    "SECONDS_A_BRICK",
    "Lot",
    "ShoppingList",
    "count_lots",
    "list_texts",
    "mass_of",
    "not_made",
    "priced",
    "shopping_list",
]
