"""Where the grid lies: it holds the model with a free rim, keeps its symmetry, and stands on its first layer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.mesh.size import scale_mesh
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.slicing.coverage import covered_area
from legorize_addon.core.slicing.lattice import ALPHA, Grid, fit_grid
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from legorize_addon.core.units import BRICK, STUD
from tests.core.solids import box, joined, mesh_of, reversed_mesh, sheet, sphere
from tests.core.textured import table, turned_about_z

STEP = np.array([8.0, 8.0, 9.6])
"""Sides of a unit brick along x, y and z in mm, as the paper gives them."""

sides = st.floats(0.5, 500)
places = st.floats(-1e4, 1e4)


def corners(grid: Grid) -> tuple[np.ndarray, np.ndarray]:
    """Return the lowest and the highest corner of a grid in mm."""
    return grid.origin, grid.origin + STEP * grid.shape[::-1]


def extent(mesh: TriangleMesh) -> tuple[np.ndarray, np.ndarray]:
    """Return the corners of the box around a mesh."""
    return mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)


def moved(mesh: TriangleMesh, way) -> TriangleMesh:
    """Shift a mesh."""
    return replace(mesh, vertices=mesh.vertices + way)


def first_layer(mesh: TriangleMesh, grid: Grid) -> np.ndarray:
    """Return the area in mm^2 that the first layer covers of every cell, by many planes."""
    heights = grid.origin[2] + (np.arange(24) + 0.5) / 24 * BRICK
    area = covered_area(linked(mesh.faces, slice_mesh(mesh, heights)), 24, grid.origin[:2], grid.n_y, grid.n_x)
    return area.mean(axis=0)


@settings(max_examples=40)
@given(st.tuples(sides, sides, sides), st.tuples(places, places, places), st.booleans())
def test_grid_holds_the_mesh_with_a_free_rim(size, place, symmetric):
    """On every side at least one whole cell stays free; no layer is without the model."""
    mesh = box(place, np.add(place, size))
    low, high = extent(mesh)
    start, end = corners(fit_grid(mesh, symmetric=symmetric))
    assert (start[:2] <= low[:2] - STUD + 1e-6).all()
    assert (end[:2] >= high[:2] + STUD - 1e-6).all()
    assert start[2] == low[2]
    assert high[2] - 1e-6 <= end[2] < max(high[2], low[2] + 1e-6) + BRICK


@pytest.mark.parametrize("symmetric", [True, False])
def test_steps_are_a_stud_and_a_brick(symmetric):
    """A box of 13 x 6 studs and 7 bricks covers exactly so many cells and layers, all of them wholly."""
    mesh = box((3, -2, 5), np.array([3, -2, 5]) + STEP * [13, 6, 7])
    grid = fit_grid(mesh, symmetric=symmetric)
    covered = first_layer(mesh, grid)
    assert grid.n_layers == 7
    assert covered.sum() == pytest.approx(13 * 6 * 64)
    if symmetric:
        assert np.isclose(covered, 64).sum() == 13 * 6


@pytest.mark.parametrize("k", [10, 5, 2.5])
def test_size_follows_the_scale_factor(k):
    """At k = 10, 5 and 2.5 the layers and covered cells are those of the size times k / 10, but for one."""
    whole = box((0, 0, 0), (413, 277, 633.6))
    mesh = scale_mesh(whole, k / 10)
    grid = fit_grid(mesh, symmetric=True)
    half = first_layer(mesh, grid) >= 32
    counts = np.array([half.any(axis=0).sum(), half.any(axis=1).sum(), grid.n_layers])
    assert np.abs(counts - np.array([413 / 8, 277 / 8, 66]) * k / 10).max() <= 1
    np.testing.assert_array_equal(np.diff(np.flatnonzero(half.any(axis=0))), 1)


@settings(max_examples=40)
@given(st.tuples(sides, sides), st.tuples(places, places))
def test_symmetric_grid_has_the_middle_on_a_border_or_a_cell_centre(size, place):
    """The model's middle is the grid's; as many cells as the model is studs wide, even or odd."""
    mesh = box((*place, 0), (*np.add(place, size), 20))
    grid = fit_grid(mesh, symmetric=True)
    low, high = extent(mesh)
    start, end = corners(grid)
    np.testing.assert_allclose((start + end)[:2] / 2, (low + high)[:2] / 2, atol=1e-9)
    wide = (high - low)[:2] / STUD
    clear = np.abs(wide % 1 - 0.5) > 1e-6
    # what is thin has one row of cells around its middle
    rows = np.maximum(np.round(wide), 1 if wide.max() >= 0.5 else 0)
    np.testing.assert_array_equal((np.array([grid.n_x, grid.n_y]) - rows)[clear] % 2, 0)


@settings(max_examples=40)
@given(st.tuples(st.floats(170, 500), sides))
def test_literal_grid_starts_at_the_enlarged_rectangle(size):
    """Without symmetry cells begin at the corner of B; small models get one cell more in front of it."""
    mesh = box((0, 0, 0), (*size, 20))
    grid = fit_grid(mesh, symmetric=False)
    corner = -(ALPHA - 1) / 2 * np.array(size)
    assert grid.origin[0] == pytest.approx(corner[0])
    assert (corner[1] - grid.origin[1]) / STUD == pytest.approx(round((corner[1] - grid.origin[1]) / STUD), abs=1e-9)


@settings(max_examples=40)
@given(st.tuples(places, places, places), st.booleans())
def test_grid_moves_with_the_mesh(way, symmetric):
    """Where the model stands in the world does not matter."""
    mesh = sphere(4, 37.0)
    here, there = fit_grid(mesh, symmetric=symmetric), fit_grid(moved(mesh, way), symmetric=symmetric)
    assert here.shape == there.shape
    np.testing.assert_allclose(there.origin - here.origin, way, atol=1e-6)


# -------------------------------------------------------------- the first layer

TIP = [(0, 0), (70, 100), (40, 160), (0, 160)]
"""Profile of a bust on a cone of 70 degrees, its tip down."""


@pytest.mark.parametrize("profile", [TIP, [(0, 0), (6, 0), (60, 60), (0, 100)]])
@pytest.mark.parametrize("symmetric", [True, False])
def test_pointed_underside_stands_on_more_than_three_cells(profile, symmetric):
    """A bust that ends in a tip or a short pin is sunk until its first layer carries it."""
    mesh = turned_about_z(profile)
    grid = fit_grid(mesh, symmetric=symmetric)
    assert (first_layer(mesh, grid) >= 32).sum() > 3


@pytest.mark.parametrize("radius", [20, 40, 64, 200])
def test_ball_stands_on_more_than_three_cells(radius):
    """A ball of any size has a first layer that carries it."""
    mesh = sphere(24, float(radius))
    assert (first_layer(mesh, fit_grid(mesh, symmetric=True)) >= 32).sum() > 3


STEADY = {
    "box": box((0, 0, 0), (48, 32, 57.6)),
    "pillar": box((0, 0, 0), (16, 16, 96)),
    "table": table(),
    "table on thin legs": table(leg=4.0),
    "cup": joined(box((0, 0, 0), (48, 48, 48)), reversed_mesh(box((8, 8, 9.6), (40, 40, 40)))),
    "flat": box((0, 0, 0), (80, 80, 2)),
    "sheet": mesh_of(sheet().vertices * 80, sheet().faces),
    "wall": mesh_of(sheet().vertices[:, [0, 2, 1]] * 80, sheet().faces),
}


@pytest.mark.parametrize("name", STEADY)
def test_flat_undersides_stay_where_they_are(name):
    """What stands well on its lowest point is not sunk."""
    mesh = moved(STEADY[name], [0, 0, 123.4])
    assert fit_grid(mesh, symmetric=True).origin[2] == pytest.approx(123.4)


@settings(max_examples=40)
@given(st.floats(1, 90), st.floats(1, 90), st.floats(20, 200))
def test_at_most_one_brick_is_sunk(radius, width, height):
    """Whatever the underside, less than one brick is lost, in whole plates; all above stays in the grid."""
    mesh = turned_about_z([(0, 0), (radius, height / 3), (width, height / 2), (0, height)], n=12)
    grid = fit_grid(mesh, symmetric=True)
    plates = grid.origin[2] / 3.2
    assert round(plates) in range(4)
    assert plates == pytest.approx(round(plates), abs=1e-9)
    top = corners(grid)[1][2]
    assert height - 1e-6 <= top < height + BRICK


def test_leaning_model_is_sunk_for_its_balance():
    """A ball beside its pin falls over on the pin; the grid begins where the ball carries it."""
    ball = moved(sphere(16, 40.0), [0, 0, 46])
    mesh = joined(ball, moved(box((0, 0, 0), (8, 8, 20)), [24, 0, 2]))
    grid = fit_grid(mesh, symmetric=True)
    flat = fit_grid(moved(box((-40, -40, 2), (40, 40, 80)), 0), symmetric=True)
    assert grid.origin[2] > flat.origin[2]
