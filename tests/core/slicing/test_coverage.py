"""Edges cut at the grid, and the exact area of every cell inside the loops."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.triangle_mesh import repair
from legorize_addon.core.slicing.coverage import Pieces, covered_area, covered_area_shares, cut_at_grid
from legorize_addon.core.slicing.lattice import ALPHA, Grid
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from legorize_addon.core.unit_bricks.generation import half_covered
from legorize_addon.core.unit_bricks.surface_samples import inner_cells
from tests.core.solids import box, joined, reversed_mesh, sphere
from tests.core.textured import stages, torus

TOLERANCE = 64e-12
"""A cell's area is right to a millionth of a millionth of the cell."""


def pieces_of(loops, corner=(0, 0)) -> Pieces:
    """Cut closed polygons at the grid."""
    loops = [np.asarray(loop, dtype=np.float64) for loop in loops]
    return cut_at_grid(
        np.concatenate(loops), np.concatenate([np.roll(loop, -1, axis=0) for loop in loops]), np.asarray(corner, float)
    )


def cover(loops, n_y=12, n_x=12, corner=(0, 0)) -> np.ndarray:
    """Return the area of every cell inside closed polygons, (n_y, n_x)."""
    pieces = pieces_of(loops, corner)
    return covered_area_shares(pieces, np.zeros(len(pieces.edge), dtype=np.int64), 1, n_y, n_x)[0]


def rectangle(x0, y0, x1, y1) -> np.ndarray:
    """Return the corners of a rectangle, counter-clockwise."""
    return np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], dtype=np.float64)


def star(radii, x=48.0, y=48.0) -> np.ndarray:
    """Draw a polygon around a middle with the given radii, counter-clockwise."""
    turn = np.arange(len(radii)) * 2 * np.pi / len(radii)
    return np.array([x, y]) + np.asarray(radii)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)


def area_of(loop) -> float:
    """Return the signed area of a polygon."""
    (x, y), (x1, y1) = np.asarray(loop).T, np.roll(loop, -1, axis=0).T
    return float((x * y1 - x1 * y).sum() / 2)


radii = st.lists(st.floats(5, 45), min_size=3, max_size=40)
shifts = st.tuples(st.floats(-30, 30), st.floats(-30, 30))


# ------------------------------------------------------------------ pieces


@given(radii, shifts)
def test_pieces_add_up_to_their_edges(distances, corner):
    """The pieces of an edge come one after the other and are as long together; each lies in its cell."""
    loop = star(distances)
    pieces = pieces_of([loop], corner)
    assert (np.diff(pieces.edge) >= 0).all()
    length = np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1)
    np.testing.assert_allclose(np.bincount(pieces.edge, pieces.length), length, rtol=1e-12)
    for end in (pieces.middle - pieces.along / 2, pieces.middle + pieces.along / 2):
        assert (end >= pieces.cell - 1e-6).all()
        assert (end <= pieces.cell + 1 + 1e-6).all()
    start = pieces.middle - pieces.along / 2
    first = np.flatnonzero(np.diff(pieces.edge, prepend=-1))
    np.testing.assert_allclose(start[first], (loop - corner) / 8, atol=1e-9)
    later = np.delete(np.arange(len(start)), first)
    np.testing.assert_allclose(start[later], (pieces.middle + pieces.along / 2)[later - 1], atol=1e-9)


@pytest.mark.parametrize("nudge", [0.0, 1e-9, -1e-9])
def test_edges_on_grid_lines_belong_to_the_inside(nudge):
    """Edges along grid lines, but for rounding, count for the cells on their left: inside, and outside of a hole."""
    body, hole = rectangle(16, 24, 56, 64), rectangle(32, 40, 48, 56)[::-1]
    inside, around = pieces_of([body + nudge]), pieces_of([hole + nudge])
    # where sides lie beside their lines, their ends reach a hair into the next cells
    passed = [set(map(tuple, pieces.cell[pieces.length > 1e-6].tolist())) for pieces in (inside, around)]
    assert passed[0] == {(x, y) for x in range(2, 7) for y in range(3, 8) if x in (2, 6) or y in (3, 7)}
    assert passed[1] == {(x, y) for x in (4, 5) for y in (4, 7)} | {(x, y) for x in (3, 6) for y in (5, 6)}


# ---------------------------------------------------------------- coverage


@pytest.mark.parametrize("seed", range(6))
def test_coverage_is_that_of_shapely(seed):
    """Every cell of a polygon with a hole has the area of its intersection as shapely finds it."""
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(seed)
    outer, hole = star(rng.uniform(25, 45, 30)), star(rng.uniform(3, 20, 12), 50, 45)[::-1]
    corner = rng.uniform(-8, 0, 2)
    found = cover([outer, hole], 14, 14, corner)
    shape = shapely.Polygon(outer, [hole])
    x, y = corner[:, None] + 8 * np.arange(14)
    cells = shapely.box(x[None, :], y[:, None], x[None, :] + 8, y[:, None] + 8)
    np.testing.assert_allclose(found, shapely.area(shapely.intersection(shape, cells)), rtol=0, atol=TOLERANCE)
    assert (found > 63).any()
    assert ((found > 1) & (found < 63)).any()


@given(radii, shifts)
def test_cells_add_up_to_the_polygon(distances, corner):
    """The areas of all cells are the area of the polygon, wherever the grid lies."""
    loop = star(distances)
    assert cover([loop], 20, 20, corner=np.subtract(corner, 30)).sum() == pytest.approx(area_of(loop), rel=1e-12)


@pytest.mark.parametrize("nudge", [0, 1e-15, 1e-12, 1e-9, 3e-8, 1e-6])
def test_edges_near_grid_lines_are_exact(nudge):
    """A rectangle whose sides lie on grid lines, or a hair beside them, covers its cells exactly."""
    for way in (-1, 1):
        x0, y0, x1, y1 = np.array([16, 24, 56, 64]) + way * nudge * np.array([1, -1, -1, 1])
        grid = 8.0 * np.arange(13)
        across = np.clip(np.minimum(grid[1:], x1) - np.maximum(grid[:-1], x0), 0, 8)
        up = np.clip(np.minimum(grid[1:], y1) - np.maximum(grid[:-1], y0), 0, 8)
        np.testing.assert_allclose(cover([rectangle(x0, y0, x1, y1)]), up[:, None] * across, rtol=0, atol=TOLERANCE)


def test_corners_a_hair_beyond_a_grid_line_are_exact():
    """A polygon whose tips reach just over grid lines gives their rows no more than that."""
    tip = 16 + 5e-8
    triangle = np.array([(20.0, 40), (44, 40), (32, tip - 1e-7)])
    found = cover([triangle])
    assert found[1].sum() < 1e-12
    assert found.sum() == pytest.approx(area_of(triangle), rel=1e-13)


@given(radii, radii)
def test_coverage_is_additive(one, other):
    """Two loops together cover what they cover one by one; a loop run backwards takes it away again."""
    a, b = star(one), star(other, 40, 52)
    np.testing.assert_allclose(cover([a, b]), cover([a]) + cover([b]), atol=1e-9)
    np.testing.assert_allclose(cover([a, b, a[::-1]]), cover([b]), atol=1e-9)


@given(radii, shifts)
def test_moving_the_grid_is_moving_the_polygon_back(distances, shift):
    """Coverage depends only on where the polygon lies relative to the grid's corner; whole cells move the array."""
    loop = star(distances)
    np.testing.assert_allclose(cover([loop + shift], corner=shift), cover([loop]), atol=1e-9)
    np.testing.assert_allclose(cover([loop], 14, 14, corner=(-16, -8))[1:13, 2:], cover([loop]), atol=1e-9)


@given(radii, st.tuples(st.integers(-3, 9), st.integers(-3, 9)))
def test_loops_may_leave_the_grid(distances, offset):
    """What lies beside the grid does not count and does not disturb: a small grid is a window on a large one."""
    loop = star(distances)
    large = cover([loop], 30, 30, corner=(-72, -72))
    x, y = offset
    small = cover([loop], 5, 4, corner=(8 * x, 8 * y))
    np.testing.assert_allclose(small, large[9 + y :][:5, 9 + x :][:, :4], atol=1e-9)


def test_slices_are_covered_one_by_one():
    """Each slice of a torus and of a box with a cavity covers its own level, with the area of the solid."""
    ring = torus(40, 15, 48, 24)
    heights = np.linspace(-14, 14, 9)
    outline = linked(ring.faces, slice_mesh(ring, heights))
    found = covered_area(outline, len(heights), np.array([-60.0, -60]), 15, 15)
    areas = np.add.reduceat(
        np.cross(np.insert(outline.start, 2, 0, 1), np.insert(outline.ends, 2, 0, 1))[:, 2], outline.loop_start[:-1]
    )
    expected = np.bincount(outline.slice[outline.loop_start[:-1]], areas / 2, len(heights))
    np.testing.assert_allclose(found.sum(axis=(1, 2)), expected)
    shell = joined(box((0, 0, 0), (40, 40, 40)), reversed_mesh(box((8, 8, 8), (32, 32, 32))))
    found = covered_area(linked(shell.faces, slice_mesh(shell, np.array([4.0, 20.0]))), 2, np.zeros(2), 5, 5)
    np.testing.assert_allclose(found[0], 64)
    np.testing.assert_allclose(found[1], np.pad(np.zeros((3, 3)), 1, constant_values=64))


def test_overlapping_bodies_cover_a_cell_once():
    """Where bodies overlap a cell is not covered more than wholly."""
    pair = joined(box((0, 0, 0), (24, 24, 9)), box((8, 8, 0), (32, 32, 9)))
    found = covered_area(linked(pair.faces, slice_mesh(pair, np.array([5.0]))), 1, np.zeros(2), 4, 4)[0]
    assert found.max() == 64
    assert found.sum() == pytest.approx(2 * 576 - 256)


# ------------------------------------------ what the paper does with the cells


@pytest.mark.parametrize(("covered_by", "valid"), [(31.9, False), (32.0, True), (32.1, True)])
def test_half_covered_cells_are_valid(covered_by, valid):
    """A cell with 31.9 mm^2 inside is no unit brick; with 32.0 and 32.1 mm^2 it is one."""
    found = cover([rectangle(16 - covered_by / 8, 8, 48, 40)], 8, 8)
    assert found[2, 1] == pytest.approx(covered_by)
    assert half_covered(found / 64)[2, 1] == valid


@pytest.mark.parametrize("offset", [0.5, 3.0, 3.9875, 4.0, 4.0125, 6.0, 7.5])
def test_shifted_square_falls_back_to_the_inner_cell(offset):
    """A square's edge at d into a cell bounds that cell if (8 - d) 8 >= 32 mm^2, else the next one inwards."""
    # the square's four edges lie at d into the outermost of 10 x 10 cells
    square = box((offset, offset, 0), (80 - offset, 80 - offset, 9.6))
    built = stages(square, grid=Grid(np.array([-8.0, -8, 0]), 1, 12, 12))
    pieces, level = built.pieces()
    area = covered_area_shares(pieces, level[pieces.edge], len(built.layer), 12, 12)
    assert area[0, 6, 1] == pytest.approx((8 - offset) * 8)
    solid = half_covered(area / 64)
    samples = built.steep()
    found = inner_cells(samples, solid)
    depth = 0 if (8 - offset) * 8 >= 32 else 1
    for outermost, inwards in ((1, 1), (10, -1)):
        # without the corners, where less of the cells is covered
        straight = (samples.cell[:, 2] == outermost) & (samples.cell[:, 1] > 2) & (samples.cell[:, 1] < 9)
        assert straight.sum() >= 6
        expected = samples.cell[straight] + [0, 0, depth * inwards]
        np.testing.assert_array_equal(found[straight], np.ravel_multi_index(tuple(expected.T), solid.shape))


def tiny_pieces(loops, alpha) -> int:
    """Count the pieces in the partial cells at the rim of the rectangle B, enlarged by alpha."""
    points = np.concatenate(loops)
    low, high = points.min(axis=0), points.max(axis=0)
    corner = (low + high) / 2 - alpha * (high - low) / 2
    whole = np.floor(alpha * (high - low) / 8)
    cell = pieces_of(loops, corner).cell
    return int(((cell < 0) | (cell >= whole)).any(axis=1).sum())


@pytest.mark.parametrize("size", [163.0, 205.5, 317.25])
def test_no_trajectory_passes_tiny_cells_of_the_enlarged_rectangle(size):
    """With alpha = 1.1 no piece of trajectory lies in the partial cells at the rim of B; with 1.0 some do."""
    ball = repair(sphere(8, size / 2))[0]
    outline = linked(ball.faces, slice_mesh(ball, np.linspace(-0.4, 0.4, 9) * size))
    loops = np.split(outline.start, outline.loop_start[1:-1])
    assert tiny_pieces(loops, ALPHA) == 0
    assert tiny_pieces(loops, 1.0) > 0
