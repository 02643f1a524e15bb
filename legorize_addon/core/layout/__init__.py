"""Which bricks cover the cells: :func:`lay` in three tiers, :func:`lay_learned` as in the paper; then all is joined."""

from __future__ import annotations

from .again import as_good, cells_of, lay_again
from .alike import Alike
from .around import lay_around
from .fixed import owners_of, with_fixed
from .lay import FILLER, Manner, lay, lay_fixed, lay_unjoined
from .lay_learned import lay_learned
from .paying import paying
from .recolour import recolour_visible
from .slopes import lay_around_slopes, lie_among, slopes_beside
from .tops import Smoothed, smooth_tops

__all__ = [
    "FILLER",
    "Alike",
    "Manner",
    "Smoothed",
    "as_good",
    "cells_of",
    "lay",
    "lay_again",
    "lay_around",
    "lay_around_slopes",
    "lay_fixed",
    "lay_learned",
    "lay_unjoined",
    "lie_among",
    "owners_of",
    "paying",
    "recolour_visible",
    "slopes_beside",
    "smooth_tops",
    "with_fixed",
]
