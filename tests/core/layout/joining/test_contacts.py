"""Where components could be joined, and what that costs."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.joining.contacts import near_contacts
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
