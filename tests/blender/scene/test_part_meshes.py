"""The meshes of the parts: closed, outward, of the right size, studs where the footprint says."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from legorize_addon.core.model.catalogue import Part, footprint, load_catalogue
from legorize_addon.core.units import PLATE, STUD
from legorize_addon.scene.instancing import colour_material
from legorize_addon.scene.part_meshes import (
    GAP,
    SIDES,
    STUD_HEIGHT,
    STUD_RADIUS,
    Loft,
    part_loft,
    part_mesh,
    parts_collection,
)

PARTS = [part for part in load_catalogue().parts if part.length <= 16 and not part.shaped]
"""Baseplates differ in their size alone; slopes have tests of their own."""

DETAILS = ("low", "high")
every_part = pytest.mark.parametrize("part", PARTS, ids=lambda part: part.number)
every_detail = pytest.mark.parametrize("detail", DETAILS)


def rings(loft: Loft) -> list[NDArray[np.int32]]:
    """Return the vertex rows of each face."""
    return np.split(loft.corners, loft.starts[1:])


def volume(loft: Loft) -> float:
    """Return the volume that the faces enclose, by the divergence theorem over fans of triangles."""
    total = 0.0
    for ring in rings(loft):
        points = loft.vertices[ring]
        total += np.einsum(
            "ij,ij->", np.cross(points[1:-1], points[2:]), np.broadcast_to(points[0], (len(ring) - 2, 3))
        )
    return total / 6


def tops(loft: Loft) -> NDArray[np.float64]:
    """Return the middles of the faces at the very top, shape (n, 2)."""
    top = loft.vertices[:, 2].max()
    return np.array(
        [loft.vertices[ring].mean(axis=0)[:2] for ring in rings(loft) if loft.vertices[ring][:, 2].min() == top]
    )


@pytest.mark.numbers
@every_part
def test_low_detail_encloses_body_and_studs(part: Part) -> None:
    """The simple mesh encloses exactly the box with its gaps and an octagonal prism a stud: closed and outward."""
    cells = 1 if part.jumper else len(footprint(part, 0)) * part.studs
    below = 0.0 if part.sockets else part.height * PLATE / 2
    sides = np.array([part.length, part.width]) * STUD - 2 * GAP
    missing = STUD**2 if part.corner else 0.0
    body = (sides.prod() - missing) * (part.height * PLATE - GAP - below)
    octagon = SIDES["low"] / 2 * STUD_RADIUS**2 * np.sin(2 * np.pi / SIDES["low"])
    # the studs' bottoms are open, on the body's top face: closing them adds their height above the origin
    open_bottoms = cells * octagon * (part.height * PLATE - GAP) / 3
    studs = cells * octagon * (STUD_HEIGHT + GAP)
    assert volume(part_loft(part, "low")) == pytest.approx(body + studs + open_bottoms)


@pytest.mark.numbers
@every_part
@every_detail
def test_no_edge_has_a_wrong_neighbour(part: Part, detail: str) -> None:
    """Two faces meet at every edge, in opposite directions, but for the open ends of studs and tubes."""
    loft = part_loft(part, detail)
    edges = np.concatenate([np.stack([ring, np.roll(ring, -1)], axis=1) for ring in rings(loft)]).astype(np.int64)
    n = len(loft.vertices)
    forth, back = edges[:, 0] * n + edges[:, 1], edges[:, 1] * n + edges[:, 0]
    assert len(np.unique(forth)) == len(forth)
    open_edges = edges[~np.isin(forth, back)]
    heights = {round(float(z), 6) for z in loft.vertices[open_edges].reshape(-1, 3)[:, 2]}
    assert len(heights) <= (1 if detail == "low" else 2)
    assert len(open_edges) % SIDES[detail] == 0
    assert len(heights) > 0 or not part.studs


@pytest.mark.numbers
@every_part
@every_detail
def test_part_keeps_to_its_box(part: Part, detail: str) -> None:
    """The body stands on z = 0, in the middle of its cells, with a gap all round; the studs rise above.

    A baseplate is half as thick, with its top where a plate has it.
    """
    vertices = part_loft(part, detail).vertices
    half = np.array([part.length, part.width]) * STUD / 2 - GAP
    np.testing.assert_allclose(vertices[:, :2].min(axis=0), -half)
    np.testing.assert_allclose(vertices[:, :2].max(axis=0), half)
    assert vertices[:, 2].min() == (0 if part.sockets else part.height * PLATE / 2)
    top = STUD_HEIGHT if part.studs else -GAP
    assert vertices[:, 2].max() == pytest.approx(part.height * PLATE + top)


@pytest.mark.numbers
@every_part
@every_detail
def test_studs_stand_on_the_footprint(part: Part, detail: str) -> None:
    """There is one stud in the middle of each cell of the footprint; the one of a tile or jumper is in its middle."""
    corner = np.array([part.length, part.width]) * STUD / 2
    cells = (tops(part_loft(part, detail)) + corner) / STUD - 0.5
    found = sorted(map(tuple, np.rint(cells).astype(int)))
    if part.studs and not part.jumper:
        np.testing.assert_allclose(cells, np.rint(cells), atol=1e-9)
        assert found == sorted(map(tuple, footprint(part, 0)))
    else:
        np.testing.assert_allclose(cells, [[part.length / 2 - 0.5, part.width / 2 - 0.5]], atol=1e-9)


@pytest.mark.numbers
@every_detail
def test_high_detail_is_hollow(detail: str) -> None:
    """A brick seen from below has a floor in low detail and none but the rim and the tubes in high detail."""
    loft = part_loft(PARTS[load_catalogue().part_row("3001")], detail)
    floor = [ring for ring in rings(loft) if loft.vertices[ring][:, 2].max() == 0]
    area = sum(
        abs(volume(Loft(loft.vertices - [0, 0, 1], ring, np.array([0]), np.array([False])))) * 3 for ring in floor
    )
    whole = (4 * STUD - 2 * GAP) * (2 * STUD - 2 * GAP)
    assert area == pytest.approx(whole) if detail == "low" else area < whole / 2


@every_detail
def test_blender_finds_nothing_to_repair(detail: str) -> None:
    """Every mesh is valid as it is; round studs and flat faces differ by smoothness, or by normals in high detail."""
    for part in PARTS:
        mesh = part_mesh(part, detail)
        assert not mesh.validate(verbose=True)
        smooth = np.zeros(len(mesh.polygons), dtype=bool)
        mesh.polygons.foreach_get("use_smooth", smooth)
        if detail == "high":
            assert smooth.all()
            assert mesh.has_custom_normals
        else:
            np.testing.assert_array_equal(smooth, part_loft(part, detail).smooth)
            assert smooth.any() == part.studs
            assert not smooth.all()


def test_mesh_is_made_once() -> None:
    """A part has one mesh for each detail in a file, whoever asks."""
    first = part_mesh(PARTS[0], "high")
    assert part_mesh(PARTS[0], "high") == first
    assert part_mesh(PARTS[0], "low") != first
    assert part_mesh(PARTS[1], "high") != first
    assert len(bpy.data.meshes) == 3


def test_parts_collection_is_in_order_of_names() -> None:
    """Geometry Nodes sorts by name, and names sort as the variants were given, also beside an earlier collection."""
    catalogue = load_catalogue()
    kinds = [(part, colour) for colour in catalogue.colours[:12] for part in catalogue.parts]
    for _ in range(2):
        collection = parts_collection([(part, colour_material(colour)) for part, colour in kinds], "low", "test")
        by_name = sorted(collection.objects, key=lambda variant: variant.name)
        assert [(variant["legorize_part"], variant.active_material.name.split()[1]) for variant in by_name] == [
            (part.number, str(colour.code)) for part, colour in kinds
        ]
    assert len(bpy.data.meshes) == len(catalogue.parts)
    assert len(bpy.data.materials) == 12
