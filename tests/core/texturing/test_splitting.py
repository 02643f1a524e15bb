"""Triangles cut without tearing the surface."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.texturing.splitting import Triangles, split_edges
from tests.core.solids import sphere


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1), st.floats(0, 1))
def test_any_edges_may_be_cut(seed, share) -> None:
    """Whatever edges are marked, the surface stays closed, its area and normals stay, and image coordinates follow."""
    mesh = sphere(4)
    triangles = Triangles(mesh.vertices, mesh.faces.astype(np.int64), mesh.vertices[mesh.faces][..., :2])
    # vertices at one place are one here, so that a tear would show
    place, number = np.unique(np.round(mesh.vertices, 9), axis=0, return_inverse=True)
    triangles = Triangles(place, number.reshape(-1)[triangles.faces], triangles.uvs)
    marked = np.random.default_rng(seed).random(triangles.faces.shape) < share
    parts, owner = split_edges(triangles, marked)
    ends = np.stack([parts.faces, np.roll(parts.faces, -1, axis=1)], axis=2).reshape(-1, 2)
    there, back = ({tuple(pair) for pair in each} for each in (ends.tolist(), ends[:, ::-1].tolist()))
    assert len(there) == len(ends)
    assert there == back
    corners = parts.vertices[parts.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    whole = place[triangles.faces]
    expected = np.cross(whole[:, 1] - whole[:, 0], whole[:, 2] - whole[:, 0])
    summed = np.stack([np.bincount(owner, normals[:, axis], len(whole)) for axis in range(3)], axis=1)
    np.testing.assert_allclose(summed, expected, atol=1e-9)
    assert ((normals * expected[owner]).sum(axis=1) > 0).all()
    np.testing.assert_allclose(parts.uvs, corners[..., :2], atol=1e-9)


def test_marked_edges_are_halved() -> None:
    """A triangle with all edges marked becomes four of half the sides; one without stays."""
    triangles = Triangles(np.array([(0, 0, 0), (4, 0, 0), (0, 3, 0.0)]), np.array([[0, 1, 2]]), np.zeros((1, 3, 2)))
    parts, owner = split_edges(triangles, np.array([[True, True, True]]))
    assert owner.tolist() == [0] * 4
    np.testing.assert_allclose(np.sort(parts.sides(), axis=1), np.tile([1.5, 2, 2.5], (4, 1)))
    np.testing.assert_array_equal(split_edges(triangles, np.zeros((1, 3), bool))[0].faces, triangles.faces)


def test_weights_are_cut_with_their_edges() -> None:
    """The middle of an edge has the mean of the weights of its ends."""
    corners = np.array([(0, 0, 0), (4, 0, 0), (0, 3, 0.0)])
    triangles = Triangles(corners, np.array([[0, 1, 2]]), np.zeros((1, 3, 2)), corners[:, 0] / 4)
    parts, _ = split_edges(triangles, np.array([[True, True, True]]))
    np.testing.assert_allclose(parts.weight, parts.vertices[:, 0] / 4)
