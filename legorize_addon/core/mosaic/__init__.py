"""Mosaics of images: studs of a picture, their colours, a base, and what covers it."""

from __future__ import annotations

from .base import lay_base
from .cover import Covered, cover_base, surface_parts
from .likeness import seen_from_afar
from .picture import Picture, picture_of
from .studs import Canvas, Goal, canvas_of, goal_of, longer_side
from .tints import fewer_colours, stud_colours, winning_colours

__all__ = [
    "Canvas",
    "Covered",
    "Goal",
    "Picture",
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
    "winning_colours",
]
