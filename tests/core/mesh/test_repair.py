"""The single repairs: welding, repeated faces, slivers, holes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.mesh.repair import HOLE, redundant, small_holes, useless_slivers, weld
from legorize_addon.core.mesh.topology import areas_and_longest_sides, components, edges_of
from tests.core.solids import BOX_FACES, box, sheet, without


@given(st.integers(0, 2**32 - 1), st.integers(1, 40))
def test_weld_joins_exactly_the_chains_of_close_points(seed, n):
    """The same clusters as from all distances, named by their first member."""
    random = np.random.default_rng(seed)
    points = random.integers(0, 12, (n, 3)) * 0.05 + random.normal(0, 0.003, (n, 3))
    tolerance = 0.06
    first = weld(points, tolerance)
    distance = np.linalg.norm(points[:, None] - points, axis=-1)
    label = components(n, *np.nonzero(distance <= tolerance))
    np.testing.assert_array_equal(first, [np.flatnonzero(label == label[row])[0] for row in range(n)])


def test_weld_sees_across_cell_borders():
    """Two points at any offset in the grid of cells, just within and just beyond the tolerance."""
    tolerance = 1e-6
    for offset in np.linspace(0, 1e-6, 23):
        frame = np.array([[0, 0, 0], [1, 1, 1], [0.3 + offset, 0.4, 0.5]])
        near, far = frame[2] + [0.99e-6, 0, 0], frame[2] + [0, 1.01e-6, 0]
        assert weld(np.vstack([frame, near]), tolerance).tolist() == [0, 1, 2, 2]
        assert weld(np.vstack([frame, far]), tolerance).tolist() == [0, 1, 2, 3]


def drawn_twice(extra) -> list[int]:
    """Return the redundant faces of a box with some faces more."""
    faces = np.vstack([BOX_FACES, np.asarray(extra, dtype=np.int32)])
    return np.flatnonzero(redundant(faces, edges_of(faces))).tolist()


def test_of_equal_faces_the_first_is_kept():
    """However the corners are rotated."""
    assert drawn_twice([BOX_FACES[3], np.roll(BOX_FACES[3], 1), np.roll(BOX_FACES[7], 2)]) == [12, 13, 14]


def test_the_back_of_a_face_of_a_closed_body_goes():
    """The rest would not close without the front."""
    assert drawn_twice([BOX_FACES[3][::-1]]) == [12]
    assert drawn_twice([BOX_FACES[3][::-1], BOX_FACES[2][::-1]]) == [12, 13]


def test_a_membrane_with_both_sides_stays():
    """The box closes without it: front and back cancel."""
    assert drawn_twice([[0, 3, 4], [3, 0, 4]]) == []


def test_slivers_stay_where_they_hold_the_surface_together():
    """A flat triangle between two halves of a wall stays; one at an open border goes."""
    firm = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 4]], dtype=np.int32)  # 1 lies between 0 and 2
    wall = np.vstack([firm, [[0, 2, 1]]]).astype(np.int32)
    flat = np.array([False, False, False, True])
    assert useless_slivers(flat, edges_of(wall)).tolist() == [False] * 4
    torn = wall[[0, 2, 3]]
    assert useless_slivers(flat[1:], edges_of(torn)).tolist() == [False, False, True]


def filling(mesh):
    """Look for holes of a mesh of one patch."""
    corners = mesh.vertices[mesh.faces]
    patch = np.zeros(len(corners), np.int64)
    area, _ = areas_and_longest_sides(corners)
    return small_holes(mesh.vertices, mesh.faces, edges_of(mesh.faces), patch, area)


def hole_of(width: float, breadth: float):
    """Cut a rectangular hole into a sheet of 5 by 5 squares over [0, 1] x [0, 1]."""
    mesh = sheet(5, 5)
    hole = without(mesh, *(k for row in (12,) for k in (row, row + 25)))
    inner = (hole.vertices[:, :2] > 0.3).all(axis=1) & (hole.vertices[:, :2] < 0.7).all(axis=1)
    hole.vertices[inner, :2] = 0.5 + (hole.vertices[inner, :2] - 0.5) * np.array([width, breadth]) / 0.2
    return hole


@pytest.mark.parametrize(
    ("width", "breadth", "filled"),
    [(HOLE / 1.5, HOLE / 1.5, True), (HOLE, HOLE, False), (0.2, 0.2, False), (0.2, HOLE / 11, True)],
)
def test_holes_are_filled_by_their_size(width, breadth, filled):
    """A hole goes when its diagonal, or its breadth, is below what could be built."""
    found = filling(hole_of(width, breadth))
    assert (found is not None) == filled
    if found is not None:
        assert (found.n_holes, len(found.faces)) == (1, 4)
        np.testing.assert_allclose(found.centres, [[0.5, 0.5, 0]])


def test_fills_run_against_the_rim():
    """The half-edges of the triangles are those that were missing."""
    mesh = hole_of(0.01, 0.01)
    found = filling(mesh)
    tails = mesh.faces.ravel()[found.rim]
    heads = mesh.faces[:, [1, 2, 0]].ravel()[found.rim]
    np.testing.assert_array_equal(found.faces[:, :2], np.column_stack([heads, tails]))
    assert (found.faces[:, 2] == len(mesh.vertices)).all()


def test_nothing_is_filled_where_nothing_is_open():
    """A closed box and a loose sheet have no holes."""
    assert filling(box()) is None
    assert filling(sheet()) is None
