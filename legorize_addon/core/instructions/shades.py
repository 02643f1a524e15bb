"""Colours of the pictures: of the sides of a brick in light and shade, of lines, of what is pale."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Ints
from .canvas import Rgb

SIDE_LIGHT: Final = (1.0, 0.86, 0.72)
"""Light on the top of a brick, on its side to the left, on its side to the right: the light comes from the left."""

PALE: Final = 0.62
"""Share of white in the colours of what was built before."""

SUPPORT_TINT: Final[Rgb] = (255, 122, 40)
"""What supports are tinted with, as no part of the model is: they go away again."""

TINTS: Final[tuple[Rgb, ...]] = (SUPPORT_TINT, (0, 190, 196), (222, 60, 190), (120, 200, 40))
"""Other tints, for models that have the first one's colour themselves."""

TINT: Final = 0.55
"""Share of it in the colours of supports."""

DARK: Final = 0.28
"""Brightness of a colour below which lines on it are light."""

LINE: Final[Rgb] = (20, 20, 22)
LIGHT_LINE: Final[Rgb] = (176, 180, 186)
PALE_LINE: Final[Rgb] = (150, 150, 154)


def mixed(one: Rgb, other: Rgb, share: float) -> Rgb:
    """Return a colour with a share of another one."""
    red, green, blue = (round(a + (b - a) * share) for a, b in zip(one, other, strict=True))
    return red, green, blue


def lit(rgb: Rgb, side: int) -> Rgb:
    """Return the colour of a side of a brick."""
    return mixed((0, 0, 0), rgb, SIDE_LIGHT[side])


def pale(rgb: Rgb) -> Rgb:
    """Return the colour of what was built before."""
    return mixed(rgb, (255, 255, 255), PALE)


def tinted(rgb: Rgb, tint: Rgb = SUPPORT_TINT) -> Rgb:
    """Return the colour of a support."""
    return mixed(rgb, tint, TINT)


def tint_for(colours: Ints) -> Rgb:
    """Return the tint that is farthest from the colours of a model, (n, 3) bytes, of each brick one.

    A colour counts as far as bricks have it: a few bricks do not decide.
    """
    found, count = np.unique(colours.reshape(-1, 3), axis=0, return_counts=True)
    common = found[count * _RARE >= count.sum()]
    away = [np.abs(common - tint).sum(axis=1).min(initial=_NEAR) for tint in TINTS]
    return TINTS[int(np.argmax(away))]


_RARE: Final = 50
"""A colour of less than one brick in so many is rare."""

_NEAR: Final = 180
"""Difference over the three channels from which on a colour is not taken for the tint."""


def brightness(rgb: Rgb) -> float:
    """Return how bright a colour is, from 0 to 1 (weights of Rec. 709 on the bytes, as eyes judge them)."""
    red, green, blue = rgb
    return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255
