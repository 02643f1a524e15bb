"""Trajectories drawn layer by layer: by the side on which they lie, or in their colours.

References
----------
Paper, Fig. 3 and 8: exterior trajectories blue, interior ones green.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..instructions import Item, Page, Paint, Path
from ..model import COLOUR_ANY, Catalogue
from ..slicing import Trajectories
from ..units import STUD
from .colour_runs import ColourRuns, colour_runs
from .sheet import Line, Rgb, Sheet

Shown = Literal["sides", "colours"]
"""Whether trajectories are drawn by side, or in their colours."""

EXTERIOR: Final[Rgb] = (20, 110, 255)
INTERIOR: Final[Rgb] = (0, 180, 60)
GAP: Final[Rgb] = (220, 0, 160)

THICK: Final = 0.45
THIN: Final = 0.22
"""mm of a line in the middle of a layer, and a plate below or above."""

_MIDDLE: Final = 1


def trajectory_maps(
    trajectories: Trajectories,
    layer: NDArray[np.int32],
    plate: NDArray[np.int8],
    *,
    origin: Floats,
    sheet: Sheet,
    catalogue: Catalogue,
    shown: Shown,
) -> Iterator[Page]:
    """Draw the trajectories of each layer that has any.

    Parameters
    ----------
    trajectories : Trajectories
    layer, plate : (n_slices,) int32 and int8 array
        Layer of each slice, and the plate of it whose middle the slice is.
    origin : (2,) float64 array
        Corner of the grid in mm.
    sheet : Sheet
    catalogue : Catalogue
    shown : {"sides", "colours"}

    Yields
    ------
    Page
    """  # fmt: skip
    runs = colour_runs(trajectories)
    exterior = trajectories.areas() > 0
    loop_layer = layer[trajectories.loop_slice]
    for number in np.unique(loop_layer).tolist():
        mine = loop_layer == number
        slices = np.unique(trajectories.loop_slice[mine])
        drawing: list[Item] = []
        for each in slices[np.argsort(plate[slices] == _MIDDLE, kind="stable")].tolist():
            width = THICK if plate[each] == _MIDDLE else THIN
            loops = trajectories.loop_slice == each
            paint = Paint(width=width / sheet.cell)
            if shown == "sides":
                drawing += _by_side(trajectories, loops, exterior, origin, paint)
            else:
                drawing += _by_colour(runs, loops, origin, paint, catalogue)
        outer = int(exterior[mine].sum())
        note = f"{len(slices)} slice{'s' * (len(slices) > 1)}, {outer} exterior, {int(mine.sum()) - outer} interior"
        legend = _sides() if shown == "sides" else _colours(runs, mine, catalogue)
        yield sheet.page(f"Layer {number + 1}", note, drawing, legend)


def _by_side(trajectories: Trajectories, loops: Mask, exterior: Mask, origin: Floats, paint: Paint) -> Iterator[Item]:
    """Yield the loops as two paths in cells."""
    count = np.diff(trajectories.loop_start)
    for side, rgb in ((True, EXTERIOR), (False, INTERIOR)):
        wanted = loops & (exterior == side)
        points = (trajectories.points[np.repeat(wanted, count)] - origin) / STUD
        yield Path(points, count[wanted], True, (paint._replace(stroke=rgb),))


def _by_colour(runs: ColourRuns, loops: Mask, origin: Floats, paint: Paint, catalogue: Catalogue) -> Iterator[Item]:
    """Yield a path in cells for each colour."""
    here = loops[runs.loop]
    for code in np.unique(runs.colour[here]).tolist():
        wanted = here & (runs.colour == code)
        points = (runs.points[np.repeat(wanted, runs.count)] - origin) / STUD
        yield Path(points, runs.count[wanted], False, (paint._replace(stroke=colour_rgb(code, catalogue)),))


def _sides() -> list[Line]:
    return [(Paint(stroke=EXTERIOR, width=1.2), "exterior"), (Paint(stroke=INTERIOR, width=1.2), "interior")]


def _colours(runs: ColourRuns, loops: Mask, catalogue: Catalogue) -> list[Line]:
    codes = np.unique(runs.colour[loops[runs.loop]]).tolist()
    return [(Paint(stroke=colour_rgb(code, catalogue), width=1.2), colour_name(code, catalogue)) for code in codes]


def colour_rgb(code: int, catalogue: Catalogue) -> Rgb:
    """Return the sRGB bytes of a trajectory's colour; magenta where it closes a gap of the mesh."""
    if code == COLOUR_ANY:
        return GAP
    red, green, blue = catalogue.rgb[catalogue.colour_row(code)].tolist()
    return red, green, blue


def colour_name(code: int, catalogue: Catalogue) -> str:
    """Return what a trajectory's colour is called."""
    return "closes a gap" if code == COLOUR_ANY else catalogue.colours[catalogue.colour_row(code)].name
