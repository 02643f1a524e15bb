"""Pictures of the builds of a scene."""

from __future__ import annotations

from .film import Cut, make_film, render_frames
from .still import AZIMUTH, render_still

__all__ = [
    "AZIMUTH",
    "Cut",
    "make_film",
    "render_frames",
    "render_still",
]
