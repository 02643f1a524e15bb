"""Symmetric models of symmetric meshes: cells that differ from their image by next to nothing become like it.

The two halves of a mesh are hardly ever equal to the last digit, and a cell that is half covered falls to one side on
the left and to the other on the right. Where the mesh is not symmetric, as with a sword in one hand or a patch on one
eye, the cells stay as they are.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Mask
from ..geometry import mirror_axis
from ..model import COLOUR_EMPTY
from .colour_votes import CLEAR, Ballot, Codes

Moved = NDArray[np.uint8]

NEAR: Final = 0.1
"""Share of a cell by which the mesh inside it may differ from that in its image."""

CLOSE: Final = CLEAR / 2
"""Mean CIEDE2000 difference from its surface by which a cell may get worse to be like its image: half of what
is clear at a glance."""


def mirror_shapes(solid: Mask, share: Floats, *, height: int, moved: Moved | None = None) -> Mask:
    """Give columns and their images the same cells, where the mesh in both is the same.

    Parameters
    ----------
    solid : (n_levels, n_y, n_x) bool array
        Filled cells of a grid whose middle is that of the mesh.
    share : (n_levels, n_y, n_x) float64 array
        Share of each cell inside the mesh.
    height : int
        Levels of a column that is decided about at once: those of a layer.
    moved : (n_layers, n_y, n_x) uint8 array, optional
        As in :class:`~.slicing.Grid`: what was moved along the axis stays as it is.

    Returns
    -------
    (n_levels, n_y, n_x) bool array
        Of two shapes that mirrored columns have, both take the one that is
        closer to the mesh, and never none, so that nothing thin is lost. A
        model that is not symmetric stays as it is.
    """
    axis = mirror_axis(solid)
    if axis is None:
        return solid
    image, far = np.flip(solid, axis), np.flip(share, axis)
    alike = _of_columns(np.abs(share - far) <= NEAR, height).all(axis=1) & ~_moved(moved, axis)
    own, others = (_sums(np.abs(share - each) + np.abs(far - each), height) for each in (solid, image))
    here, there = (_of_columns(each, height).sum(axis=1) for each in (solid, image))
    more = (there > here) | ((there == here) & _first(solid.shape, axis, height))
    closer = (others < own) | ((others == own) & more)
    takes = alike & (there > 0) & ((here == 0) | closer)
    found: Mask = np.where(_spread(takes, height), image, solid)
    return found


def mirror_colours(colour: Codes, seen: Mask, ballot: Ballot, *, height: int, moved: Moved | None = None) -> Codes:
    """Give columns and their images the same colours, where these hardly matter to the surface of both.

    Parameters
    ----------
    colour : (n_levels, n_y, n_x) int16 array
        LDraw codes, ``COLOUR_ANY`` or ``COLOUR_EMPTY``.
    seen : (n_levels, n_y, n_x) bool array
        Visible cells; others stay as they are.
    ballot : Ballot
        What the surface of each visible cell asks for.
    height : int
        Levels of a column that is decided about at once: those of a layer.
    moved : (n_layers, n_y, n_x) uint8 array, optional
        As in :class:`~.slicing.Grid`: what was moved along the axis stays as it is.

    Returns
    -------
    (n_levels, n_y, n_x) int16 array
        Of two colourings that mirrored columns have, both take the one that is
        closer to the surface of both.
    """
    axis = mirror_axis(colour != COLOUR_EMPTY)
    if axis is None or not len(ballot.codes):
        return colour
    cost = np.zeros((*colour.shape, len(ballot.codes)))
    cost[seen] = ballot.cost
    image, far = np.flip(colour, axis), np.flip(cost, axis)
    decided = (colour >= 0) & (image >= 0) & seen & np.flip(seen, axis)
    differs = _of_columns(decided & (colour != image), height).any(axis=1, keepdims=True)
    # whole columns, so that no brick is torn into plates
    differs &= ~_moved(moved, axis)[:, None]
    differs = np.broadcast_to(differs, _of_columns(decided, height).shape).reshape(colour.shape) & decided
    own, others = _price(cost, colour, ballot.codes, differs), _price(cost, image, ballot.codes, differs)
    own_far, others_far = _price(far, image, ballot.codes, differs), _price(far, colour, ballot.codes, differs)
    # what a column and its image lose if both look like the image, and if both look like the column
    as_image, as_own = _sums(others - own, height), _sums(others_far - own_far, height)
    takes = (as_image < as_own) | ((as_image == as_own) & _first(colour.shape, axis, height))
    # beside plates that nobody sees, one that is seen must not change clearly
    takes &= _of_columns(others - own, height).max(axis=1) <= CLOSE
    found: Codes = np.where(_spread(takes, height) & differs, image, colour).astype(np.int16)
    return found


def _moved(moved: Moved | None, axis: int) -> Mask:
    """Return which columns, or their images, were moved along an axis."""
    if moved is None:
        return np.zeros((1, 1, 1), bool)
    there = moved & (1 if axis == 2 else 2) > 0
    either: Mask = there | np.flip(there, axis)
    return either


def _of_columns(cells: np.ndarray, height: int) -> np.ndarray:
    """Return levels as those of layers, (n_layers, height, n_y, n_x)."""
    return cells.reshape(-1, height, *cells.shape[1:])


def _sums(amount: Floats, height: int) -> Floats:
    """Return the sums over columns, (n_layers, n_y, n_x)."""
    total: Floats = _of_columns(amount, height).sum(axis=1)
    return np.round(total, 9)


def _spread(columns: Mask, height: int) -> Mask:
    """Return of each cell what holds for its column."""
    return np.repeat(columns, height, axis=0)


def _first(shape: tuple[int, ...], axis: int, height: int) -> Mask:
    """Return the columns of the half with the lower numbers: they give way where nothing else decides."""
    at = np.indices((shape[0] // height, *shape[1:]))[axis]
    first: Mask = at < shape[axis] // 2
    return first


def _price(cost: Floats, colour: Codes, codes: Codes, which: Mask) -> Floats:
    """Return what cells cost in a colour, 0 where nothing is asked."""
    place = np.minimum(np.searchsorted(codes, colour), len(codes) - 1)
    there = codes[place] == colour
    found = np.take_along_axis(cost, place[..., None], axis=-1)[..., 0]
    return np.where(which, np.where(there, found, np.inf), 0.0)
