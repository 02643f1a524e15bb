"""Trees: branches that join downwards, as thin as their load lets them be."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.supports.tree import tree
from tests.core.supports.places import assert_sound, ceilings, contacts_between, owners, room_under, triples

SIDE = 16


def grown(cells, room, straight=False):
    """Return the trees under cells."""
    cells = np.array(cells, dtype=np.int32).reshape(-1, 3)
    return tree(cells, np.ones(len(cells)), room, straight=np.full(len(cells), straight))


def layer_of(boxes, number):
    """Return the boxes of a layer, by place."""
    return sorted(map(tuple, boxes[boxes[:, 2] == 3 * number].tolist()))


def test_no_contact_no_tree():
    """Nothing grows under nothing."""
    assert grown([], room_under(np.full((3, 3), 9))).shape == (0, 6)


@pytest.mark.parametrize("height", range(1, 8))
def test_trunk_under_one_contact(height):
    """One contact gets bricks on layers counted from the ground, plates on top of them, and a wide foot."""
    boxes = grown([(3, 3, height)], room_under(np.full((8, 8), height)))
    heights = boxes[np.argsort(boxes[:, 2]), 5].tolist()
    assert heights == [3] * (height // 3) + [1] * (height % 3)
    assert boxes[(boxes[:, 2] == 0) & (boxes[:, 5] == 3), 3:5].tolist() == [[2, 2]] * (height >= 3)


@pytest.mark.parametrize(("height", "trunks"), [(10, 2), (11, 1)])
def test_branches_join_where_enough_layers_are_left(height, trunks):
    """Two tips four studs apart meet if there are ten layers below theirs, and have trunks of their own with nine."""
    boxes = grown([(4, 5, 3 * height), (8, 5, 3 * height)], room_under(np.full((12, 14), 3 * height)))
    assert len(layer_of(boxes, 0)) == trunks


def test_node_lies_in_the_lower_layer():
    """In a Y the layer with two branches is above the one with one brick, and that brick joins them both."""
    cells = [(4, 5, 36), (8, 5, 36)]
    boxes = grown(cells, room_under(np.full((12, 14), 36)))
    layers = [layer_of(boxes, number) for number in range(12)]
    node = max(number for number in range(12) if len(layers[number]) == 1)
    assert [len(each) for each in layers] == [1] * (node + 1) + [2] * (11 - node)
    assert 0 < node < 11
    x, y, _, a, b, _ = layers[node][0]
    for above in layers[node + 1]:
        assert x < above[0] + above[3]
        assert above[0] < x + a
        assert y < above[1] + above[4]
        assert above[1] < y + b


def test_straight_contacts_stay_alone():
    """What shall not join gets a column of its own."""
    cells = [(4, 5, 24), (7, 5, 24)]
    boxes = grown(cells, room_under(np.full((12, 14), 24)), straight=True)
    assert [len(layer_of(boxes, number)) for number in range(8)] == [2] * 8


def test_trunks_grow_with_their_load():
    """One contact, four and nine close together end on a trunk of one, two and four studs."""
    room = room_under(np.full((SIDE, SIDE), 60))
    for n, studs in ((1, 1), (2, 2), (3, 4)):
        cells = [(6 + 2 * i, 6 + 2 * j, 60) for j in range(n) for i in range(n)]
        boxes = grown(cells, room)
        assert len(layer_of(boxes, 1)) == 1
        assert np.prod(layer_of(boxes, 1)[0][3:5]) == studs


@given(ceilings())
def test_trees_are_sound(case):
    """Trees are parts that stand in open room, hold together and carry every contact, joined or not."""
    room, cells = case
    assert_sound(grown(cells, room), room, triples(cells))
    assert_sound(grown(cells, room, straight=True), room, triples(cells))


@given(st.sets(st.tuples(st.integers(2, SIDE - 3), st.integers(2, SIDE - 3)), max_size=60), st.integers(1, 12))
def test_trees_under_a_flat_ceiling_are_sound(places, layers):
    """The same where many contacts lie side by side."""
    cells = [(x, y, 3 * layers) for x, y in sorted(places)]
    room = room_under(np.full((SIDE, SIDE), 3 * layers))
    assert_sound(grown(cells, room), room, cells)


@given(st.sets(st.tuples(st.integers(1, 6), st.integers(1, 6)), min_size=1, max_size=12), st.integers(8, 20))
def test_trunks_never_get_thinner_downwards(places, layers):
    """With room around, each brick stands on as many studs as the load that surely rests on it asks for."""
    cells = [(3 * x, 3 * y, 3 * layers) for x, y in sorted(places)]
    room = room_under(np.full((24, 24), 3 * layers))
    boxes = grown(cells, room)
    studs = contacts_between(boxes, owners(boxes, room.open.shape))
    n_below, total = Counter(), Counter()
    for (_, upper), n in studs.items():
        n_below[upper] += 1
        total[upper] += n
    load = Counter()
    owner = owners(boxes, room.open.shape)
    for x, y, z in cells:
        load[int(owner[z - 1, y, x])] += 1
    for row in np.argsort(-boxes[:, 2], kind="stable").tolist():
        if boxes[row, 2] == 0:
            continue
        assert total[row] >= (1 if load[row] < 3 else 2 if load[row] < 7 else 4)
        # one that lies on two others may lean on a neighbour by chance
        if n_below[row] == 1:
            load[next(lower for lower, upper in studs if upper == row)] += load[row]
    assert (owner[0] != NOBODY).any()


@given(ceilings())
def test_trees_do_not_depend_on_the_order_of_runs(case):
    """The same contacts give the same trees."""
    room, cells = case
    np.testing.assert_array_equal(grown(cells, room), grown(cells.copy(), room))
