"""Which slopes a model gets: chosen by the exact cut of the mesh before the bricks are laid."""

from __future__ import annotations

from .behind import open_up
from .choice import Slopes, choose_slopes

__all__ = [
    "Slopes",
    "choose_slopes",
    "open_up",
]
