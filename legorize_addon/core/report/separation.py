"""Why the components of a model are not one: how near they come to each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

import numpy as np

from ..arrays import Ints, Mask
from ..model import NOBODY

if TYPE_CHECKING:
    from ..model import Rows

_APART, _EDGE, _SIDE, _FLAT = range(4)

_STEPS: Final = tuple(step for step in np.ndindex(2, 3, 3) if step > (0, 1, 1))
"""Steps, more by one along y and x, to the neighbours of a cell above it and beside it, one of each opposite pair."""

_REASONS: Final = (
    "{} nothing else: let the meshes touch if they should be one model",
    "{} others only at edges or corners, where no stud can hold: let the meshes overlap there by a stud",
    "{} others side by side, but no part of a fitting colour could be laid across the seam: allow plates, or "
    "make the model a stud thicker or of one colour where they meet",
    "{} others side by side in a layer one plate thick, with nothing below or above it that could hold them: make the "
    "model thicker there, or give a picture a backing",
)


def reasons(owner: Rows, component: Rows) -> str:
    """Say why components are not one, and what can be done about it.

    Parameters
    ----------
    owner : (n_z, n_y, n_x) int32 array
        Row of the brick in each cell, ``NOBODY`` where there is none.
    component : (n,) int32 array
        Component of each brick; there are two at least.

    Returns
    -------
    str
        The end of a sentence, without its full stop. All components but the
        largest are counted by how near they come to any other one.
    """
    met = meetings(owner, component)
    met[_flat(owner, component)] = _FLAT
    others = np.delete(met, np.bincount(component).argmax())
    counts = [int(np.count_nonzero(others == kind)) for kind in (_FLAT, _SIDE, _EDGE, _APART)]
    if len(others) == 1:
        return _REASONS[int(others[0])].format("the smaller one touches")
    if max(counts) == len(others):
        return _REASONS[int(others[0])].format("they touch")
    told = zip(counts, (_FLAT, _SIDE, _EDGE, _APART), strict=True)
    return "; ".join(
        _REASONS[kind].format(f"{count} of them touch{'es' * (count == 1)}") for count, kind in told if count
    )


def meetings(owner: Rows, component: Rows) -> Ints:
    """Tell how near each component comes to another one.

    Parameters
    ----------
    owner : (n_z, n_y, n_x) int32 array
    component : (n,) int32 array

    Returns
    -------
    (n_components,) int64 array
        2 if some of their cells lie side by side, 1 if they meet at an edge or a
        corner, 0 if not even that.
    """
    met = np.zeros(int(component.max()) + 1, dtype=np.int64)
    for sideways, one, other in _pairs(owner, component):
        for side in (one, other):
            rows = np.unique(side)
            met[rows] = np.maximum(met[rows], _SIDE if sideways else _EDGE)
    return met


def _pairs(owner: Rows, component: Rows) -> Iterator[tuple[bool, Rows, Rows]]:
    """Yield for each step to a neighbour whether it is to a side, and the different components at both ends."""
    # the brick of no cell finds its component at the end
    label = np.pad(np.append(component, np.int32(NOBODY))[owner], 1, constant_values=NOBODY)
    here = label[:-1, 1:-1, 1:-1]
    for up, back, right in _STEPS:
        there = label[
            up : label.shape[0] - 1 + up, back : label.shape[1] - 2 + back, right : label.shape[2] - 2 + right
        ]
        apart = (here != NOBODY) & (there != NOBODY) & (here != there)
        yield abs(up) + abs(back - 1) + abs(right - 1) == 1, here[apart], there[apart]


def _flat(owner: Rows, component: Rows) -> Mask:
    """Tell which components are a plate, by itself, beside others that are, and beside no other kind."""
    levels = [np.unique(plane) for plane in owner]
    height = np.bincount(np.concatenate(levels) + 1, minlength=len(component) + 1)[1:]
    single = (np.bincount(component) == 1) & (np.bincount(component, height) == 1)
    beside, taller = np.zeros((2, len(single)), dtype=bool)
    for sideways, one, other in _pairs(owner, component):
        if sideways:
            for end, neighbour in ((one, other), (other, one)):
                beside[end] = True
                taller[end[~single[neighbour]]] = True
    flat: Mask = single & beside & ~taller
    return flat
