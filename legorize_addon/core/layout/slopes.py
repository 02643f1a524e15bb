"""Layouts around slopes: those that keep bricks from being joined make room for the cells that they stand for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, Bricks, Catalogue, UnitGrid, contact_graph

Lay = Callable[[Bricks], tuple[Bricks, UnitGrid]]
"""Covers the cells of a model around bricks that lie there already, and ties what is loose; returns all bricks, and the
cells with those fixed."""

_ROUNDS: Final = 8
"""Times that a model is laid anew with fewer slopes."""


def lay_around_slopes(
    slopes: Bricks, worth: Floats, pair: Ints, dear: Mask, catalogue: Catalogue, lay: Lay
) -> tuple[Bricks, UnitGrid]:
    """Lay a model around its slopes, as many of them as let it hang together.

    Those near what is loose leave, except where likeness counts more: there only those between what is loose and the
    rest, the least worthy quarter at a time. A loose head keeps the slopes of its face if it can.

    Parameters
    ----------
    slopes : Bricks
        Without collisions.
    worth : (n,) float64 array
        What each gains.
    pair : (n,) int64 array
        The same number for slopes that stay or go together.
    dear : (n,) bool array
        Those where likeness counts more.
    catalogue : Catalogue
    lay : callable

    Returns
    -------
    bricks : Bricks
        In one component, unless there is none without slopes near what is loose.
    grid : UnitGrid
        With the cells of the slopes fixed, and those that were added for ties.
    """
    for turn in range(_ROUNDS):
        bricks, laid = lay(slopes)
        links = contact_graph(bricks, catalogue)
        if links.n_components <= 1:
            break
        # what stands may be a foot
        main = int(np.bincount(links.component).argmax())
        beside = lie_among(slopes, bricks.take(slopes_beside(bricks, links.component != main, catalogue)))
        go = beside & ~dear
        if not go.any() and turn < _ROUNDS - 1:
            between = slopes_between(bricks, links.component, catalogue)
            for number in np.flatnonzero(np.arange(links.n_components) != main).tolist():
                go |= _least_worthy(lie_among(slopes, bricks.take(between[number])), worth, pair)
        if not go.any():
            go = beside
        if not go.any():
            break
        slopes, worth, pair, dear = slopes.take(~go), worth[~go], pair[~go], dear[~go]
    else:
        bricks, laid = lay(slopes)
    return bricks, laid


def _least_worthy(which: Mask, worth: Floats, pair: Ints) -> Mask:
    """Return the least worthy quarter of some slopes, with those that go together with one of them."""
    number, unit = np.unique(pair, return_inverse=True)
    total = np.bincount(unit, worth, len(number))
    asked = np.unique(unit[which])
    fewest = asked[np.argsort(total[asked], kind="stable")][: (len(asked) + 3) // 4]
    return np.isin(unit, fewest)


def slopes_beside(bricks: Bricks, which: Mask, catalogue: Catalogue) -> Mask:
    """Return the slopes that are some of the bricks, or touch some.

    Parameters
    ----------
    bricks : Bricks
    which : (n,) bool array
        Those that are meant.
    catalogue : Catalogue

    Returns
    -------
    (n,) bool array
    """
    links = contact_graph(bricks, catalogue)
    near = ndimage.binary_dilation(np.append(which, False)[links.owner])
    touched = np.zeros(len(bricks), bool)
    touched[links.owner[near & (links.owner != NOBODY)]] = True
    wrong: Mask = touched & _sloped(bricks, catalogue)
    return wrong


def slopes_between(bricks: Bricks, component: NDArray[np.integer], catalogue: Catalogue) -> Mask:
    """Return the slopes where components touch each other.

    Parameters
    ----------
    bricks : Bricks
    component : (n,) int array
        Number of the component of each, all from 0 on.
    catalogue : Catalogue

    Returns
    -------
    (n_components, n) bool array
        Those of each component that touch another one, and those of others that touch it.
    """
    owner = contact_graph(bricks, catalogue).owner
    touching = np.zeros((int(component.max(initial=-1)) + 1, len(bricks)), bool)
    for axis in range(3):
        cells = np.moveaxis(owner, axis, 0)
        there = (cells[:-1] != NOBODY) & (cells[1:] != NOBODY)
        one, other = cells[:-1][there], cells[1:][there]
        apart = component[one] != component[other]
        for here in (one[apart], other[apart]):
            touching[component[one[apart]], here] = touching[component[other[apart]], here] = True
    between: Mask = touching & _sloped(bricks, catalogue)
    return between


def _sloped(bricks: Bricks, catalogue: Catalogue) -> Mask:
    return np.array([part.shaped for part in catalogue.parts])[bricks.part]


def lie_among(bricks: Bricks, others: Bricks) -> Mask:
    """Return which bricks are among some others: the same part at the same corner, (n,)."""
    there = set(_placed(others))
    return np.array([each in there for each in _placed(bricks)], bool)


def _placed(bricks: Bricks) -> Iterator[tuple[int, ...]]:
    """Yield part and corner of each brick."""
    return zip(bricks.part.tolist(), *bricks.corner.T.tolist(), strict=True)
