"""Weights on a lattice in space."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.mesh import WeightField


def ramp():
    """Return a field whose weights are 1 + x + 10 y + 100 z in steps of the lattice."""
    z, y, x = np.mgrid[0:3, 0:4, 0:5]
    return WeightField(np.array([8.0, -4.0, 2.0]), 4.0, (1 + x + 10 * y + 100 * z).astype(np.float32))


def test_weights_between_points_of_the_lattice():
    """At a point lies its own weight, between them what is between, and 0 outside."""
    points = np.array([[8.0, -4, 2], [10, -4, 2], [12, 2, 8], [7, -4, 2], [8, -4, 11]])
    np.testing.assert_allclose(ramp().at(points), [1, 1.5, 1 + 1 + 15 + 150, 0, 0], atol=1e-5)


def test_a_scaled_field_goes_with_its_mesh():
    """The same weights lie at places that are scaled about the origin."""
    points = np.random.default_rng(0).uniform([8, -4, 2], [24, 8, 10], (50, 3))
    np.testing.assert_allclose(ramp().scaled(1.5).at(1.5 * points), ramp().at(points))


def test_points_of_the_lattice_have_their_own_weights():
    """The points are listed as the weights are."""
    np.testing.assert_allclose(ramp().at(ramp().points), ramp().values.reshape(-1))
