"""What slopes would bring where: the volume that a model fills wrongly without them and not with them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints, Mask
from ..colours import ciede2000, lab_from_srgb
from ..model import COLOUR_ANY, Catalogue
from ..units import PLATES_PER_BRICK
from .forms import Form
from .site import MARGIN, Site
from .tilt import as_steep, surface_facing

_BRICK: Final = 0.2
_PLATE: Final = 0.15
"""Share of a part that a cell column of a brick's height takes, and each plate of a column that is none."""


_CLEAR: Final = 22.0
_WRONG: Final = 2.0
"""CIEDE2000 difference that is clearly visible, and what a cell of such a colour costs, in cells a plate high."""


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """Places of slopes.

    Attributes
    ----------
    form : (n,) int64 array
        Row among the forms.
    place : (n,) int64 array
        Flat index of the corner in the site.
    score : (n,) float64 array
        Volume gained less the price of the parts and of wrong colours, in cells a plate high.
    worth : (n,) float64 array
        The same without the price of the parts.
    colour : (n,) int16 array
        LDraw code.
    """

    form: Ints
    place: Ints
    score: Floats
    worth: Floats
    colour: Ints

    def take(self, rows: Ints | Mask) -> Candidates:
        """Return some of them."""
        return Candidates(*(getattr(self, name)[rows] for name in self.__slots__))


def candidates(site: Site, among: tuple[Form, ...], catalogue: Catalogue, *, price: float) -> Candidates:
    """List the places in which slopes would pay if they had any colour.

    Parameters
    ----------
    site : Site
    among : tuple of Form
    catalogue : Catalogue
        Says which part is made in which colour.
    price : float
        Volume that a part more has to save, in cells a plate high.

    Returns
    -------
    Candidates
        Each could be built: it claims nothing but cells of the shell and open air, in a colour in which the part is
        made and that pays, keeps free what cannot be joined to it, and holds to the shell.
    """
    facing = surface_facing(site)
    found = [_of_form(site, facing, number, form, catalogue, price) for number, form in enumerate(among)]
    return Candidates(*(np.concatenate([getattr(each, name) for each in found]) for name in Candidates.__slots__))


def _of_form(
    site: Site, facing: NDArray[np.float32], number: int, form: Form, catalogue: Catalogue, price: float
) -> Candidates:
    """List the places of one form."""
    cells = site.flat(form.cells)
    place = _places(site, form, cells)
    place = place[site.room[place[:, None] + cells].all(axis=1)]
    place = place[_may_stand(site, form, place)]
    place = place[as_steep(site, form, facing, place)]
    gain = _gain(site, form, place[:, None] + cells)
    pays = gain > 0
    place, gain = place[pays], gain[pays]
    score = gain - price * (1 + _parts_more(site, form, place) + _PLATE * _opened(site, form, place))
    code, wrong = _colours(site, form, place[:, None] + cells, catalogue)
    # its image may have a better colour
    fits = (score > 0) & np.isfinite(wrong)
    place = place[fits]
    return Candidates(np.full(len(place), number), place, (score - wrong)[fits], (gain - wrong)[fits], code[fits])


def _places(site: Site, form: Form, cells: Ints) -> Ints:
    """Return the corners, ascending, of which a cell that the slope fills in part lies on the surface."""
    share = form.fill.mean(axis=1)
    falling = cells[(share > 0) & (share < 1)]
    place = site.mixed[:, None] - falling
    place = _once(place[place >= 0], len(site.solid))
    z, y, x = np.unravel_index(place, site.shape)
    # what is as high as bricks keeps to their layers
    fits = (z % PLATES_PER_BRICK == 0) | (form.height % PLATES_PER_BRICK != 0)
    far = form.cells.max(axis=0)
    fits &= (y >= MARGIN) & (x >= MARGIN) & (z + far[0] + 1 < site.shape[0])
    fits &= (y + far[1] < site.shape[1] - MARGIN) & (x + far[2] < site.shape[2] - MARGIN)
    places: Ints = place[fits]
    return places


def _may_stand(site: Site, form: Form, place: Ints) -> Mask:
    """Return where a slope holds to the shell, and where nothing is that could not be joined to it."""
    free = ~site.solid & site.air
    fits = np.ones(len(place), bool)
    for cells in (form.above, form.below):
        there = place[:, None] + site.flat(cells)
        fits &= (free[np.maximum(there, 0)] & (there >= 0)).all(axis=1)
    held, holding = (place[:, None] + site.flat(cells) for cells in (form.held, form.holding))
    joined = site.required[held].any(axis=1) | (site.required[np.maximum(holding, 0)] & (holding >= 0)).any(axis=1)
    ok: Mask = fits & joined
    return ok


def _gain(site: Site, form: Form, cells: Ints) -> Floats:
    """Return the volume that is filled wrongly as it is, less that with the slope, more where likeness counts more."""
    row = site.row[cells]
    used = _once(row, len(site.gain))
    # sums of single precision would differ between machines
    of_cell = site.gain[used].astype(np.float64)
    filled = of_cell @ form.fill.T / form.fill.shape[1]
    whole = of_cell.mean(axis=1)
    at = np.searchsorted(used, row)
    saved = np.where(site.solid[cells], whole[at], 0) - filled[at, np.arange(cells.shape[1])]
    gain: Floats = (saved * site.factor[cells]).sum(axis=1)
    return gain


def _once(numbers: Ints | NDArray[np.int32], end: int) -> Ints:
    """Return each of some numbers from 0 to before an end once, ascending: without sorting them."""
    there = np.zeros(end, bool)
    there[numbers] = True
    return np.flatnonzero(there)


def _parts_more(site: Site, form: Form, place: Ints) -> Floats:
    """Return about how many parts more the columns take that a slope cuts."""
    step = site.shape[1] * site.shape[2]
    level = place // step
    more = np.zeros(len(place))
    for (z, y, x), count in ((column[:3], column[3]) for column in form.columns.tolist()):
        first = place + site.flat(np.array([[z, y, x]]))[0]
        bottom = level + z
        for layer in range(-(-(int(count) + PLATES_PER_BRICK - 1) // PLATES_PER_BRICK)):
            base = (bottom // PLATES_PER_BRICK + layer) * PLATES_PER_BRICK
            cells = (first - (bottom - base) * step)[:, None] + step * np.arange(PLATES_PER_BRICK)
            there = site.solid[cells]
            level_of = base[:, None] + np.arange(PLATES_PER_BRICK)
            left = there & ((level_of < bottom[:, None]) | (level_of >= bottom[:, None] + count))
            more += _parts(left) - _parts(there)
    return more


def _opened(site: Site, form: Form, place: Ints) -> Ints:
    """Return how many cells have to be built because one looks at them past a slope."""
    there = np.maximum(place[:, None] + site.flat(form.beside), 0)
    count: Ints = np.count_nonzero(site.hidden[there] & ~site.required[there], axis=1)
    return count


def _parts(there: Mask) -> Floats:
    """Return about how many parts columns of three plates take, (n, 3)."""
    return np.where(there.all(axis=1), _BRICK, _PLATE * there.sum(axis=1))


def _colours(site: Site, form: Form, cells: Ints, catalogue: Catalogue) -> tuple[Ints, Floats]:
    """Return the colours that are closest to those of the claimed cells, and how many cells these make wrong.

    Infinitely many where no cell shows a colour.
    """
    codes = np.unique(site.colour[site.solid])
    codes = codes[codes >= 0]
    made = codes[catalogue.exists_in(form.part, codes)]
    if not len(made) or not len(cells):
        return np.zeros(len(cells), np.int64), np.full(len(cells), np.inf)
    shown = np.where(site.solid[cells], site.colour[cells], np.int16(COLOUR_ANY))
    factor = site.factor[cells]
    count = np.stack([(factor * (shown == code)).sum(axis=1) for code in codes], axis=1)
    lab = lab_from_srgb(catalogue.rgb[catalogue.colour_rows(codes)])
    apart = ciede2000(lab[:, None], lab[np.searchsorted(codes, made)][None])
    wrong = _WRONG * count @ np.minimum(apart / _CLEAR, 1)
    best = wrong.argmin(axis=1)
    least: Floats = np.where(count.any(axis=1), wrong[np.arange(len(cells)), best], np.inf)
    return made[best].astype(np.int64), least


def rows(site: Site, among: tuple[Form, ...], found: Candidates) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Yield rows of candidates of each form with the cells that they claim, and those that they keep free."""
    for number, form in enumerate(among):
        which = np.flatnonzero(found.form == number)
        place = found.place[which, None]
        kept = np.concatenate([form.above, form.below])
        yield which, place + site.flat(form.cells), place + site.flat(kept)
