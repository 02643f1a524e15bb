"""Which slopes are laid: the best first, none over another one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..geometry import mirror_axis
from ..mesh import TriangleMesh
from ..model import Bricks, Catalogue, Role, UnitGrid
from ..native import one_thread
from ..units import PLATES_PER_BRICK
from .candidates import Candidates, candidates, rows
from .forms import Form, slopes_of
from .mirrored import in_pairs
from .site import Site

_DEAR: Final = 2.0
"""Times as much as usual from which likeness counts more, as for colours."""


@dataclass(frozen=True, slots=True, eq=False)
class Slopes:
    """Slopes of a model, before its bricks are laid.

    Attributes
    ----------
    bricks : Bricks
        By ascending plate, then y, then x; they claim cells of the shell and open air.
    worth : (n,) float64 array
        Volume that each gains, less that of wrong colours, in cells a plate high.
    pair : (n,) int64 array
        The same number for a slope and its mirror image.
    dear : (n,) bool array
        Those where likeness counts at least twice as much as usual.
    solid : (n_layers, 3, n_y, n_x) bool array
        What the model fills before it is hollowed.
    filled : bool
        Whether hidden cells behind slopes have to be filled as they would without them, as what a model hangs on.
    pays : bool
        Whether it is known that all of them pay.
    """

    bricks: Bricks
    worth: Floats
    pair: Ints
    dear: Mask
    solid: Mask
    filled: bool = False
    pays: bool = False

    def settled(self, rows: Mask, *, filled: bool) -> Slopes:
        """Return those of them that stay, and are not asked again whether they pay."""
        kept = self.bricks.take(rows), self.worth[rows], self.pair[rows], self.dear[rows]
        return Slopes(*kept, self.solid, filled, pays=True)


@one_thread()
def choose_slopes(
    mesh: TriangleMesh,
    grid: UnitGrid,
    shell: UnitGrid,
    catalogue: Catalogue,
    *,
    price: float,
    plates: bool,
    symmetric: bool = False,
) -> Slopes:
    """Choose the slopes of a model before its bricks are laid.

    Parameters
    ----------
    mesh : TriangleMesh
        In mm.
    grid, shell : UnitGrid
        The model before and after it was hollowed.
    catalogue : Catalogue
    price : float
        Volume that a part more has to save, in cells a plate high.
    plates : bool
        Whether plates may be laid around slopes.
    symmetric : bool, optional
        Whether a symmetric model gets each slope with its mirror image.

    Returns
    -------
    Slopes
    """
    among = slopes_of(catalogue, plates=plates)
    site = Site.of(mesh, grid, shell)
    found = candidates(site, among, catalogue, price=price)
    axis = mirror_axis(grid.solid.reshape(-1, *grid.solid.shape[2:])) if symmetric else None
    pair = np.arange(len(found.form))
    if axis is not None and len(pair):
        found, pair = in_pairs(site, among, found, axis)
    pays = found.score > 0
    found, pair = found.take(pays), pair[pays]
    chosen = best(site, among, found, pair)
    return _table(site, among, found.take(chosen), pair[chosen], grid.solid | shell.solid)


def best(site: Site, among: tuple[Form, ...], found: Candidates, pair: Ints) -> Ints:
    """Choose candidates greedily: by score, none that claims what a better one claims or keeps free.

    Parameters
    ----------
    site : Site
    among : tuple of Form
    found : Candidates
    pair : (n,) int64 array
        Of equally good ones those with the lowest number are the first, one after the other.

    Returns
    -------
    (k,) int64 array
        Rows, ascending.
    """
    rank = np.empty(len(found.form), np.int64)
    rank[np.lexsort((pair, -np.round(found.score, 6)))] = np.arange(len(rank))[::-1]
    left = [[which, claimed, kept] for which, claimed, kept in rows(site, among, found)]
    taken, closed = np.zeros((2, int(np.prod(site.shape))), bool)
    chosen: list[Ints] = []
    # whoever is the best in all of his cells would be taken by going from the best to the worst, too
    while any(len(which) for which, *_ in left):
        claims, keeps = np.full((2, len(taken)), -1)
        for which, claimed, kept in left:
            np.maximum.at(claims, claimed.reshape(-1), np.repeat(rank[which], claimed.shape[1]))
            np.maximum.at(keeps, kept.reshape(-1), np.repeat(rank[which], kept.shape[1]))
        for which, claimed, kept in left:
            mine = rank[which][:, None]
            wins = (claims[claimed] <= mine).all(axis=1) & (keeps[claimed] <= mine).all(axis=1)
            wins &= (claims[kept] <= mine).all(axis=1)
            chosen.append(which[wins])
            taken[claimed[wins]] = True
            closed[kept[wins]] = True
        left = [_free(each, taken, closed) for each in left]
    return np.sort(np.concatenate(chosen)) if chosen else np.zeros(0, np.int64)


def _free(group: list[Ints], taken: Mask, closed: Mask) -> list[Ints]:
    """Return the candidates of a form that no chosen one stands in the way of."""
    which, claimed, kept = group
    free = ~(taken[claimed] | closed[claimed]).any(axis=1) & ~taken[kept].any(axis=1)
    return [which[free], claimed[free], kept[free]]


def _table(site: Site, among: tuple[Form, ...], found: Candidates, pair: Ints, solid: Mask) -> Slopes:
    """Return candidates as bricks."""
    part, turn = (np.array([getattr(form, name) for form in among])[found.form] for name in ("part", "turn"))
    corner = site.corners(found.place).astype(np.int32)
    dear = np.zeros(len(part), bool)
    for which, claimed, _ in rows(site, among, found):
        dear[which] = site.factor[claimed].mean(axis=1) >= _DEAR
    order = np.lexsort(tuple(corner.T))
    bricks = Bricks(
        part=part.astype(np.int16),
        corner=corner,
        turn=turn.astype(np.uint8),
        colour=found.colour.astype(np.int16),
        role=np.full(len(part), Role.SHELL, np.uint8),
        piece=np.zeros(len(part), np.int16),
        step=corner[:, 2] // np.int32(PLATES_PER_BRICK),
    )
    return Slopes(bricks.take(order), found.worth[order], pair[order], dear[order], solid)
