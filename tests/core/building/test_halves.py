"""Halves of symmetric models are built in the same way."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.blocking import column_pairs, knots
from legorize_addon.core.building.halves import match_halves
from legorize_addon.core.building.mirror import mirror_images
from legorize_addon.core.building.order import steps_of
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.building.units import LARGEST, Units, find_units
from legorize_addon.core.model import NOBODY, Assembly, Role, components
from legorize_addon.core.model.contacts import contact_graph
from tests.core.standing import CATALOGUE, table

ARMS = (
    *(("3003", 0, 0, 3 * k) for k in range(16)),
    ("3008", -3, 0, 48),
    ("3008", -3, 1, 48),
    ("3023", -3, 0, 47, 1),
    ("3023", 4, 0, 47, 1),
    ("3023", -3, 0, 46, 1),
    ("3023", 4, 0, 46, 1),
)
"""A post with two beams; two plates hang below each end of them, one below the other."""


def found_units(bricks, ground):
    """Return the units of bricks, their images and contacts."""
    level = bricks.corner[:, 2].astype(np.int64)
    pairs = contact_graph(bricks, CATALOGUE).pairs
    units = find_units(np.arange(len(bricks)), level, pairs, column_pairs(bricks, CATALOGUE), ground=ground)
    return units, mirror_images(bricks, CATALOGUE), pairs


def plain_whole(unit, image):
    """Return sets of what must go on together, by growing each until nothing is added."""
    sets = [set(np.flatnonzero(unit == number).tolist()) for number in np.unique(unit)]
    while True:
        images = [{int(image[each]) for each in one if image[each] != NOBODY} for one in sets]
        for wanted in images:
            met = [one for one in sets if one & wanted]
            if len(met) > 1:
                sets = [one for one in sets if not one & wanted] + [set().union(*met)]
                break
        else:
            return sorted(map(sorted, sets))


@pytest.mark.parametrize("stands", [(), (22,), (22, 23)])
def test_the_other_half_goes_on_together_where_it_stands_on_supports(stands):
    """Plates that hang in one half and stand on a support in the other are one sub-assembly in both."""
    supports = (("3005", 4, 0, 43), ("3005", 4, 1, 43))[: len(stands)]
    bricks = table(*ARMS, *supports)
    ground = bricks.corner[:, 2] == 0
    ground[list(stands)] = True
    units, _, pairs = found_units(bricks, ground)
    model = np.arange(len(bricks)) < len(ARMS)
    image = np.full(len(bricks), NOBODY)
    image[model] = mirror_images(bricks.take(np.flatnonzero(model)), CATALOGUE)
    assert image[[18, 20]].tolist() == [19, 21]
    found = match_halves(units, image, pairs)
    assert [found.unit[18] == found.unit[20], found.unit[19] == found.unit[21]] in ([True, True], [False, False])
    assert (found.unit[18] == found.unit[16]) == (found.unit[19] == found.unit[16])


def test_units_of_asymmetric_models_stay():
    """Without images nothing changes."""
    units, _, pairs = found_units(table(*ARMS), table(*ARMS).corner[:, 2] == 0)
    found = match_halves(units, np.full(len(ARMS), NOBODY), pairs)
    assert np.unique(np.stack([found.unit, units.unit]), axis=1).shape[1] == len(np.unique(units.unit))
    assert len(np.unique(found.unit)) == len(np.unique(units.unit))


def plain(unit, before=(), pressed=()):
    """Return units with such numbers."""
    n = len(unit)
    return Units(
        np.array(unit, dtype=np.int64),
        np.isin(np.arange(n), pressed),
        np.zeros(n, dtype=bool),
        np.array(before, dtype=np.int32).reshape(-1, 2),
    )


def pairs_of(*pairs):
    """Return contacts."""
    return np.array(pairs, dtype=np.int32).reshape(-1, 2)


TWINS = np.array([2, 3, 0, 1, *[NOBODY] * 8])
"""Twelve bricks of which the first two are the images of the next two."""


@pytest.mark.parametrize(
    ("units", "pairs", "joined"),
    [
        (plain([0, 0, *range(1, 11)]), pairs_of((0, 1), (2, 3)), True),
        # the others do not touch
        (plain([0, 0, *range(1, 11)]), pairs_of((0, 1)), False),
        # one of the others is pressed from below
        (plain([0, 0, *range(1, 11)], pressed=[3]), pairs_of((0, 1), (2, 3)), False),
        # a brick between the others waits for one of them and is waited for by the other
        (plain([0, 0, *range(1, 11)], before=[(1, 3), (3, 2)]), pairs_of((0, 1), (2, 3)), False),
        # one waits for the other, that is all
        (plain([0, 0, *range(1, 11)], before=[(1, 2)]), pairs_of((0, 1), (2, 3)), True),
    ],
)
def test_images_go_on_together_where_they_can(units, pairs, joined):
    """They must hang together, come from above, and nothing may have to come between them."""
    found = match_halves(units, TWINS, pairs)
    assert (found.unit[2] == found.unit[3]) == joined
    assert found.unit[0] == found.unit[1]
    assert len(np.unique(found.unit)) == 11 - joined


def test_units_that_wait_for_each_other_already_end_nothing():
    """A knot that was there before is left to the check of the order."""
    found = match_halves(plain([0, 0, *range(1, 11)], before=[(9, 10), (10, 9)]), TWINS, pairs_of((0, 1), (2, 3)))
    assert found.unit[2] == found.unit[3]
    nothing = match_halves(plain([]), np.zeros(0, dtype=np.int64), pairs_of())
    assert len(nothing.unit) == 0


@pytest.mark.parametrize(("n", "joined"), [(8, True), (7, False)])
def test_what_becomes_one_is_no_larger_than_a_sub_assembly(n, joined):
    """A quarter of the bricks at most."""
    image = np.array([2, 3, 0, 1, *[NOBODY] * (n - 4)])
    found = match_halves(plain([0, 0, *range(1, n - 1)]), image, pairs_of((0, 1), (2, 3)))
    assert LARGEST == 0.25
    assert (found.unit[2] == found.unit[3]) == joined


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=60, deadline=None)
def test_joined_units_equal_a_plain_search(seed):
    """They are the plain closure, as far as it may be; no unit waits for itself, and halves are alike."""
    rng = np.random.default_rng(seed)
    half = 24
    image = np.concatenate([np.arange(half, 2 * half), np.arange(half)])
    image[rng.choice(2 * half, 4, replace=False)] = NOBODY
    image[(image != NOBODY) & (image[image] == NOBODY)] = NOBODY
    unit = np.unique(np.where(rng.random(2 * half) < 0.3, rng.integers(0, 6, 2 * half), np.arange(6, 6 + 2 * half)),
                     return_inverse=True)[1]  # fmt: skip
    n = int(unit.max()) + 1
    before = np.sort(rng.integers(0, n, (12, 2)), axis=1)
    units = plain(unit, before[before[:, 0] < before[:, 1]])
    pairs = rng.integers(0, 2 * half, (160, 2)).astype(np.int32)
    found = match_halves(units, image, pairs)
    whole = plain_whole(unit, image)
    for number in np.unique(found.unit):
        rows = np.flatnonzero(found.unit == number)
        old = np.unique(unit[rows])
        if len(old) > 1:
            assert rows.tolist() in whole
            assert len(rows) <= LARGEST * 2 * half
            assert len(np.unique(components(pairs[np.isin(pairs, rows).all(axis=1)], 2 * half)[rows])) == 1
    m = int(found.unit.max()) + 1
    assert len(np.unique(knots(found.before, m))) == m


def test_a_symmetric_model_with_uneven_supports_is_built_alike():
    """The plates below both ends of a beam come in sub-assemblies of one size, though one of them has a support."""
    bricks = table(*ARMS, *(("3005", 4, 0, 3 * k + 1) for k in range(15)), ("3024", 4, 0, 0))
    bricks.role[len(ARMS) :] = Role.SUPPORT_OUTSIDE
    steps = steps_of(Assembly(bricks, CATALOGUE))
    owner = steps.submodel_of(len(bricks))
    kinds = [steps.submodels[each].kind for each in owner[[18, 19, 20, 21]].tolist()]
    assert kinds == [Kind.SUBASSEMBLY] * 4
    step = steps.moves.step_of(len(bricks))
    assert abs(int(step[20]) - int(step[21])) <= 1
