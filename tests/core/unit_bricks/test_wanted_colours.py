"""The light of the surface on cells is that of the texels there, whatever the bricks' colours."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.colours.difference import linear_from_srgb
from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.unit_bricks.facing import Facing
from legorize_addon.core.unit_bricks.wanted_colours import wanted_colours
from tests.core.solids import box
from tests.core.textured import hollow_box, painted, rgb_of, textured

# 6 x 4 studs, 3 layers, in a grid that it fills
LOW, HIGH = (-24.0, -16.0, 0.0), (24.0, 16.0, 28.8)
SOLID = np.ones((3, 3, 4, 6), bool)
CORNER = np.array(LOW)


@pytest.mark.parametrize("plates", [False, True])
def test_a_plain_box_wants_its_colour_everywhere(plates):
    """Each visible cell has the one light, and all of them share the whole surface."""
    found = wanted_colours(painted(box(LOW, HIGH), 4), SOLID, CORNER, plates=plates)
    levels = SOLID.reshape(-1, 4, 6)[:: 1 if plates else 3]
    np.testing.assert_array_equal(found.cell, np.argwhere(visible(levels, outer_air(levels))))
    assert found.plates == (1 if plates else 3)
    expected = linear_from_srgb(painted(box(LOW, HIGH), 4).images[0][0, 0])
    np.testing.assert_allclose(found.light, np.broadcast_to(expected, found.light.shape), atol=1e-7)
    surface = 2 * (48 * 32 + 48 * 28.8 + 32 * 28.8)
    # rows of rays a third of a stud apart do not divide a height of 28.8 mm
    assert found.area.sum() == pytest.approx(surface, rel=0.03)
    assert found.light.dtype == found.area.dtype == np.float32


def test_each_side_wants_its_own():
    """Left of the middle red, right of it blue, with nothing between."""
    mesh = box(LOW, HIGH)
    uvs = mesh.vertices[mesh.faces][..., [0, 1]] / (48, 32) + 0.5
    image = rgb_of([4, 1])[None]
    found = wanted_colours(textured(mesh, image, uvs, clamp=True), SOLID, CORNER, plates=False)
    left, right = linear_from_srgb(image[0])
    expected = np.where((found.cell[:, 2] < 3)[:, None], left, right)
    np.testing.assert_allclose(found.light, expected, atol=1e-7)


def test_a_chequered_cell_wants_the_mean_light():
    """Of texels that are black and white in equal parts a cell wants half of the light."""
    image = np.zeros((24, 24, 3), np.uint8)
    image[np.add.outer(np.arange(24), np.arange(24)) % 2 == 0] = 255
    mesh = box(LOW, HIGH)
    # one texel to a ray: a third of a stud
    uvs = mesh.vertices[mesh.faces][..., [0, 1]] / 64 + 0.5
    level = np.abs(mesh.normals[:, 2]) > 0
    found = wanted_colours(
        textured(mesh, image, np.where(level[:, None, None], uvs, 0.02)), SOLID, CORNER, plates=False
    )
    inner = (found.cell[:, 0] == 2) & np.isin(found.cell[:, 1], (1, 2)) & np.isin(found.cell[:, 2], (1, 2, 3, 4))
    assert inner.sum() == 8
    # of nine rays four or five meet white
    assert np.isin(np.round(found.light[inner] * 9, 4), (4, 5)).all()


def test_surface_that_no_air_reaches_does_not_count():
    """The colour of a sealed cavity is nowhere."""
    mesh = painted(hollow_box((LOW, HIGH), ((-8, -8, 9.6), (8, 8, 19.2))), [4] * 12 + [1] * 12)
    found = wanted_colours(mesh, SOLID, CORNER, plates=False)
    red = linear_from_srgb(mesh.images[0][0, 1])
    np.testing.assert_allclose(found.light, np.broadcast_to(red, found.light.shape), atol=1e-7)


def test_of_a_picture_the_front_counts():
    """The back of a flat box that is looked at from above has no say."""
    flat = box((-24, -16, 0), (24, 16, 9.6))
    top = flat.normals[:, 2] > 0
    mesh = painted(flat, np.where(top, 4, 1))
    found = wanted_colours(mesh, SOLID[:1], CORNER, plates=False, facing=Facing(2, 1))
    assert len(found) == 24
    red = linear_from_srgb(mesh.images[0][0, 1])
    np.testing.assert_allclose(found.light, np.broadcast_to(red, found.light.shape), atol=1e-5)


def test_no_solid_cell_wants_nothing():
    """Without cells there are no colours to want, and no error."""
    found = wanted_colours(painted(box(LOW, HIGH), 4), np.zeros_like(SOLID), CORNER, plates=True)
    assert len(found) == 0
    assert found.cell.shape == found.light.shape == (0, 3)
