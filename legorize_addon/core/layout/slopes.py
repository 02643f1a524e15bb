"""Layouts around slopes: those that keep bricks from being joined make room for the cells that they stand for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Mask
from ..model import NOBODY, Bricks, Catalogue, UnitGrid, contact_graph

Lay = Callable[[Bricks], tuple[Bricks, UnitGrid]]
"""Covers the cells of a model around bricks that lie there already, and ties what is loose; returns all bricks, and the
cells with those fixed."""

_ROUNDS: Final = 4
"""Times that a model is laid anew with fewer slopes."""


def lay_around_slopes(slopes: Bricks, catalogue: Catalogue, lay: Lay) -> tuple[Bricks, UnitGrid]:
    """Lay a model around its slopes, as many of them as let it hang together.

    Parameters
    ----------
    slopes : Bricks
        Without collisions.
    catalogue : Catalogue
    lay : callable

    Returns
    -------
    bricks : Bricks
        In one component, unless there is none without slopes near what is loose.
    grid : UnitGrid
        With the cells of the slopes fixed, and those that were added for ties.
    """
    for _ in range(_ROUNDS):
        bricks, laid = lay(slopes)
        links = contact_graph(bricks, catalogue)
        if links.n_components <= 1:
            break
        # what stands may be a foot
        loose = links.component != np.bincount(links.component).argmax()
        wrong = slopes_beside(bricks, loose, catalogue)
        if not wrong.any():
            break
        slopes = slopes.take(~lie_among(slopes, bricks.take(wrong)))
    else:
        bricks, laid = lay(slopes)
    return bricks, laid


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
    sloped = np.array([part.sloped for part in catalogue.parts])[bricks.part]
    wrong: Mask = touched & sloped
    return wrong


def lie_among(bricks: Bricks, others: Bricks) -> Mask:
    """Return which bricks are among some others: the same part at the same corner, (n,)."""
    there = set(_placed(others))
    return np.array([each in there for each in _placed(bricks)], bool)


def _placed(bricks: Bricks) -> Iterator[tuple[int, ...]]:
    """Yield part and corner of each brick."""
    return zip(bricks.part.tolist(), *bricks.corner.T.tolist(), strict=True)
