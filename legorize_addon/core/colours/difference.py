"""How different two colours look.

References
----------
CIE 15:2004 (CIELAB, D65); G. Sharma, W. Wu and E. N. Dalal, "The CIEDE2000
color-difference formula: implementation notes, supplementary test data, and
mathematical observations", Color Research and Application 30(1), 2005.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats

_XYZ_FROM_LINEAR = np.array(
    [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
)
_WHITE = np.array([0.95047, 1.0, 1.08883])

_ROUNDING: Final = 1e-9
"""Degrees within which two hues are opposite."""


def linear_from_srgb(encoded: NDArray[np.uint8]) -> Floats:
    """Return linear colours in [0, 1] of sRGB bytes; any shape."""
    share = np.arange(256) / 255.0
    linear: Floats = np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)[encoded]
    return linear


def srgb_from_linear(linear: NDArray[np.floating]) -> NDArray[np.uint8]:
    """Return sRGB bytes of linear colours, cut to [0, 1]; any shape."""
    share = np.clip(linear, 0.0, 1.0)
    curve = np.where(share <= 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)
    encoded: NDArray[np.uint8] = np.rint(curve * 255.0).astype(np.uint8)
    return encoded


def lab_from_srgb(rgb: NDArray[np.uint8]) -> Floats:
    """Return CIELAB of sRGB bytes, shape (..., 3)."""
    return lab_from_linear(linear_from_srgb(rgb))


def lab_from_linear(linear: Floats) -> Floats:
    """Return CIELAB of linear colours in [0, 1], shape (..., 3)."""
    xyz = linear @ _XYZ_FROM_LINEAR.T / _WHITE
    f = np.where(xyz > (6 / 29) ** 3, np.cbrt(xyz), xyz / (3 * (6 / 29) ** 2) + 4 / 29)
    x, y, z = f[..., 0], f[..., 1], f[..., 2]
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def ciede2000(first: Floats, second: Floats) -> Floats:
    """Return the CIEDE2000 difference of CIELAB colours.

    Parameters
    ----------
    first, second : (..., 3) float64 arrays
        CIELAB; the shapes broadcast.

    Returns
    -------
    (...) float64 array
        About 1 is just noticeable.

    References
    ----------
    Sharma, Wu and Dalal 2005, equations 2 to 22; letters as there, primes left out.
    """
    l1, l2 = first[..., 0], second[..., 0]
    c1, h1, c2, h2 = _chroma_and_hue(first, second)
    l_mean, c_mean = (l1 + l2) / 2, (c1 + c2) / 2
    grey = c1 * c2 == 0
    turn = h2 - h1
    # opposite hues stay as they are, whatever the rounding, so that both orders of the colours agree
    turn = np.where(grey, 0, turn - 360 * np.sign(turn) * (np.abs(turn) > 180 + _ROUNDING))
    h_mean = np.where(grey, h1 + h2, h1 + turn / 2) % 360
    t = (
        1
        - 0.17 * _cos(h_mean - 30)
        + 0.24 * _cos(2 * h_mean)
        + 0.32 * _cos(3 * h_mean + 6)
        - 0.20 * _cos(4 * h_mean - 63)
    )
    dl = (l2 - l1) / (1 + 0.015 * (l_mean - 50) ** 2 / np.sqrt(20 + (l_mean - 50) ** 2))
    dc = (c2 - c1) / (1 + 0.045 * c_mean)
    dh = 2 * np.sqrt(c1 * c2) * np.sin(np.radians(turn / 2)) / (1 + 0.015 * c_mean * t)
    bend = -2 * _seventh(c_mean) * np.sin(np.radians(60 * np.exp(-(((h_mean - 275) / 25) ** 2))))
    difference: Floats = np.sqrt(dl**2 + dc**2 + dh**2 + bend * dc * dh)
    return difference


def _chroma_and_hue(first: Floats, second: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Return chroma and hue (degrees) of both colours, with a* stretched near grey."""
    mean = (np.hypot(first[..., 1], first[..., 2]) + np.hypot(second[..., 1], second[..., 2])) / 2
    stretch = 1 + 0.5 * (1 - _seventh(mean))
    a1, a2 = first[..., 1] * stretch, second[..., 1] * stretch
    b1, b2 = first[..., 2], second[..., 2]
    return (
        np.hypot(a1, b1),
        np.degrees(np.arctan2(b1, a1)) % 360,
        np.hypot(a2, b2),
        np.degrees(np.arctan2(b2, a2)) % 360,
    )


def _seventh(chroma: Floats) -> Any:
    return np.sqrt(chroma**7 / (chroma**7 + 25.0**7))


def _cos(degrees: Floats) -> Any:
    return np.cos(np.radians(degrees))
