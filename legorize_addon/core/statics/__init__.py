"""Whether a model stands: forces in balance as proof that it does, a motion as proof that it does not."""

from __future__ import annotations

from .equilibrium import AIMS, SOON, SPARE, Aim
from .forces import GRAVITY, HOLD, Statics
from .stability import PROGRAMME, Effort, Stability, stability, torn_by

__all__ = [
    "AIMS",
    "GRAVITY",
    "HOLD",
    "PROGRAMME",
    "SOON",
    "SPARE",
    "Aim",
    "Effort",
    "Stability",
    "Statics",
    "stability",
    "torn_by",
]
