"""Weights of vertices survive repairs: merged, filled and unused vertices, in whatever order they come."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.mesh import repair, scale_mesh, turn_mesh
from tests.core.solids import box, joined, mesh_of, sphere, without


def by_x(mesh):
    """Return a mesh whose weight rises evenly from 0 to 1 along x, and that function of places."""
    low, high = mesh.vertices[:, 0].min(), mesh.vertices[:, 0].max()

    def rise(places):
        """Return the weight that belongs to places."""
        return (places[..., 0] - low) / (high - low)

    return replace(mesh, weight=rise(mesh.vertices)), rise


def test_weights_stay_at_their_places():
    """Of two balls, one of which is inside out, seams are welded and loose vertices dropped: weights go with places."""
    other = sphere(5, 2.0, (6, 0, 0))
    both = joined(sphere(5, 2.0), mesh_of(other.vertices, other.faces[:, ::-1]))
    mesh, rise = by_x(mesh_of(np.insert(both.vertices, 3, (1, 9, 9), axis=0), both.faces + (both.faces >= 3)))
    found, repairs = repair(mesh)
    assert repairs.turned == 1
    assert repairs.welded > 0
    assert len(found.weight) == len(found.vertices) < len(mesh.vertices)
    np.testing.assert_allclose(found.weight, rise(found.vertices), atol=1e-9)
    scaled = turn_mesh(scale_mesh(found, 3.0), "y")
    np.testing.assert_array_equal(scaled.weight, found.weight)


def test_a_filled_hole_takes_the_weights_of_its_rim():
    """The vertex in the middle of a hole that is filled has the mean of those around it, not 0."""
    whole = sphere(120, 1.0)
    top = np.flatnonzero(np.isclose(whole.vertices, (0, 0, 1)).all(axis=1))
    mesh = without(whole, *np.flatnonzero(np.isin(whole.faces, top).any(axis=1)))
    mesh = replace(mesh, weight=np.full(len(mesh.vertices), 0.75))
    found, repairs = repair(mesh)
    assert repairs.filled == 1
    np.testing.assert_allclose(found.weight, 0.75)


def test_merged_vertices_have_the_greatest_weight():
    """Of two boxes side by side only one is painted: where they touch, the paint stays."""
    both = joined(box(), box((1, 0, 0), (2, 1, 1)))
    mesh = replace(both, weight=np.repeat([1.0, 0.0], 8))
    found, _ = repair(mesh)
    np.testing.assert_array_equal(found.weight, np.where(found.vertices[:, 0] <= 1, 1.0, 0.0))


@pytest.mark.parametrize("bad", [-0.1, 1.1, np.nan, np.inf])
def test_weights_that_are_none_are_refused(bad):
    """One sentence says how many are wrong."""
    weight = np.zeros(8)
    weight[3] = bad
    with pytest.raises(MeshError, match=r"^1 of 8 weights are not from 0 to 1: paint them again\.$"):
        repair(replace(box(), weight=weight))
    with pytest.raises(MeshError, match=r"^There are 7 weights for 8 vertices"):
        repair(replace(box(), weight=weight[:7]))


def test_without_weights_there_are_none():
    """A mesh that nobody has painted has no weights after its repair."""
    assert repair(box())[0].weight is None
