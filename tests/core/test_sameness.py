"""Values that are the same to the last bit, and what they weigh."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pytest

from legorize_addon.core.sameness import inner, same, weight


@dataclass(frozen=True, eq=False)
class Table:
    """A table as the stages have them."""

    rows: np.ndarray
    more: object = None

    @cached_property
    def total(self) -> np.ndarray:
        """Something that follows, and is kept."""
        return np.arange(1000)


NAN = np.array([np.nan, 1.0])


@pytest.mark.parametrize(
    ("one", "other", "expected"),
    [
        (1, 1, True),
        (1, True, False),
        (1, 1.0, False),
        ("a", "a", True),
        (None, None, True),
        (NAN, NAN.copy(), True),
        (np.array([0.0]), np.array([-0.0]), False),
        (np.zeros(2, np.int8), np.zeros(2, np.int16), False),
        (np.zeros((2, 1)), np.zeros((1, 2)), False),
        (np.arange(6).reshape(2, 3).T, np.arange(6).reshape(2, 3).T.copy(), True),
        ((1, [2, {"a": NAN}]), (1, [2, {"a": NAN.copy()}]), True),
        ((1, 2), [1, 2], False),
        ((1, 2), (1, 2, 3), False),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}, False),
        (Table(NAN, (1,)), Table(NAN.copy(), (1,)), True),
        (Table(NAN, (1,)), Table(NAN, (2,)), False),
        (object(), object(), False),
        (np.array([None]), np.array([None]), False),
    ],
)
def test_same_means_every_bit(one, other, expected):
    """Types, shapes and bits count; of what nobody knows only the same object is the same."""
    assert same(one, other) is expected
    assert same(one, one)


def test_what_follows_from_a_table_does_not_count():
    """What a table has computed of itself makes it no other one, but is part of what it weighs."""
    one, other = Table(NAN), Table(NAN)
    before = sum(map(weight, inner(one)))
    assert len(one.total) == 1000
    assert same(one, other)
    assert sum(map(weight, inner(one))) >= before + 8000


def test_shared_arrays_weigh_once():
    """A view has the data of its base, and an array that is named twice is there once."""
    rows = np.zeros(10_000)
    assert 80_000 <= sum(map(weight, inner((rows, rows[:5000], Table(rows), [rows])))) < 81_500
