"""Parts to the lattice: which quarter turn a matrix is, and in which cell a part lies."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..files import MATRICES, part_origin
from ..model import Catalogue
from ..units import PLATE_LDU, STUD_LDU

ROUNDED: Final = 0.01
"""How far an entry of a matrix may lie off a whole number: programs write three digits, or chain rotations."""

SNAP: Final = 0.1
"""How far in LDU a part may lie off its cell, a twenty-fifth of a millimetre: what rounding leaves."""

PITCH: Final = np.array([STUD_LDU, PLATE_LDU, STUD_LDU])
"""Size of a cell in LDU along the axes of LDraw."""

_HALVED: Final = PITCH / (2, 1, 2)
"""The same with half studs, on which jumpers hold what lies there."""

_ACROSS: Final = np.diag((-1, 1, 1))
_DIAGONAL: Final = np.array([[0, 0, 1], [0, 1, 0], [1, 0, 0]])
"""Mirrors that leave a box, and a corner part, as it is."""


def quarter_turns(matrix: Floats, corner: Mask) -> tuple[Ints, Mask]:
    """Return the quarter turns of parts.

    Parameters
    ----------
    matrix : (n, 3, 3) float64 array
    corner : (n,) bool array
        Whether the part is a corner.

    Returns
    -------
    turn : (n,) int64 array
        0 to 3, counter-clockwise as seen from above; -1 where a part does not
        stand upright, or is stretched.
    mirrored : (n,) bool array
        Whether the matrix mirrors. Boxes, corners and slopes look the same in a mirror, so they have a turn all the
        same; a wedge plate has that of its image, mirrored across its width.
    """
    # a turn has entries from -1 to 1; numbers without end, or none, would spoil the arithmetic
    turning = (np.abs(matrix) < 2).all(axis=(1, 2), keepdims=True)
    matrix = np.where(turning, matrix, 0.0)
    whole = np.rint(matrix)
    straight = (np.abs(matrix - whole) <= ROUNDED).all(axis=(1, 2))
    mirrored: Mask = straight & (np.linalg.det(whole) < -0.5)
    whole[mirrored & ~corner] = whole[mirrored & ~corner] @ _ACROSS
    whole[mirrored & corner] = whole[mirrored & corner] @ _DIAGONAL
    turn = np.full(len(matrix), -1)
    for number, text in enumerate(MATRICES):
        same = (whole == np.array(text.split(), np.float64).reshape(3, 3)).all(axis=(1, 2))
        turn[straight & same] = number
    return turn, mirrored


def cells(place: Floats, part: Ints, turn: Ints, catalogue: Catalogue) -> tuple[Ints, Ints, Mask]:
    """Return the lowest corners of parts on the lattice of most of them, or half a stud off it if there are jumpers.

    Parameters
    ----------
    place : (n, 3) float64 array
        Origins in LDU.
    part : (n,) int64 array
        Rows of the catalogue.
    turn : (n,) int64 array
        Quarter turns.
    catalogue : Catalogue

    Returns
    -------
    corner : (n, 3) int64 array
        x and y in studs, z in plates, z up.
    half : (n, 2) int64 array
        Half studs, 0 or 1, by which they lie beyond their corners along x and y.
    on : (n,) bool array
        Which parts lie there; corners of others mean nothing.
    """
    reduced = turn % np.array([each.turns for each in catalogue.parts])[part]
    own = np.array([[part_origin(each, quarter) for quarter in range(4)] for each in catalogue.parts])[part, reduced]
    corner = place - own
    corner = corner - _phase(corner)
    # without jumpers nothing holds what lies half a stud off
    jumpers = np.array([each.jumper for each in catalogue.parts])[part].any()
    halves = np.rint(corner / _HALVED) if jumpers else np.rint(corner / PITCH) * (2, 1, 2)
    on: Mask = (np.abs(corner - halves * _HALVED) <= SNAP).all(axis=1)
    doubled = halves[:, [0, 2, 1]].astype(np.int64) * (1, 1, -1)
    cell = np.column_stack([doubled[:, :2] // 2, doubled[:, 2]])
    return cell, doubled[:, :2] % 2, on


def _phase(corner: Floats) -> Floats:
    """Return where the lattice begins on which most corners lie, in LDU below a cell; zero if that is as good."""
    if not len(corner):
        return np.zeros(3)
    rest = np.round(corner % PITCH / SNAP).astype(np.int64) % np.rint(PITCH / SNAP).astype(np.int64)
    found, count = np.unique(rest, axis=0, return_counts=True)
    # of equals the first, which is the smallest
    begin: Floats = found[count.argmax()] * SNAP
    return begin
