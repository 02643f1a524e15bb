"""Winding and outsides: floods, rays, and which patches are turned."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh import orientation as mesh_orientation
from legorize_addon.core.mesh.orientation import consistent_winding, surrounding
from legorize_addon.core.mesh.topology import areas_and_longest_sides, edges_of
from tests.core.solids import BOX_FACES, box, joined, moebius, sphere


def winding_of(mesh):
    """Wind a mesh, its vertices as they are."""
    area, _ = areas_and_longest_sides(mesh.vertices[mesh.faces])
    return consistent_winding(edges_of(mesh.faces), area)


@given(st.lists(st.booleans(), min_size=12, max_size=12))
def test_flips_make_all_neighbours_agree_and_turn_the_smaller_share(turn):
    """Every edge is run both ways afterwards; at most half of the box is turned (its faces are equal)."""
    faces = BOX_FACES.copy()
    faces[turn] = faces[turn][:, ::-1]
    winding = consistent_winding(edges_of(faces), np.ones(12))
    assert winding.flip.sum() <= 6
    faces[winding.flip] = faces[winding.flip][:, ::-1]
    edges = edges_of(faces)
    assert (np.add.reduceat(np.where(edges.forward[edges.order], 1, -1), edges.start[:-1]) == 0).all()
    assert winding.patch.tolist() == [0] * 12
    assert not winding.one_sided.any()


def test_patches_are_numbered_by_their_first_face():
    """Two boxes whose faces take turns, one of them with a face turned."""
    faces = joined(box(), box()).faces.reshape(2, 12, 3).swapaxes(0, 1).reshape(-1, 3).copy()
    faces[4] = faces[4][::-1]
    winding = consistent_winding(edges_of(faces), np.ones(24))
    assert winding.patch.tolist() == [0, 1] * 12
    assert np.flatnonzero(winding.flip).tolist() == [4]


def test_a_moebius_strip_has_one_side():
    """And a strip beside it that is a box has two."""
    winding = winding_of(joined(moebius(), box()))
    assert winding.one_sided.tolist() == [True, False]
    assert not winding.flip.any()


SHELLS = joined(
    box((0, 0, 0), (8, 8, 8)), box((1, 1, 1), (7, 7, 7)), sphere(3, 2.0, (4, 4, 4)), box((20, 0, 0), (21, 1, 1))
)
PATCH = np.repeat([0, 1, 2, 3], [12, 12, 108, 12])


@pytest.mark.parametrize("chunk", [7, 1 << 22])
def test_surrounding_counts_the_shells_around_a_point(monkeypatch, chunk):
    """Nested shells, one beside, a point's own, points right below edges; in pieces or at once."""
    monkeypatch.setattr(mesh_orientation, "RAYS_AT_ONCE", chunk)
    points = np.array(
        [[4, 4, 4], [4.1, 3.7, 4.2], [4, 4, 4], [0.5, 4, 4], [4, 4, 7.5], [9, 4, 4], [20.5, 0.5, 0.5], [4, 4, -1]]
    )
    own = np.array([9, 2, 0, 9, 9, 9, 9, 9])
    found = surrounding(points.astype(float), own, SHELLS.vertices[SHELLS.faces], PATCH)
    assert found.tolist() == [3, 2, 2, 1, 1, 0, 1, 0]


@given(st.integers(0, 2**32 - 1))
def test_surrounding_agrees_with_the_boxes_themselves(seed):
    """Random boxes and points, many on the boxes' edges and corners in x and y."""
    random = np.random.default_rng(seed)
    lows = random.integers(0, 5, (4, 3))
    highs = lows + random.integers(1, 5, (4, 3))
    shells = joined(*(box(low, high) for low, high in zip(lows, highs, strict=True)))
    # half-way heights keep the points off the horizontal faces; x and y may lie right above an edge inside
    points = random.integers(0, 10, (20, 3)) + np.array([0.5, 0.25, 0.5])
    inside = ((points[:, None] > lows) & (points[:, None] < highs)).all(axis=2).sum(axis=1)
    own = np.full(20, -1)
    np.testing.assert_array_equal(
        surrounding(points, own, shells.vertices[shells.faces], np.repeat(np.arange(4), 12)), inside
    )
