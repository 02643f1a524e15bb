"""Which cells of the grid are required, optional or empty, and what the shell needs to hold together."""

from __future__ import annotations

from .cohesion import count_additions, make_cohesive
from .hollowing import hollow
from .near_bodies import free_bodies
from .regions import tally_cases

__all__ = [
    "count_additions",
    "free_bodies",
    "hollow",
    "make_cohesive",
    "tally_cases",
]
