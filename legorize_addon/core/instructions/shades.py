"""Colours of the pictures: of the sides of a brick in light and shade, of lines, of what is pale."""

from __future__ import annotations

from typing import Final

from .canvas import Rgb

SIDE_LIGHT: Final = (1.0, 0.72, 0.86)
"""Light on the top of a brick, on its side to the right, on its side to the left: the light comes from the left."""

PALE: Final = 0.62
"""Share of white in the colours of what was built before."""

SUPPORT_TINT: Final[Rgb] = (255, 122, 40)
"""What supports are tinted with, as no part of the model is: they go away again."""

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


def tinted(rgb: Rgb) -> Rgb:
    """Return the colour of a support."""
    return mixed(rgb, SUPPORT_TINT, TINT)


def brightness(rgb: Rgb) -> float:
    """Return how bright a colour is, from 0 to 1 (weights of Rec. 709 on the bytes, as eyes judge them)."""
    red, green, blue = rgb
    return (0.2126 * red + 0.7152 * green + 0.0722 * blue) / 255
