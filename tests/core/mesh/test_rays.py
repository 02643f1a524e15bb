"""Vertical rays: where they should hit they hit once, with the image coordinates of the place."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.rays import vertical_hits
from legorize_addon.core.mesh.triangle_mesh import repair
from tests.core.solids import box, joined, mesh_of, sheet, sphere, tube
from tests.core.textured import blob, turned_about_z


def hits(mesh, corner=(0.0, 0.0), pitch=2.0):
    """Return the hits of the lattice's rays, and the column and row of each."""
    face, points, uvs = vertical_hits(mesh, corner=np.asarray(corner, dtype=np.float64), pitch=pitch)
    place = (points[:, :2] - corner) / pitch - 0.5
    np.testing.assert_allclose(place, np.round(place), atol=1e-8)
    return face, points, uvs, np.round(place).astype(int)


def counts(place) -> np.ndarray:
    """Return how many hits every ray has that hits at all."""
    return np.unique(place, axis=0, return_counts=True)[1]


def facing(mesh, face) -> np.ndarray:
    """Return 1 for faces that look upwards and -1 for those that look down."""
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces[face]], 1, 0)
    return np.sign(np.cross(b - a, c - a)[:, 2])


def test_plane_is_hit_once_by_every_ray():
    """A level sheet is hit at its height by each ray over it, wherever its triangles meet."""
    flat = sheet(4, 3)
    mesh = mesh_of(flat.vertices * [24, 24, 1] + [0, 0, 5], flat.faces)
    _, points, _, place = hits(mesh)
    assert place[np.lexsort(place.T[::-1])].tolist() == [[x, y] for x in range(12) for y in range(12)]
    np.testing.assert_allclose(points[:, 2], 5)


def test_leaning_plane_is_hit_at_its_heights():
    """On a leaning sheet the heights follow the plane."""
    flat = sheet(5, 4, lambda x, y: 0.3 * x - 0.7 * y)
    _, points, _, _ = hits(mesh_of(flat.vertices * 30, flat.faces), (0.1, 0.2))
    assert len(points) == 15 * 15
    np.testing.assert_allclose(points[:, 2], 0.3 * points[:, 0] - 0.7 * points[:, 1], atol=1e-9)


def test_ball_is_hit_twice():
    """Each ray through a ball hits it below and above, at the sphere's heights; none beside it hits."""
    ball = repair(sphere(40, 30.0))[0]
    face, points, _, place = hits(ball, (-40.3, -40.7), 2.5)
    away = np.hypot(points[:, 0], points[:, 1])
    np.testing.assert_array_equal(counts(place[away < 29.8]), 2)
    np.testing.assert_allclose(np.linalg.norm(points, axis=1), 30, rtol=2e-3)
    np.testing.assert_array_equal(facing(ball, face), np.sign(points[:, 2]))
    lattice = np.stack(np.meshgrid(np.arange(32), np.arange(32)), axis=-1).reshape(-1, 2) * 2.5 + 1.25 - [40.3, 40.7]
    assert (np.hypot(*lattice.T) < 29.8).sum() == len(np.unique(place[away < 29.8], axis=0))


def test_image_coordinates_are_those_of_the_place():
    """Where the image lies flat on x and y, a hit's image coordinates are its x and y."""
    _, points, uvs, _ = hits(repair(blob(8, 30.0, size=8))[0], (-50, -50))
    ball = repair(sphere(9, 30.0))[0]
    _, points, uvs, _ = hits(ball, (-31.1, -30.3))
    assert len(points) > 100
    np.testing.assert_allclose(uvs, points[:, :2], atol=1e-9)


def test_hits_lie_in_their_triangles():
    """A hit is in the plane of its triangle and between its corners."""
    mesh = repair(blob(8, 40.0, size=8))[0]
    face, points, _, _ = hits(mesh, (-55, -55), 1.7)
    corners = mesh.vertices[mesh.faces[face]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    np.testing.assert_allclose(((points - corners[:, 0]) * normal).sum(axis=1), 0, atol=1e-6)
    assert (points >= corners.min(axis=1) - 1e-6).all()
    assert (points <= corners.max(axis=1) + 1e-6).all()


@pytest.mark.parametrize("n", [6, 8, 24])
def test_rays_through_edges_and_corners_hit_once(n):
    """On lattice points that lie on diagonals, sides and corners of triangles a fan and a grid are hit once."""
    fan = turned_about_z([(0, 0), (24, 0), (24, 10), (0, 10)], n)
    _, points, _, place = hits(fan, (-25, -25))
    keys = np.column_stack([place, np.round(points[:, 2])])
    assert len(np.unique(keys, axis=0)) == len(keys)
    assert {(12, 12, 0), (12, 12, 10)} <= set(map(tuple, keys.astype(int).tolist()))


@given(st.integers(0, 2**32 - 1), st.sampled_from([1.0, 2.0, 8 / 3]))
def test_no_ray_is_lost_or_counted_twice(seed, pitch):
    """Over a triangulated sheet with corners on and off the lattice every ray hits once, whatever its height."""
    rng = np.random.default_rng(seed)
    flat = sheet(6, 6)
    vertices = flat.vertices * [48, 48, 0]
    inner = ((vertices[:, :2] > 0) & (vertices[:, :2] < 48)).all(axis=1)
    # half of the inner corners move to lattice points, the others anywhere near, but no triangle turns over
    moved = rng.uniform(-1.3, 1.3, (int(inner.sum()), 2))
    on_lattice = rng.random(len(moved)) < 0.5
    near = vertices[inner, :2] + moved
    near[on_lattice] = (np.round(vertices[inner, :2][on_lattice] / pitch - 0.5) + 0.5) * pitch
    vertices[inner, :2] = near
    vertices[:, 2] = rng.uniform(0, 9, len(vertices))
    _, _, _, place = hits(mesh_of(vertices, flat.faces), pitch=pitch)
    n = round(48 / pitch)
    assert len(place) == n * n
    np.testing.assert_array_equal(counts(place), 1)


@given(st.integers(0, 2**32 - 1))
def test_every_ray_leaves_the_bodies_that_it_enters(seed):
    """Over closed bodies each ray hits as many faces that look up as faces that look down."""
    rng = np.random.default_rng(seed)
    # sides on the rays, but no two surfaces at one height
    low = rng.integers(-6, 6, (4, 3)) + np.arange(1, 5)[:, None] * [0, 0, 0.2]
    mesh = joined(*(box(a, a + rng.integers(1, 9, 3)) for a in low), repair(sphere(3, 6.0, (0, 0, 40)))[0])
    face, _, _, place = hits(mesh, (-20.5, -20.5), 1.0)
    _, ray = np.unique(place, axis=0, return_inverse=True)
    assert np.bincount(ray.ravel(), facing(mesh, face)).any() == 0


def test_left_and_right_are_treated_alike():
    """A body whose sides lie exactly on rays is hit on both of them, so that mirrored bodies have mirrored hits."""
    _, _, _, place = hits(tube(8, 4, 10, n=4), (-10, -10), 1.0)
    mirrored = np.column_stack([19 - place[:, 0], place[:, 1]])
    _, _, _, on_sides = hits(box((-8.5, -8.5, 0), (8.5, 8.5, 5)), (-10, -10), 1.0)
    assert sorted(place.tolist()) == sorted(mirrored.tolist())
    assert on_sides[:, 0].min() == 1
    assert on_sides[:, 0].max() == 18


def test_upright_walls_are_never_hit():
    """Walls exactly on the rays, or upright but for rounding, are no level surface."""
    cube = box((1, 1, 0), (9, 9, 20))
    for lean in (0, 1e-12, -1e-12, 1e-10, -1e-10):
        mesh = mesh_of(cube.vertices + lean * cube.vertices[:, 2:] * [1, 1, 0], cube.faces)
        _, points, _, place = hits(mesh, (0, 0), 2.0)
        np.testing.assert_allclose(np.minimum(np.abs(points[:, 2]), np.abs(points[:, 2] - 20)), 0, atol=1e-6)
        assert counts(place).max() == 2


@pytest.mark.parametrize("tilt", [0, 1e-10, -1e-10])
def test_side_along_a_row_of_rays_is_hit_all_along(tilt):
    """A side of a triangle on a row of rays, but for rounding, is hit by all of them, above or below the triangle."""
    for tip in (-5, 15):
        triangle = mesh_of([(0, 5 - tilt, 0), (20, 5 + tilt, 0), (10, tip, 0)], [0, 1, 2])
        _, _, _, place = hits(triangle)
        assert place[place[:, 1] == 2, 0].tolist() == list(range(10))


def test_long_thin_triangles_are_cheap_and_right():
    """Slivers across the whole lattice are hit where they are, without looking at the box around them."""
    turn = np.linspace(0, np.pi / 2, 2001)
    rim = 4000 * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    k = np.arange(1, 2001)
    fan = mesh_of(np.concatenate([np.zeros((1, 3)), rim]), np.column_stack([0 * k, k, k + 1]))
    _, points, _, place = hits(fan, (0, 0), 8.0)
    np.testing.assert_array_equal(counts(place), 1)
    assert len(points) == pytest.approx(np.pi / 4 * 500**2, rel=1e-3)


def test_rays_beside_the_mesh_hit_nothing():
    """Triangles between the rays, and meshes smaller than the lattice, give nothing."""
    face, points, uvs, _ = hits(box((0.1, 0.1, 0), (0.4, 0.4, 1)), pitch=2.0)
    assert len(face) == len(points) == len(uvs) == 0


@pytest.mark.parametrize(("beside", "met"), [(0.0, True), (0.9e-9, True), (1.2e-9, False)])
def test_an_edge_is_met_from_a_billionth_of_a_pitch_beside_it(beside, met):
    """A ray through an edge meets it in spite of rounding, and one a little farther away does not."""
    corners = np.array([[beside, -9, 0], [9, 0, 0], [beside, 9, 0]]) * 2.0
    columns = hits(mesh_of(corners, [[0, 1, 2]]), (-1.0, -1.0))[3][:, 0]
    assert (columns == 0).any() == met
    assert (columns == 1).any()
