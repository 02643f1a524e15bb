"""Steps that hands can follow."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.grouping import (
    ASIDE,
    FEW,
    HIGHER,
    LAYER,
    LOTS,
    MANY,
    NEW_LOT,
    SOON,
    WAITS,
    _Grouping,
    group,
)
from legorize_addon.core.building.items import MOST, REACH, TILE_MOST, Atoms, Items, span
from legorize_addon.core.building.tiles import tiles_of
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.progress import silent


def items(box, level, *, lot=None, image=None, temporary=None, tile=None, size=None, due=None):
    """Return items of given places, all alike where nothing else is said."""
    n = len(level)
    return Items(
        box=np.array(box, np.int64).reshape(-1, 4),
        level=np.array(level, np.int64),
        due=np.array(level if due is None else due, np.int64),
        size=np.ones(n, np.int64) if size is None else np.array(size, np.int64),
        lot=np.zeros(n, np.int64) if lot is None else np.array(lot, np.int64),
        temporary=np.zeros(n, bool) if temporary is None else np.array(temporary, bool),
        image=np.full(n, NOBODY) if image is None else np.array(image, np.int64),
        tile=np.zeros(n, np.int64) if tile is None else tile,
    )


def floor(wide, deep, side=2):
    """Return the boxes of square parts that cover a floor."""
    y, x = (each.ravel() * side for each in np.meshgrid(np.arange(deep), np.arange(wide), indexing="ij"))
    return np.stack([x, x + side - 1, y, y + side - 1], axis=1)


NONE = np.zeros((0, 2), np.int32)


def test_a_large_layer_is_laid_in_small_steps_near_each_other():
    """A floor of 24 x 16 parts is laid in steps of five to ten, none wider than 16 studs."""
    box = floor(24, 16)
    found = group(items(box, np.zeros(len(box))), NONE)
    sizes = np.array([len(step) for step in found])
    assert sorted(item for step in found for item in step) == list(range(len(box)))
    assert np.mean((sizes >= FEW) & (sizes <= MANY)) > 0.9
    assert sizes.min() > 1
    assert max(span(box[step]) for step in found) <= REACH


def test_of_two_at_once_a_step_has_half():
    """Where two equal floors are laid together, a step has at most six bricks of each."""
    box = floor(24, 16)
    sizes = [len(step) for step in group(items(box, np.zeros(len(box))), NONE, copies=2)]
    assert sum(sizes) == len(box)
    assert max(sizes) <= MOST // 2
    assert np.mean(np.array(sizes) >= FEW) > 0.9


def test_few_kinds_in_a_step():
    """Of parts in 40 kinds spread at random, a step holds few."""
    rng = np.random.default_rng(2)
    box = floor(20, 20)
    lot = rng.integers(0, 40, len(box))
    found = group(items(box, np.zeros(len(box)), lot=lot), NONE)
    assert np.median([len(set(lot[step].tolist())) for step in found]) <= LOTS


def test_order_is_kept():
    """Each item comes after those that must be before it, within a step and from step to step."""
    box = np.concatenate([floor(6, 6)] * 5)
    level = np.repeat(np.arange(5) * 3, 36)
    before = np.array([[36 * z + k, 36 * (z + 1) + k] for z in range(4) for k in range(36)], np.int32)
    found = [item for step in group(items(box, level), before) for item in step]
    turn = np.argsort(found)
    assert (turn[before[:, 0]] < turn[before[:, 1]]).all()


def test_mirrored_parts_come_together_or_one_after_the_other():
    """Near ones share a step; far ones are built in steps that follow each other."""
    left = floor(6, 4)
    right = left.copy()
    for gap in (2, 30):
        right[:, :2] = 22 + gap - left[:, 1::-1]
        box = np.concatenate([left, right])
        image = np.concatenate([np.arange(24) + 24, np.arange(24)])
        found = group(items(box, np.zeros(48), image=image), NONE)
        step_of = np.zeros(48, int)
        for number, step in enumerate(found):
            step_of[step] = number
        apart = np.abs(step_of - step_of[image])
        assert (apart <= 1).mean() >= 0.9
        assert max(map(len, found)) <= MOST


def test_supports_and_bricks_are_not_mixed():
    """Supports have steps of their own where there are enough of them."""
    box = floor(6, 4)
    temporary = np.arange(24) % 2 == 0
    for step in group(items(box, np.zeros(24), temporary=temporary), NONE):
        assert len(set(temporary[step].tolist())) == 1


def test_supports_come_when_they_are_wanted():
    """A support under a high brick waits until the bricks up to there are laid; one under a low brick comes first."""
    beside = floor(5, 1) + np.array([0, 0, 9, 9])
    box = np.concatenate([floor(6, 2), floor(6, 2), beside, beside])
    level = np.array([0] * 12 + [3] * 12 + [0] * 10)
    found = group(items(box, level, temporary=np.arange(34) >= 24, due=[*level[:24], *[0] * 5, *[9] * 5]), NONE)
    first = {item: number for number, step in enumerate(found) for item in step}
    assert max(first[item] for item in range(24, 29)) == 0
    assert min(first[item] for item in range(29, 34)) > max(first[item] for item in range(12))


def test_a_brick_left_alone_moves_to_others():
    """A single part of a kind at the edge is put with its neighbours, not into a picture of its own."""
    box = floor(11, 1)
    lot = np.zeros(11)
    lot[-1] = 1
    assert min(map(len, group(items(box, np.zeros(11), lot=lot), NONE))) > 1


def test_mosaics_go_tile_by_tile():
    """A picture of 48 x 32 studs is laid in steps of 16 within its tiles, one tile after the other."""
    box = floor(48, 32, side=1)
    level = np.zeros(len(box), np.int64)
    tile = tiles_of(box, level)
    found = group(items(box, level, tile=tile), NONE)
    assert {len(step) for step in found} == {TILE_MOST}
    order = [set(tile[step].tolist()) for step in found]
    assert all(len(each) == 1 for each in order)
    assert [min(each) for each in order] == sorted(min(each) for each in order)


def test_what_rests_on_images_follows_in_their_step():
    """Of two stacks that mirror each other far apart, steps follow each other; the last two bricks are one."""
    box = np.repeat([[0, 1, 0, 1], [60, 61, 0, 1]], 5, axis=0)
    level = np.tile(np.arange(5) * 2, 2)
    before = np.array([(k, k + 1) for k in (0, 1, 2, 3, 5, 6, 7, 8)], np.int32)
    found = group(items(box, level, image=(np.arange(10) + 5) % 10), before)
    assert found == [[0, 1, 2, 3], [5, 6, 7, 8], [4, 9]]


def test_what_has_an_image_waits_until_that_can_be_built():
    """Of two mirrored towers far apart, the right one needs a base first: the left one is not begun before."""
    tower = [[x, x + 1, 0, 1] for x in (0, 2, 4, 6, 8)]
    box = [
        *tower,
        *([99 - x1, 99 - x0, *y] for x0, x1, *y in tower),
        *([40 + 2 * k, 41 + 2 * k, 0, 1] for k in range(5)),
    ]
    image = [*range(5, 10), *range(5), *[NOBODY] * 5]
    before = np.array([(14, k) for k in range(5, 10)], np.int32)
    found = group(items(box, np.zeros(15), image=image), before)
    assert list(map(sorted, found)) == [list(range(10, 15)), list(range(5)), list(range(5, 10))]


def test_nothing_gives_no_steps():
    """No items, no steps."""
    assert group(items([], []), NONE) == []


@settings(deadline=None, max_examples=80)
@given(st.integers(0, 10**6))
def test_all_items_once_in_an_order_that_holds(seed):
    """Whatever comes, every item is in one step, within the limits, and after all that must be before it."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 60))
    low = rng.integers(0, 40, (n, 2))
    high = low + rng.integers(0, 6, (n, 2))
    box = np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1)
    level = rng.integers(0, 5, n) * 3
    pairs = rng.integers(0, n, (2 * n, 2))
    before = pairs[level[pairs[:, 0]] < level[pairs[:, 1]]].astype(np.int32)
    made = items(box, level, lot=rng.integers(0, 9, n), temporary=rng.random(n) < 0.2)
    found = group(made, before)
    flat = [item for step in found for item in step]
    assert sorted(flat) == list(range(n))
    turn = np.argsort(flat)
    assert (turn[before[:, 0]] < turn[before[:, 1]]).all()
    assert max(map(len, found)) <= MOST
    assert max(span(box[step]) for step in found) <= REACH


class Plain:
    """The rules of steps in plain words: one part after the other, one pair of studs after the other."""

    def __init__(self, atoms):
        self.a, self.done, self.found, self.last = atoms, set(), [], None

    def steps(self):
        """Return the steps before the small ones are given up."""
        while len(self.done) < len(self.a):
            step = self.filled([self.seed()], MANY)
            images = []
            for image in self.a.image[step].tolist():
                if image not in {NOBODY, *self.done} and self.done.union(images).issuperset(self.a.below[image]):
                    images += [image] if self.room([*images, image]) else []
            if images:
                self.filled(images, FEW, unpaired=True)
        return self.found

    def room(self, step):
        """Tell whether a picture shows so much."""
        return sum(self.a.size[step]) <= self.a.most and span(self.a.box[step]) <= REACH

    def ready(self):
        """Return what may be next."""
        return [k for k in range(len(self.a)) if k not in self.done and self.done.issuperset(self.a.below[k])]

    def middle(self, k):
        """Return twice the middle of a part."""
        x0, x1, y0, y1 = self.a.box[k].tolist()
        return x0 + x1, y0 + y1

    def seed(self):
        """Return what a step begins with."""
        a, left = self.a, [k for k in range(len(self.a)) if k not in self.done]
        ready = self.ready() or [min(left, key=lambda k: a.level[k])]
        due = min(a.due[k] for k in ready)

        def order(k):
            way = self.last and max(abs(p - q) for p, q in zip(self.middle(k), self.last, strict=True))
            return not a.temporary[k], a.tile[k], self.waits(k), way, sum(self.middle(k)), k

        return min((k for k in ready if a.due[k] == due), key=order)

    def waits(self, k, images=frozenset()):
        """Tell whether the image of a part has to wait for others than those and what is done."""
        image = int(self.a.image[k])
        return image not in {NOBODY, *self.done} and not (self.done | images).issuperset(self.a.below[image])

    def filled(self, begun, enough, *, unpaired=False):
        """Fill a step."""
        a, step = self.a, list(begun)
        self.done |= set(begun)
        enough = a.most if a.tile[step[0]] else enough
        while sum(a.size[step]) < enough:
            costs = {k: self.cost(k, step, unpaired) for k in self.ready()}
            best = min(costs, key=costs.get, default=None)
            if best is None or costs[best] == np.inf:
                break
            step.append(best)
            self.done.add(best)
        self.found.append(step)
        self.last = tuple(sum(each) / len(step) for each in zip(*map(self.middle, step), strict=True))
        return step

    def cost(self, k, step, unpaired):
        """Return how far a part is from belonging to a step, infinite if it does not."""
        a, first, size = self.a, step[0], sum(self.a.size[step])
        higher, image = abs(a.level[k] - a.level[first]), int(a.image[k])
        fits = span(a.box[[*step, k]]) <= REACH and size + a.size[k] <= a.most
        fits = fits and all(a.image[each] != k for each in step) and not (unpaired and image != NOBODY)
        fits = fits and a.tile[k] == a.tile[first] and a.temporary[k] == a.temporary[first]
        layers = LAYER - 1 if size >= FEW else 2 * LAYER if size > 1 else 3 * LAYER
        fits = fits and (a.due[k] <= a.due[first] + SOON if a.temporary[first] else higher <= layers)
        near = min(max(studs_between(a.box[k], a.box[each])) for each in step)
        lots = {a.lot[each] for each in step}
        new = a.lot[k] not in lots
        waits = self.waits(k, {a.image[each] for each in step})
        if not fits or (size >= FEW and (near > ASIDE or waits or (new and len(lots) >= LOTS))):
            return np.inf
        return near + NEW_LOT * new + HIGHER * (not a.temporary[first]) * higher + WAITS * waits


def studs_between(one, other):
    """Return how many studs are between two boxes, in x and in y."""
    for low, high in ((0, 1), (2, 3)):
        squares = [range(each[low], each[high] + 1) for each in (one, other)]
        yield max(min(abs(p - q) for p in squares[0] for q in squares[1]) - 1, 0)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10**6))
def test_steps_are_those_of_the_plain_rules(seed):
    """Small parts and large ones, with images, supports, tiles, and some that each wait for the other."""
    rng = np.random.default_rng(seed)
    n, wide = int(rng.integers(1, 26)), int(rng.choice([8, 20, 40]))
    low = rng.integers(0, wide, (n, 2))
    high = low + rng.integers(0, 5, (n, 2))
    image = np.full(n, NOBODY)
    for one, other in rng.permutation(n)[: n // 2 * 2].reshape(-1, 2):
        if rng.random() < 0.4:
            image[[one, other]] = other, one
    level = rng.integers(0, 4, n) * rng.choice([1, 3])
    pairs = rng.integers(0, n, (n, 2))
    before = pairs[(level[pairs[:, 0]] < level[pairs[:, 1]]) | (rng.random(n) < 0.05)]
    made = items(
        np.stack([low[:, 0], high[:, 0], low[:, 1], high[:, 1]], axis=1),
        level,
        lot=rng.integers(0, rng.choice([1, 3, 12]), n),
        image=image,
        temporary=rng.random(n) < rng.choice([0, 0.4]),
        tile=rng.integers(0, 3, n) * rng.integers(0, 2),
        size=rng.choice([1, 1, 1, 2, 5], n),
        due=level + rng.integers(0, 9, n),
    )
    atoms = Atoms(made, before.astype(np.int32))
    grouping = _Grouping(atoms, MANY)
    grouping.steps(silent)
    assert grouping.found == Plain(atoms).steps()


def first_step(places, **columns):
    """Return the first step of parts of one stud, given where they lie in x."""
    x = np.array(places)
    made = items(np.stack([x, x, 0 * x, 0 * x], axis=1), columns.pop("level", 0 * x), **columns)
    grouping = _Grouping(Atoms(made, NONE), MANY)
    grouping.steps(silent)
    return grouping.found[0]


def test_a_step_has_ten_bricks_of_six_kinds():
    """Of one kind there are ten; of kinds that all differ, six."""
    assert first_step(range(15)) == list(range(10))
    assert first_step(range(15), lot=range(15)) == list(range(6))


@pytest.mark.parametrize(("gap", "taken"), [(5, True), (6, False)])
def test_with_five_bricks_a_step_reaches_five_studs_on(gap, taken):
    """What is farther belongs to another step, though a picture of four bricks would take it."""
    assert (5 in first_step([0, 1, 2, 3, 4, 5 + gap])) == taken
    assert 4 in first_step([0, 1, 2, 3, 4 + gap])


@pytest.mark.parametrize(
    ("studs", "other", "nearer"),
    [
        (2, {"lot": [0, 1, 0]}, True),
        (4, {"lot": [0, 1, 0]}, False),
        (1, {"level": [0, 1, 0]}, True),
        (2, {"level": [0, 1, 0]}, False),
        (5, {"image": [NOBODY, 3, NOBODY, 1]}, True),
        (7, {"image": [NOBODY, 3, NOBODY, 1]}, False),
    ],
    ids=["kind near", "kind far", "level near", "level far", "image near", "image far"],
)
def test_what_a_new_kind_a_plate_and_an_image_are_worth(studs, other, nearer):
    """A part of a new kind beside the first costs 3 studs of way, one a plate higher 1.5, one whose image waits 6."""
    places = [0, 1, 1 + studs] + [40] * ("image" in other)
    columns = dict(other)
    if "image" in other:
        # the image is ready when what is far away is in place
        columns["level"] = [0, 0, 0, 0]
        atoms = Atoms(items([[x, x, 0, 0] for x in (*places, 60)], [0] * 5, image=[*other["image"], NOBODY]),
                      np.array([[4, 3]], np.int32))  # fmt: skip
        grouping = _Grouping(atoms, MANY)
        grouping.steps(silent)
        found = grouping.found[0]
    else:
        found = first_step(places, **columns)
    assert found[1] == (2 if nearer else 1)


@pytest.mark.parametrize(("n", "high"), [(1, 9), (2, 6), (4, 6), (5, 2)])
def test_layers_of_a_step(n, high):
    """The more bricks a step has, the less they differ in height: 9 plates beside one brick, 6, then 2 from five on."""
    for more, taken in ((high, True), (high + 1, False)):
        assert (n in first_step(range(n + 1), level=[0] * n + [more])) == taken


def test_supports_for_six_plates_ahead_are_built_together():
    """One that is wanted a plate later than that comes later."""
    found = first_step(range(3), temporary=[True] * 3, level=[0] * 3, due=[1, 7, 8])
    assert found == [0, 1]
