"""How much of the textures each brick colour stands for."""

from __future__ import annotations

import numpy as np

from .dominant import SurfaceColours

Share = tuple[tuple[int, int, int], int, int, float]
"""Mean of some texels, sRGB bytes; the brick colour that is nearest; what stands for it; the share of all texels."""


def colour_shares(found: SurfaceColours) -> list[Share]:
    """Return the mean colour of all texels of each brick colour.

    Parameters
    ----------
    found : SurfaceColours

    Returns
    -------
    list of Share
        Most texels first. What stands for a colour is another one where a user replaced it.
    """
    nearest = found.codes if found.nearest is None else found.nearest
    count = sum(np.bincount(labels.ravel(), minlength=len(found.centres)) for labels in found.labels)
    weight = np.asarray(count, dtype=np.float64)
    shares: list[Share] = []
    for code in np.unique(nearest):
        of_code = nearest == code
        total = weight[of_code].sum()
        if total:
            red, green, blue = np.rint(weight[of_code] @ found.centres[of_code] / total).astype(int).tolist()
            stands = int(found.codes[of_code][0])
            shares.append(((red, green, blue), int(code), stands, float(total / weight.sum())))
    return sorted(shares, key=lambda each: -each[3])
