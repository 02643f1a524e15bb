"""The meshes of wedge plates: closed, outward, of the right volume, hollow from below where a side vanishes, too."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import Part, columns, load_catalogue, outline
from legorize_addon.core.model.polygons import area, depths
from legorize_addon.core.units import PLATE, STUD
from legorize_addon.scene.lofts import GAP, Loft
from legorize_addon.scene.part_meshes import SIDES, part_loft
from legorize_addon.scene.wedge_bodies import inset, wedge_body

WEDGES = [part for part in load_catalogue().parts if part.wedge]
every_wedge = pytest.mark.parametrize("part", WEDGES, ids=lambda part: part.number)
every_detail = pytest.mark.parametrize("detail", ["low", "high"])

pytestmark = pytest.mark.numbers


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


@every_wedge
@every_detail
def test_bodies_are_closed(part: Part, detail: str) -> None:
    """At every edge of a body two faces meet, in opposite directions."""
    edges = [edge for face in faces(wedge_body(part, detail))
             for edge in zip(face.tolist(), np.roll(face, -1).tolist(), strict=True)]  # fmt: skip
    assert len(set(edges)) == len(edges)
    assert {(end, start) for start, end in edges} == set(edges)


@every_wedge
def test_low_detail_is_the_outline_drawn_up(part: Part) -> None:
    """The simple body is the outline moved inwards by the gap, as high as a plate without it."""
    loft = wedge_body(part, "low")
    assert volume(loft) == pytest.approx(area(inset(outline(part) * STUD, GAP)) * (PLATE - GAP))


@every_wedge
def test_high_detail_is_hollow(part: Part) -> None:
    """Less than two thirds of the body is left, and it lies within the simple one."""
    low, high = (wedge_body(part, detail) for detail in ("low", "high"))
    assert 0.2 * volume(low) < volume(high) < 0.67 * volume(low)
    assert (high.vertices >= low.vertices.min(axis=0) - 1e-6).all()
    assert (high.vertices <= low.vertices.max(axis=0) + 1e-6).all()


@every_wedge
@every_detail
def test_studs_stand_where_the_columns_have_them(part: Part, detail: str) -> None:
    """As many lids of studs lie over the body as there are studs, in the middles of their squares."""
    loft = part_loft(part, detail)
    top = loft.vertices[:, 2].max()
    lids = [loft.vertices[face] for face in faces(loft) if (loft.vertices[face][:, 2] > top - 1e-6).all()]
    found = columns(part, 0)
    middles = {tuple(np.round(lid[:, :2].mean(axis=0) / STUD + (part.length / 2, part.width / 2), 3)) for lid in lids}
    assert middles == {tuple(place + 0.5) for place in found.xy[found.stud].astype(float)}
    assert all(len(lid) == SIDES[detail] for lid in lids)


def test_sides_that_vanish_leave_one_corner() -> None:
    """A tip narrower than the walls has one corner in place of two; a square keeps its four."""
    tip = np.array([(0.0, 0.0), (10.0, 0.0), (10.0, 1.0), (0.0, 6.0)])
    found = inset(tip, 1.0)
    assert found[1].tolist() == found[2].tolist()
    assert found[0].tolist() == [1.0, 1.0]
    square = np.array([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)])
    assert inset(square, 1.0).tolist() == [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]


@every_wedge
def test_tubes_stand_between_the_sides(part: Part) -> None:
    """No part of the mesh reaches beyond the outline, as tubes did where two squares clutch, but no four."""
    loft = part_loft(part, "high")
    places = loft.vertices[:, :2] + np.array([part.length, part.width]) * STUD / 2
    assert depths(outline(part) * STUD, places).min() > 0
