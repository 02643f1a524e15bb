"""Layouts around slopes: those that keep bricks from being joined make room for the cells that they stand for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from scipy import ndimage

from ..arrays import Mask
from ..model import NOBODY, Bricks, Catalogue, ContactGraph, UnitGrid, contact_graph
from .fixed import with_fixed

Lay = Callable[[UnitGrid, Bricks], tuple[Bricks, UnitGrid]]
"""Covers the cells of a grid around bricks that lie there already, and ties what is loose; see :func:`~.lay.lay`."""

_ROUNDS: Final = 4
"""Times that a model is laid anew with fewer slopes."""


def lay_around_slopes(grid: UnitGrid, slopes: Bricks, catalogue: Catalogue, lay: Lay) -> tuple[Bricks, UnitGrid]:
    """Lay a model around its slopes, as many of them as let it hang together.

    Parameters
    ----------
    grid : UnitGrid
        The hollowed model.
    slopes : Bricks
        Within the grid, without collisions.
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
        bricks, laid = lay(with_fixed(grid, slopes, catalogue), slopes)
        links = contact_graph(bricks, catalogue)
        if links.n_components <= 1:
            break
        wrong = _beside_loose(bricks, links, catalogue)
        if not wrong.any():
            break
        slopes = slopes.take(~_among(slopes, bricks.take(wrong)))
    else:
        bricks, laid = lay(with_fixed(grid, slopes, catalogue), slopes)
    return bricks, laid


def _beside_loose(bricks: Bricks, links: ContactGraph, catalogue: Catalogue) -> Mask:
    """Return the slopes that are outside of the largest component, or touch what is: what stands may be a foot."""
    loose = links.component != np.bincount(links.component).argmax()
    near = ndimage.binary_dilation(np.append(loose, False)[links.owner])
    touched = np.zeros(len(bricks), bool)
    touched[links.owner[near & (links.owner != NOBODY)]] = True
    sloped = np.array([part.sloped for part in catalogue.parts])[bricks.part]
    wrong: Mask = touched & sloped
    return wrong


def _among(bricks: Bricks, others: Bricks) -> Mask:
    """Return which bricks lie where some others do."""
    there = set(map(tuple, others.corner.tolist()))
    return np.array([tuple(corner) in there for corner in bricks.corner.tolist()], bool)
