"""Which slopes a model gets: chosen by the exact cut of the mesh before the bricks are laid."""

from __future__ import annotations

from .choice import choose_slopes

__all__ = [
    "choose_slopes",
]
