"""What is compared with a mesh for the paper's claims: cells, centre points, cavities."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.drafting import draft_model
from legorize_addon.core.model.unit_grid import Fill
from legorize_addon.core.settings import Settings
from scripts.research.accuracy import accuracy, centres_inside, levels, mean_distance, shares_inside
from scripts.research.cavities import cavities
from tests.core.solids import box, joined, sphere, tube, without

BY_SCALE = Settings(size_by="scale", scale=10.0)
"""As large as the mesh."""


def test_points_beside_a_cube_of_cells():
    """Above, beside, and off an edge and a corner of one cell; on its faces they are at no distance."""
    cell = np.ones((1, 1, 1), dtype=bool)
    points = np.array([[4, 4, 5.2], [10, 4, 1], [11, 4, 7.2], [9, 9, 4.2], [1, 8, 3], [8, 0, 0]], dtype=float)
    wanted = [2, 2, 5, 3**0.5, 0, 0]
    found = [mean_distance(point[None], cell, np.zeros(3)) for point in points]
    assert found == pytest.approx(wanted)


def test_faces_are_where_the_origin_puts_them():
    """The middle of a block of 3 x 2 x 6 plates is 8 mm from its long sides."""
    cells = np.ones((6, 2, 3), dtype=bool)
    assert mean_distance(np.array([[112.0, 208, 309.6]]), cells, np.array([100.0, 200, 300])) == pytest.approx(8)


@pytest.mark.parametrize("plates", ["none", "all"])
def test_centres_and_shares_of_a_ball(plates):
    """A centre is inside by its distance from the middle; shares add up to the volume."""
    radius = 37.0
    draft = draft_model(sphere(n=32, radius=radius), replace(BY_SCALE, plates=plates))
    height = 3 if plates == "none" else 1
    shape = levels(draft).shape
    z, y, x = np.indices((shape[0] // height, *shape[1:]))
    middles = draft.grid.origin + (np.stack([x, y, z], axis=-1) + 0.5) * [8, 8, 3.2 * height]
    corners = draft.mesh.vertices
    centre = (corners.min(axis=0) + corners.max(axis=0)) / 2
    distance = np.linalg.norm(middles - centre, axis=-1)
    clear = np.repeat(abs(distance - radius) > 1, height, axis=0)
    inside = np.repeat(distance < radius, height, axis=0)
    assert (centres_inside(draft, height) == inside)[clear].all()
    assert inside.any()
    sunk = draft.grid.origin[2] - corners[:, 2].min()
    volume = 4 / 3 * np.pi * radius**3 - np.pi * sunk**2 * (radius - sunk / 3)
    assert shares_inside(draft).sum() * 8 * 8 * 3.2 == pytest.approx(volume, rel=0.01)


def test_block_of_whole_bricks_is_exact():
    """What is made of whole studs and bricks is met by all ways."""
    row = accuracy(box((0, 0, 0), (64, 48, 28.8)), BY_SCALE)
    assert row == {name: pytest.approx(float(name.endswith("iou")), abs=1e-6) for name in row}


def test_open_mesh_has_no_inside():
    """Without its lid a box is compared by distance alone."""
    row = accuracy(without(box((0, 0, 0), (64, 48, 28.8)), 2, 3), BY_SCALE)
    assert [name for name, value in row.items() if value is not None] == ["bricks_mm", "plates_mm"]


def test_cavity_of_a_tube():
    """What it runs around stays empty; layers that are filled no longer count."""
    draft = draft_model(tube(outer=60.0, inner=36.0), BY_SCALE)
    whole = cavities(draft)
    assert whole["cells"] > 15 * 50
    assert whole["iou"] == 1
    solid = draft.grid.solid
    half = solid.copy()
    half[: len(solid) // 2] = True
    cover = np.where(half, np.uint8(Fill.REQUIRED), draft.grid.cover)
    filled = replace(draft, grid=replace(draft.grid, cover=cover))
    assert cavities(filled)["iou"] == pytest.approx(1 - (len(solid) // 2) / len(solid))


@pytest.mark.parametrize("mesh", [box((0, 0, 0), (64, 48, 28.8)), sphere(n=16, radius=37.0)])
def test_solids_have_no_cavity(mesh):
    """Nothing is judged then, not even cells that the surface cuts."""
    assert cavities(draft_model(mesh, BY_SCALE)) == {"cells": 0, "iou": None}


def test_walls_of_several_bodies_enclose():
    """Four walls that are bodies of their own have a room between them."""
    walls = [((0, 0), (80, 8)), ((0, 72), (80, 80)), ((0, 8), (8, 72)), ((72, 8), (80, 72))]
    mesh = joined(*(box((*low, 0), (*high, 28.8)) for low, high in walls))
    assert cavities(draft_model(mesh, BY_SCALE)) == {"cells": 8 * 8 * 9, "iou": 1.0}
