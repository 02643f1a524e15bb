"""The room in which supports stand and are taken out again."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.supports.clearance import MARGIN, clearance_around
from scripts.benchmarks.stablelego import placed
from tests.core.standing import CATALOGUE, table

BRIDGE = (("3004", 0, 0, 0), ("3004", 4, 0, 0), ("3009", 0, 0, 3))
"""A beam of six over two feet."""


def around(*rows):
    """Return the room around bricks."""
    return clearance_around(contact_graph(table(*rows), CATALOGUE))


def test_room_under_a_bridge_is_open():
    """Between its feet and all around there is open room, under the feet and over the beam there is none."""
    room = around(*BRIDGE)
    x, y = np.array([0, 0]) - room.low[:2]
    under = room.open[:, y, x : x + 6]
    assert under[:3].all(axis=0).tolist() == [False, False, True, True, False, False]
    assert not under[3:].any()
    assert room.open[:, y, x - MARGIN : x].all()
    assert room.open.shape[1:] == (1 + 2 * MARGIN, 6 + 2 * MARGIN)


def test_low_leads_back_to_the_grid():
    """``low`` is the cell of the model's grid at the room's corner, on the model's lowest plate."""
    room = around(("3005", 5, 6, 7))
    x, y, z = np.array([5, 6, 7]) - room.low
    assert z == 0
    assert room.filled[:, y, x].all()
    assert room.filled.sum() == 3


def test_layers_are_counted_from_the_ground():
    """A layer has room where all three of its plates have, and the last may be cut by the top."""
    room = around(("3024", 0, 0, 0), ("3024", 4, 0, 0), ("3020", 0, 0, 1), ("3710", 1, 0, 2), ("3710", 1, 0, 3))
    x, y = -room.low[:2]
    assert not room.layer(0)[y, x : x + 4].any()
    assert room.layer(1)[y - 1, x]


def test_closed_hollow_is_not_free():
    """The air in a closed box is not reached from outside, that under a bridge is."""
    box = around(
        *[("3001", 0, 0, z, 0) for z in (0, 6)],
        *[("3010", 0, 0, 3, 0), ("3005", 0, 1, 3, 0), ("3622", 1, 1, 3, 0)],
    )
    assert (box.free | box.filled).all()
    hole = around(
        ("3002", 0, 0, 0), ("3002", 0, 2, 0), ("3622", 0, 0, 3), ("3622", 0, 3, 3),
        *[("3004", x, 1, 3, 1) for x in (0, 2)], ("3002", 0, 0, 6), ("3002", 0, 2, 6),
    )  # fmt: skip
    x, y = -hole.low[:2]
    assert not (hole.free | hole.filled)[3:6, y + 1 : y + 3, x + 1].any()
    assert hole.free[0, 0, 0]


@given(st.lists(st.tuples(st.integers(0, 8), st.integers(0, 8), st.integers(0, 12)), min_size=1, max_size=30))
def test_open_room_has_nothing_below(places):
    """An open cell has open cells down to the ground, a filled one and all above it are closed; open air is free."""
    bricks = placed([("3024", *place, 0) for place in dict.fromkeys(places)], CATALOGUE)
    graph = contact_graph(bricks, CATALOGUE)
    room = clearance_around(graph)
    assert room.filled.sum() == (graph.owner != NOBODY).sum()
    np.testing.assert_array_equal(room.open, ~np.logical_or.accumulate(room.filled, axis=0))
    assert not (room.free & room.filled).any()
    sky = ~np.logical_or.accumulate(room.filled[::-1], axis=0)[::-1]
    assert room.free[sky].all()


def test_supports_keep_off_what_lies_half_a_stud_aside():
    """Under a plate of which one half carries other half studs, a column is closed on each side between them."""
    graph = contact_graph(table(("3005", 0, 0, 0), ("3024", 0, 0, 3), ("3034", 0, 0, 6)), CATALOGUE)
    kinds = np.zeros((3, 4, 9), np.uint8)
    kinds[2, :, 4:] = 1
    plain, room = clearance_around(graph), clearance_around(graph, kinds)
    assert (room.low == plain.low).all()
    row = room.open[5, MARGIN + 1, MARGIN : MARGIN + 8]
    assert plain.open[5, MARGIN + 1, MARGIN : MARGIN + 8].all()
    assert row.tolist() == [True, True, True, False, False, True, True, True]
    # nothing stands below where nothing may be
    assert (room.open[:-1] | ~room.open[1:]).all()
    assert (clearance_around(graph, np.zeros_like(kinds)).open == plain.open).all()
