"""How bricks look from afar: blurred over a few studs, in linear light."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear
from tests.core.textured import rgb_of

BLUR = 1.5
"""Standard deviation in studs."""


def light_of(codes) -> np.ndarray:
    """Return the linear light of brick colours, (..., 3)."""
    kinds, row = np.unique(codes, return_inverse=True)
    return linear_from_srgb(rgb_of(kinds))[row.reshape(np.shape(codes))]


def from_afar(light) -> np.ndarray:
    """Return a picture in linear light, (h, w, 3), as CIELAB of what is seen of it from afar."""
    blurred = ndimage.gaussian_filter(light, (BLUR, BLUR, 0), mode="nearest")
    return lab_from_srgb(srgb_from_linear(blurred))


def difference_from_afar(codes, light) -> float:
    """Return the mean CIEDE2000 between bricks, (h, w), and a picture in linear light, (h, w, 3)."""
    return float(ciede2000(from_afar(light_of(codes)), from_afar(light)).mean())
