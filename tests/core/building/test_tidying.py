"""Steps that are too small are given up."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.items import REACH, Atoms, Items, in_turn, span
from legorize_addon.core.building.tidying import Tidying
from legorize_addon.core.model.bricks import NOBODY
from tests.core.building.test_grouping import NONE, items


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
    """Parts 20 studs away are no help."""
    assert Tidying(row(18), [list(range(4)), [17], list(range(4, 8))]).steps()[1] == [17]


def test_a_neighbour_comes_where_steps_are_full():
    """What is alone beside a full step gets the first of its parts that is near, but not its only one."""
    assert Tidying(row(18), [list(range(4)), [17], list(range(4, 17))]).steps()[1] == [10, 17]
    full = items([[0, 1, 0, 0], [2, 3, 0, 0]], [0, 0], size=[1, 12])
    assert Tidying(Atoms(full, NONE), [[0], [1]]).steps() == [[0], [1]]


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


def plain(atoms, found):
    """Give up steps of one brick, then of two, then of three: all parts of a step move, or none."""
    found = [list(step) for step in found]

    def number(atom):
        return next(k for k, step in enumerate(found) if atom in step)

    def may_move(atom, k):
        step, image = [*found[k], atom], atoms.image[atom]
        in_order = all(number(each) <= k for each in atoms.below[atom])
        in_order = in_order and all(number(each) >= k for each in atoms.above[atom])
        beside = image == NOBODY or abs(number(image) - k) <= 1
        room = sum(atoms.size[step]) <= atoms.most and span(atoms.box[step]) <= REACH
        return in_order and beside and room and len(set(atoms.tile[step].tolist())) == 1

    def from_near(own):
        for far in range(1, len(found)):
            yield from (k for k in (own - far, own + far) if 0 <= k < len(found) and found[k])

    def target(atom, own):
        return next((k for k in from_near(own) if may_move(atom, k)), None)

    for few in (1, 2, 3):
        for own in range(len(found)):
            if not 1 <= sum(atoms.size[found[own]]) <= few:
                continue
            kept = [list(step) for step in found]
            for atom in kept[own]:
                to = target(atom, own)
                if to is None:
                    found[:] = kept
                    break
                found[own].remove(atom)
                found[to].append(atom)
    for own in range(len(found)):
        if len(found[own]) == 1:
            [atom] = found[own]
            image = int(atoms.image[atom])
            if image != NOBODY and atoms.size[atom] == atoms.size[image] == 1 and [image] in found:
                to = number(image)
                in_order = all(number(each) <= to for each in atoms.below[atom])
                in_order = in_order and all(number(each) >= to for each in atoms.above[atom])
                if in_order and atoms.tile[atom] == atoms.tile[image]:
                    found[own].remove(atom)
                    found[to].append(atom)
    for own in range(len(found)):
        if sum(atoms.size[found[own]]) == 1:
            more = [(atom, k) for k in from_near(own) for atom in found[k] if may_move(atom, own)]
            for atom, k in [each for each in more if sum(atoms.size[found[each[1]]]) > atoms.size[each[0]] + 1][:1]:
                found[k].remove(atom)
                found[own].append(atom)
    return [set(step) for step in found if step]


@settings(deadline=None, max_examples=150)
@given(st.integers(0, 10**6))
def test_small_steps_are_given_up_by_the_plain_rules(seed):
    """Whatever the places, sizes, tiles, images and the order: the steps are those of the rules written out."""
    rng = np.random.default_rng(seed)
    n, n_steps = int(rng.integers(2, 16)), int(rng.integers(2, 8))
    step = np.sort(rng.integers(0, n_steps, n))
    low = rng.integers(0, rng.choice([4, 14, 20]), (n, 2))
    image = np.full(n, NOBODY)
    for one, other in rng.permutation(n)[: n // 2 * 2].reshape(-1, 2):
        if rng.random() < 0.3:
            image[[one, other]] = other, one
    level = rng.integers(0, 9, n)
    pairs = np.sort(rng.integers(0, n, (n // 2, 2)), axis=1)
    made = Items(
        box=np.stack([low[:, 0], low[:, 0] + 2, low[:, 1], low[:, 1] + 1], axis=1),
        level=level,
        due=level,
        size=rng.choice([1, 1, 2, 4], n),
        lot=np.zeros(n, np.int64),
        temporary=np.zeros(n, bool),
        image=image,
        tile=rng.integers(0, 2, n) * rng.integers(0, 2),
    )
    atoms = Atoms(made, pairs[pairs[:, 0] < pairs[:, 1]].astype(np.int32))
    step_of = np.array([step[members[0]] for members in atoms.members])
    begun = [np.flatnonzero(step_of == k).tolist() for k in range(n_steps)]
    found = Tidying(atoms, [each for each in begun if each]).steps()
    assert [set(each) for each in found] == plain(atoms, [each for each in begun if each])
    assert found == [in_turn(each, atoms.below, atoms.box, atoms.level) for each in found]


def test_lonely_bricks_join_their_image():
    """Two mirrored bricks far apart become one step if both are alone and the order lets them, and else stay two."""
    box = [[0, 1, 0, 1], [60, 61, 0, 1], [30, 31, 30, 31]]
    lonely = items(box, [0, 0, 3], image=[1, 0, NOBODY])
    assert sorted(map(sorted, Tidying(Atoms(lonely, NONE), [[0], [1], [2]]).steps())) == [[0, 1], [2]]
    assert Tidying(Atoms(lonely, np.array([[0, 2], [2, 1]], np.int32)), [[0], [2], [1]]).steps() == [[0], [2], [1]]
    unlike = items(box, [0, 0, 3])
    assert Tidying(Atoms(unlike, NONE), [[0], [1], [2]]).steps() == [[0], [1], [2]]
