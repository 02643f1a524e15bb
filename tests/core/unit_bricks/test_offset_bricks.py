"""Offset bricks in whole models: their role, and that all that shows has a colour."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.build import Build
from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.solids import box, joined, sphere
from tests.core.textured import blob, hollow_box, painted, turned_about_z

RED = 4
QUICK = {"layout": "fast", "supports": "none", "strengthen": False}
"""Settings that say nothing of cells."""


def cone(studs_a_layer: float, n: int = 8) -> Build:
    """Build a frustum that narrows by so many studs on every side from layer to layer, in bricks."""
    top = 40.0
    bottom = top + 8 * studs_a_layer * n
    mesh = turned_about_z([(0, 0), (bottom, 0), (top, 9.6 * n), (0, 9.6 * n)], n=192)
    return legorize(
        painted(mesh, RED),
        Settings(size_by="scale", scale=10.0, plates="none", layout="fast", supports="none", strengthen=False),
    )


def offsets(build: Build) -> np.ndarray:
    """Return which cells are offset bricks, by layers."""
    return (build.grid.role == Role.OFFSET).any(axis=1)


def test_slopes_that_bricks_carry_need_no_offsets():
    """A cone of one stud a layer has hardly any offset bricks below its top; one of three has two rings a layer."""
    flat = cone(1.0, 4)
    # a few cells where the round outline falls oddly on the grid
    assert offsets(flat)[:-1].sum() < 0.02 * flat.grid.solid[:, 0].sum()
    steep = cone(3.0, 4)
    assert (steep.offsets.ring[1:-1].max(axis=(1, 2)) == 2).all()
    assert offsets(steep)[:-1].any(axis=(1, 2)).all()


def test_top_of_a_box_is_offset_bricks_inside_its_outline():
    """All but the outermost bricks of a flat top lie on offset trajectories; walls and floor have none."""
    build = legorize(painted(box((0, 0, 0), (80, 80, 48)), RED), Settings(width=10, plates="none"))
    found = offsets(build)
    assert found[-1].sum() == 8 * 8
    assert not found[:-1].any()


@pytest.mark.parametrize("plates", ["none", "pays", "all"])
@pytest.mark.parametrize("colour", ["likeness", "longest"])
def test_whatever_shows_has_a_colour(plates, colour):
    """No cell that the air reaches is free to be of any colour, undersides included, and no hidden one is fixed."""
    for mesh in (blob(n=12, size=32), joined(box((0, 0, 0), (8, 8, 40)), box((-24, -24, 40), (32, 32, 60)))):
        mesh = mesh if len(mesh.images[0]) > 1 else painted(mesh, RED)
        build = legorize(mesh, Settings(width=24, plates=plates, cell_colour=colour, **QUICK))
        levels = build.grid.colour.reshape(-1, *build.grid.colour.shape[2:])
        solid = levels != COLOUR_EMPTY
        seen = visible(solid, outer_air(solid))
        assert (levels[seen] >= 0).all()


def test_sealed_cavity_has_no_offset_bricks():
    """The floor and the ceiling of a sealed cavity are seen by nobody and get no offsets."""
    mesh = painted(hollow_box(((0, 0, 0), (120, 120, 120)), ((30, 30, 30), (90, 90, 90))), RED)
    build = legorize(mesh, Settings(width=15, hollow=False, plates="none"))
    assert not offsets(build)[1:-1].any()


def test_larger_angle_asks_for_fewer_offsets():
    """The limit moves with the critical angle."""
    mesh = painted(sphere(24, 96.0), RED)
    count = [
        int(offsets(legorize(mesh, Settings(width=24, plates="none", critical_angle=angle))).sum())
        for angle in (30.0, 45.0, 60.0, 75.0)
    ]
    assert count == sorted(count, reverse=True)
    assert count[0] > count[-1]


def test_offset_cells_are_cells_of_the_model():
    """Every offset brick is solid, visible and coloured."""
    build = legorize(blob(n=12, size=32), Settings(width=24))
    cells = build.grid.role == Role.OFFSET
    assert cells.any()
    assert (build.grid.colour[cells] > COLOUR_ANY).all()
