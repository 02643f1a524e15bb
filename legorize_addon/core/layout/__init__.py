"""Which bricks cover the cells: :func:`lay` in its three tiers, and the joining of their result into one model."""

from __future__ import annotations

from .again import as_good, cells_of, lay_again
from .alike import Alike
from .lay import FILLER, Manner, lay
from .recolour import recolour_visible

__all__ = [
    "FILLER",
    "Alike",
    "Manner",
    "as_good",
    "cells_of",
    "lay",
    "lay_again",
    "recolour_visible",
]
