"""How like its image a mosaic looks."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter

from ..arrays import Floats
from ..colours import ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear
from ..model import Catalogue
from .studs import Goal

_BLUR: Final = 1.0
"""Standard deviation in studs: from so far, single studs run into one another."""


def seen_from_afar(goal: Goal, colour: NDArray[np.int16], catalogue: Catalogue) -> float:
    """Return how far the colours of studs are from those of the image, both blurred over a stud.

    Parameters
    ----------
    goal : Goal
    colour : (rows, columns) int16 array
        LDraw codes, of no meaning where no stud is covered.
    catalogue : Catalogue

    Returns
    -------
    float
        Mean CIEDE2000 difference of the covered studs; about 1 is just noticeable.
    """
    rows = np.searchsorted(catalogue.codes, np.where(goal.there, colour, catalogue.codes[0]))
    shown = linear_from_srgb(catalogue.rgb[rows])
    difference = ciede2000(_blurred(goal.light, goal), _blurred(shown, goal))
    return float(difference[goal.there].mean())


def _blurred(light: Floats, goal: Goal) -> Floats:
    """Return CIELAB of light that is blurred within what is covered."""
    weight = goal.there.astype(float)
    share = gaussian_filter(weight, _BLUR, mode="constant")[..., None]
    mean = gaussian_filter(light * weight[..., None], (_BLUR, _BLUR, 0), mode="constant") / np.maximum(share, 1e-9)
    return lab_from_srgb(srgb_from_linear(mean))
