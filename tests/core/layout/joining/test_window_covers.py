"""Covers of windows: what they join, and that none is cheaper."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.joining.window_covers import cuts_apart, first_joined, joining_cover, touched
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from tests.core.layout.cells import RED, problem_of


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_cuts_are_the_placements_that_would_join_what_is_torn(seed):
    """Sets of components that bricks hold together, one by one: torn ones, and the loose one alone, need one more."""
    rng = np.random.default_rng(seed)
    k, n = int(rng.integers(1, 6)), int(rng.integers(1, 8))
    touches = rng.random((k, n)) < 0.3
    chosen = np.flatnonzero(rng.random(n) < 0.5)
    home, loose = rng.integers(0, 3, k), int(rng.integers(3))
    groups = [{each} for each in range(k)]
    for brick in chosen:
        held = [group for group in groups if touches[list(group), brick].any()]
        groups = [group for group in groups if group not in held] + ([set().union(*held)] if held else [])
    assert first_joined(touches[:, chosen]).tolist() == [
        next(min(group) for group in groups if each in group) for each in range(k)
    ]
    expected = []
    for group in sorted(groups, key=min):
        inside = {int(home[each]) for each in group}
        others = {int(home[each]) for each in range(k) if each not in group}
        if inside & others or inside == {loose}:
            ends = [(touches[list(group), j].any(), np.delete(touches[:, j], list(group)).any()) for j in range(n)]
            expected.append([float(one and other) for one, other in ends])
    assert cuts_apart(touches, chosen, home, loose).tolist() == expected


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_touches_are_the_components_above_and_below(seed):
    """Cell by cell of each placement: who lies below it and above it."""
    rng = np.random.default_rng(seed)
    problem = problem_of(rng.choice([COLOUR_EMPTY, RED], (3, 4), p=[0.2, 0.8]).tolist())
    labels = rng.integers(-1, 4, (2, len(problem.required)))
    table, known = touched(problem.placements, labels)
    assert known.tolist() == sorted(set(labels[:, np.unique(problem.placements.cells)].ravel().tolist()) - {-1})
    for row in range(len(problem.placements)):
        cells = problem.placements.cells[problem.placements.entries(np.array([row]))]
        assert set(known[table[:, row]].tolist()) == set(labels[:, cells].ravel().tolist()) - {-1}


def covers(problem):
    """Yield every set of placements that covers the required cells once and the others at most once."""
    found, required = problem.placements, problem.required
    cells = [set(found.cells[found.entries(np.array([row]))].tolist()) for row in range(len(found))]

    def further(chosen, taken):
        bare = [cell for cell in range(len(required)) if required[cell] and cell not in taken]
        if not bare:
            yield chosen
            return
        for row in range(len(cells)):
            if bare[0] in cells[row] and not cells[row] & taken:
                yield from further([*chosen, row], taken | cells[row])

    yield from further([], set())


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_a_cover_is_the_cheapest_of_those_that_join(seed):
    """Of small windows all covers are tried: what they hold together is followed, and what hangs costs more."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, RED], (2, 3), p=[0.15, 0.85])
    colour[0, 0] = RED
    problem = problem_of(colour)
    labels = rng.choice([-1, -1, -1, 0, 1, 2], (2, len(problem.required)))
    touches, known = touched(problem.placements, labels)
    home, loose = rng.integers(0, 2, len(known)), int(rng.integers(2))
    costs = []
    for chosen in covers(problem):
        groups = [{each} for each in range(len(known))]
        for brick in chosen:
            held = [group for group in groups if touches[list(group), brick].any()]
            groups = [group for group in groups if group not in held] + ([set().union(*held)] if held else [])
        homes = [{int(home[each]) for each in group} for group in groups]
        torn = any(one & other for k, one in enumerate(homes) for other in homes[:k])
        if not torn and {loose} not in homes:
            costs.append(problem.cost[chosen].sum() + 3.5 * (~touches[:, chosen].any(axis=0)).sum())
    found = joining_cover(problem, touches, home, loose)
    assert (found is not None) == bool(costs)
    if found is not None:
        cost = problem.cost[found].sum() + 3.5 * (~touches[:, found].any(axis=0)).sum()
        assert sorted(problem.placements.cells[problem.placements.entries(found)].tolist()) == list(
            range(len(problem.required))
        )
        assert np.isclose(cost, min(costs))
