"""Lists of many ranges at once."""

from __future__ import annotations

import doctest
import sys

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.geometry.ranges import ranges


@given(st.lists(st.tuples(st.integers(-100, 100), st.integers(0, 20)), max_size=30))
def test_ranges_follow_each_other(spans):
    """The integers are those of Python's ranges, one after the other, each with the number of its range."""
    first, count = np.array(spans, dtype=np.int64).reshape(-1, 2).T
    owner, value = ranges(first, count)
    expected = [(i, k) for i, (start, n) in enumerate(spans) for k in range(start, start + n)]
    assert list(zip(owner.tolist(), value.tolist(), strict=True)) == expected


def test_example_is_true():
    """The docstring's example gives what it says."""
    assert doctest.testmod(sys.modules[ranges.__module__]).failed == 0
    assert doctest.testmod(sys.modules[ranges.__module__]).attempted
