"""Meshes cut at heights stay what they were; drawn together, they keep their volume, and a shifted tower is aligned."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.islands import PHASES, find_islands
from legorize_addon.core.half_studs.moving import cut_at, draw_together
from legorize_addon.core.half_studs.regions import choose_regions
from legorize_addon.core.mesh import WeightField
from legorize_addon.core.slicing.lattice import fit_grid
from tests.core.half_studs.tower import BLOCK, table, tower
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


def drawn(mesh, half_of):
    """Draw a mesh together, with half studs by the layer of islands."""
    grid = fit_grid(mesh, symmetric=True, plates=True)
    islands = find_islands(mesh, grid)
    half = np.array([half_of(layer) for layer in islands.layer.tolist()])
    return draw_together(mesh, float(grid.origin[2]), islands, half)


def test_what_is_above_comes_back():
    """The tower is moved back by half a stud along x, the block stays but for the plate that leans below the tower."""
    mesh = tower()
    found = drawn(mesh, lambda layer: (int(layer >= BLOCK), 0))
    high = 9.6 * BLOCK
    above = found.vertices[:, 2] > high + 1e-9
    assert found.vertices[above, 0].min() == pytest.approx(8)
    # half a stud beside the tower nothing leans
    assert (found.vertices[~above, 0].min(), found.vertices[~above, 0].max()) == (0, 48)
    assert volume(found) == pytest.approx(volume(mesh), rel=0.01)
    assert (edges(found) == 2).all()


def test_a_cut_keeps_the_weights():
    """New vertices have the weight that belongs to their place."""
    mesh, rise = by_x(sphere(6))
    cut = cut_at(mesh, 0.123)
    assert len(cut.vertices) > len(mesh.vertices)
    np.testing.assert_allclose(cut.weight, rise(cut.vertices), atol=1e-12)


def test_features_move_with_their_surface():
    """The surface of a tower that comes back counts as much as it did before, and so does that of the block."""
    mesh = tower()
    shape = (14, 4, 10)
    places = np.arange(10) * 8.0 - 12
    field = WeightField(np.array([-12.0, -4, -4]), 8.0, np.broadcast_to(places, shape).astype(np.float32))
    found = drawn(replace(mesh, features=field), lambda layer: (int(layer >= BLOCK), 0))
    assert found.features is not None
    high = 9.6 * BLOCK
    np.testing.assert_allclose(found.features.at(np.array([[20.0, 8, high + 12], [20, 8, high - 12]])), [24, 20])


def test_a_leg_comes_back_alone():
    """Three legs and the top stay, the fourth one stands on the studs."""
    mesh = table(0.5)
    grid = fit_grid(mesh, symmetric=True, plates=True)
    islands = find_islands(mesh, grid)
    choice = choose_regions(islands, price=1.0, anywhere=False)
    found = draw_together(mesh, float(grid.origin[2]), islands, np.array(PHASES)[choice.off])
    low = found.vertices[:, 2] < 9.6
    assert sorted(set(np.round(found.vertices[low, 0], 6).tolist())) == [0, 16, 40, 48, 56, 64]
    top = found.vertices[:, 2] > 9.6 * BLOCK + 1e-6
    assert (found.vertices[top, 0].min(), found.vertices[top, 0].max()) == (0, 64)


def test_the_volume_of_a_ball_stays():
    """Cut and sheared, as much is inside."""
    ball = sphere(6, 30)
    found = drawn(ball, lambda layer: (int(layer >= 2), int(layer >= 2)))
    assert np.ptp(found.vertices[:, 0]) != np.ptp(ball.vertices[:, 0])
    assert volume(found) == pytest.approx(volume(ball), rel=0.01)
