"""Exchange of bricks: moves that save bricks are made, all others are not."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.solvers.exchange import exchange, fewer_small
from legorize_addon.core.layout.solvers.greedy import cover
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import RED, WHITE, problem_of


def rows_at(problem, *bricks):
    """Return the rows of placements, given length along x, width and lowest x and y of each."""
    rows = []
    for w, length, x, y in bricks:
        shape = np.flatnonzero((problem.shapes.extent == [w, length]).all(axis=1) & (problem.shapes.size == w * length))
        rows.append(problem.placements.find(shape, np.array([[x, y, 0]]))[0])
    assert min(rows) >= 0
    return np.array(rows)


def extents(problem, rows):
    """Return sizes along x and y of placements, sorted."""
    return sorted(map(tuple, problem.shapes.extent[problem.placements.shape[rows]].tolist()))


def test_a_single_cell_takes_a_neighbours_end():
    """A brick of 4 and one of 1 in a row become 3 and 2."""
    problem = problem_of(np.full((1, 5), RED))
    better = fewer_small(problem, rows_at(problem, (4, 1, 0, 0), (1, 1, 4, 0)), np.random.default_rng(0))
    assert extents(problem, better) == [(2, 1), (3, 1)]


def test_two_bricks_become_one():
    """A brick that covers two others takes their place."""
    problem = problem_of(np.full((1, 4), RED))
    better = fewer_small(problem, rows_at(problem, (3, 1, 0, 0), (1, 1, 3, 0)), np.random.default_rng(0))
    assert extents(problem, better) == [(4, 1)]


def test_optional_rest_is_dropped():
    """What is left of a cut brick need not be covered again where nothing must be built."""
    colour = [[RED, RED, COLOUR_ANY, COLOUR_ANY]]
    problem = problem_of(colour, [[Fill.REQUIRED, Fill.REQUIRED, Fill.OPTIONAL, Fill.OPTIONAL]])
    better = fewer_small(problem, rows_at(problem, (1, 1, 0, 0), (3, 1, 1, 0)), np.random.default_rng(0))
    assert len(better) == 1


def test_nothing_is_changed_without_gain():
    """Where no move saves anything, the same array comes back."""
    problem = problem_of([[RED, WHITE]])
    chosen = rows_at(problem, (1, 1, 0, 0), (1, 1, 1, 0))
    assert fewer_small(problem, chosen, np.random.default_rng(0)) is chosen
    assert exchange(problem, chosen, np.arange(len(problem.placements)), np.random.default_rng(0)) is chosen


def test_a_reward_pays_for_a_patch():
    """A rewarded brick is laid over the middle of another one only if several may cover the rest."""
    problem = problem_of(np.full((2, 8), RED))
    chosen = rows_at(problem, (8, 2, 0, 0))
    offered = rows_at(problem, (2, 2, 3, 0))
    rng = np.random.default_rng(0)
    assert exchange(problem, chosen, offered, rng, reward=np.array([9.0])) is chosen
    patched = exchange(problem, chosen, offered, rng, reward=np.array([9.0]), patch=2.5)
    assert offered[0] in patched
    cells = problem.placements.cells[problem.placements.entries(patched)]
    assert sorted(cells.tolist()) == list(range(16))


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_covers_stay_covers_and_get_cheaper(seed):
    """After any exchange required cells are covered once, no cell twice, and the cost has not grown."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, COLOUR_ANY, RED, RED, WHITE], (8, 9))
    wanted = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED], (8, 9)))
    wanted[0, 0], colour[0, 0] = Fill.REQUIRED, RED
    problem = problem_of(colour, wanted)
    chosen = cover(problem, rng)
    everything = np.arange(len(problem.placements))
    for better in (
        fewer_small(problem, chosen, rng),
        exchange(problem, chosen, everything, rng),
        exchange(problem, chosen, everything, rng, reward=rng.random(len(everything)) * 3, patch=2.0),
    ):
        times = np.bincount(
            problem.placements.cells[problem.placements.entries(better)], minlength=len(problem.required)
        )
        assert times.max() == 1
        assert (times[problem.required] == 1).all()
    unrewarded = exchange(problem, chosen, everything, rng)
    assert problem.cost[unrewarded].sum() <= problem.cost[chosen].sum() + 1e-9


def test_the_first_of_all_placements_can_be_a_rest():
    """What is left of a cut brick is found among all placements, the one in row 0 as well."""
    problem = problem_of(np.full((1, 3), RED))
    better = fewer_small(problem, rows_at(problem, (2, 1, 0, 0), (1, 1, 2, 0)), np.random.default_rng(0))
    assert extents(problem, better) == [(3, 1)]
    chosen, offered = rows_at(problem, (3, 1, 0, 0)), rows_at(problem, (2, 1, 1, 0))
    assert rows_at(problem, (1, 1, 0, 0)).tolist() == [0]
    moved = exchange(problem, chosen, offered, np.random.default_rng(0), reward=np.array([5.0]))
    assert extents(problem, moved) == [(1, 1), (2, 1)]
