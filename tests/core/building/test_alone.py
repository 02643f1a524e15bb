"""When bricks can be shown without supports."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.alone import steps_alone
from tests.core.building.heaps import reached


def alone(arrival, pairs, ground):
    """Return the steps of bricks."""
    mask = np.isin(np.arange(len(arrival)), ground)
    return steps_alone(np.array(arrival, np.int32), np.array(pairs, np.int32).reshape(-1, 2), ground=mask).tolist()


def test_what_stands_is_there_as_it_arrives():
    """A tower is shown brick by brick."""
    assert alone([0, 1, 2], [(0, 1), (1, 2)], [0]) == [0, 1, 2]


def test_what_a_support_carried_waits_for_its_hold():
    """A brick that comes in step 1 is held by one of step 5 alone; the shorter way over a later brick does not help."""
    assert alone([0, 1, 5, 7], [(0, 2), (2, 1), (0, 3), (3, 1)], [0]) == [0, 5, 5, 7]


def test_what_floats_is_shown_all_the_same():
    """A brick without any way to the ground comes when it is placed."""
    assert alone([0, 3], [], [0]) == [0, 3]


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 10**6))
def test_each_brick_comes_in_the_first_step_that_reaches_it(seed):
    """In every step, what has arrived by then is followed from the ground, over what has arrived alone."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 10))
    arrival, pairs = rng.integers(0, 6, n).tolist(), rng.integers(0, n, (int(rng.integers(0, 2 * n)), 2)).tolist()
    ground = np.flatnonzero(rng.random(n) < 0.3).tolist()
    expected = list(arrival)
    for step in range(5, -1, -1):
        there = {brick for brick in range(n) if arrival[brick] <= step}
        for brick in reached(there.intersection(ground), [pair for pair in pairs if there.issuperset(pair)]):
            expected[brick] = step
    assert alone(arrival, pairs, ground) == expected
