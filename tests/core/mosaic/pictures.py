"""Images for the tests of mosaics, made by numbers."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.mosaic.picture import picture_of

CATALOGUE = load_catalogue()


def painted(codes, scale=1):
    """Return an image with a square of pixels in a brick colour for each LDraw code, row 0 at the bottom."""
    rgb = CATALOGUE.rgb[np.searchsorted(CATALOGUE.codes, codes)]
    return picture_of(np.repeat(np.repeat(rgb, scale, axis=0), scale, axis=1))


def ramp(height=40, width=60):
    """Return an image whose bytes grow from black on the left to white on the right."""
    grey = np.broadcast_to(np.linspace(0, 255, width), (height, width))
    return picture_of(np.repeat(grey[..., None], 3, axis=2).astype(np.uint8))
