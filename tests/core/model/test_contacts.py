"""Connection: cells, collisions, studs, components and what floats, against counting by hand."""

from __future__ import annotations

from itertools import product

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model.bricks import NOBODY, Bricks
from legorize_addon.core.model.catalogue import footprint, load_catalogue
from legorize_addon.core.model.contacts import contact_graph, stud_columns
from legorize_addon.core.model.profiles import columns

CATALOGUE = load_catalogue()


def table(*rows):
    """Return bricks, given part number, x, y, plate and turn of each."""
    part = [CATALOGUE.part_row(row[0]) for row in rows]
    corner = np.array([row[1:4] for row in rows], np.int32).reshape(-1, 3)
    turn = np.array([row[4] if len(row) > 4 else 0 for row in rows], np.uint8)
    n = len(rows)
    return Bricks(
        np.array(part, np.int16),
        corner,
        turn,
        np.full(n, 4, np.int16),
        np.zeros(n, np.uint8),
        np.zeros(n, np.int16),
        np.zeros(n, np.int32),
    )


@pytest.mark.parametrize(("dx", "dy", "studs"), [(0, 0, 8), (1, 0, 6), (2, 1, 2), (3, 1, 1), (-3, 0, 2)])
def test_studs_that_two_bricks_share(dx, dy, studs):
    """A 2 x 4 brick on another one, shifted, shares the studs of the overlap."""
    links = contact_graph(table(("3001", 5, 5, 0), ("3001", 5 + dx, 5 + dy, 3)), CATALOGUE)
    assert links.pairs.tolist() == [[0, 1]]
    assert links.studs.tolist() == [studs]
    assert links.n_components == 1
    assert links.n_floating == 0


def test_side_by_side_is_not_connected():
    """Bricks that only stand next to each other are two components, both on the ground."""
    links = contact_graph(table(("3001", 0, 0, 0), ("3001", 4, 0, 0)), CATALOGUE)
    assert len(links.pairs) == 0
    assert links.n_components == 2
    assert links.grounded.all()


def test_a_gap_of_one_plate_is_no_contact():
    """A brick a plate above another one floats."""
    links = contact_graph(table(("3001", 0, 0, 0), ("3001", 0, 0, 4), ("3001", 0, 0, 7)), CATALOGUE)
    assert links.grounded.tolist() == [True, False, False]
    assert links.n_floating == 2
    assert links.n_components == 2


def test_ground_is_the_lowest_plate():
    """A model that begins at plate 6 stands on plate 6."""
    links = contact_graph(table(("3001", 0, 0, 6), ("3001", 9, 0, 9)), CATALOGUE)
    assert links.grounded.tolist() == [True, False]


@pytest.mark.parametrize("turn", range(4))
def test_a_corner_holds_nothing_in_its_missing_cell(turn):
    """A 1 x 1 brick over the free cell of a corner brick is not connected, over the others it is."""
    covered = {tuple(cell) for cell in footprint(CATALOGUE.parts[CATALOGUE.part_row("2357")], turn).tolist()}
    for cell in product(range(2), range(2)):
        links = contact_graph(table(("2357", 0, 0, 0, turn), ("3005", *cell, 3)), CATALOGUE)
        assert (links.n_components == 1) == (cell in covered)


def test_plates_and_tall_bricks_connect_at_their_own_heights():
    """A plate carries at plate 1, a tall brick at plate 9."""
    links = contact_graph(
        table(("3024", 0, 0, 0), ("14716", 0, 0, 1), ("3024", 0, 0, 10), ("3024", 0, 0, 12)), CATALOGUE
    )
    assert links.pairs.tolist() == [[0, 1], [1, 2]]
    assert links.grounded.tolist() == [True, True, True, False]


def test_collisions_count_cells():
    """Two bricks in one place collide in all their cells, and the first one is named as the owner."""
    links = contact_graph(table(("3001", 0, 0, 0), ("3001", 2, 0, 0), ("3024", 3, 1, 2)), CATALOGUE)
    assert links.collisions == 4 * 3
    assert (links.owner[:, :2, 2:4] == 0).all()
    assert contact_graph(table(("3001", 0, 0, 0), ("3001", 4, 0, 0)), CATALOGUE).collisions == 0


def test_owner_covers_the_volume_of_the_parts():
    """The cells of a brick are its studs times its plates."""
    rows = (("3001", 0, 0, 0), ("2357", 4, 0, 0), ("3710", 0, 2, 2), ("30144", 0, 4, 0))
    links = contact_graph(table(*rows), CATALOGUE)
    counts = np.bincount(links.owner[links.owner != NOBODY])
    assert counts.tolist() == [24, 9, 4, 72]
    assert links.owner.shape == (9, 6, 6)


def test_negative_places_are_allowed():
    """Bricks at negative coordinates shift the array of owners, nothing else."""
    links = contact_graph(table(("3005", -2, -3, -6), ("3004", -2, -3, -3)), CATALOGUE)
    assert links.low.tolist() == [-2, -3, -6]
    assert links.owner[0, 0, 0] == 0
    assert links.studs.tolist() == [1]
    assert links.grounded.all()


def test_no_bricks():
    """An empty table has no cells, no contacts and no components."""
    links = contact_graph(table(), CATALOGUE)
    assert links.owner.size == 0
    assert links.pairs.shape == (0, 2)
    assert (links.n_components, links.n_floating, links.collisions) == (0, 0, 0)


places = st.tuples(
    st.sampled_from(["3005", "3004", "3001", "2357", "3024", "3020", "30145"]),
    st.integers(0, 6),
    st.integers(0, 6),
    st.integers(0, 12),
    st.integers(0, 3),
)


@given(st.lists(places, min_size=1, max_size=12))
def test_same_as_counting_cell_by_cell(rows):
    """Contacts, components and grounds equal those found with dictionaries, for bricks without collisions."""
    bricks = table(*rows)
    heights = [CATALOGUE.parts[part].height for part in bricks.part]
    cells = {}
    kept = []
    for row, (part, corner, turn) in enumerate(zip(bricks.part, bricks.corner, bricks.turn, strict=True)):
        mine = {
            (int(x + corner[0]), int(y + corner[1]), int(corner[2]) + z)
            for x, y in footprint(CATALOGUE.parts[part], int(turn))
            for z in range(heights[row])
        }
        if not mine & cells.keys():
            cells |= dict.fromkeys(mine, len(kept))
            kept.append(row)
    bricks = bricks.take(np.array(kept))
    graph = nx.Graph()
    graph.add_nodes_from(range(len(bricks)))
    shared = {}
    for (x, y, z), lower in cells.items():
        upper = cells.get((x, y, z + 1), lower)
        if upper != lower:
            shared[lower, upper] = shared.get((lower, upper), 0) + 1
    graph.add_edges_from(shared)
    links = contact_graph(bricks, CATALOGUE)
    assert dict(zip(map(tuple, links.pairs.tolist()), links.studs.tolist(), strict=True)) == shared
    assert links.collisions == 0
    lowest = bricks.corner[:, 2].min()
    for members in nx.connected_components(graph):
        rows_of = list(members)
        assert len(set(links.component[rows_of].tolist())) == 1
        assert links.grounded[rows_of].tolist() == [bool((bricks.corner[rows_of, 2] == lowest).any())] * len(rows_of)
    assert links.n_components == nx.number_connected_components(graph)


def test_stud_columns_are_sorted_by_brick():
    """Every brick appears as often as it has studs, in order."""
    brick, columns = stud_columns(table(("3001", 0, 0, 0), ("2357", 5, 5, 3, 1), ("3005", 9, 9, 0)), CATALOGUE)
    assert brick.tolist() == [0] * 8 + [1] * 3 + [2]
    assert columns[-1].tolist() == [9, 9, 0]


@pytest.mark.parametrize(
    ("lower", "upper", "holds"),
    [
        ("3023", "3069b", True),
        ("3069b", "3023", False),
        ("3069b", "3069b", False),
        ("3867", "3023", True),
        ("3023", "3867", False),
    ],
)
def test_nothing_clutches_on_a_tile_or_under_a_baseplate(lower, upper, holds):
    """What lies on a tile, or a baseplate on studs, shares no stud with it: it floats."""
    links = contact_graph(table((lower, 0, 0, 0), (upper, 0, 0, 1)), CATALOGUE)
    assert links.collisions == 0
    assert links.pairs.tolist() == ([[0, 1]] if holds else [])
    assert links.grounded.tolist() == [True, holds]


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("part", [part for part in CATALOGUE.parts if part.wedge], ids=lambda part: part.number)
def test_wedge_plates_clutch_where_they_have_room(part, turn):
    """What lies over a wedge plate is held by its studs, it by those under its sockets; studs in notches hold none."""
    own = columns(part, turn)
    found = contact_graph(table(("3958", 0, 0, 0), (part.number, 1, 1, 1, turn), ("3958", 0, 0, 2)), CATALOGUE)
    assert found.collisions == 0
    assert found.pairs.tolist() == [[0, 1], [1, 2]]
    assert found.studs.tolist() == [np.count_nonzero(own.socket), np.count_nonzero(own.stud)]
    notches = [("3024", x, y, 0) for x, y in own.xy[~own.socket].tolist()]
    found = contact_graph(table(*notches, (part.number, 0, 0, 1, turn)), CATALOGUE)
    assert found.collisions == len(found.pairs) == 0
    assert found.grounded.tolist() == [True] * len(notches) + [False]
