"""Steps of somebody else: kept as they are, and walked as our own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.check import walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.given import given_steps
from legorize_addon.core.model.assembly import Assembly
from tests.core.any_bricks import CATALOGUE, table
from tests.core.building.heaps import cells_of, heap, shared_studs

BRICK = CATALOGUE.part_row("3001")


def tower(*steps):
    """Return 2 x 4 bricks on each other, each in a step, from below."""
    return Assembly(table([(BRICK, 0, 0, 3 * row, 0, 4, 0, 0, step) for row, step in enumerate(steps)]), CATALOGUE)


def found(assembly):
    """Return the moves as (brick, pressed, step), and what the check of the order says."""
    none = np.zeros(len(assembly), bool)
    contacts = building_contacts(assembly, temporary=none)
    steps = given_steps(assembly, contacts.pairs)
    moves = steps.moves
    rows = list(zip(moves.brick.tolist(), moves.pressed.tolist(), moves.step.tolist(), strict=True))
    return rows, walk(steps, assembly, contacts, temporary=none)


def test_steps_are_kept_without_gaps():
    """Two, then one, then one, whatever their numbers; within a step from below."""
    rows, checked = found(tower(2, 2, 7, 9))
    assert rows == [(0, False, 0), (1, False, 0), (2, False, 1), (3, False, 2)]
    assert checked.buildable


def test_what_hangs_is_pressed_from_below():
    """A brick under another one that sticks out, in a later step, is pressed on; in the same step as well."""
    rows = [(BRICK, 0, 0, 9, 0, 4, 0, 0, 0), (BRICK, 3, 0, 12, 0, 4, 0, 0, 0), (BRICK, 6, 0, 9, 0, 4, 0, 0, 1)]
    rows += [(BRICK, 0, 0, z, 0, 4, 0, 0, 0) for z in (0, 3, 6)]
    for step in (0, 1):
        bricks = table([(*row[:-1], step) if row[1] == 6 else row for row in rows])
        moves, checked = found(Assembly(bricks, CATALOGUE))
        assert moves[-1] == (2, True, step)
        assert checked.buildable


def test_upside_down_order_is_told():
    """The upper brick first: nothing holds it, and the check says so."""
    rows, checked = found(tower(1, 0))
    assert rows == [(1, False, 0), (0, False, 1)]
    assert checked.in_air.tolist() == [1]
    assert not checked.buildable


def test_nothing_has_no_steps():
    """No bricks, no moves."""
    rows, checked = found(tower())
    assert rows == []
    assert checked.buildable


def plain(bricks):
    """Return the moves one by one: what has something below it before what is pressed, the lowest first."""
    cells, steps = cells_of(bricks), bricks.step.tolist()
    level = [min(z for *_, z in each) for each in cells]
    below = [{a for a in range(len(cells)) if shared_studs(cells[a], cells[b])} for b in range(len(cells))]
    above = [{b for b in range(len(cells)) if a in below[b]} for a in range(len(cells))]
    there, found = set(), []
    for number, step in enumerate(sorted(set(steps))):
        waiting = [row for row in range(len(cells)) if steps[row] == step]
        while waiting:
            ways = [(False, level[row], row) for row in waiting if level[row] == min(level) or below[row] & there]
            ways += [(True, level[row], row) for row in waiting if above[row] & there]
            ways += [(False, *min((level[row], row) for row in waiting))] * (not ways)
            pressed, _, row = min(ways)
            waiting.remove(row)
            there.add(row)
            found.append((row, pressed, number))
    return found


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_order_within_steps_is_that_of_plain_rules(seed):
    """Of heaps with steps at random, every move is chosen by looking at all bricks that are left."""
    bricks = heap(seed, most=16, size=(5, 5, 9))
    bricks = replace(bricks, step=np.random.default_rng(seed).choice([2, 5, 9], len(bricks)).astype(np.int32))
    assert found(Assembly(bricks, CATALOGUE))[0] == plain(bricks)
