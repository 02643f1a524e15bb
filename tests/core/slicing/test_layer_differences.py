"""Layers whose trajectories differ from those of their neighbours."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.slicing.lattice import fit_grid
from legorize_addon.core.slicing.layer_differences import Marks, differing_layers
from tests.core.solids import box, joined, sphere
from tests.core.textured import turned_about_z


def marks(mesh, tolerance=0.1) -> Marks:
    """Compare the layers of a mesh."""
    return differing_layers(mesh, fit_grid(mesh, symmetric=True), tolerance=tolerance)


def test_box_needs_no_plates():
    """The layers of an upright box are alike."""
    assert not marks(box((0, 0, 0), (64, 48, 96))).any.any()


def test_ball_needs_plates_towards_its_poles():
    """On a ball lengths and areas differ near the poles, not at the equator, and areas sooner than lengths."""
    found = marks(sphere(24, 96.0, centre=(0, 0, 96)))
    assert found.area[[0, -1]].all()
    assert found.length[[0, -1]].all()
    assert not found.any[len(found.any) // 2]
    assert found.area.sum() > found.length.sum() > 0
    assert not found.number.any()


def test_cone_by_the_tolerance():
    """A cone loses a known share of its length and area from layer to layer: marked by a smaller tolerance only."""
    n, radius = 10, 160.0
    mesh = turned_about_z([(0, 0), (radius, 0), (radius / 2, n * 9.6), (0, n * 9.6)], n=96)
    middle = radius * (1 - (np.arange(n) + 0.5) / (2 * n))
    least = 1 - (middle[1:] / middle[:-1]).max()
    assert marks(mesh, least * 0.99).length.all()
    greatest = 1 - (middle[1:] / middle[:-1]).min()
    assert not marks(mesh, greatest * 1.01).length.any()
    assert marks(mesh, greatest * 1.01).area.all()


def test_legs_differ_in_number_from_what_they_carry():
    """Where four legs become one top the number differs; both layers are marked, those beside them are not."""
    legs = [box((x, y, 0), (x + 16, y + 16, 48)) for x in (0, 48) for y in (0, 48)]
    found = marks(joined(*legs, box((0, 0, 48), (64, 64, 96))))
    np.testing.assert_array_equal(np.flatnonzero(found.number), [4, 5])


def test_moved_polygons_have_no_partner():
    """A block far aside of the one below is no partner of it, though both layers have one polygon."""
    found = marks(joined(box((0, 0, 0), (8, 8, 19.2)), box((400, 0, 19.2), (408, 8, 38.4))))
    np.testing.assert_array_equal(found.number, [False, True, True, False])
    assert not found.area.any()
