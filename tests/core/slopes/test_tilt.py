"""How steep the surface is: the way that planes face, slopes at walls that lean, and none at upright ones."""

from __future__ import annotations

from unittest.mock import Mock

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.model import COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.slicing import ACROSS, UP
from legorize_addon.core.slopes.candidates import candidates
from legorize_addon.core.slopes.forms import slopes_of
from legorize_addon.core.slopes.site import Site
from legorize_addon.core.slopes.tilt import as_steep, surface_facing
from legorize_addon.core.units import PLATE, STUD
from tests.core.slopes.ramps import CATALOGUE, RED, cells_of_ramp, prism, ramp
from tests.core.solids import mesh_of

FORMS = slopes_of(CATALOGUE, plates=True)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1), st.floats(-4, 4))
def test_planes_face_along_their_normal(x, y, z, beyond):
    """A block that a plane cuts faces as the plane does there, wherever the plane goes through the cells."""
    normal = np.array([x, y, z])
    if np.linalg.norm(normal) < 0.1:
        normal = np.array([0.0, 0.0, 1.0])
    normal /= np.linalg.norm(normal)
    # shares by points, in 8 x 8 x 8 cells around a place on the plane
    n, size = 4, 8
    parts, step = np.array([UP, ACROSS, ACROSS]), np.array([PLATE, STUD, STUD])
    at = [(np.arange(size * k * n) + 0.5) / (k * n) - size / 2 for k in parts]
    inside = at[0][:, None, None] * step[0] * normal[2] + at[1][:, None] * step[1] * normal[1]
    inside = inside + at[2] * step[2] * normal[0] < beyond
    share = (
        inside.reshape(size, UP, n, size, ACROSS, n, size, ACROSS, n).mean(axis=(2, 5, 8)).transpose(0, 2, 4, 1, 3, 5)
    )
    site = Mock(shape=(size,) * 3, row=np.arange(size**3), gain=1 - 2 * share.reshape(size**3, -1))
    area = surface_facing(site).reshape(size, size, size, 3)[1:-1, 1:-1, 1:-1].reshape(-1, 3).sum(axis=0)
    assert area @ normal / np.linalg.norm(area) > np.cos(np.radians(3))


@pytest.mark.parametrize(
    ("number", "steep"), [("3039", 39.8), ("4286", 59.0), ("60481", 22.6), ("4460b", 15.5), ("3665", -39.8)]
)
def test_slopes_face_as_they_are_named(number, steep):
    """They fall a whole number of bricks in a stud or two, and face so many degrees above the horizon; lips apart."""
    facing = next(form.facing for form in FORMS if CATALOGUE.parts[form.part].number == number and form.turn == 0)
    assert facing[0] > 0
    assert facing[1] == pytest.approx(0)
    assert np.degrees(np.arctan2(facing[2], facing[0])) == pytest.approx(steep, abs=7)


def leaning(degrees, height=9):
    """Return a block with a side that leans inwards by an angle from upright, and its cells."""
    inwards = height * PLATE * np.tan(np.radians(degrees)) / STUD
    mesh = prism([(1, 0), (7 + inwards / 2, 0), (7 - inwards / 2, height), (1, height)], 4)
    colour = np.full((height, 6, 10), COLOUR_EMPTY, np.int16)
    colour[:, 1:-1, 1:7] = RED
    colour = colour.reshape(-1, 3, 6, 10)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    grid = UnitGrid(colour, cover, np.zeros(colour.shape, np.uint8), np.zeros(3))
    return Site.of(mesh, grid, grid)


def steep_there(site, number, x, z):
    """Return whether the surface is as steep as a slope in the turn in which it falls towards x."""
    form = next(each for each in FORMS if CATALOGUE.parts[each.part].number == number and each.turn == 0)
    corners = site.corners(np.arange(len(site.solid)))
    place = np.flatnonzero((corners == (x, 2, z)).all(axis=1))
    return bool(as_steep(site, form, surface_facing(site), place)[0])


@pytest.mark.parametrize(
    ("degrees", "steep"), [(-8, False), (0, False), (3, False), (5.5, True), (15, True), (40, True)]
)
def test_steep_slopes_need_a_wall_that_leans(degrees, steep):
    """A slope of 75 degrees, 15 from upright, stands at walls that lean by a quarter of that or more."""
    assert steep_there(leaning(degrees), "4460b", 5, 0) is steep


def test_upright_walls_get_none():
    """Whatever the phase of a round upright wall, no slope pays at it."""
    angle = np.arange(24) * 2 * np.pi / 24
    corners = [(4.3 + 2.6 * np.cos(a), 4.1 + 2.6 * np.sin(a)) for a in angle]
    disc = prism([(x, y * STUD / PLATE) for x, y in corners], 6)  # lies along y
    upright = mesh_of(disc.vertices[:, [0, 2, 1]], disc.faces[:, ::-1])
    centre = np.stack(np.meshgrid(np.arange(9) + 0.5, np.arange(9) + 0.5, indexing="ij"), axis=-1)
    within = np.hypot(centre[..., 1] - 4.3, centre[..., 0] - 4.1) < 2.6
    colour = np.full((24, 9, 9), COLOUR_EMPTY, np.int16)
    colour[3:18, within] = RED  # the disc reaches from 2.5 to 17.5 plates
    colour = colour.reshape(-1, 3, 9, 9)
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    grid = UnitGrid(colour, cover, np.zeros(colour.shape, np.uint8), np.zeros(3))
    site = Site.of(upright, grid, grid)
    found = candidates(site, FORMS, CATALOGUE, price=0.0)
    low = site.corners(found.place)[:, 2]
    high = low + np.array([form.height for form in FORMS])[found.form]
    assert len(site.mixed)
    assert not ((low > 3) & (high < 17)).any()


def test_slopes_face_as_the_surface_does():
    """A slope that fits is as steep; turned round it is not, since the surface faces the other way."""
    site = Site.of(ramp(), cells_of_ramp(), cells_of_ramp())
    assert steep_there(site, "3039", 5, 3)
    turned = next(each for each in FORMS if CATALOGUE.parts[each.part].number == "3039" and each.turn == 2)
    place = np.flatnonzero((site.corners(np.arange(len(site.solid))) == (6, 1, 3)).all(axis=1))
    assert not as_steep(site, turned, surface_facing(site), place)[0]
