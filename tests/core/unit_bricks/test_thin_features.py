"""What is thinner than half a cell is kept, connected, and not made thicker than it must be."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy import ndimage

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.unit_bricks import thin_features
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples
from legorize_addon.core.unit_bricks.thin_features import thin_cells
from tests.core.solids import box, joined, mesh_of, sphere
from tests.core.textured import stages, turned_about_z

UP = np.array([9.6, 8, 8])
"""Sides of a cell along layer, y and x in mm."""


def sheared(mesh: TriangleMesh, x: float, y: float = 0.0) -> TriangleMesh:
    """Lean a mesh over by a share of its height."""
    return mesh_of(mesh.vertices + mesh.vertices[:, 2:] * [x, y, 0], mesh.faces)


THIN = {
    "wall": box((0, 0, 0), (2, 160, 96)),
    "wall across": box((3.1, 0, 0), (163, 2, 96)),
    "leaning wall": sheared(box((0, 0, 0), (2, 120, 96)), 0.6),
    "leg": box((0, 0, 0), (3, 3, 96)),
    "leaning leg": sheared(box((0, 0, 0), (3, 3, 144)), 0.45, 0.3),
    "lying leg": sheared(box((0, 0, 0), (120, 3, 3)), 0),
    "round leg": turned_about_z([(0, 0), (1.5, 0), (1.5, 120), (0, 120)], n=12),
    "sheet": box((0, 0, 0), (160, 120, 1)),
    "needle": turned_about_z([(0, 0), (3.5, 0), (1, 150), (0, 150)], n=12),
}


def kept(mesh: TriangleMesh, *, keep_thin: bool) -> np.ndarray:
    """Return the cells of a mesh as whole bricks."""
    return stages(mesh).bricks(keep_thin=keep_thin).solid[:, 0]


@pytest.mark.parametrize("name", THIN)
def test_thin_things_vanish_without_the_guard(name):
    """By the rule of half a cell alone, next to nothing is left."""
    assert kept(THIN[name], keep_thin=False).sum() <= 2


@pytest.mark.parametrize("name", THIN)
def test_thin_things_are_kept_in_one_piece(name):
    """With the guard they are kept, all cells connected face to face."""
    solid = kept(THIN[name], keep_thin=True)
    assert solid.any()
    assert ndimage.label(solid)[1] == 1


@pytest.mark.parametrize("name", THIN)
def test_thin_things_are_kept_in_full(name):
    """The kept cells reach as far as the thing does, to within a cell, along every axis."""
    solid = kept(THIN[name], keep_thin=True)
    size = np.ptp(THIN[name].vertices, axis=0)[::-1]
    cells = np.array([np.ptp(np.nonzero(solid)[axis]) + 1 for axis in range(3)])
    assert np.abs(cells - np.maximum(size / UP, 1)).max() <= 1.01


def test_wall_has_no_holes_and_one_cell_of_thickness():
    """A wall of 2 mm, which lies on a cell border, becomes a wall one cell thick without a window."""
    solid = kept(THIN["wall"], keep_thin=True)
    assert (solid.sum(axis=2) <= 1).all()
    shown = solid.any(axis=2)
    layers, rows = np.flatnonzero(shown.any(axis=1)), np.flatnonzero(shown.any(axis=0))
    assert shown[layers[0] : layers[-1] + 1, rows[0] : rows[-1] + 1].all()


@pytest.mark.parametrize("lean", [0.3, 0.45, 0.7, 1.2, 2.0])
def test_leaning_wall_of_plates_has_no_holes(lean):
    """A wall of 1 mm that leans by less than a stud a plate is closed, level by level, and stands on itself."""
    found = stages(sheared(box((0, 0, 0), (1, 160, 96)), lean), cusp=0.1)
    made = replace(found, grid=found.grid.plates()).bricks().solid
    solid = made.reshape(-1, *made.shape[2:])
    rows = np.flatnonzero(solid.any(axis=(0, 2)))
    assert solid.any(axis=2)[1:-1, rows].all()
    assert (solid[1:] & solid[:-1]).any(axis=2)[1:-1, rows].all()


def test_sheet_has_no_holes():
    """A sheet of 1 mm becomes one layer without holes."""
    solid = kept(THIN["sheet"], keep_thin=True)
    assert solid.sum() >= 19 * 14
    assert (ndimage.binary_fill_holes(solid.any(axis=0)) == solid.any(axis=0)).all()
    assert (solid.sum(axis=0) <= 1).all()


@pytest.mark.parametrize("name", ["leg", "round leg", "leaning leg"])
def test_leg_is_as_thin_as_can_be(name):
    """A leg of 3 mm takes one cell a layer, and two where it steps aside."""
    solid = kept(THIN[name], keep_thin=True)
    count = solid.sum(axis=(1, 2))
    assert count.max() <= 3
    assert count.mean() <= 2.2


def test_legs_reach_from_the_ground_to_the_body():
    """A body on four thin legs stands on them: its cells and theirs are one piece down to the first layer."""
    legs = [box((x, y, 0), (x + 3, y + 3, 80)) for x in (1, 60) for y in (2, 40)]
    mesh = joined(*legs, box((0, 0, 76), (64, 48, 110)))
    solid = kept(mesh, keep_thin=True)
    assert ndimage.label(solid)[1] == 1
    assert ndimage.label(solid[0])[1] == 4
    # without them the model begins with its body
    body = kept(mesh, keep_thin=False)
    assert ndimage.label(body[0])[1] == 1
    assert len(body) < len(solid)


@pytest.mark.parametrize(
    "mesh",
    [box((0, 0, 0), (80, 64, 57.6)), sphere(16, 60.0), box((2.3, 1.1, 0.7), (85.1, 66.6, 50.3))],
    ids=["aligned box", "ball", "box"],
)
def test_thick_things_get_no_cells(mesh):
    """Surface that rounding puts up to half a cell outside the bricks is not lost."""
    np.testing.assert_array_equal(kept(mesh, keep_thin=True), kept(mesh, keep_thin=False))


def in_cells(cell, area) -> SurfaceSamples:
    """Make samples in the middle of cells."""
    cell = np.array(cell, np.int64).reshape(-1, 3)
    place = cell + 0.5
    return SurfaceSamples(place, place * 0, cell, place * 0 + 1.0, np.array(area, float), np.zeros(len(cell), np.int16))


def test_specks_are_left_out():
    """Surface below 12 mm^2 in a cell is no feature; from 12 on it is one."""
    solid = np.zeros((3, 3, 3), bool)
    assert not thin_cells(in_cells([1, 1, 1], [11.9]), solid).any()
    np.testing.assert_array_equal(np.argwhere(thin_cells(in_cells([1, 1, 1], [12.0]), solid)), [[1, 1, 1]])


def test_a_rim_needs_more_than_a_speck():
    """Right beside a brick, surface below 18 mm^2 adds no other one, as that would only make the rim ragged."""
    solid = np.zeros((3, 3, 3), bool)
    solid[1, 1, 0] = True
    # not within half a cell of the brick
    assert not thin_cells(far_in_cell([1, 1, 1], 17.9), solid).any()
    np.testing.assert_array_equal(np.argwhere(thin_cells(far_in_cell([1, 1, 1], 18.0), solid)), [[1, 1, 1]])


def far_in_cell(cell, area) -> SurfaceSamples:
    """Make one sample in the far half of a cell along x."""
    samples = in_cells(cell, [area])
    return replace(samples, place=samples.place + np.array([0, 0, 0.4]))


def test_surface_in_bricks_is_not_lost():
    """No cell is added for surface inside bricks, and none that is a brick already."""
    solid = np.zeros((3, 3, 4), bool)
    solid[1, 1, 1] = True
    added = thin_cells(in_cells([[1, 1, 1], [1, 1, 3]], [100.0, 100.0]), solid)
    np.testing.assert_array_equal(np.argwhere(added), [[1, 1, 3]])


def test_surface_below_the_first_layer_is_passed_over(monkeypatch):
    """A tip that is sunk below the ground, under a brick, neither adds cells nor goes on without end."""
    rounds = iter(range(100))
    lost_area = thin_features._lost_area

    def counted(*arguments):
        assert next(rounds, None) is not None
        return lost_area(*arguments)

    monkeypatch.setattr(thin_features, "_lost_area", counted)
    solid = np.zeros((3, 3, 3), bool)
    solid[0, 1, 1] = True
    sunk = in_cells([0, 1, 1], [500.0])
    sunk.place[0, 0] = -0.9
    sunk.normal[0] = [-0.2, 1, 0]
    assert not thin_cells(sunk, solid).any()


def test_nothing_adds_nothing():
    """Without samples there is nothing to keep."""
    assert not thin_cells(in_cells([], []), np.zeros((2, 2, 2), bool)).any()


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_half_a_cell_is_the_same_on_both_sides(axis):
    """Surface exactly half a cell beside a brick is near to it on both of two opposite sides, or on neither."""
    solid = np.zeros((5, 5, 5), bool)
    solid[2, 2, 2] = True
    added = []
    for side in (-1, 1):
        sample = in_cells([2, 2, 2], [100.0])
        sample.place[0, axis] += side
        sample.cell[0, axis] += side
        added.append(int(thin_cells(sample, solid).sum()))
    assert added[0] == added[1]
