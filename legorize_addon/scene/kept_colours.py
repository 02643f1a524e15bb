"""The colours that were found in the textures of a build's objects, and what each became, kept with it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import bpy

from .state import BUILD_KEY

KEY: Final = "found_colours"


class FoundColour(NamedTuple):
    """A colour of the textures, and the brick colour that stands for it.

    Attributes
    ----------
    rgb : (int, int, int)
        Mean of its texels, sRGB bytes.
    nearest : int
        LDraw code of the brick colour that is nearest.
    code : int
        What stands for it: another one where the user replaced it.
    share : float
        Of all texels.
    """

    rgb: tuple[int, int, int]
    nearest: int
    code: int
    share: float


def keep_found_colours(
    build: bpy.types.Collection, found: Sequence[tuple[tuple[int, int, int], int, int, float]]
) -> None:
    """Keep the colours with a build, most frequent first."""
    build[BUILD_KEY][KEY] = [value for rgb, nearest, code, share in found for value in (*rgb, nearest, code, share)]


def found_colours(build: bpy.types.Collection) -> list[FoundColour]:
    """Return the colours that a build keeps; none of an image, a brick model or an earlier version."""
    flat = list(build[BUILD_KEY].get(KEY, ()))
    rows = [flat[first : first + 6] for first in range(0, len(flat), 6)]
    return [
        FoundColour((int(red), int(green), int(blue)), int(nearest), int(code), float(share))
        for red, green, blue, nearest, code, share in rows
    ]
