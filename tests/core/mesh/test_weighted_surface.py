"""Weights at points of the surface, and in the cells that it goes through."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.mesh import cell_factors, emphasised, weight_at
from legorize_addon.core.units import PLATE, STUD
from tests.core.mesh.test_vertex_weights import by_x
from tests.core.solids import box, sphere


def test_points_have_the_weights_between_those_of_the_corners():
    """In a ball whose weight rises along x, that of any point of a face is that of its x."""
    mesh, rise = by_x(sphere(6, 10.0))
    share = np.random.default_rng(0).dirichlet((1, 1, 1), 200)
    face = np.arange(200) % len(mesh.faces)
    points = (share[:, :, None] * mesh.vertices[mesh.faces[face]]).sum(axis=1)
    np.testing.assert_allclose(weight_at(mesh, face, points), rise(points), atol=1e-9)
    assert weight_at(sphere(3), face[:1], points[:1]) is None


def test_a_point_beside_its_face_and_a_face_without_area():
    """Beside a face counts its nearest part; a face without area has the mean of its corners."""
    mesh = replace(box(), weight=np.array([1.0, 0, 0, 0, 0, 0, 0, 0]))
    # the corner 0 is at the origin, and face 0 has the corners 0, 2 and 1
    assert weight_at(mesh, np.array([0]), np.array([[-1.0, -1.0, 0]])) == pytest.approx(1.0)
    flat = replace(mesh, vertices=mesh.vertices * 0)
    assert weight_at(flat, np.array([0]), np.zeros((1, 3))) == pytest.approx(1 / 3)


def test_cells_count_by_the_surface_in_them():
    """Where one half of a block is painted, cells there count as often as is said, the others once."""
    mesh = box((0, 0, 0), (10 * STUD, 4 * STUD, 12 * PLATE))
    low = replace(mesh, weight=np.where(mesh.vertices[:, 0] == 0, 1.0, 0.0))
    corner, shape = np.array([-2 * STUD, -2 * STUD, 0]), (16, 8, 14)
    factors = cell_factors(emphasised(low, 3.0), corner, shape)
    # a block's walls rise from 1 to 0 along x: the cell in the middle of stud k has 1 - (k + .5) / 10
    np.testing.assert_allclose(factors[6, 2, 3:12], 1 + 3 * (1 - (np.arange(1, 10) + 0.5) / 10), atol=0.02)
    # beside the surface counts what is next to it, far from it nothing
    assert factors[6, 4, 1] > 3.5
    assert (factors[:, :, -1] < 1.3).all()
    assert factors[6, 4, 7] == 1
    assert (factors[15] == 1).all()


def test_nothing_painted_counts_once():
    """Without weights, or with weights of 0, all cells count once, bit for bit."""
    mesh = box((0, 0, 0), (16, 16, 16))
    assert emphasised(mesh, 3.0) is mesh
    assert emphasised(replace(mesh, weight=np.zeros(8)), 3.0).weight is None
    assert emphasised(replace(mesh, weight=np.ones(8)), 0.0).weight is None
    np.testing.assert_array_equal(emphasised(replace(mesh, weight=np.ones(8)), 2.0).weight, 2.0)
    assert (cell_factors(mesh, np.zeros(3), (2, 2, 2)) == 1).all()
