"""The fast tier on single sheets: exact covers, few bricks where the best is known, always the same."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.solvers import greedy
from legorize_addon.core.layout.solvers.greedy import cover
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import RED, assert_covered_once, problem_of, random_sheet


def laid(problem, seed=0):
    """Return the chosen rows and the cell numbers that they cover, one after the other."""
    rows = cover(problem, np.random.default_rng(seed))
    return rows, problem.placements.cells[problem.placements.entries(rows)]


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_must_cells_once_and_others_at_most_once(seed):
    """No two bricks overlap, every required cell is covered, and nothing more could be laid."""
    problem = problem_of(*random_sheet(seed))
    rows, _ = laid(problem)
    assert_covered_once(problem, rows)
    times = problem.owner(rows) != NOBODY
    assert (problem.placements.totals(times) > 0).all()


@pytest.mark.parametrize(
    ("n_y", "n_x", "bricks"), [(1, 1, 1), (2, 8, 1), (8, 2, 1), (4, 8, 2), (1, 5, 2), (2, 12, 2), (16, 16, 16)]
)
def test_rectangles_take_as_few_bricks_as_can_be(n_y, n_x, bricks):
    """A rectangle that parts fill exactly is filled by them."""
    rows, _ = laid(problem_of(np.full((n_y, n_x), RED)))
    assert len(rows) == bricks


def test_a_wide_slab_takes_nearly_the_largest_parts():
    """A slab of one colour is laid with at least 13 of the 16 cells that the largest part has."""
    rows, cells = laid(problem_of(np.full((40, 40), RED)))
    assert len(cells) / len(rows) >= 13


def test_a_corner_is_one_brick():
    """Three cells round a corner are one corner brick."""
    rows, _ = laid(problem_of([[RED, RED], [COLOUR_EMPTY, RED]]))
    assert len(rows) == 1


def test_optional_cells_save_bricks():
    """Two cells that touch at a corner are one brick if a cell beside both may be covered, else two."""
    colour = [[RED, COLOUR_ANY], [COLOUR_EMPTY, RED]]
    with_it, _ = laid(problem_of(colour, [[Fill.REQUIRED, Fill.OPTIONAL], [Fill.EMPTY, Fill.REQUIRED]]))
    without, _ = laid(problem_of([[RED, COLOUR_EMPTY], [COLOUR_EMPTY, RED]]))
    assert (len(with_it), len(without)) == (1, 2)


def test_no_cell_is_left_alone():
    """In a row of seven no brick of one cell is left over: 4 + 3 or 6 + 1 cost two bricks both."""
    problem = problem_of(np.full((1, 7), RED))
    rows, _ = laid(problem)
    assert len(rows) == 2


def test_seams_below_are_bridged():
    """Over two bricks of 2 x 4 end to end, a brick is laid across their seam."""
    below = np.where(np.arange(8) < 4, 0, 1) * np.ones((2, 1), np.int32)
    problem = problem_of(np.full((2, 8), RED), owner=below)
    across = problem.placements.corner[:, 0] < 4
    across &= problem.placements.corner[:, 0] + problem.shapes.extent[problem.placements.shape, 0] > 4
    rows, _ = laid(problem)
    assert across[rows].any()
    size = problem.placements.size
    assert problem.cost[across & (size == 4)].max() < problem.cost[~across & (size == 4)].min()


def test_same_seed_same_bricks():
    """The same state of the generator gives the same bricks; the problem is not changed."""
    problem = problem_of(np.full((13, 11), RED))
    before = problem.cost.copy()
    np.testing.assert_array_equal(laid(problem, 3)[0], laid(problem, 3)[0])
    np.testing.assert_array_equal(problem.cost, before)


def test_hanging_costs():
    """Over nothing and under nothing a brick costs more than one that touches something below."""
    below = np.full((1, 4), NOBODY)
    below[0, 0] = 0
    problem = problem_of(np.full((1, 4), RED), owner=below)
    touching = problem.placements.corner[:, 0] == 0
    same = problem.placements.size == 2
    assert problem.cost[touching & same].max() + 1 < problem.cost[~touching & same].min()


def plain(problem, rng):
    """Return what is laid by the plain rules: again and again, all that shares no cell with a better one."""
    # a cell has twice its price at 60 offers, and is worth half a brick more if it has one neighbour
    found, one, partners = problem.placements, greedy._ONE, {1: greedy._ONE // 2, 2: greedy._ONE // 10}
    cells = [found.cells[start:end].tolist() for start, end in zip(found.start, found.start[1:], strict=False)]
    chance, left, laid = rng.permutation(len(cells)), set(range(len(cells))), []
    ties = []
    for row in range(len(cells)):
        x, y, sheet = found.corner[row].tolist()
        # a whole number of Python: the sum of two truths of numpy is one truth
        odd = int(problem.sheets.level[sheet]) // problem.sheets.height % 2
        wide, deep = problem.shapes.extent[found.shape[row]].tolist()
        on_lattice = ((x + odd * (wide // 2)) % wide == 0) + ((y + odd * (deep // 2)) % deep == 0)
        ties.append(on_lattice * len(cells) + int(chance[row]))
    while left:
        price, n_cells = [0] * len(problem.required), len(problem.required)
        through = [[row for row in left if cell in cells[row]] for cell in range(n_cells)]
        near = [{c for row in through[k] if len(cells[row]) == 2 for c in cells[row] if c != k} for k in range(n_cells)]
        for cell in np.flatnonzero(problem.required).tolist():
            if through[cell]:
                largest, offers = (how(len(cells[row]) for row in through[cell]) for how in (max, sum))
                price[cell] += round(one * largest**-0.5) * (offers + 60) // offers
            for count, amount in partners.items():
                if len(near[cell]) == count:
                    price[cell] += amount * count
                    for other in near[cell]:
                        price[other] -= amount
        merit = {row: round((1 - problem.cost[row]) * one) if len(cells[row]) > 1 else 0 for row in left}
        score = {row: (sum(price[cell] for cell in cells[row]) + merit[row], ties[row]) for row in left}
        won = {row for row in left if all(score[row] == max(score[other] for other in through[c]) for c in cells[row])}
        laid += sorted(won)
        taken = {cell for row in won for cell in cells[row]}
        left = {row for row in left if taken.isdisjoint(cells[row])}
    return laid


@given(st.integers(0, 2**32 - 1))
@example(21)
@settings(max_examples=25)
def test_bricks_are_those_of_the_plain_rules(seed):
    """Small sheets over nothing, over the ground and over seams: the same bricks in the same order."""
    rng = np.random.default_rng(seed)
    colour, wanted = random_sheet(seed, (4, 5))
    below = rng.choice([NOBODY, 0, 1, 2], (4, 5)) if rng.random() < 0.7 else None
    problem = problem_of(colour, wanted, owner=below)
    assert cover(problem, np.random.default_rng(seed)).tolist() == plain(problem, np.random.default_rng(seed))
