"""Which bricks cover the cells: :func:`lay` in its three tiers, and what joins their result to one model."""

from __future__ import annotations

from .lay import FILLER, lay
from .recolour import recolour_visible

__all__ = [
    "FILLER",
    "lay",
    "recolour_visible",
]
