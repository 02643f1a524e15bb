"""Forces of a model that is nearly the same, at the contacts that are still there: nearly in balance."""

from __future__ import annotations

from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..model import NOBODY
from ..units import PLATE, STUD
from .forces import Statics

FINEST: Final = 8
"""Parts of a stud that contact points lie on."""


def transferred(before: Statics, forces: Floats, after: Statics) -> Floats:
    """Return the forces of one balance at the contacts of another one.

    Parameters
    ----------
    before : Statics
        The balance that the forces belong to.
    forces : (k,) float64 array
        In N.
    after : Statics
        The balance of a model that is nearly the same.

    Returns
    -------
    (m,) float64 array
        In N: those of ``before`` at the same points in the same direction; 0
        where there was no contact.
    """
    known, wanted = _keys(before, after)
    order = np.argsort(known, kind="stable")
    # one more, which no key is equal to
    known, forces = np.append(known[order], -1), np.append(forces[order], 0.0)
    at = np.searchsorted(known[:-1], wanted)
    return np.where(known[at] == wanted, forces[at], 0.0)


def _keys(*balances: Statics) -> list[Ints]:
    """Return a number of each force, the same in all balances for the same place and direction."""
    columns = [_columns(each) for each in balances]
    every = np.concatenate([*columns, np.zeros((1, 6), dtype=np.int64)])
    low, size = every.min(axis=0), np.ptp(every, axis=0) + 1
    return [np.ravel_multi_index(tuple((each - low).T), tuple(size.tolist())).astype(np.int64) for each in columns]


def _columns(balance: Statics) -> Ints:
    """Return the point of each force, its number at that point, and the brick above the ground, (k, 6)."""
    contacts = balance.contacts
    places = np.rint(contacts.point * (FINEST, FINEST, STUD / PLATE)).astype(np.int64)
    # at a corner of the table two bricks may meet
    towards = np.rint((balance.middle[contacts.on] - contacts.point)[:, :2] * FINEST)
    both = np.column_stack([places, np.where(contacts.by[:, None] == NOBODY, towards, 0).astype(np.int64)])
    new = np.append(True, (both[1:] != both[:-1]).any(axis=1))[: len(both)]
    rows = np.arange(len(both))
    number = rows - np.maximum.accumulate(np.where(new, rows, 0))
    return np.column_stack([both, number])
