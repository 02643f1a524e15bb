"""Columns that agree with their neighbours: the estimate of parts, the order of changes, and that none costs more."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.unit_bricks.icm import Columns, is_brick, relax

RED, BLUE = 4, 1
BRICK = (RED, RED, RED)
ONE, TWO = (RED, COLOUR_EMPTY, COLOUR_EMPTY), (RED, RED, COLOUR_EMPTY)
SPLIT = (BLUE, BLUE, RED)
HIDDEN = (COLOUR_ANY,) * 3
NOTHING = (COLOUR_EMPTY,) * 3


def all_of(there: np.ndarray) -> Columns:
    """List every column, whatever it depends on."""
    return Columns.of(there, there)


def agree(one: int, two: int) -> bool:
    """Tell whether one part may have both colours."""
    return COLOUR_EMPTY not in (one, two) and (one == two or COLOUR_ANY in (one, two))


def parts(codes, columns: Columns) -> float:
    """Count parts, column by column: by how many neighbours each brick or plate may be one part with."""
    state = [tuple(each) for each in np.asarray(codes).tolist()] + [NOTHING]
    brick = [COLOUR_EMPTY not in each and len({*each} - {COLOUR_ANY}) <= 1 for each in state]
    total = 0.0
    for row, own in enumerate(state):
        near = [other for other in columns.beside[row] if brick[other] == brick[row]]
        if brick[row]:
            n = sum(agree(max(own), max(state[other])) for other in near)
            total += (1, 0.15, 0.1, 0.1, 0.1)[n]
            continue
        for plate in range(3):
            n = sum(agree(own[plate], state[other][plate]) for other in near)
            total += (own[plate] != COLOUR_EMPTY) * (1, 0.5, 0.15, 0.1, 0.1)[n]
    return total


def settled(*row) -> list[tuple[int, ...]]:
    """Let columns in a row become bricks, for a little more than what a part is worth a missing plate."""
    there = np.array([each != NOTHING for each in row])[None, None]
    columns = all_of(there)
    start = np.array([each for each in row if each != NOTHING], np.int16)

    def offers(_which, now, _beside):
        missing = (now == COLOUR_EMPTY).sum(axis=1)
        offered = np.stack([now, np.full_like(now, RED)], axis=1)
        return offered, np.stack([0.0 * missing, 1.2 * missing], axis=1)

    found = relax(start, columns, np.arange(len(start)), offers, 1.0)
    return [tuple(each) for each in found.tolist()]


@pytest.mark.parametrize("column", [BRICK, HIDDEN, (RED, COLOUR_ANY, RED)])
def test_full_columns_of_one_colour_are_bricks(column):
    """Cells of any colour agree with every other."""
    assert is_brick(np.array(column, np.int16))


@pytest.mark.parametrize("column", [ONE, TWO, SPLIT, NOTHING, (COLOUR_ANY, COLOUR_EMPTY, COLOUR_ANY)])
def test_other_columns_are_plates(column):
    """What has a gap or several colours is no brick, nor is nothing."""
    assert not is_brick(np.array(column, np.int16))


def test_lone_plates_become_bricks_runs_do_not():
    """Two lone plates between bricks save three parts as a brick that joins them; in a run each saves hardly any."""
    assert settled(BRICK, TWO, BRICK) == [BRICK] * 3
    assert settled(BRICK, *[TWO] * 6, BRICK) == [BRICK, *[TWO] * 6, BRICK]
    assert settled(TWO, NOTHING, TWO) == [TWO] * 2


def test_columns_of_one_turn_have_nothing_in_common():
    """Neighbours, and neighbours of neighbours, change in other turns."""
    columns = all_of(np.ones((1, 9, 8), bool))
    turn = columns.turn.reshape(9, 8)
    for up, right in ((0, 1), (1, 0), (0, 2), (2, 0), (1, 1), (1, -1)):
        first = turn[: 9 - up, max(-right, 0) : 8 - max(right, 0)]
        second = turn[up:, max(right, 0) : 8 + min(right, 0)]
        assert (first != second).all()


def choice(columns: Columns, rng: np.random.Generator):
    """Return offers of any of a few states, each with an error by column and plate, and that error."""
    states = np.array([BRICK, TWO, SPLIT, ONE, (BLUE,) * 3, NOTHING], np.int16)
    price = rng.uniform(0, 1, (len(columns), 3, RED + 3))

    def error(rows, codes):
        return price[rows[:, None, None], np.arange(3), codes - COLOUR_EMPTY].sum(axis=2)

    def offers(which, now, beside):
        assert beside.shape == (len(which), 4, 3)
        offered = np.concatenate([now[:, None], np.broadcast_to(states, (len(which), *states.shape))], axis=1)
        return offered, error(which, offered)

    return states, offers, error


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0, 2))
def test_nothing_gets_dearer(seed, worth):
    """The errors and what the parts are worth never add up to more than at the start; the same start, the same end."""
    rng = np.random.default_rng(seed)
    columns = all_of(rng.random((2, 6, 5)) < 0.8)
    states, offers, error = choice(columns, rng)
    start = states[rng.integers(len(states), size=len(columns))]
    rows = np.arange(len(columns))
    found = relax(start, columns, rows, offers, worth)
    before, after = (error(rows, each[:, None]).sum() + worth * parts(each, columns) for each in (start, found))
    assert after <= before + 1e-4
    np.testing.assert_array_equal(found, relax(start, columns, rows, offers, worth))


def test_without_worth_every_column_takes_its_own_best():
    """Neighbours do not matter where parts are worth nothing."""
    rng = np.random.default_rng(5)
    columns = all_of(np.ones((1, 5, 7), bool))
    states, offers, error = choice(columns, rng)
    rows = np.arange(len(columns))
    found = relax(states[rng.integers(len(states), size=len(columns))], columns, rows, offers, 0.0)
    best = states[error(rows, np.broadcast_to(states, (len(rows), *states.shape))).argmin(axis=1)]
    np.testing.assert_array_equal(found, best)


@settings(max_examples=20, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_what_is_listed_is_all_that_matters(seed):
    """Columns farther off than two steps from those that may change make no difference; the others do not change."""
    rng = np.random.default_rng(seed)
    there, active = rng.random((2, 7, 8)) < 0.9, rng.random((2, 7, 8)) < 0.15
    states, *_ = choice(all_of(there), rng)
    cells = states[rng.integers(len(states), size=there.shape)].transpose(0, 3, 1, 2)
    cells = np.where(there[:, None], cells, COLOUR_EMPTY).astype(np.int16)
    price = rng.uniform(0, 1, (*there.shape, len(states) + 1))
    found = []
    for columns in (Columns.of(there, active), all_of(there)):
        rows = np.flatnonzero(active[columns.layer, columns.y, columns.x])
        error = price[columns.layer, columns.y, columns.x][rows]

        def offers(which, now, _beside, error=error):
            offered = np.concatenate([now[:, None], np.broadcast_to(states, (len(which), *states.shape))], axis=1)
            return offered, error[which]

        found.append(columns.put(cells, relax(columns.plates(cells), columns, rows, offers, 0.5)))
    np.testing.assert_array_equal(*found)
    changed = (found[0] != cells).any(axis=1)
    assert not (changed & ~(active & there)).any()
