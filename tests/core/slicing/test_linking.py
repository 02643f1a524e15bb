"""Segments that follow each other: exactly over edges, and sensibly over gaps."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.triangle_mesh import repair
from legorize_addon.core.slicing import linking
from legorize_addon.core.slicing.linking import matched_ends, successors
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from tests.core.solids import BOX_FACES, box, joined, mesh_of, sphere, tube, walls, without
from tests.core.textured import blob, torus

CLOSED = {
    "ball": repair(sphere(9, 30.0))[0],
    "torus": torus(30, 12, 24, 16),
    "tube": tube(),
    "blob": repair(blob(10, 40.0))[0],
    "overlapping": joined(box((0, 0, 0), (20, 20, 20)), box((10, 10, 5), (30, 30, 25))),
}


def middle_loops(mesh) -> list[list[tuple[float, float]]]:
    """Cut a mesh at half its height; return the points of every loop, from its lowest one on."""
    outline = linked(mesh.faces, slice_mesh(mesh, np.array([mesh.vertices[:, 2].mean()])))
    loops = []
    for a, b in zip(outline.loop_start[:-1], outline.loop_start[1:], strict=True):
        points = [tuple(point) for point in np.round(outline.start[a:b], 6).tolist()]
        first = points.index(min(points))
        loops.append(points[first:] + points[:first])
    return sorted(loops)


# ---------------------------------------------------------- closed meshes


@pytest.mark.parametrize("name", CLOSED)
@pytest.mark.parametrize("through_vertices", [True, False])
def test_closed_meshes_link_without_any_gap(name, through_vertices):
    """Every segment has one successor, which starts at its very end, to the last bit."""
    mesh = CLOSED[name]
    z = np.unique(mesh.vertices[:, 2])
    slices = slice_mesh(mesh, z if through_vertices else (z[1:] + z[:-1]) / 2)
    following = successors(mesh.faces, slices)
    assert sorted(following.tolist()) == list(range(len(slices)))
    np.testing.assert_array_equal(slices.segments[following, 0], slices.segments[:, 1])
    np.testing.assert_array_equal(slices.slice[following], slices.slice)
    assert len(matched_ends(slices, following)[0]) == 0


@given(st.lists(st.floats(-40, 40), min_size=1, max_size=30, unique=True), st.integers(0, 2))
def test_any_planes_link(heights, axis):
    """Wherever the planes lie and whichever way they face, all segments of a closed mesh link exactly."""
    mesh = CLOSED["blob"]
    slices = slice_mesh(mesh, np.sort(np.array(heights)), axis=axis)
    following = successors(mesh.faces, slices)
    assert sorted(following.tolist()) == list(range(len(slices)))
    np.testing.assert_array_equal(slices.segments[following, 0], slices.segments[:, 1])


def test_order_of_faces_does_not_matter():
    """Shuffled faces and corners give the same loops."""
    mesh = CLOSED["torus"]
    rng = np.random.default_rng(2)
    faces = np.array(
        [np.roll(face, turn) for face, turn in zip(mesh.faces, rng.integers(0, 3, len(mesh.faces)), strict=True)]
    )
    assert middle_loops(mesh_of(mesh.vertices, rng.permutation(faces))) == middle_loops(mesh)


def test_more_planes_than_triangles():
    """A long triangle met by hundreds of planes links in each of them."""
    slices = slice_mesh(box((0, 0, 0), (1, 1, 1000)), np.arange(500) * 2 + 0.7)
    following = successors(BOX_FACES, slices)
    np.testing.assert_array_equal(slices.slice[following], slices.slice)
    np.testing.assert_array_equal(slices.segments[following, 0], slices.segments[:, 1])


# ------------------------------------------------- edges with many faces


def test_bodies_that_share_an_edge_link():
    """Two cubes with one edge in common, four faces on it: every segment still has one successor at its end."""
    pair = joined(box((0, 0, 0), (10, 10, 10)), box((10, 10, 0), (20, 20, 10)))
    _, number = np.unique(pair.vertices, axis=0, return_inverse=True)
    mesh = mesh_of(np.unique(pair.vertices, axis=0), number.ravel()[pair.faces])
    assert len(mesh.vertices) == 14
    slices = slice_mesh(mesh, np.array([3.0, 7.0]))
    following = successors(mesh.faces, slices)
    assert sorted(following.tolist()) == list(range(len(slices)))
    np.testing.assert_array_equal(slices.segments[following, 0], slices.segments[:, 1])


def test_faces_given_twice_link():
    """A body whose faces all come twice gives every loop twice."""
    cube = box((0, 0, 0), (10, 10, 10))
    twice = mesh_of(cube.vertices, np.concatenate([cube.faces, cube.faces]))
    assert middle_loops(twice) == middle_loops(cube) * 2


def test_faces_given_twice_but_for_some_link_one_to_one():
    """Where an edge has two faces on one side and one on the other, one link is made and one end left."""
    cube = box((0, 0, 0), (10, 10, 10))
    mesh = mesh_of(cube.vertices, np.concatenate([cube.faces, cube.faces[:-3]]))
    slices = slice_mesh(mesh, np.array([5.0]))
    following = successors(mesh.faces, slices)
    linked_on = following[following >= 0]
    assert len(linked_on) == len(set(linked_on.tolist())) < len(slices)
    np.testing.assert_array_equal(slices.segments[linked_on, 0], slices.segments[following >= 0, 1])


def test_three_faces_on_an_edge_leave_one_end():
    """Of three walls on one edge two link, in the order of their numbers; the third has no neighbour there."""
    star = walls([(0, 0), (10, 0)], [(10, 0), (20, 5)], [(10, 0), (20, -5)])
    vertices, number = np.unique(star.vertices, axis=0, return_inverse=True)
    slices = slice_mesh(mesh_of(vertices, number.ravel()[star.faces]), np.array([5.0]))
    starts, ends = slices.segments[:, 0], slices.segments[:, 1]
    following = successors(slices.mesh.faces, slices)
    linked_on = following >= 0
    np.testing.assert_array_equal(starts[following[linked_on]], ends[linked_on])
    assert (~linked_on).sum() == 2


def test_faces_that_run_against_each_other_do_not_link():
    """Over an edge whose faces wind in opposite senses there is no way through: both segments end or begin there."""
    cube = box((0, 0, 0), (10, 10, 10))
    faces = cube.faces.copy()
    side = np.flatnonzero((cube.vertices[faces][..., 0] == 10).all(axis=1))
    faces[side] = faces[side][:, ::-1]
    slices = slice_mesh(mesh_of(cube.vertices, faces), np.array([5.0]))
    assert (successors(faces, slices) < 0).sum() == 2


# ------------------------------------------------------------------- gaps


def test_hole_in_a_wall_is_closed_straight():
    """A cube without a triangle is closed across the opening: at half its height it still is the square's outline."""
    cube = box((0, 0, 0), (10, 10, 10))
    side = np.flatnonzero((cube.vertices[cube.faces][..., 0] == 10).all(axis=1))[0]
    outline = linked(cube.faces, slice_mesh(without(cube, side), np.array([4.0])))
    assert (outline.face < 0).sum() == 1
    assert set(middle_loops(without(cube, side))[0]) == set(middle_loops(cube)[0])


@pytest.mark.parametrize(("gap", "together"), [(1.9, True), (7.9, True), (8.1, False)])
def test_chains_join_up_to_eight_millimetres(gap, together):
    """Two halves of a ring become one loop where their ends are near, else each closes on itself."""
    half = np.array([(0.0, 0), (50, 0), (50, 50), (0, 50)])
    mesh = walls(half, [50, 50] - half - [50 + gap, 0] + [0, 0])
    loops = middle_loops(mesh)
    assert len(loops) == (1 if together else 2)


def test_nearest_ends_join_first():
    """An end takes the start 1 mm away, not the one at 1.5 mm, which another end is nearer to."""
    mesh = walls([(0, 0), (20, 0)], [(21, 0), (40, 0)], [(21.5, 1.2), (40, 20)], [(0, 20), (21.5, 2)])
    slices = slice_mesh(mesh, np.array([5.0]))
    following = successors(mesh.faces, slices)
    tail, head = matched_ends(slices, following)
    ends, starts = (np.round(part, 6) for part in (slices.ends(tail), slices.starts(head)))
    pairs = {tuple(a): tuple(b) for a, b in zip(ends.tolist(), starts.tolist(), strict=True)}
    assert pairs[20.0, 0.0] == (21.0, 0.0)
    assert pairs[21.5, 2.0] == (21.5, 1.2)


def test_near_ends_join_before_far_ones():
    """A start goes to the nearer of two ends, though the other one comes first; that takes one farther away."""
    mesh = walls([(0, 0), (20, 0)], [(0, 9), (20, 2.5)], [(20, 1.5), (60, 0)], [(22, -4), (60, -40)])
    slices = slice_mesh(mesh, np.array([5.0]))
    tail, head = matched_ends(slices, successors(mesh.faces, slices))
    ends, starts = slices.ends(tail).round(6).tolist(), slices.starts(head).round(6).tolist()
    assert starts[ends.index([20.0, 2.5])] == [20.0, 1.5]
    assert starts[ends.index([20.0, 0.0])] == [22.0, -4.0]


def test_equally_near_ends_all_find_a_partner():
    """Ends and starts that alternate along a line at one distance are joined in pairs, none twice."""
    mesh = walls(*([(4.0 * i, 0), (4.0 * i + 3, 0)] for i in range(20)))
    slices = slice_mesh(mesh, np.array([5.0]))
    tail, head = matched_ends(slices, successors(mesh.faces, slices))
    gaps = np.linalg.norm(slices.ends(tail) - slices.starts(head), axis=1)
    assert sorted(head.tolist()) == sorted(set(head.tolist()))
    assert (gaps.round(6) == 1).sum() == 19


def test_ends_join_only_within_their_slice():
    """Chains of neighbouring planes that lie one above the other do not mix."""
    mesh = walls([(0, 0), (20, 0), (20, 20)], [(21, 20), (21, 40)], height=10.0)
    slices = slice_mesh(mesh, np.linspace(0.1, 9.9, 50))
    tail, head = matched_ends(slices, successors(mesh.faces, slices))
    np.testing.assert_array_equal(slices.slice[tail], slices.slice[head])


@given(st.sets(st.integers(0, 107), max_size=60))
def test_torn_meshes_always_close(missing):
    """Whatever triangles of a ball are missing, every slice falls into closed loops that use each segment once."""
    ball = without(repair(sphere(3, 20.0))[0], *missing)
    slices = slice_mesh(ball, np.linspace(-19, 19, 7))
    outline = linked(ball.faces, slices)
    assert sorted(outline.segment[outline.segment >= 0].tolist()) == list(range(len(slices)))
    real = outline.face >= 0
    np.testing.assert_array_equal(outline.start[real], slices.starts(outline.segment[real]))
    np.testing.assert_array_equal(outline.ends[real], slices.ends(outline.segment[real]))
    same = np.repeat(outline.slice[outline.loop_start[:-1]], np.diff(outline.loop_start))
    np.testing.assert_array_equal(outline.slice, same)


# ---------------------------------------------------------- many ends in one place, and in a row


def pages(n: int):
    """Triangles that all share one upright edge, like the pages of a book that stands open."""
    angle = 2 * np.pi * np.arange(n) / n
    tips = np.column_stack([40 * np.cos(angle), 40 * np.sin(angle), np.full(n, 20.0)])
    number = np.arange(n)
    return mesh_of(
        np.vstack([[(0, 0, 0), (0, 0, 40)], tips]), np.column_stack([0 * number, 0 * number + 1, number + 2])
    )


def fence(n: int):
    """Sheets side by side, every other one turned round, with gaps that grow from one to the next."""
    place = np.cumsum(1 + np.arange(n) / n)
    return walls(*([(x, 0.0), (x, 40.0)][:: 1 if i % 2 else -1] for i, x in enumerate(60 * place / place[-1])))


def seen_points(mesh, monkeypatch) -> int:
    """Link the middle slice of a mesh; return how many points were put into trees and looked up there."""
    seen = [0]

    class Tree(linking.cKDTree):
        def __init__(self, data, *args, **options):
            seen[0] += len(data)
            super().__init__(data, *args, **options)

        def query(self, x, k=1, **options):
            seen[0] += np.atleast_2d(x).shape[0] * (1 if np.isscalar(k) else len(k))
            return super().query(x, k, **options)

    monkeypatch.setattr(linking, "cKDTree", Tree)
    slices = slice_mesh(mesh, np.array([0.3]))
    tail, head = matched_ends(slices, successors(mesh.faces, slices))
    assert sorted(head.tolist()) == sorted(set(head.tolist()))
    assert len(tail) >= len(mesh.faces) // 2
    return seen[0]


@pytest.mark.parametrize("made", [pages, fence])
def test_work_grows_with_the_number_of_ends(made, monkeypatch):
    """Where ends lie in one place, or gaps grow one after the other, four times the ends take four times the work."""
    few, many = seen_points(made(200), monkeypatch), seen_points(made(800), monkeypatch)
    assert many < 6 * few
    assert many < 60 * 800


@given(st.lists(st.tuples(st.integers(0, 6), st.integers(0, 6), st.booleans()), min_size=2, max_size=24))
def test_nearest_pairs_are_joined_as_if_one_by_one(places):
    """However many ends lie in one place, the nearest pairs are joined first."""
    ends, starts = (np.array([(2.3 * x, 3.1 * y) for x, y, end in places if end is kind]) for kind in (True, False))
    if not len(ends) or not len(starts):
        return
    match = np.full(len(ends), -1)
    linking._match_nearest(ends.reshape(-1, 2), starts.reshape(-1, 2), match)
    joined_now = match >= 0
    gaps = np.linalg.norm(ends[joined_now] - starts[match[joined_now]], axis=1)
    assert len(set(match[joined_now].tolist())) == joined_now.sum()
    assert (gaps <= 8).all()
    apart = np.linalg.norm(ends[:, None] - starts[None], axis=2)
    own = np.full(len(ends), np.inf)
    own[joined_now] = gaps
    taken = np.full(len(starts), np.inf)
    taken[match[joined_now]] = gaps
    # no end and start are nearer to each other than both are to what they were joined with
    nearer = (apart < own[:, None] - 1e-9) & (apart < taken[None] - 1e-9) & (apart <= 8)
    assert not nearer.any()
