"""Bodies that move as one: what stays together where contacts are let loose, or where a motion opens none."""

from __future__ import annotations

from typing import Final

import numpy as np
from scipy.sparse import csr_array

from ..arrays import Floats, Ints, Mask
from ..model import NOBODY, components
from .forces import Statics

STILL: Final = 1e-6
"""Share of the widest gap of a motion up to which a contact does not open."""


def touching(equations: Statics) -> csr_array:
    """Return which bodies have a contact with which, (n, n)."""
    contacts, n = equations.contacts, len(equations.rows)
    inner = contacts.by != NOBODY
    one, other = np.divmod(np.unique(contacts.on[inner] * n + contacts.by[inner]), n)
    entries = np.ones(2 * len(one), dtype=np.int32)
    return csr_array((entries, (np.append(one, other), np.append(other, one))), shape=(n, n))


def grown(near: csr_array, bodies: Mask) -> Mask:
    """Add the bodies that touch some."""
    more: Mask = bodies | (near @ bodies.astype(np.int32) > 0)
    return more


def lumps_around(near: csr_array, loose: Mask) -> Ints:
    """Return a lump of its own for each loose body, and one for each part of the rest that hangs together, (n,)."""
    pairs = near.tocoo()
    kept = ~(loose[pairs.row] | loose[pairs.col])
    return components(np.column_stack([pairs.row, pairs.col])[kept], len(loose)).astype(np.int64)


def stiff_lumps(equations: Statics, motion: Floats) -> Ints:
    """Return lumps of the bodies that do not move against each other, (n,)."""
    contacts, n = equations.contacts, len(equations.rows)
    inner = contacts.by != NOBODY
    opening = np.abs(equations.matrix.T @ motion)
    pairs, at = np.unique(contacts.on[inner] * n + contacts.by[inner], return_inverse=True)
    moving = np.zeros(len(pairs))
    np.maximum.at(moving, at, opening[inner])
    kept = moving <= STILL * opening.max(initial=0)
    return components(np.stack(np.divmod(pairs[kept], n), axis=1), n).astype(np.int64)
