"""Half-edges, connected parts and rims, against plain loops over small meshes."""

from __future__ import annotations

from collections import Counter

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.topology import components, edges_of, n_bodies, open_rim, rim_fans, rim_loops, spread
from tests.core.solids import box, joined, sheet, without


def tangle(seed: int, n_vertices: int, n_faces: int) -> np.ndarray:
    """Draw faces of three different vertices."""
    random = np.random.default_rng(seed)
    return np.array([random.permutation(n_vertices)[:3] for _ in range(n_faces)], dtype=np.int32)


def half_edges(faces: np.ndarray) -> list[tuple[int, int]]:
    """List (from, to) of every half-edge."""
    return [(int(face[k]), int(face[(k + 1) % 3])) for face in faces for k in range(3)]


TANGLES = (st.integers(0, 2**32 - 1), st.integers(3, 12), st.integers(1, 30))


@given(*TANGLES)
def test_edges_group_the_half_edges_of_the_same_two_vertices(seed, n_vertices, n_faces):
    """Every edge holds all its half-edges, in ascending order, with their directions."""
    faces = tangle(seed, n_vertices, n_faces)
    edges, ends = edges_of(faces), half_edges(faces)
    groups = [edges.order[a:b].tolist() for a, b in zip(edges.start[:-1], edges.start[1:], strict=True)]
    expected = {}
    for number, (tail, head) in enumerate(ends):
        expected.setdefault((min(tail, head), max(tail, head)), []).append(number)
    assert groups == [expected[pair] for pair in sorted(expected)]
    assert edges.forward.tolist() == [tail < head for tail, head in ends]
    assert all((edges.edge()[group] == number).all() for number, group in enumerate(groups))


@given(*TANGLES)
def test_turned_edges_are_the_edges_of_the_turned_faces(seed, n_vertices, n_faces):
    """Renumbering half-edges is the same as grouping them anew, but for the order within an edge."""
    faces = tangle(seed, n_vertices, n_faces)
    flip = np.random.default_rng(seed).random(n_faces) < 0.5
    turned = edges_of(faces).turned(flip)
    faces[flip] = faces[flip][:, [0, 2, 1]]
    anew = edges_of(faces)
    np.testing.assert_array_equal(turned.start, anew.start)
    np.testing.assert_array_equal(turned.forward, anew.forward)
    np.testing.assert_array_equal(turned.edge(), anew.edge())


@given(*TANGLES)
def test_a_surface_and_its_rim_are_closed(seed, n_vertices, n_faces):
    """With the rim every edge has as many half-edges one way as the other."""
    faces = tangle(seed, n_vertices, n_faces)
    edges = edges_of(faces)
    ways = Counter(half_edges(faces))
    # edges of two faces are left to the winding, so only the others are promised
    crowded = [pair for pair, count in Counter(tuple(sorted(way)) for way in half_edges(faces)).items() if count != 2]
    rim, owner = open_rim(faces, edges, np.zeros(n_faces, np.int64))
    ways.update(map(tuple, rim.tolist()))
    assert all(ways[low, high] == ways[high, low] for low, high in crowded)
    assert not owner.any()


def test_the_rim_of_an_open_box_is_one_loop_around_the_hole():
    """The missing lid: four edges, whose fan is the lid, counter-clockwise from above."""
    mesh = without(box(), 2, 3)
    rim, owner = open_rim(mesh.faces, edges_of(mesh.faces), np.zeros(10, np.int64))
    loop, simple = rim_loops(rim, owner)
    fans, centre = rim_fans(mesh.vertices, rim, loop)
    assert loop.tolist() == [0] * 4
    assert simple.tolist() == [True]
    np.testing.assert_allclose(centre, [[0.5, 0.5, 1]])
    normals = np.cross(fans[:, 1] - fans[:, 0], fans[:, 2] - fans[:, 0])
    np.testing.assert_allclose(normals, [[0, 0, 0.5]] * 4)


def test_a_rim_that_touches_itself_is_not_simple():
    """Two holes with a common corner are one loop that is left twice there."""
    flat = sheet(4, 4)
    square = {(i, j): [k, k + 16] for k, (j, i) in enumerate(np.ndindex(4, 4))}
    mesh = without(flat, *square[1, 1], *square[2, 2])
    loop, simple = rim_loops(*open_rim(mesh.faces, edges_of(mesh.faces), np.zeros(28, np.int64)))
    assert sorted(np.bincount(loop).tolist()) == [8, 16]
    assert simple[np.argsort(np.bincount(loop))].tolist() == [False, True]


def test_bodies_are_counted_over_edges_of_any_number_of_faces():
    """Two boxes welded along an edge are one body, two apart are two."""
    faces = joined(box(), box()).faces
    patch = np.repeat([0, 1], 12)
    assert n_bodies(edges_of(faces), patch) == 2
    hinge = np.where(np.isin(faces, [8, 12]), faces - 8, faces)
    assert n_bodies(edges_of(hinge), patch) == 1


def test_components_count_up_by_their_first_node():
    """Labels do not depend on the order of the pairs."""
    assert components(6, np.array([5, 3]), np.array([0, 2])).tolist() == [0, 1, 2, 2, 3, 0]
    assert components(0, np.empty(0, int), np.empty(0, int)).tolist() == []


def test_spread_lists_the_members_of_ranges():
    """Empty ranges have none."""
    row, member = spread(np.array([3, 7, 0]), np.array([5, 7, 1]))
    assert row.tolist() == [0, 0, 2]
    assert member.tolist() == [3, 4, 0]
