"""Which way flat models look."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.colours.dominant import surface_colours
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.unit_bricks.facing import Facing, facing_of
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples
from tests.core.solids import box, sheet
from tests.core.textured import painted

PLATE_OF_TWO = np.where(np.arange(12) % 2, 4, 1)
"""The two triangles of every side of a box in two colours."""


def facing(mesh) -> Facing:
    """Colour a mesh and find out which way it looks."""
    catalogue = load_catalogue()
    surface = surface_colours(
        mesh,
        catalogue,
        n_colours=8,
        palette=catalogue.codes,
        one_to_one=False,
        rng=np.random.default_rng(0),
    )
    return facing_of(mesh, surface)


def thin_box(axis) -> np.ndarray:
    """Return the far corner of a box that is thin along an axis."""
    return np.where(np.arange(3) == axis, 8.0, 96.0)


def two_coloured(axis, sign):
    """Make a thin box with one side in two colours, all others in one."""
    mesh = box(high=thin_box(axis))
    looks = mesh.normals[:, axis] * sign > 0
    return painted(mesh, np.where(looks, PLATE_OF_TWO, 15))


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("sign", [-1, 1])
def test_open_sheet_looks_along_its_normals(axis, sign):
    """A standing picture looks where its only side does; a lying one always up."""
    flat = sheet(4, 4, lambda x, y: 0.1 * np.sin(3 * x))
    vertices = np.roll(96 * flat.vertices, axis - 2, axis=1)
    mesh = painted(replace(flat, vertices=vertices, faces=flat.faces[:, ::sign]), 4)
    assert facing(mesh) == Facing(axis, 1 if axis == 2 else sign)


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("sign", [-1, 1])
def test_closed_slab_looks_where_more_colours_are(axis, sign):
    """The picture is the side with more colours."""
    assert facing(two_coloured(axis, sign)) == Facing(axis, sign)


@pytest.mark.parametrize(("axis", "sign"), [(0, 1), (1, -1), (2, 1)])
def test_equal_sides(axis, sign):
    """Of two equal sides that counts which Blender shows from the right, the front and the top."""
    assert facing(painted(box(high=thin_box(axis)), 4)) == Facing(axis, sign)


def test_not_flat():
    """A quarter of the next larger side is flat; more is refused in one sentence with both numbers."""
    assert facing(painted(box(high=(100, 25, 200)), 4)) == Facing(1, -1)
    with pytest.raises(
        SettingsError, match=r"^The model is 26 mm thick and 100 mm broad, .*: set backing to 0 or .*\.$"
    ):
        facing(painted(box(high=(100, 26, 200)), 4))


@pytest.mark.parametrize("sign", [-1, 1])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_front_counts_before_the_edges(axis, sign):
    """What looks forward keeps its area, walls are next to nothing, edges and what looks backward are dropped."""
    normal, place = np.zeros((5, 3)), np.full((5, 3), 4.0)
    normal[:, 2 - axis] = sign * np.array([1.0, 0.5, 0.0, 0.0, -1.0])
    normal[1:4, 1 - axis] = 1.0
    place[:, 2 - axis] -= sign * np.array([0.0, 2.0, 2.0, 0.5, 2.0])
    colour = np.arange(5, dtype=np.int16)
    samples = SurfaceSamples(place, 0 * place, place.astype(np.int64), normal, np.arange(1.0, 6), colour)
    weighed = Facing(axis, sign).weighed(samples)
    assert weighed.colour.tolist() == [0, 1, 2]
    assert weighed.area.tolist() == pytest.approx([1, 2, 3e-6])
