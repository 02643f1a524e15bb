"""The dominant colours of the textures, and the brick colours that stand for them."""

from __future__ import annotations

from .difference import ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear
from .dominant import SurfaceColours, chosen_palette, surface_colours
from .texels import texel_at

__all__ = [
    "SurfaceColours",
    "chosen_palette",
    "ciede2000",
    "lab_from_srgb",
    "linear_from_srgb",
    "srgb_from_linear",
    "surface_colours",
    "texel_at",
]
