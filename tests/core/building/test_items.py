"""What is put on in a step, and in which order."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.items import MOST, REACH, TILE_MOST, Atoms, Items, in_turn, span
from legorize_addon.core.model.bricks import NOBODY

NONE = np.zeros((0, 2), np.int32)


def pair(gap, *, level=(0, 0), tile=(0, 0)):
    """Return two mirrored items, some studs apart."""
    return Items(
        box=np.array([[0, 1, 0, 1], [2 + gap, 3 + gap, 0, 1]], np.int64),
        level=np.array(level, np.int64),
        due=np.array(level, np.int64),
        size=np.ones(2, np.int64),
        lot=np.zeros(2, np.int64),
        temporary=np.zeros(2, bool),
        image=np.array([1, 0], np.int64),
        tile=np.array(tile, np.int64),
    )


def test_span_is_the_longer_side():
    """Studs from the first to the last square."""
    assert span(np.array([[0, 3, 0, 1], [5, 6, -2, 0]])) == 7


def test_mirrored_parts_in_one_picture_are_one_atom():
    """Up to 16 studs they are put on together; then each knows its image."""
    near, far = Atoms(pair(12), NONE), Atoms(pair(13), NONE)
    assert near.members == [[0, 1]]
    assert near.size.tolist() == [2]
    assert near.box.tolist() == [[0, 15, 0, 1]]
    assert near.image.tolist() == [NOBODY]
    assert far.members == [[0], [1]]
    assert far.image.tolist() == [1, 0]


@pytest.mark.parametrize("apart", [{"level": (0, 3)}, {"tile": (1, 2)}])
def test_levels_and_tiles_are_kept_apart(apart):
    """Mirrored parts of two levels or tiles stay two atoms."""
    assert len(Atoms(pair(2, **apart), NONE)) == 2


def test_limit_of_a_mosaic_is_higher():
    """Tiles have room for more bricks a step."""
    assert Atoms(pair(2), NONE).most == MOST
    assert Atoms(pair(2, tile=(1, 1)), NONE).most == TILE_MOST


def test_lowest_first_unless_something_waits():
    """The order of a step goes by level and place, and never against what must come before."""
    box = np.array([[4, 4, 0, 0], [0, 0, 0, 0], [2, 2, 0, 0]])
    level = np.array([0, 0, 3])
    assert in_turn([2, 1, 0], [[], [], []], box, level) == [1, 0, 2]
    assert in_turn([2, 1, 0], [[], [2], []], box, level) == [0, 2, 1]


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_atoms_are_pairs_that_lie_in_one_picture(seed):
    """Each two items that are images of each other are looked at: places, levels, tiles and numbers of bricks."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 12))
    low = rng.integers(0, [24, 24], (n, 2)) // rng.choice([1, 3], 2)
    image = np.full(n, NOBODY)
    for one, other in rng.permutation(n)[: n // 2 * 2].reshape(-1, 2):
        image[[one, other]] = other, one
    level, size, tile = rng.integers(0, 2, n) // 2 * 3, rng.choice([1, 1, 1, 2], n), rng.integers(0, 2, n) // 2
    level[0] = tile[-1] = 1
    box = np.stack([low[:, 0], low[:, 0] + 2, low[:, 1], low[:, 1] + 1], axis=1)
    lot, temporary = np.zeros(n, np.int64), np.zeros(n, bool)
    pairs = np.sort(rng.integers(0, n, (n, 2)), axis=1)
    before = pairs[pairs[:, 0] < pairs[:, 1]]
    atoms = Atoms(Items(box, level, level, size, lot, temporary, image, tile), before.astype(np.int32))
    expected = set()
    for one, other in enumerate(image.tolist()):
        both = [one, other]
        near = other != NOBODY and span(box[both]) <= REACH and max(size[both]) == 1
        joined = near and level[one] == level[other] and tile[one] == tile[other]
        expected.add(tuple(sorted(both)) if joined else (one,))
    assert {tuple(each) for each in atoms.members} == expected
    number = {item: k for k, each in enumerate(atoms.members) for item in each}
    for k, each in enumerate(atoms.members):
        own = box[each]
        assert atoms.box[k].tolist() == [own[:, 0].min(), own[:, 1].max(), own[:, 2].min(), own[:, 3].max()]
        assert atoms.size[k] == size[each].sum()
        alone = len(each) == 2 or image[each[0]] == NOBODY
        assert atoms.image[k] == (NOBODY if alone else number[int(image[each[0]])])
    links = {(number[one], number[other]) for one, other in before.tolist()}
    links = {link for link in links if link[0] != link[1]}
    assert {(below, k) for k in range(len(atoms)) for below in atoms.below[k]} == links


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_a_step_is_in_the_first_of_all_orders_that_hold(seed):
    """Of all orders in which nothing comes before what it waits for, the one whose lowest parts come soonest."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 6))
    corner = rng.permutation(25)[:n]
    box = np.stack([corner % 5, corner % 5, corner // 5, corner // 5], axis=1)
    level = rng.integers(0, 3, n)
    rank = {part: k for k, part in enumerate(rng.permutation(n).tolist())}
    below = [[other for other in range(n) if rank[other] < rank[part] and rng.random() < 0.4] for part in range(n)]
    holding = [
        order
        for order in permutations(range(n))
        if all(set(order[:k]).issuperset(below[part]) for k, part in enumerate(order))
    ]
    first = min(holding, key=lambda order: [(level[part], *box[part].tolist()) for part in order])
    assert in_turn(rng.permutation(n).tolist(), below, box, level) == list(first)
