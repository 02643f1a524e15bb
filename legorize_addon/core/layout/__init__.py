"""Which bricks cover the cells: :func:`lay` in its three tiers, and the joining of their result into one model."""

from __future__ import annotations

from .lay import FILLER, lay
from .recolour import recolour_visible

__all__ = [
    "FILLER",
    "lay",
    "recolour_visible",
]
