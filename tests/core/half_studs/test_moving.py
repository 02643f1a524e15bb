"""Meshes cut at heights stay what they were; drawn together, they keep their volume, and a shifted tower is aligned."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.half_studs.moving import cut_at, draw_together
from legorize_addon.core.half_studs.planes import Plane
from tests.core.half_studs.tower import BLOCK, tower
from tests.core.mesh.test_vertex_weights import by_x
from tests.core.solids import sphere


def volume(mesh):
    """Return the volume of a closed mesh."""
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def edges(mesh):
    """Return how many faces each edge has, by the places of its ends."""
    which = np.unique(np.round(mesh.vertices, 9) + 0.0, axis=0, return_inverse=True)[1].reshape(-1)[mesh.faces]
    ends = np.sort(np.concatenate([which[:, [0, 1]], which[:, [1, 2]], which[:, [2, 0]]]), axis=1)
    return np.unique(ends, axis=0, return_counts=True)[1]


# 0.5 goes through vertices of the sphere's middle ring, too
@pytest.mark.parametrize("height", [-0.9, -0.31, 0.0, 0.123, 0.5])
def test_a_cut_leaves_the_surface_where_it_is(height):
    """No triangle reaches across the height any more; area, volume and closedness stay, and so does the texture."""
    mesh = sphere(6)
    cut = cut_at(mesh, height)
    z = cut.vertices[cut.faces][:, :, 2]
    assert not ((z < height - 1e-12) & (z.max(axis=1, keepdims=True) > height + 1e-12)).any()
    assert np.linalg.norm(cut.normals, axis=1).sum() == pytest.approx(np.linalg.norm(mesh.normals, axis=1).sum())
    assert volume(cut) == pytest.approx(volume(mesh))
    assert (edges(cut) == 2).all()
    # the texture of solids says where their vertices are
    np.testing.assert_allclose(cut.uvs, cut.vertices[cut.faces][..., :2], atol=1e-12)
    assert len(cut.face_image) == len(cut.faces)


def test_what_is_above_a_plane_comes_back():
    """The tower is moved back by half a stud along x, the block stays, the volume is the same."""
    mesh = tower()
    drawn = draw_together(mesh, 0.0, (Plane(3 * BLOCK, (1, 0)),))
    high = 9.6 * BLOCK
    above = drawn.vertices[:, 2] > high + 1e-9
    assert drawn.vertices[above, 0].min() == pytest.approx(8)
    below = drawn.vertices[:, 2] < high - 3.2 + 1e-9
    assert (drawn.vertices[below, 0].min(), drawn.vertices[below, 0].max()) == (0, 48)
    assert volume(draw_together(sphere(6, 30), -30.0, (Plane(6, (1, 1)), Plane(12, (0, 1))))) == pytest.approx(
        volume(sphere(6, 30))
    )


def test_without_planes_a_mesh_stays():
    """The same object comes back."""
    mesh = sphere(3)
    assert draw_together(mesh, 0.0, ()) is mesh


def test_a_cut_keeps_the_weights():
    """New vertices have the weight that belongs to their place."""
    mesh, rise = by_x(sphere(6))
    cut = cut_at(mesh, 0.123)
    assert len(cut.vertices) > len(mesh.vertices)
    np.testing.assert_allclose(cut.weight, rise(cut.vertices), atol=1e-12)
