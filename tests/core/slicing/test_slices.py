"""Planes through meshes: which heights, and segments that lie where they should."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh, repair
from legorize_addon.core.slicing.linking import successors
from legorize_addon.core.slicing.slices import adaptive_heights, slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from tests.core.solids import box, joined, mesh_of, sheet, sphere, tube, volume
from tests.core.textured import blob, torus, turned_about_z

OCTAHEDRON = mesh_of(
    [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]],
)


def middles(n, low, high) -> np.ndarray:
    """Return the middles of n slabs of one height."""
    return low + (np.arange(n) + 0.5) / n * (high - low)


def loop_areas_of(mesh, heights, axis=2) -> tuple[np.ndarray, np.ndarray]:
    """Cut a mesh; return the areas of all loops and their slices."""
    outline = linked(mesh.faces, slice_mesh(mesh, np.asarray(heights, dtype=np.float64), axis=axis))
    x, y = outline.start.T
    x1, y1 = outline.ends.T
    first = outline.loop_start[:-1]
    return np.add.reduceat(x * y1 - x1 * y, first) / 2, outline.slice[first]


def slice_areas(mesh, heights, axis=2) -> np.ndarray:
    """Cut a mesh; return the area inside the loops of every slice."""
    areas, slices = loop_areas_of(mesh, heights, axis)
    return np.bincount(slices, areas, len(heights))


def heights_for(mesh, *, n_layers, cusp=3.2, colour=None) -> np.ndarray:
    """Return how many planes every layer gets, standing on the ground."""
    colour = np.zeros(len(mesh.faces), np.int16) if colour is None else np.asarray(colour, np.int16)
    heights, layer, plate = adaptive_heights(mesh, ground=0.0, n_layers=n_layers, cusp=cusp, colour=colour)
    np.testing.assert_allclose(heights, layer * 9.6 + plate * 3.2 + 1.6)
    assert (np.diff(heights) > 0).all()
    count = np.bincount(layer, minlength=n_layers)
    # one plane is that of the middle plate
    assert (plate[np.isin(layer, np.flatnonzero(count == 1))] == 1).all()
    return count


# ------------------------------------------------------------------ segments


def test_cube_gives_one_square_a_plane():
    """Every plane through a cube has one loop, the square, counter-clockwise."""
    areas, slices = loop_areas_of(box((0, 0, 0), (10, 10, 10)), middles(7, 0, 10))
    np.testing.assert_allclose(areas, 100)
    assert slices.tolist() == list(range(7))


def test_plane_in_a_face_is_one_just_below_it():
    """A plane through the floor of a cube cuts nothing, one through its top the whole square, none a face."""
    cube = box((0, 0, 0), (10, 10, 10))
    slices = slice_mesh(cube, np.array([0.0, 5.0, 10.0]))
    assert np.bincount(slices.slice, minlength=3).tolist() == [0, 8, 8]
    assert slice_areas(cube, [0, 5, 10]).tolist() == [0, 100, 100]


def test_plane_through_a_step_is_one_just_below_it():
    """A plane in the horizontal ring of a stepped cylinder cuts the part below the ring."""
    stepped = turned_about_z([(0, 0), (20, 0), (20, 10), (10, 10), (10, 20), (0, 20)], n=32)
    disc = 16 * np.sin(np.pi / 16)
    np.testing.assert_allclose(slice_areas(stepped, [5, 10, 10 + 1e-9, 20]), disc * np.array([400, 400, 100, 100]))


def test_plane_through_vertices_only():
    """A plane through four corners of an octahedron is a closed square; through its lower tip, nothing."""
    slices = slice_mesh(OCTAHEDRON, np.array([-1.0, 0.0, 1.0]))
    assert np.bincount(slices.slice, minlength=3).tolist() == [0, 4, 4]
    assert (successors(OCTAHEDRON.faces, slices) >= 0).all()
    np.testing.assert_allclose(slice_areas(OCTAHEDRON, [-1, 0, 1]), [0, 2, 0], atol=1e-12)


@pytest.mark.parametrize("mesh", [repair(sphere(6, 30.0))[0], torus(30, 12, 24, 16), tube(), repair(blob(8, 40.0))[0]])
def test_planes_through_all_vertices(mesh):
    """With a plane through every vertex each triangle still meets a plane in one segment at most, and all link."""
    heights = np.unique(mesh.vertices[:, 2])
    slices = slice_mesh(mesh, heights)
    assert len(np.unique(slices.face.astype(np.int64) * len(heights) + slices.slice)) == len(slices)
    assert sorted(successors(mesh.faces, slices).tolist()) == list(range(len(slices)))


@given(st.lists(st.integers(-8, 8), min_size=1, max_size=12, unique=True), st.integers(0, 2))
def test_segments_run_through_their_triangle_and_plane(levels, axis):
    """Start and end lie on two sides of the triangle, at the height of the plane, the inside to the left."""
    mesh = repair(sphere(3, 8.0))[0]
    slices = slice_mesh(mesh, np.sort(np.array(levels, dtype=np.float64)), axis=axis)
    corners = mesh.vertices[mesh.faces[slices.face]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    plane = [(axis + 1) % 3, (axis + 2) % 3]
    segments = slices.segments
    for end in (0, 1):
        points = np.empty((len(slices), 3))
        points[:, axis] = slices.heights[slices.slice]
        points[:, plane] = segments[:, end]
        np.testing.assert_allclose(((points - corners[:, 0]) * normal).sum(axis=1), 0, atol=1e-9)
        sides = np.roll(corners, -1, axis=1) - corners
        areas = (np.cross(sides, points[:, None] - corners) * normal[:, None]).sum(axis=2)
        np.testing.assert_allclose(np.sort(areas, axis=1)[:, 0], 0, atol=1e-8)
    along = segments[:, 1] - segments[:, 0]
    assert (along[:, 1] * normal[:, plane[0]] - along[:, 0] * normal[:, plane[1]] >= -1e-9).all()


def test_image_coordinates_follow_the_points():
    """Where the image lies flat on x and y, the image coordinates of a segment's ends are its points."""
    mesh = repair(sphere(7, 20.0))[0]
    slices = slice_mesh(mesh, middles(9, -20, 20))
    np.testing.assert_allclose(slices.uvs(np.arange(len(slices))), slices.segments, atol=1e-12)
    some = np.array([5, 2, 40])
    np.testing.assert_array_equal(slices.segments[some], np.stack([slices.starts(some), slices.ends(some)], axis=1))


def test_first_finds_the_segment_of_a_triangle():
    """The first-index leads from triangle and plane to their segment."""
    slices = slice_mesh(torus(30, 12, 24, 16), middles(20, -12, 12))
    np.testing.assert_array_equal(slices.first[slices.face] + slices.slice, np.arange(len(slices)))


def test_planes_beside_the_mesh_cut_nothing():
    """Planes above and below, and no planes at all, give no segments."""
    assert len(slice_mesh(box(), np.array([-5.0, 7.0]))) == 0
    assert len(slice_mesh(box(), np.zeros(0))) == 0


# --------------------------------------------------------------------- areas


def test_areas_of_a_sphere():
    """Slices of a sphere of radius 40 a plate apart have the areas of circles within half a percent."""
    ball = repair(sphere(80, 40.0))[0]
    assert len(ball.faces) > 20_000
    heights = middles(25, -40, 40)
    np.testing.assert_allclose(slice_areas(ball, heights), np.pi * (1600 - heights**2), rtol=0.005)


def test_areas_of_a_torus():
    """Slices of a ring are an outer loop and an inner one, and the area between circles lies between them."""
    ring = torus(48, 20, 192, 96)
    heights = middles(21, -20, 20)
    areas, slices = loop_areas_of(ring, heights)
    np.testing.assert_array_equal(np.bincount(slices), 2)
    assert ((areas > 0) == (np.abs(areas) > np.pi * 48**2 * 0.99)).all()
    width = np.sqrt(400 - heights**2)
    np.testing.assert_allclose(slice_areas(ring, heights), 4 * np.pi * 48 * width, rtol=0.005)


def test_areas_of_a_tilted_plate():
    """A plate of 60 x 40 x 1 mm, tilted by 30 degrees, has slices of its thickness over the sine, 40 wide."""
    plate = box((-30, -20, -0.5), (30, 20, 0.5))
    sine, cosine = 0.5, np.sqrt(0.75)
    turned = mesh_of(plate.vertices @ np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]]), plate.faces)
    areas, _ = loop_areas_of(turned, middles(40, -14.5, 14.5))
    assert len(areas) == 40
    np.testing.assert_allclose(areas, 40 * 1 / sine)


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("name", ["tube", "torus", "blob"])
def test_volume_is_the_same_along_every_axis(name, axis):
    """The slices along each axis add up to the volume of the mesh."""
    mesh = {"tube": tube(n=256), "torus": torus(30, 12, 48, 24), "blob": repair(blob(10, 40.0))[0]}[name]
    low, high = mesh.vertices[:, axis].min(), mesh.vertices[:, axis].max()
    heights = middles(2000, low, high)
    total = slice_areas(mesh, heights, axis).sum() * (high - low) / len(heights)
    assert total == pytest.approx(volume(mesh), rel=2e-4)


# ---------------------------------------------------------- adaptive heights


def wedge(slope: float) -> TriangleMesh:
    """Make a pyramid whose four faces have normals with the given z, 48 mm high, its floor far below."""
    half = 48 * slope / np.sqrt(1 - slope * slope)
    tip, floor = [0, 0, 48], [[x, y, 0] for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]
    return mesh_of([*floor, tip], [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [0, 3, 2], [0, 2, 1]])


@pytest.mark.parametrize(("slope", "planes"), [(0.2, 1), (0.33, 1), (0.34, 3), (0.8, 3)])
def test_steep_slabs_need_one_plane_and_shallow_ones_three(slope, planes):
    """At a cusp of 3.2 mm a slab of 9.6 mm is cut three times where its normals lean by more than a third."""
    assert heights_for(wedge(slope), n_layers=5).tolist() == [planes] * 5


def test_planes_are_monotone_in_the_cusp():
    """There are one to three planes a layer, the fewer the larger the cusp: all of them at 0, the least at 9.6."""
    ball = repair(sphere(24, 48.0, (0, 0, 48)))[0]
    counts = [heights_for(ball, n_layers=10, cusp=cusp).sum() for cusp in (0, 0.1, 1, 2, 3.2, 5, 7, 9, 9.6)]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] == 30
    assert counts[-1] == 10
    assert len(set(counts)) > 4


@pytest.mark.parametrize(
    ("height", "planes"), [(9.6, 1), (9.6 + 1.5, 1), (9.6 + 1.7, 3), (9.6 + 4.8, 3), (19.2 - 1.5, 1)]
)
def test_horizontal_facet_inside_a_slab_forces_three_planes(height, planes):
    """A level top farther than half a plate from the slab's faces is cut three times, nearer ones once."""
    step = joined(box((0, 0, 0), (40, 40, 48)), box((40, 0, 0), (80, 40, height)))
    assert heights_for(step, n_layers=5).tolist() == [1, planes, 1, 1, 1]


def test_many_colours_force_three_planes():
    """Layers with walls in two colours, or with a wall that has several, are cut three times."""
    tower = joined(*(box((0, 0, 9.6 * i), (40, 40, 9.6 * (i + 1))) for i in range(3)))
    colour = np.repeat([4, 4, 4], 12)
    assert heights_for(tower, n_layers=3, colour=colour).tolist() == [1, 1, 1]
    colour[12 + 5] = 1
    assert heights_for(tower, n_layers=3, colour=colour).tolist() == [1, 3, 1]
    colour[24:] = -1
    assert heights_for(tower, n_layers=3, colour=colour).tolist() == [1, 3, 3]
    # floors and tops are level: no plane cuts them, so their colours do not matter
    level = np.where(np.ptp(tower.vertices[tower.faces][..., 2], axis=1) == 0, 14, 4)
    assert heights_for(tower, n_layers=3, colour=level).tolist() == [1, 1, 1]


def test_surface_below_the_ground_does_not_count():
    """A model that is sunk into the ground is looked at only above it."""
    pot = joined(wedge(0.8), box((-9, -9, 48), (9, 9, 96)))
    moved = mesh_of(pot.vertices - [0, 0, 48], pot.faces)
    assert heights_for(moved, n_layers=5).tolist() == [1] * 5


def test_layers_without_surface_have_one_plane():
    """Between two bodies, one above the other, there is nothing to cut finely."""
    pair = joined(box((0, 0, 0), (20, 20, 9.6)), box((0, 0, 38.4), (20, 20, 48)))
    assert heights_for(pair, n_layers=5).tolist() == [1] * 5


def test_sheets_are_cut_too():
    """An open sheet that leans is sliced into one segment or more a plane, all of the length of the sheet."""
    leaning = sheet(5, 4, lambda x, y: y)
    slices = slice_mesh(leaning, middles(6, 0, 1))
    length = np.linalg.norm(slices.segments[:, 1] - slices.segments[:, 0], axis=1)
    np.testing.assert_allclose(np.bincount(slices.slice, length), 1)
