"""How steep the surface is where a slope would lie, and how steep the slope is.

The volume alone would stand slopes at upright walls that are round: there is a place at which they fill more of what is
inside than of what is outside, as there is for any part. Seen from the side they are splinters.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..slicing import ACROSS, UP
from ..units import PLATE, STUD
from .forms import Form
from .site import Site

_LEAST: Final = 0.25
"""How far from upright and from level the surface is at least, as a share of how far the slope is.

At 24 studs the mean gap grows by .001 to .005 studs with it (fox, spot, horse), and faces are nearer to the surface's
own by .5 to .7 degrees (spot, horse); with .5 spot loses .009 studs. Pictures of a mug and a tree are rid of splinters.
"""


def as_steep(site: Site, form: Form, facing: NDArray[np.float32], place: Ints) -> Mask:
    """Return where the surface in the cells that a slope fills in part is about as steep as the slope.

    Parameters
    ----------
    site : Site
    form : Form
    facing : (n_cells, 3) float32 array
        Which way the surface in each cell of the site faces.
    place : (n,) int64 array
        Flat indices of the slope's corner in the site.

    Returns
    -------
    (n,) bool array
        Not where the surface falls away from where the slope does.
    """
    share = form.fill.mean(axis=1)
    falling = (share > 0) & (share < 1)
    there = facing[place[:, None] + site.flat(form.cells[falling])].sum(axis=1, dtype=np.float64)
    ahead, up = float(np.hypot(*form.facing[:2])), float(form.facing[2])
    # what the surface does across the fall does not count: at the edge of a roof it also faces to the side
    along, above = there[:, :2] @ (form.facing[:2] / ahead), there[:, 2] * np.copysign(1, up)
    steep, angle = np.degrees(np.arctan2(abs(up), ahead)), np.degrees(np.arctan2(above, along))
    alike: Mask = (angle >= _LEAST * steep) & (90 - angle >= _LEAST * (90 - steep))
    return alike


def surface_facing(site: Site) -> NDArray[np.float32]:
    """Return which way the surface in each cell of a site faces: its area as seen along x, y and z, outwards.

    By the divergence theorem that is the difference of what is inside at opposite faces of the cell. Cells can be
    added: what faces each other inside of them cancels out.

    Returns
    -------
    (n_cells, 3) float32 array
        mm²; 0 in cells that are far from the surface.
    """
    inside = ((1 - site.gain) / 2).reshape(-1, UP, ACROSS, ACROSS)
    row = site.row.reshape(site.shape)
    area = np.zeros((*site.shape, 3), np.float32)
    for axis, (size, first, last) in enumerate(
        (
            (STUD * PLATE, inside[..., 0], inside[..., -1]),
            (STUD * PLATE, inside[:, :, 0], inside[:, :, -1]),
            (STUD * STUD, inside[:, 0], inside[:, -1]),
        )
    ):
        along = 2 - axis
        # sums of single precision would differ between machines
        filled = ((size * each.mean(axis=(1, 2), dtype=np.float64)).astype(np.float32) for each in (first, last))
        ahead, behind = (np.moveaxis(each[row], along, 0) for each in filled)
        own = np.moveaxis(area[..., axis], along, 0)
        # between two cells lies the mean of the small parts on both of its sides
        between = (behind[:-1] + ahead[1:]) / 2
        own[1:] += between
        own[:-1] -= between
        if axis == 2:
            own[0] += ahead[0]  # the ground goes on below; at all other edges nothing is inside
    return area.reshape(-1, 3)
