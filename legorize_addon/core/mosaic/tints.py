"""The brick colour of each stud of an image."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..colours import PaletteMixer, ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear
from ..model import COLOUR_EMPTY, Catalogue
from ..texturing import box_means
from .picture import Picture
from .studs import Goal

Codes = NDArray[np.int16]

_AT_ONCE: Final = 4096
"""Studs that are compared with all colours at once."""

_ROWS: Final = 256
"""Rows of pixels that are compared at once."""


def stud_colours(goal: Goal, palette: Codes, catalogue: Catalogue, *, dithering: str) -> Codes:
    """Choose a colour for each stud.

    Parameters
    ----------
    goal : Goal
    palette : (k,) int16 array
        LDraw codes of the colours to use.
    catalogue : Catalogue
    dithering : {"none", "ordered", "diffusion"}
        The nearest colour for each stud by itself, colours mixed in a fixed pattern, or errors passed on to the next
        studs, so that areas look right from afar.

    Returns
    -------
    (rows, columns) int16 array
        LDraw codes, ``COLOUR_EMPTY`` where no stud is covered.
    """
    mixer = PaletteMixer(palette, catalogue)
    if dithering == "diffusion":
        # from the top, as images are read
        found = mixer.diffused(goal.light[::-1, :, None], goal.there[::-1, :, None])[::-1, :, 0]
    elif dithering == "ordered":
        row, column = (each.ravel() for each in np.indices(goal.there.shape))
        found = mixer.ordered(goal.light.reshape(-1, 3), row, column).reshape(goal.there.shape)
    else:
        found = mixer.nearest(goal.light)
    return np.where(goal.there, found, np.int16(COLOUR_EMPTY))


def winning_colours(picture: Picture, goal: Goal, palette: Codes, catalogue: Catalogue) -> Codes:
    """Choose for each stud the colour of most of its pixels, so that edges stay as clear as in a drawing.

    Parameters
    ----------
    picture : Picture
    goal : Goal
        The studs.
    palette : (k,) int16 array
        LDraw codes of the colours to use.
    catalogue : Catalogue

    Returns
    -------
    (rows, columns) int16 array
        LDraw codes, ``COLOUR_EMPTY`` where no stud is covered. What is behind an image counts as little as what cannot
        be seen of it.
    """
    mixer = PaletteMixer(palette, catalogue)
    rows = range(0, len(picture.rgb), _ROWS)
    nearest = np.concatenate([mixer.nearest(linear_from_srgb(picture.rgb[row : row + _ROWS])) for row in rows])
    opacity = picture.alpha.astype(np.float32)
    found = np.full(goal.there.shape, palette[0], dtype=np.int16)
    best = np.zeros(goal.there.shape)
    for code in np.unique(nearest):
        share = box_means(np.where(nearest == code, opacity, np.float32(0)), goal.there.shape)
        found[share > best] = code
        best = np.maximum(best, share)
    return np.where(goal.there, found, np.int16(COLOUR_EMPTY))


def fewer_colours(goal: Goal, palette: Codes, catalogue: Catalogue, most: int) -> Codes:
    """Choose the colours of a palette that an image can least do without.

    The colour whose studs lose least by their next best one is left out, until
    few enough are left.

    Parameters
    ----------
    goal : Goal
    palette : (k,) int16 array
        LDraw codes.
    catalogue : Catalogue
    most : int
        Colours to keep at most.

    Returns
    -------
    (n,) int16 array
        In the order of the palette.
    """
    if len(palette) <= most:
        return palette
    far = _differences(goal.light[goal.there], palette, catalogue)
    kept = np.arange(len(palette))
    while len(kept) > most:
        order = np.argsort(far[:, kept], axis=1, kind="stable")[:, :2]
        best, second = (np.take_along_axis(far[:, kept], order[:, [rank]], axis=1)[:, 0] for rank in (0, 1))
        loss = np.bincount(order[:, 0], second - best, len(kept))
        kept = np.delete(kept, loss.argmin())
    return palette[kept]


def _differences(light: Floats, palette: Codes, catalogue: Catalogue) -> Floats:
    """Return the CIEDE2000 difference of each light, (n, 3), to each colour, shape (n, k)."""
    rgb = catalogue.rgb[[catalogue.colour_row(int(code)) for code in palette]]
    lab, own = lab_from_srgb(srgb_from_linear(light)), lab_from_srgb(rgb)
    parts = [ciede2000(lab[start : start + _AT_ONCE, None], own[None]) for start in range(0, len(lab), _AT_ONCE)]
    return np.concatenate(parts)
