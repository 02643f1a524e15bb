"""What of the grid must be built, may be built, or stays empty, and what its shell needs to hold together."""

from __future__ import annotations

from .cohesion import make_cohesive
from .hollowing import hollow
from .near_bodies import free_bodies
from .regions import tally_cases

__all__ = [
    "free_bodies",
    "hollow",
    "make_cohesive",
    "tally_cases",
]
