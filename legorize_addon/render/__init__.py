"""Pictures of the builds of a scene."""

from __future__ import annotations

from .still import AZIMUTH, render_still

__all__ = [
    "AZIMUTH",
    "render_still",
]
