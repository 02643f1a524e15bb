"""The dominant colours of the textures, and the brick colours that stand for them."""

from __future__ import annotations

from .brick_difference import brick_differences
from .counted import count_texels
from .difference import ciede2000, lab_from_linear, lab_from_srgb, linear_from_srgb, srgb_from_linear
from .dithering import PaletteMixer
from .dominant import Dominant, SurfaceColours, chosen_palette, image_colours, surface_colours
from .replacing import replaced, replacements, replacements_text
from .shares import colour_shares
from .texels import texel_at, texels_at

__all__ = [
    "Dominant",
    "PaletteMixer",
    "SurfaceColours",
    "brick_differences",
    "chosen_palette",
    "ciede2000",
    "colour_shares",
    "count_texels",
    "image_colours",
    "lab_from_linear",
    "lab_from_srgb",
    "linear_from_srgb",
    "replaced",
    "replacements",
    "replacements_text",
    "srgb_from_linear",
    "surface_colours",
    "texel_at",
    "texels_at",
]
