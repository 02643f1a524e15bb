"""Whether a model stands: forces in balance as proof that it does, a motion as proof that it does not."""

from __future__ import annotations

from .equilibrium import AIMS, Aim
from .forces import GRAVITY, HOLD, Statics
from .stability import Stability, stability, torn_by

__all__ = [
    "AIMS",
    "GRAVITY",
    "HOLD",
    "Aim",
    "Stability",
    "Statics",
    "stability",
    "torn_by",
]
