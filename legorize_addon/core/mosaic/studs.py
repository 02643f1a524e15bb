"""From the pixels of an image to the studs of a mosaic: how many, and what light each should give."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Mask
from ..colours import linear_from_srgb
from ..errors import SettingsError
from ..texturing import box_means
from ..units import MM_PER_CM, STUD
from .picture import Picture


@dataclass(frozen=True, slots=True)
class Canvas:
    """The size of a mosaic in studs.

    Attributes
    ----------
    columns, rows : int
        Of the image.
    border : int
        Width of the border around it.
    """

    columns: int
    rows: int
    border: int

    @property
    def size(self) -> tuple[int, int]:
        """Studs along x and y, with the border."""
        return self.columns + 2 * self.border, self.rows + 2 * self.border


@dataclass(frozen=True, slots=True, eq=False)
class Goal:
    """What the studs of an image should look like.

    Attributes
    ----------
    light : (rows, columns, 3) float64 array
        Mean linear light of what can be seen there; row 0 is the bottom.
    there : (rows, columns) bool array
        Studs that get a colour.
    """

    light: Floats
    there: Mask


def canvas_of(size: tuple[int, int], *, longer: float, border: int, row: float = 1.0) -> Canvas:
    """Return the studs of a mosaic whose image keeps its proportions.

    Parameters
    ----------
    size : (int, int)
        Width and height of the image in pixels.
    longer : float
        Studs along the longer side, with the border; rounded.
    border : int
        Width of the border in studs.
    row : float, optional
        Height of a row in studs: that of a brick in a wall.

    Returns
    -------
    Canvas

    Raises
    ------
    SettingsError
        The border leaves no room for the image.
    """
    inside = round(longer) - 2 * border
    if inside < 1:
        raise SettingsError(
            f"A border of {border} studs on each side leaves nothing of the {round(longer)} studs of the longer side: "
            "choose a larger size or a narrower border."
        )
    columns, rows = (
        max(1, round(inside * side / max(size) / high)) for side, high in zip(size, (1.0, row), strict=True)
    )
    return Canvas(columns, rows, border)


def longer_side(*, size_by: str, width: int, cm: float) -> float:
    """Return the studs along the longer side that the settings of the size ask for.

    Parameters
    ----------
    size_by : {"width", "height", "scale", "cm"}
    width : int
        Studs.
    cm : float

    Returns
    -------
    float

    Raises
    ------
    SettingsError
        The size is given in a way that means nothing for an image.
    """
    if size_by not in ("width", "cm"):
        raise SettingsError(f"A mosaic cannot be sized by {size_by}: give its width in studs or its size in cm.")
    return width if size_by == "width" else cm * MM_PER_CM / STUD


def goal_of(picture: Picture, canvas: Canvas, *, least: float, behind: Floats | None) -> Goal:
    """Return the mean light of an image on each stud.

    Parameters
    ----------
    picture : Picture
    canvas : Canvas
    least : float
        Least mean alpha of a stud that is covered, if nothing is behind the image.
    behind : (3,) float64 array or None
        Linear light of a background, if there is one.

    Returns
    -------
    Goal

    Raises
    ------
    SettingsError
        No stud would be covered.
    """
    shape = canvas.rows, canvas.columns
    opacity = picture.alpha / 255.0
    alpha = box_means(opacity, shape)
    # pixels count as far as they are seen
    channels = [box_means(linear_from_srgb(picture.rgb[..., channel]) * opacity, shape) for channel in range(3)]
    light = np.stack(channels, axis=-1)
    if behind is not None:
        return Goal(light + (1 - alpha[..., None]) * behind, np.ones(shape, dtype=bool))
    there = (alpha >= least) & (alpha > 0)
    if not there.any():
        raise SettingsError(
            f"No stud of the image has an alpha of {least:g} or more: choose a smaller least_alpha, or a background."
        )
    return Goal(light / np.where(there, alpha, 1)[..., None], there)
