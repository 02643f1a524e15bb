"""Bevels are shaded as roundings between faces that stay flat."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import Part, load_catalogue
from legorize_addon.scene.lofts import BEVEL, Loft, welded
from legorize_addon.scene.part_meshes import STUD_RADIUS, part_loft, part_mesh
from legorize_addon.scene.rounding import corner_normals

CATALOGUE = load_catalogue()
PARTS = [part for part in CATALOGUE.parts if part.length <= 8]
every_part = pytest.mark.parametrize("part", PARTS, ids=lambda part: part.number)
SIDE = 10.0


def faces(loft: Loft) -> list[np.ndarray]:
    """Return the rows of each face's corners."""
    return np.split(np.arange(len(loft.corners)), loft.starts[1:])


def flat_normal(points: np.ndarray) -> np.ndarray:
    """Return the unit normal of a flat polygon."""
    normal = np.cross(points - points[0], np.roll(points, -1, axis=0) - points[0]).sum(axis=0)
    return normal / np.linalg.norm(normal)


def bevelled_edge(width: float) -> Loft:
    """Return a level and an upright square with a bevel between them."""
    top = np.array([(0, 0, width), (SIDE, 0, width), (SIDE, SIDE, width), (0, SIDE, width)])
    front = np.array([(0, -width, -SIDE), (SIDE, -width, -SIDE), (SIDE, -width, 0), (0, -width, 0)])
    bevel = np.array([front[3], front[2], top[1], top[0]])
    return welded([top, front, bevel])


@pytest.mark.numbers
def test_bevel_goes_from_face_to_face() -> None:
    """It has the normal of the level face above, that of the upright one below; both keep theirs."""
    loft = bevelled_edge(BEVEL)
    up, ahead = (0, 0, 1), (0, -1, 0)
    expected = [up] * 4 + [ahead] * 4 + [ahead, ahead, up, up]
    points = loft.vertices[loft.corners]
    np.testing.assert_allclose(corner_normals(loft), expected, atol=1e-12)
    assert (points[8:10, 2] < points[10:, 2].min()).all()


@pytest.mark.numbers
def test_wide_bevels_and_sharp_edges_stay() -> None:
    """What is wide is a face of its own, and an edge without a bevel is none."""
    wide = bevelled_edge(1.0)
    np.testing.assert_allclose(corner_normals(wide)[8:], np.tile((0, -(0.5**0.5), 0.5**0.5), (4, 1)), atol=1e-12)
    sharp = bevelled_edge(0.0)
    np.testing.assert_allclose(corner_normals(sharp), [(0, 0, 1)] * 4 + [(0, -1, 0)] * 4, atol=1e-12)


@pytest.mark.numbers
@every_part
def test_wide_faces_stay_flat(part: Part) -> None:
    """Flat faces as wide as a plate is thick have their own normals; no other normal turns away from its face."""
    loft = part_loft(part, "high")
    normals, points = corner_normals(loft), loft.vertices[loft.corners]
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0)
    for face, smooth in zip(faces(loft), loft.smooth, strict=True):
        flat = flat_normal(points[face])
        assert (normals[face] @ flat).min() > 0.5
        if not smooth and np.ptp(points[face], axis=0).min() == 0 and sorted(np.ptp(points[face], axis=0))[1] > 0.5:
            np.testing.assert_allclose(normals[face], np.tile(flat, (len(face), 1)), atol=1e-9)


@pytest.mark.numbers
def test_studs_are_round_and_upright() -> None:
    """The side of a stud is shaded as a cylinder's, up to its bevel."""
    loft = part_loft(CATALOGUE.parts[CATALOGUE.part_row("3005")], "high")
    normals, points = corner_normals(loft), loft.vertices[loft.corners]
    upright = np.abs(normals[:, 2]) < 1e-9
    wall = upright & np.isclose(np.linalg.norm(points[:, :2], axis=1), STUD_RADIUS)
    assert wall.sum() == 16 * 6
    np.testing.assert_allclose(normals[wall, :2], points[wall, :2] / STUD_RADIUS, atol=1e-9)


@pytest.mark.parametrize("number", ["3001", "3040", "3068b"])
def test_blender_shades_with_them(number: str) -> None:
    """The mesh has the same normals, to what Blender's compact form keeps of them."""
    part = CATALOGUE.parts[CATALOGUE.part_row(number)]
    mesh = part_mesh(part, "high")
    found = np.empty(3 * len(mesh.loops), dtype=np.float32)
    mesh.corner_normals.foreach_get("vector", found)
    np.testing.assert_allclose(found.reshape(-1, 3), corner_normals(part_loft(part, "high")), atol=1e-2)
