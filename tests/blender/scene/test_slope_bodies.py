"""The meshes of slopes: closed, outward, of the right volume, with studs where the profile has them."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import Part, columns, lines, load_catalogue
from legorize_addon.core.units import PLATE, STUD
from legorize_addon.scene.lofts import BEVEL, GAP, Loft, welded
from legorize_addon.scene.part_meshes import SIDES, STUD_HEIGHT, part_loft, part_mesh
from legorize_addon.scene.slope_bodies import level, slope_body

SLOPES = [part for part in load_catalogue().parts if part.sloped]
every_slope = pytest.mark.parametrize("part", SLOPES, ids=lambda part: part.number)
every_detail = pytest.mark.parametrize("detail", ["low", "high"])


def faces(loft: Loft) -> list[np.ndarray]:
    """Return the vertex rows of each face."""
    return np.split(loft.corners, loft.starts[1:])


def volume(loft: Loft) -> float:
    """Return the volume that the faces enclose, by the divergence theorem over fans of triangles."""
    total = 0.0
    for face in faces(loft):
        points = loft.vertices[face]
        cross = np.cross(points[1:-1], points[2:])
        total += np.einsum("ij,ij->", cross, np.broadcast_to(points[0], cross.shape))
    return total / 6


@pytest.mark.numbers
@every_slope
@every_detail
def test_bodies_are_closed(part: Part, detail: str) -> None:
    """At every edge of a body two faces meet, in opposite directions."""
    loft = slope_body(part, detail)
    edges = [edge for face in faces(loft) for edge in zip(face.tolist(), np.roll(face, -1).tolist(), strict=True)]
    assert len(set(edges)) == len(edges)
    assert {(end, start) for start, end in edges} == set(edges)


@pytest.mark.numbers
@every_slope
@every_detail
def test_faces_are_flat(part: Part, detail: str) -> None:
    """All corners of a face lie in one plane: a side with a curve, a roof, a bevel."""
    loft = slope_body(part, detail)
    for face in faces(loft):
        points = loft.vertices[face]
        assert np.linalg.svd(points - points.mean(axis=0))[1][-1] < 1e-4


@pytest.mark.numbers
@every_slope
def test_low_detail_is_the_profile_drawn_out(part: Part) -> None:
    """The simple body fills what lies between the two lines, a gap less on all sides but below."""
    x = np.linspace(GAP, part.length * STUD - GAP, 200_001)
    top, bottom = (np.interp(x, *(np.array(line) * (STUD, PLATE)).T) for line in lines(part))
    area = np.mean(top - GAP - bottom) * (x[-1] - x[0])
    # small corners at the ends are left out
    assert volume(slope_body(part, "low")) == pytest.approx(area * (part.width * STUD - 2 * GAP), rel=3e-3)


@pytest.mark.numbers
@every_slope
def test_high_detail_is_hollow(part: Part) -> None:
    """A hollow body has less volume than a whole one, but more than a sixth of it, and is within the same box."""
    low, high = (slope_body(part, detail) for detail in ("low", "high"))
    assert volume(low) / 6 < volume(high) < 0.9 * volume(low)
    for end in (np.min, np.max):
        np.testing.assert_allclose(end(low.vertices, axis=0), end(high.vertices, axis=0), atol=1.2 * BEVEL)


@pytest.mark.numbers
@every_slope
@every_detail
def test_studs_stand_where_columns_have_them(part: Part, detail: str) -> None:
    """Round lids lie at the height of the studs over the columns that have one, and nothing is higher."""
    loft = part_loft(part, detail)
    found = columns(part, 0)
    top = part.height * PLATE + STUD_HEIGHT
    lids = [loft.vertices[face] for face in faces(loft) if np.allclose(loft.vertices[face][:, 2], top)]
    middles = np.array([lid.mean(axis=0)[:2] for lid in lids]).reshape(-1, 2)
    wanted = (found.xy[found.stud] + 0.5 - np.array([part.length, part.width]) / 2) * STUD
    np.testing.assert_allclose(sorted(middles.tolist()), sorted(wanted.tolist()), atol=1e-6)
    assert all(len(lid) == SIDES[detail] for lid in lids)
    assert loft.vertices[:, 2].max() <= top + 1e-9


@pytest.mark.numbers
@every_slope
def test_tubes_end_below_the_top(part: Part) -> None:
    """Nothing round inside reaches through the slope, and nothing hangs below the part."""
    loft = part_loft(part, "high")
    round_ = loft.vertices[np.unique(np.concatenate([f for f, s in zip(faces(loft), loft.smooth, strict=True) if s]))] \
        if loft.smooth.any() else np.zeros((0, 3))  # fmt: skip
    inside = round_[round_[:, 2] < part.height * PLATE - 1]
    for x, _, z in inside.tolist():
        assert -1e-9 <= z < level(part, x + part.length * STUD / 2)


def test_blender_finds_nothing_to_repair() -> None:
    """Every mesh of a slope is valid as it is."""
    for part in SLOPES:
        for detail in ("low", "high"):
            assert not part_mesh(part, detail).validate(verbose=True)


@pytest.mark.numbers
def test_equal_points_are_welded() -> None:
    """Two triangles at one edge have four vertices; corners that repeat are left out."""
    one = np.array([(0, 0, 0), (1, 0, 0), (1, 0, 0), (0, 1, 0)], dtype=float)
    loft = welded([one, np.array([(1, 0, 0), (1, 1, 0), (0, 1, 1e-9)])])
    assert len(loft.vertices) == 4
    assert [len(face) for face in faces(loft)] == [3, 3]
