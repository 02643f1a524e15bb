"""The paper's pass-through types: how many corners of a cell lie inside the trajectory."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.measures.pass_through import corner_windings, pass_through_types
from legorize_addon.core.mesh.triangle_mesh import repair
from legorize_addon.core.slicing.coverage import covered_area_shares, cut_at_grid
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from tests.core.solids import joined, sphere, tube


def types_of(loops, n=12, corner=(0, 0), levels=None):
    """Classify the cells that closed polygons pass; return them with their numbers of inner corners."""
    loops = [np.asarray(loop, dtype=np.float64) for loop in loops]
    start, end = np.concatenate(loops), np.concatenate([np.roll(loop, -1, axis=0) for loop in loops])
    level = np.repeat(levels or [0] * len(loops), [len(loop) for loop in loops])
    corner = np.asarray(corner, dtype=np.float64)
    windings = corner_windings(start, end, level, corner=corner, n_levels=int(level.max()) + 1, n_y=n, n_x=n)
    pieces = cut_at_grid(start, end, corner)
    return pass_through_types(pieces, level[pieces.edge], windings)


def type_at(loops, x, y) -> int:
    """Return the type of one cell."""
    cell, inside = types_of(loops)
    [row] = np.flatnonzero((cell == (0, y, x)).all(axis=1))
    return int(inside[row])


def star(radii, x=48.0, y=48.0) -> np.ndarray:
    """Draw a polygon around a middle with the given radii, counter-clockwise."""
    turn = np.arange(len(radii)) * 2 * np.pi / len(radii)
    return np.array([x, y]) + np.asarray(radii)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)


FIXTURES = {
    # cuts through the cell from (40, 40) to (48, 48), the inside below and to the left of them
    1: [(8, 8), (76, 8), (8, 76)],
    2: [(8, 8), (86, 8), (86, 45), (8, 43)],
    3: [(8, 8), (84, 8), (8, 84)],
}


@pytest.mark.parametrize("number", FIXTURES)
def test_three_types(number):
    """A cut that leaves one, two or three corners of a cell inside is of that type, however it is turned."""
    loop = np.array(FIXTURES[number], dtype=np.float64) - [44, 44]
    for turn in range(4):
        rotation = np.array([[0, 1], [-1, 0]])
        turned = loop @ np.linalg.matrix_power(rotation, turn) + [44, 44]
        assert type_at([turned], 5, 5) == number


def test_tips_and_bays_hold_no_or_all_corners():
    """A tip that enters and leaves by one side has no corner inside, a bay all four; so does what stays in a cell."""
    assert type_at([[(44, 30), (46, 30), (45, 44)]], 5, 5) == 0
    assert type_at([[(41, 41), (47, 41), (44, 47)]], 5, 5) == 0
    hole = [(44, 44), (45, 46), (46, 44)]
    assert type_at([[(8, 8), (88, 8), (88, 88), (8, 88)], hole], 5, 5) == 4


def test_histogram_of_a_circle():
    """A circle has types 1 to 3 only, each on all four sides alike, and the two-cornered ones are the most."""
    cell, inside = types_of([star([44.7] * 720)])
    histogram = np.bincount(inside, minlength=5)
    assert histogram[[0, 4]].tolist() == [0, 0]
    assert (histogram[1:4] > 0).all()
    assert histogram[2] == histogram.max()
    number = np.zeros((12, 12), int)
    number[cell[:, 1], cell[:, 2]] = inside
    np.testing.assert_array_equal(number, number[::-1])
    np.testing.assert_array_equal(number, number[:, ::-1])


@given(st.lists(st.floats(5, 43), min_size=3, max_size=40), st.tuples(st.floats(-4, 4), st.floats(-4, 4)))
def test_corners_are_inside_as_the_polygon_has_them(radii, corner):
    """The number of inner corners is that of a plain point-in-polygon test, for just the cells that are passed."""
    # no corner of the grid lies on an edge between such points
    loop = np.add(star(radii), [0.1234567, 0.0765432])
    cell, inside = types_of([loop], 14, np.subtract(corner, 4))
    x, y = np.moveaxis((cell[:, None, [2, 1]] + [(0, 0), (1, 0), (0, 1), (1, 1)]) * 8.0 + np.subtract(corner, 4), 2, 0)
    (x0, y0), (x1, y1) = loop.T, np.roll(loop, -1, axis=0).T
    spans = (y0 < y[..., None]) != (y1 < y[..., None])
    right = x0 + (y[..., None] - y0) / np.where(y1 == y0, 1, y1 - y0) * (x1 - x0) > x[..., None]
    np.testing.assert_array_equal(inside, ((spans & right).sum(axis=2) % 2).sum(axis=1))


@given(st.lists(st.floats(5, 43), min_size=3, max_size=40))
def test_types_agree_with_the_coverage(radii):
    """Cells that nothing passes are wholly inside or outside, and their corners say which."""
    # no corner of the grid lies on an edge between such points
    loop = np.add(star(radii), [0.1234567, 0.0765432])
    start, end = loop, np.roll(loop, -1, axis=0)
    level = np.zeros(len(loop), dtype=np.int64)
    windings = corner_windings(start, end, level, corner=np.zeros(2), n_levels=1, n_y=12, n_x=12)[0]
    pieces = cut_at_grid(start, end, np.zeros(2))
    area = covered_area_shares(pieces, level[pieces.edge], 1, 12, 12)[0]
    passed = np.zeros((12, 12), dtype=bool)
    passed[pieces.cell[:, 1], pieces.cell[:, 0]] = True
    full = area > 32
    for corners in (windings[:-1, :-1], windings[1:, :-1], windings[:-1, 1:], windings[1:, 1:]):
        np.testing.assert_array_equal(corners[~passed] == 1, full[~passed])


def test_slices_and_overlaps():
    """Slices are classified by themselves; overlapping loops count as their union."""
    square = np.array([(12.0, 12), (52, 12), (52, 52), (12, 52)])
    cell, inside = types_of([square, square + 8, square], levels=[0, 0, 2])
    assert set(cell[:, 0].tolist()) == {0, 2}
    lone = types_of([square])
    np.testing.assert_array_equal(inside[cell[:, 0] == 2], lone[1])
    # the corner of the first square lies in the second: all of its cell is inside
    [row] = np.flatnonzero((cell == (0, 6, 6)).all(axis=1))
    assert inside[row] == 4


def test_loops_may_leave_the_grid():
    """Cells beside the grid are left out; those in it are classified as on a larger grid."""
    loop = star([43.7] * 90)
    whole, inside = types_of([loop])
    part, few = types_of([loop], 5, (24, 32))
    moved = part + np.array([0, 4, 3])
    kept = ((whole[:, 1:] >= [4, 3]) & (whole[:, 1:] < [9, 8])).all(axis=1)
    np.testing.assert_array_equal(moved, whole[kept])
    np.testing.assert_array_equal(few, inside[kept])


def test_points_pass_nothing():
    """An edge without length passes no cell."""
    cell, inside = types_of([np.zeros((1, 2))])
    assert len(cell) == len(inside) == 0


def test_meshes_are_classified_slice_by_slice():
    """On slices of a ball in a pipe every straight cut of a cell is of type 1, 2 or 3; few cells are of none."""
    mesh = joined(tube(60, 50, 40, centre=(0, 0, -20)), repair(sphere(16, 35.0))[0])
    outline = linked(mesh.faces, slice_mesh(mesh, np.linspace(-15, 15, 7)))
    level = outline.slice.astype(np.int64)
    corner = np.array([-72.0, -72])
    windings = corner_windings(outline.start, outline.ends, level, corner=corner, n_levels=7, n_y=18, n_x=18)
    pieces = cut_at_grid(outline.start, outline.ends, corner)
    cell, inside = pass_through_types(pieces, level[pieces.edge], windings)
    histogram = np.bincount(inside, minlength=5)
    assert histogram[1:4].sum() > 0.9 * histogram.sum()
    assert len(np.unique(cell, axis=0)) == len(cell)
    assert set(np.unique(windings).tolist()) == {0, 1}
