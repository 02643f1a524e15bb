"""Shades that no brick has, as mixtures of brick colours that look like them from afar.

Light adds up in the eye, so mixtures are computed in linear light; the nearest brick colour is found by CIEDE2000.

References
----------
B. E. Bayer, "An optimum method for two-level rendition of continuous-tone
pictures", IEEE International Conference on Communications (1973): the matrix of
thresholds. T. Knoll, US patent 6606166 (1999, expired): candidates for any
palette, by error feedback at one point, sorted by luminance. R. W. Floyd and
L. Steinberg, "An adaptive algorithm for spatial greyscale", Proceedings of the
Society for Information Display 17(2), 1976.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..model import Catalogue
from .difference import ciede2000, lab_from_srgb, linear_from_srgb, srgb_from_linear

_BAYER: Final = np.array([[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]])
"""Ranks of 16 thresholds.

A matrix of 64 came up to a twentieth nearer to pictures and gradients blurred over a stud, and farther from a ramp.
"""

_FEEDBACK: Final = 0.5
"""Share of the error that the next candidate makes up for; with more of it, farther colours come in for no gain."""

_KERNEL: Final = ((0, 1, 7 / 16), (1, -1, 3 / 16), (1, 0, 5 / 16), (1, 1, 1 / 16))
"""Step along rows and columns, and share of the error that goes there.

Every row in the same direction: so a whole diagonal can be done at once. Turning
at the end of each row (serpentine) came up to a tenth nearer on ramps blurred over
two studs, and up to 3 % farther on gradients blurred over one.
"""

_BEYOND: Final = 0.1
"""Light beyond black and white that may be wanted: errors that no mixture can make up for are not passed on."""

_LEVELS: Final = 64
"""Levels of each channel for which the nearest colour is looked up once."""

_LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])

Codes = NDArray[np.int16]


class PaletteMixer:
    """Mixes the colours of a palette.

    Parameters
    ----------
    palette : (k,) int16 array
        LDraw codes.
    catalogue : Catalogue
    """

    def __init__(self, palette: Codes, catalogue: Catalogue) -> None:
        rgb = catalogue.rgb[[catalogue.colour_row(int(code)) for code in palette]]
        # LDraw's Black is a dark blue-grey, the plastic is black: it stands for both
        black = palette[palette == 0]
        self._codes: Codes = np.concatenate([palette, black])
        self._rgb = np.concatenate([rgb, np.zeros((len(black), 3), dtype=np.uint8)])
        self._light = linear_from_srgb(self._rgb)
        self._lab = lab_from_srgb(self._rgb)
        self._nearest = np.full(_LEVELS**3, -1, dtype=np.int16)

    def nearest(self, light: Floats) -> Codes:
        """Return the LDraw codes, (...), of the colours nearest to light, (..., 3)."""
        found: Codes = self._codes[self._choice(light)]
        return found

    def ordered(self, goal: Floats, row: Ints, column: Ints) -> Codes:
        """Return the colours of places in a fixed pattern.

        Parameters
        ----------
        goal : (n, 3) float64 array
            Wanted light: red, green, blue, 0 to 1.
        row, column : (n,) int64 arrays
            Place in the pattern, which repeats.

        Returns
        -------
        (n,) int16 array
            LDraw codes. Where one colour is enough all places have it.
        """
        error = np.zeros_like(goal)
        candidates = np.empty((len(goal), _BAYER.size), dtype=np.int64)
        for number in range(_BAYER.size):
            candidates[:, number] = self._choice(goal + _FEEDBACK * error)
            error += goal - self._light[candidates[:, number]]
        brightness = (self._light @ _LUMINANCE)[candidates]
        order = np.lexsort((candidates, brightness), axis=1)
        rank = _BAYER[row % len(_BAYER), column % len(_BAYER)]
        rows = np.arange(len(goal))
        found: Codes = self._codes[candidates[rows, order[rows, rank]]]
        return found

    def diffused(self, goal: Floats, there: Mask) -> Codes:
        """Return the colours of a raster where each place passes its error on to the next ones.

        Parameters
        ----------
        goal : (h, w, s, 3) float64 array
            Wanted light at the s parts of every place.
        there : (h, w, s) bool array
            Parts that exist.

        Returns
        -------
        (h, w, s) int16 array
            LDraw codes, without meaning where no part exists.
        """
        height, width, parts, _ = goal.shape
        chosen = np.zeros((height, width, parts), dtype=np.int64)
        # a margin takes what is passed beyond the raster
        passed = np.zeros((height + 1, width + 2, 3))
        count = np.maximum(there.sum(axis=2), 1)
        for diagonal in range(width + 2 * (height - 1)):
            row = np.arange(max(0, (diagonal - width + 2) // 2), min(height - 1, diagonal // 2) + 1)
            column = diagonal - 2 * row
            wanted = np.clip(goal[row, column] + passed[row, column + 1][:, None], -_BEYOND, 1 + _BEYOND)
            chosen[row, column] = picked = self._choice(wanted)
            rest = np.where(there[row, column][..., None], wanted - self._light[picked], 0).sum(axis=1)
            rest /= count[row, column][:, None]
            for down, right, share in _KERNEL:
                passed[row + down, column + right + 1] += share * rest
        found: Codes = self._codes[chosen]
        return found

    def _choice(self, light: Floats) -> Ints:
        """Return the row of the nearest colour, (...), of light, (..., 3)."""
        level = (srgb_from_linear(light).astype(np.int64) * (_LEVELS - 1) + 127) // 255
        key = (level[..., 0] * _LEVELS + level[..., 1]) * _LEVELS + level[..., 2]
        new = np.unique(key[self._nearest[key] < 0])
        if len(new):
            levels = np.stack(np.unravel_index(new, (_LEVELS,) * 3), axis=1)
            lab = lab_from_srgb(np.rint(levels * 255 / (_LEVELS - 1)).astype(np.uint8))
            self._nearest[new] = ciede2000(lab[:, None], self._lab[None]).argmin(axis=1)
        choice: Ints = self._nearest[key].astype(np.int64)
        return choice
