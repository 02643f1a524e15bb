"""Steps that are too small are given up."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.building.items import Atoms, Items
from legorize_addon.core.building.tidying import Tidying
from legorize_addon.core.model.bricks import NOBODY


def row(n, before=()):
    """Return atoms side by side, of which some must come before others."""
    x = np.arange(n) * 2
    return Atoms(
        Items(
            box=np.stack([x, x + 1, 0 * x, 0 * x], axis=1),
            level=np.zeros(n, np.int64),
            due=np.zeros(n, np.int64),
            size=np.ones(n, np.int64),
            lot=np.zeros(n, np.int64),
            temporary=np.zeros(n, bool),
            image=np.full(n, NOBODY),
            tile=np.zeros(n, np.int64),
        ),
        np.array(before, np.int32).reshape(-1, 2),
    )


def test_a_single_part_moves_into_a_step_beside_it():
    """What is alone joins others in reach."""
    found = Tidying(row(10), [[0, 1, 2, 3], [4], [5, 6, 7, 8, 9]]).steps()
    assert found == [[0, 1, 2, 3, 4], [5, 6, 7, 8, 9]]


def test_it_stays_where_nothing_is_near():
    """Parts 20 studs away are no help, and neither are steps that are full."""
    assert Tidying(row(18), [list(range(4)), [17], list(range(4, 17))]).steps()[1] == [17]


def test_it_never_moves_before_what_it_waits_for():
    """A part that rests on a later step cannot go back."""
    atoms = row(8, before=[(4, 7), (5, 7)])
    found = Tidying(atoms, [[0, 1, 2, 3], [4, 5, 6], [7]]).steps()
    assert found == [[0, 1, 2, 3], [4, 5, 6, 7]]


def test_two_go_together_or_not_at_all():
    """If one of two parts finds no place, the other stays with it."""
    atoms = row(20)
    found = Tidying(atoms, [[0, 1, 2, 3, 4], [5, 19]]).steps()
    assert found == [[0, 1, 2, 3, 4], [5, 19]]
