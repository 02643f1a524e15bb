"""What the settings mean for the stages of a mosaic."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .colours import linear_from_srgb
from .errors import SettingsError
from .model import COLOUR_EMPTY, Bricks, Catalogue, UnitGrid
from .mosaic import (
    Canvas,
    Covered,
    Goal,
    Picture,
    Surface,
    canvas_of,
    cover_base,
    fewer_colours,
    goal_of,
    lay_base,
    longer_side,
    stud_colours,
    surface_parts,
    wall_of,
    winning_colours,
)
from .run import Run
from .settings import Settings
from .units import BRICK, STUD, count_of


def mosaic_canvas(picture: Picture, settings: Settings) -> Canvas:
    """Return the size of a mosaic in studs."""
    longer = longer_side(size_by=settings.size_by, width=settings.width, cm=settings.cm)
    row = BRICK / STUD if settings.standing else 1.0
    return canvas_of(picture.size, longer=longer, border=settings.border, row=row)


def mosaic_colours(run: Run, picture: Picture, canvas: Canvas) -> tuple[Goal, NDArray[np.int16]]:
    """Return what the studs of an image should look like, and their colours."""
    settings, catalogue = run.settings, run.catalogue
    behind = None
    if settings.background >= 0:
        behind = linear_from_srgb(catalogue.rgb[_colour(catalogue, settings.background, "background")])
    goal = goal_of(picture, canvas, least=settings.least_alpha, behind=behind)
    palette = run.palette[_made(run)]
    if not len(palette):
        raise SettingsError(
            f"No colour of the palette has {_parts(settings)} of one stud: choose other colours, or another mosaic."
        )
    palette = fewer_colours(goal, palette, catalogue, settings.colours)
    if settings.fine_texture == "texels" and settings.dithering == "none" and behind is None:
        return goal, winning_colours(picture, goal, palette, catalogue)
    return goal, stud_colours(goal, palette, catalogue, dithering=settings.dithering)


def _parts(settings: Settings) -> Surface:
    """Return what a mosaic is made of."""
    return "bricks" if settings.standing else settings.mosaic


def _made(run: Run) -> NDArray[np.bool_]:
    """Return which colours of the palette have a part of one stud for the mosaic."""
    kind = _parts(run.settings)
    among = surface_parts(kind, np.sort(run.palette), run.settings.base_colour, run.parts.catalogue)
    made = among.made[among.size == 1, :-1].any(axis=0)
    return np.isin(run.palette, among.codes[made])


def wall_cells(run: Run, canvas: Canvas, colour: NDArray[np.int16]) -> UnitGrid:
    """Return the cells of a mosaic that stands, with its border."""
    columns, rows = canvas.size
    studs = np.full((rows, columns), COLOUR_EMPTY, dtype=np.int16)
    if canvas.border:
        studs[:] = run.catalogue.codes[_colour(run.catalogue, run.settings.border_colour, "border_colour")]
    inside = np.s_[canvas.border : canvas.border + canvas.rows, canvas.border : canvas.border + canvas.columns]
    studs[inside] = colour
    return wall_of(studs)


def lay_mosaic(run: Run, canvas: Canvas, colour: NDArray[np.int16]) -> Covered:
    """Lay the base of a mosaic, its image and its border."""
    settings, catalogue, tier = run.settings, run.catalogue, run.settings.layout
    if tier == "learned":
        raise SettingsError("layout is 'learned', which knows no mosaics: choose one of fast, standard, exact.")
    base_colour = _colour(catalogue, settings.base_colour, "base_colour")
    base = lay_base(canvas.size, settings.mosaic_base, int(catalogue.codes[base_colour]), run.parts.catalogue)
    size = np.array([[part.length, part.width] for part in catalogue.parts])[base.part]
    size[base.turn % 2 == 1] = size[base.turn % 2 == 1, ::-1]
    across, deep = (base.corner[:, :2] + size).max(axis=0).tolist()
    studs = np.full((deep, across), COLOUR_EMPTY, dtype=np.int16)
    # a base that is larger has the mosaic in its middle
    x, y = (across - canvas.size[0]) // 2, (deep - canvas.size[1]) // 2
    if canvas.border:
        border = catalogue.codes[_colour(catalogue, settings.border_colour, "border_colour")]
        studs[y : y + canvas.size[1], x : x + canvas.size[0]] = border
    x, y = x + canvas.border, y + canvas.border
    studs[y : y + canvas.rows, x : x + canvas.columns] = colour
    found: list[Covered] = []

    def lay(catalogue: Catalogue) -> Bricks:
        """Lay the base in parts of a catalogue, and keep what was found."""
        found.append(cover_base(studs, base, settings.mosaic, catalogue, tier=tier, rng=run.rng))
        return found[-1].bricks

    chosen = run.parts.laid(lay)
    return next(each for each in found if each.bricks is chosen)


def _colour(catalogue: Catalogue, code: int, name: str) -> int:
    """Return the row of a colour that a setting names."""
    if code not in catalogue.codes:
        known = ", ".join(str(each) for each in catalogue.codes.tolist())
        raise SettingsError(f"{name} is {code}, which is no colour of the catalogue: choose one of {known}.")
    return catalogue.colour_row(code)


def remarks_on_mosaic(picture: Picture, canvas: Canvas, covered: Covered) -> tuple[str, ...]:
    """Return what a user must know about a mosaic, one sentence each.

    Parameters
    ----------
    picture : Picture
    canvas : Canvas
    covered : Covered

    Returns
    -------
    tuple of str
    """
    notes = []
    width, height = picture.size
    if width < canvas.columns or height < canvas.rows:
        notes.append(
            f"The image has {width} x {height} pixels, fewer than the mosaic has studs: neighbouring studs show the "
            "same pixel."
        )
    if covered.changed or covered.added:
        studs = count_of(covered.changed + covered.added, "stud", "studs")
        notes.append(
            f"{studs} got another colour than the image has, so that a part joins the parts of the base there."
        )
    return tuple(notes)
