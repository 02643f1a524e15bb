"""Where components could be joined, and what that costs."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.geometry import outer_air
from legorize_addon.core.layout.joining import contacts
from legorize_addon.core.layout.joining.contacts import RECOLOURED, near_contacts
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from tests.core.layout.cells import RED, WHITE


def found_in(owner, colour=RED, component=None, *, plates=True):
    """Return the contacts of bricks given by the planes that they own, each a component unless said otherwise."""
    owner = np.pad(np.asarray(owner, np.int32), ((1, 1), (0, 0), (0, 0)), constant_values=NOBODY)
    component = np.arange(owner.max() + 1, dtype=np.int32) if component is None else np.asarray(component, np.int32)
    colour = np.where(owner == NOBODY, COLOUR_EMPTY, np.asarray(colour)).astype(np.int16)
    return near_contacts(owner, component, colour, plates=plates)


def test_neighbours_of_one_colour_are_joined_for_nothing():
    """Two bricks side by side meet in their middle plate, at less than any price."""
    found = found_in(np.tile([[0, 1]], (3, 1, 1)))
    cut = found.added == 0
    assert cut.sum() == 1
    np.testing.assert_array_equal(found.place[cut], [[2, 0, 0]])
    assert found.price[cut] < 0
    assert found.axis[cut] == 2
    np.testing.assert_array_equal(found.bricks[cut], [[0, 1]])


def test_colours_cost_and_free_ones_do_not():
    """Two colours cost more than one; a cell of any colour agrees with both."""
    owner = np.tile([[0, 1]], (3, 1, 1))
    same, differ, free = (
        found_in(owner, np.array([[[RED, other]]]), plates=False).price for other in (RED, WHITE, COLOUR_ANY)
    )
    assert same == free
    assert differ > same + 1


def test_one_component_has_no_contacts():
    """What holds together already is not joined again."""
    assert len(found_in(np.tile([[0, 1]], (3, 1, 1)), component=[0, 0]).price) == 0


def test_edges_are_joined_by_an_added_cell():
    """Bricks that meet at an edge alone are joined in the empty cell beside one and below the other."""
    owner = np.full((6, 1, 2), NOBODY)
    owner[:3, 0, 0], owner[3:, 0, 1] = 0, 1
    found = found_in(owner)
    assert set(found.added) == {1}
    # below the upper one is cheaper than on top of the lower one
    np.testing.assert_array_equal(found.place, [[3, 0, 0], [4, 0, 0]])
    assert len(found_in(owner, plates=False).price) == 0


def test_hidden_places_are_cheaper():
    """Inside a closed box a cell costs less than outside."""
    owner = np.zeros((7, 5, 5), dtype=np.int64)
    owner[1:6, 1:4, 1:4] = NOBODY
    owner[1:3, 2, 2] = 1
    component = [0, 1]
    inside = found_in(owner, component=component)
    # the box stands on the brick inside, so that only empty cells separate them
    assert inside.price.min() < 1
    opened = owner.copy()
    opened[5:, 1:4, 1:4] = NOBODY
    assert found_in(opened, component=component).price.min() > inside.price.min()


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_nothing_is_added_below_the_ground(seed):
    """Empty planes of the grid below a model are no place for plates: the contacts are those of the model alone."""
    owner = np.random.default_rng(seed).choice([NOBODY, NOBODY, 0, 1, 2, 3], (4, 3, 4))
    owner[0, 0] = np.arange(4)
    alone, lifted = found_in(owner), found_in(np.pad(owner, ((3, 0), (0, 0), (0, 0)), constant_values=NOBODY))
    np.testing.assert_array_equal(lifted.place, alone.place + np.array([3, 0, 0]))
    np.testing.assert_array_equal(lifted.price, alone.price)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_places_lie_between_components(seed):
    """Every place has bricks of two components, cells inside the model, and comes after cheaper ones."""
    rng = np.random.default_rng(seed)
    owner = rng.choice([NOBODY, NOBODY, 0, 1, 2, 3], (6, 4, 5))
    owner[0, 0, :4] = np.arange(4)
    component = rng.integers(0, 3, 4)
    found = found_in(owner, component=component)
    assert (component[found.bricks[:, 0]] != component[found.bricks[:, 1]]).all()
    assert (np.diff(found.price) >= 0).all()
    end = found.place.copy()
    end[np.arange(len(end)), found.axis] += 1
    planes = np.pad(owner, ((1, 1), (0, 0), (0, 0)), constant_values=NOBODY)
    assert (end < planes.shape).all()
    empty = (planes[tuple(found.place.T)] == NOBODY).astype(int) + (planes[tuple(end.T)] == NOBODY)
    np.testing.assert_array_equal(empty, found.added)


def plain(owner, component, colour, places):
    """Look at each two cells side by side, one after the other, and sort what is found there."""
    size, solid, air = owner.shape, owner != NOBODY, outer_air(owner != NOBODY)
    ground = np.flatnonzero(solid.any(axis=(1, 2)))[0]

    def at(z, y, x):
        inside = all(0 <= each < most for each, most in zip((z, y, x), size, strict=True))
        return int(owner[z, y, x]) if inside else NOBODY

    stacked = set()
    for z, y, x in product(*map(range, size)):
        if NOBODY not in (at(z, y, x), at(z + 1, y, x)) and at(z, y, x) != at(z + 1, y, x):
            stacked |= {at(z, y, x), at(z + 1, y, x)}
    alone = {int(colour[cell]) for cell in zip(*np.nonzero(solid), strict=True) if at(*cell) not in stacked}
    if len(alone - {COLOUR_ANY}) <= 1:
        stacked = set(range(owner.max() + 1))

    def recoloured(z, y, x):
        around = [(z - 1, y, x), (z + 1, y, x), (z, y - 1, x), (z, y + 1, x), (z, y, x - 1), (z, y, x + 1)]
        return RECOLOURED + contacts._OPEN_FACE * [at(*cell) for cell in around].count(NOBODY)

    def reach(z, y, x):
        if solid[z, y, x]:
            return [(at(z, y, x), 0.0, 0, 0)]
        price = contacts._SEEN if air[z, y, x] else contacts._HIDDEN
        allowed = ground <= z < size[0] - 1
        below, above = (at(z - 1, y, x), price * contacts._ON_TOP, 1, 1), (at(z + 1, y, x), price, 1, 0)
        return [each for each in (above, below) if allowed and each[0] != NOBODY]

    seams = {}
    for axis, (z, y, x) in product((1, 2), product(*map(range, size))):
        one, other = (z, y, x), (z, y + (axis == 1), x + (axis == 2))
        for a, b in product(reach(*one), reach(*other) if other[axis] < size[axis] else ()):
            flat = not {a[0], b[0]} & stacked
            if component[a[0]] != component[b[0]] and not (flat and (a[3] or b[3])):
                colours = {int(colour[one]), int(colour[other])} - {COLOUR_ANY}
                change = min(recoloured(*one), recoloured(*other)) if len(colours) > 1 and not a[2] + b[2] else 0.0
                seam = (*sorted((a[0], b[0])), a[2] + b[2], a[3] + b[3])
                rank = a[1] + b[1] + change, abs((z - 1) % 3 - 1), z, y, x, axis
                seams.setdefault(seam, []).append((rank, (a[0], b[0])))
    found = {}
    for seam, cells in sorted(seams.items()):
        (price, _, z, y, x, axis), bricks = min(cells)
        price -= contacts._SEAM * min(len(cells), contacts._LONGEST)
        pair = tuple(sorted((int(component[bricks[0]]), int(component[bricks[1]]))))
        found.setdefault(pair, []).append((price, seam, [z, y, x], axis, seam[2], seam[3], list(bricks)))
    return sorted((each for of_pair in found.values() for each in sorted(of_pair)[:places]), key=lambda each: each[:2])


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_places_are_those_found_by_looking_at_each_two_cells(seed):
    """Bricks of any form, in one colour, in some or in black; with many places for two components or with few."""
    rng = np.random.default_rng(seed)
    owner = rng.choice([NOBODY, NOBODY, NOBODY, 0, 1, 2, 3, 4], (int(rng.integers(1, 6)), 3, 4))
    owner[rng.integers(len(owner)), 0, 0] = 0
    owner = np.pad(owner, ((1 + rng.integers(2), 1), (0, 0), (0, 0)), constant_values=NOBODY)
    known, owner = np.unique(owner, return_inverse=True)
    owner = (owner.reshape(-1, 3, 4) - (known[0] == NOBODY)).astype(np.int32)
    n = owner.max() + 1
    component = rng.integers(0, rng.choice([2, n + 1]), n).astype(np.int32)
    among = ([RED], [0, RED], [COLOUR_ANY, RED, WHITE], [COLOUR_ANY])[rng.integers(4)]
    colour = np.where(owner == NOBODY, COLOUR_EMPTY, rng.choice(among, owner.shape)).astype(np.int16)
    places = int(rng.choice([1, 2, 12]))
    found = near_contacts(owner, component, colour, plates=True, places=places)
    told = plain(owner, component, colour, places)
    assert found.price.tolist() == pytest.approx([each[0] for each in told])
    columns = zip(found.place.tolist(), found.axis, found.added, found.on_top, found.bricks.tolist(), strict=True)
    assert list(columns) == [each[2:] for each in told]


def test_nothing_is_joined_to_fixed_bricks():
    """A brick that stays as it is is no end of a seam, whatever lies beside it."""
    owner = np.pad(np.tile([[0, 1, 2]], (3, 1, 1)), ((1, 1), (0, 0), (0, 0)), constant_values=NOBODY).astype(np.int32)
    colour = np.where(owner == NOBODY, COLOUR_EMPTY, RED).astype(np.int16)
    component = np.arange(3, dtype=np.int32)
    found = near_contacts(owner, component, colour, plates=True, fixed={1})
    assert not (found.bricks == 1).any()
    assert (near_contacts(owner, component, colour, plates=True).bricks == 1).any()
