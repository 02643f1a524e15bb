"""Mosaics of images: studs of a picture, their colours, a base and what covers it, or a wall."""

from __future__ import annotations

from .base import lay_base
from .cover import Covered, Surface, cover_base, surface_parts
from .likeness import seen_from_afar
from .picture import Picture, picture_of
from .studs import Canvas, Goal, canvas_of, goal_of, longer_side
from .tints import fewer_colours, stud_colours, winning_colours
from .wall import DEEP, wall_of

__all__ = [
    "DEEP",
    "Canvas",
    "Covered",
    "Goal",
    "Picture",
    "Surface",
    "canvas_of",
    "cover_base",
    "fewer_colours",
    "goal_of",
    "lay_base",
    "longer_side",
    "picture_of",
    "seen_from_afar",
    "stud_colours",
    "surface_parts",
    "wall_of",
    "winning_colours",
]
