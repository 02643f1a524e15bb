"""Backing behind pictures and reliefs, and what pictures become."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from legorize_addon.core.build import Build
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import CELL_SIZE, COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.backing import add_backing
from legorize_addon.core.unit_bricks.facing import Facing
from tests.core.solids import box, sheet, sphere
from tests.core.textured import painted, rgb_of, textured, turned_about_z

WAYS = [Facing(0, -1), Facing(0, 1), Facing(1, -1), Facing(1, 1), Facing(2, 1)]
"""Every way that a flat model may look."""


# -------------------------------------------------------------- on a grid


def grid_of(solid) -> UnitGrid:
    """Make a red model of some cells, (n_plates, n_y, n_x)."""
    solid = np.asarray(solid).reshape(-1, 3, *solid.shape[1:])
    colour = np.where(solid, 4, COLOUR_EMPTY).astype(np.int16)
    cover = np.where(solid, Fill.REQUIRED, Fill.EMPTY).astype(np.uint8)
    return UnitGrid(colour, cover, np.full(solid.shape, Role.SHELL, np.uint8), np.array([-8.0, 16.0, 4.0]))


def places(grid, cells) -> np.ndarray:
    """Return the lowest corners of some cells in mm, (n, 3)."""
    z, y, x = np.nonzero(cells.reshape(-1, *cells.shape[2:]))
    return np.round(grid.origin + np.column_stack([x, y, z]) * CELL_SIZE, 6)


def flat_grid(facing, relief) -> UnitGrid:
    """Make a relief that looks some way: cells up to a height, (n, n), over a level back."""
    solid = np.arange(6)[:, None, None] < relief
    solid = solid if facing.sign > 0 else solid[::-1]
    margin = [(0, 0) if facing.axis == 2 else (1, 1), (1, 1), (1, 1)]
    turned = np.moveaxis(np.pad(solid, margin), 0, 2 - facing.axis)
    return grid_of(np.pad(turned, [(0, -len(turned) % 3), (0, 0), (0, 0)]))


def levels(solid, facing) -> np.ndarray:
    """Return the first solid cell from behind on each straight line that meets one."""
    lines = np.moveaxis(solid.reshape(-1, *solid.shape[2:]), 2 - facing.axis, 0)[:: facing.sign]
    return lines.argmax(axis=0)[lines.any(axis=0)]


@pytest.mark.parametrize("depth", [1, 2, 5])
@pytest.mark.parametrize("facing", WAYS)
def test_rows_behind(facing, depth):
    """A picture of one cell gets as many cells behind it as asked for, in any colour, and stays where it is."""
    grid = flat_grid(facing, np.ones((6, 6), int))
    backed = add_backing(grid, facing, depth=depth)
    behind = backed.colour == COLOUR_ANY
    cells = depth * (3 if facing.axis == 2 else 1)
    assert behind.sum() == 36 * cells
    assert (backed.cover[behind] == Fill.REQUIRED).all()
    assert (backed.role[behind] == Role.INSIDE).all()
    picture, added = places(backed, backed.colour == 4), places(backed, behind)
    assert picture.tolist() == places(grid, grid.solid).tolist()
    away = (picture[0] - added)[:, facing.axis] * facing.sign
    assert np.unique(away) == pytest.approx(np.arange(1, cells + 1) * CELL_SIZE[facing.axis])


@pytest.mark.parametrize("facing", WAYS)
def test_free_cells_stay_around(facing):
    """Along x and y one cell at least stays free around a backed model, as around every other."""
    solid = add_backing(flat_grid(facing, np.ones((6, 6), int)), facing, depth=4).solid
    assert not solid[..., [0, -1], :].any()
    assert not solid[..., [0, -1]].any()


@pytest.mark.parametrize("facing", WAYS)
@settings(max_examples=25)
@given(
    front=arrays(int, (6, 6), elements=st.integers(0, 6)),
    rear=arrays(int, (6, 6), elements=st.integers(0, 3)),
    depth=st.integers(1, 4),
)
def test_any_relief(facing, front, rear, depth):
    """The model stays where it was, and every straight line that meets it is filled from it to one level."""
    front[2, 3] = 6
    grid = flat_grid(facing, front)
    solid = grid.solid & ~flat_grid(facing, np.minimum(front, rear)).solid
    grid = grid_of(solid.reshape(-1, *solid.shape[2:]))
    backed = add_backing(grid, facing, depth=depth)
    assert set(map(tuple, places(grid, solid))) <= set(map(tuple, places(backed, backed.solid)))
    starts = levels(backed.solid, facing)
    assert (starts == starts[0]).all()
    assert len(starts) == np.count_nonzero(front > rear)


def test_nothing_asked_for():
    """No backing changes nothing."""
    grid = flat_grid(WAYS[0], np.ones((6, 6), int))
    assert add_backing(grid, WAYS[0], depth=0) is grid


def test_hidden_cells_need_no_colour():
    """What only the back showed is free once it is covered; what the edges show is not."""
    solid = np.zeros((12, 4, 8), bool)
    solid[:, 1:3, 1:7] = True
    backed = add_backing(grid_of(solid), Facing(1, -1), depth=1)
    # one row of the two, in the two layers between those at the edges, without its ends
    hidden = 2 * 3 * 4
    assert np.count_nonzero(backed.colour == 4) == 12 * 2 * 6 - hidden
    assert np.count_nonzero(backed.colour == COLOUR_ANY) == 12 * 6 + hidden


# -------------------------------------------------------------- pictures

TEXELS = 5
"""Texels of the pictures below to a stud; six to a brick's height."""


def slab(image, *, standing, back=None, thickness=8.0) -> TriangleMesh:
    """Make a slab with a picture, `TEXELS` to 8 mm, on the upper side or the front; else grey, if `back` is given."""
    height, width = np.array(image.shape[:2]) * 8.0 / TEXELS
    mesh = box((0, 0, 0), (width, height, thickness))
    mesh = textured(mesh, image, mesh.vertices[mesh.faces][..., :2] / (width, height), clamp=True)
    if back is not None:
        other = (mesh.normals[:, 2] <= 0).astype(np.int32)
        plain = np.full((1, 1, 3), rgb_of([back])[0])
        mesh = replace(mesh, face_image=other, images=(*mesh.images, plain), image_clamp=np.array([True, True]))
    return stood_up(mesh) if standing else mesh


def stood_up(mesh) -> TriangleMesh:
    """Turn what lies so that its upper side looks against y."""
    x, y, z = mesh.vertices.T
    return replace(mesh, vertices=np.column_stack([x, -z, y]))


def of_cells(codes, *, standing) -> np.ndarray:
    """Draw an image that has a brick colour in every cell, row 0 being the lowest."""
    codes = np.asarray(codes)
    return np.repeat(np.repeat(rgb_of(codes.ravel()).reshape(*codes.shape, 3), 6 if standing else 5, axis=0), 5, axis=1)


def shown(build: Build, *, standing) -> np.ndarray:
    """Return the colours of the front, a brick or a stud a row from below, `COLOUR_EMPTY` beside the picture."""
    colour = build.grid.colour[:, 1] if standing else build.grid.colour.reshape(-1, *build.grid.colour.shape[2:])[::-1]
    axis = 1 if standing else 0
    front = (colour != COLOUR_EMPTY).argmax(axis=axis)
    face = np.take_along_axis(colour, np.expand_dims(front, axis), axis).squeeze(axis)
    rows, columns = (np.flatnonzero((face != COLOUR_EMPTY).any(axis=a)) for a in (1, 0))
    return face[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


def built(mesh, width, **others) -> Build:
    """Legorize a picture with a backing of one, and check that it holds together."""
    build = legorize(mesh, Settings(width=width, **{"backing": 1, "feet": False, **others}))
    assert build.graph.n_components == 1
    assert build.graph.n_floating == 0
    assert build.graph.collisions == 0
    return build


def photograph(width=160, height=120) -> np.ndarray:
    """Draw a hazy sky with a sun, hills and a house, a little noisy, (height, width, 3) uint8."""
    x, y = np.meshgrid((np.arange(width) + 0.5) / width * 4 / 3, (np.arange(height) + 0.5) / height)
    image = y[..., None] * [60, 110, 200] + (1 - y[..., None]) * [250, 220, 170]
    glow = np.hypot(x - 1.05, y - 0.78)[..., None]
    image = np.where(glow < 0.11, [252, 200, 40], image + np.clip(0.25 - glow, 0, 1) * [200, 140, 20])
    for base, waves, colour in ((0.5, 5, (120, 130, 165)), (0.38, 7, (75, 130, 75)), (0.25, 9, (45, 100, 45))):
        top = (base + 0.07 * np.sin(waves * x + base))[..., None]
        image = np.where(y[..., None] < top, np.clip(1 - top + y[..., None], 0.4, 1) * colour, image)
    image = np.where(((abs(x - 0.4) < 0.13) & (abs(y - 0.22) < 0.1))[..., None], [200, 60, 50], image)
    noise = np.random.default_rng(1).normal(0, 2, image.shape)
    return np.clip(image + noise, 0, 255).astype(np.uint8)


@pytest.mark.parametrize("standing", [False, True])
@pytest.mark.parametrize("picture", ["checkerboard", "stripes", "border"])
def test_pictures_of_whole_cells(picture, standing):
    """Where every cell has one colour in the image, the mosaic has exactly these, neither mirrored nor turned."""
    y, x = np.mgrid[: 10 if standing else 12, :16]
    wanted = {
        "checkerboard": np.where((x // 2 + y // 2) % 2, 4, 15),
        "stripes": np.array([1, 14, 4, 2])[(x + 2 * y) // 4 % 4],
        "border": np.where((x < 2) | (x > 14) | (y < 1) | (y > 7), 0, np.where(x < 5, 14, 1)),
    }[picture]
    # bricks as small as these need two layers, one to lie on and one across its seams
    build = built(slab(of_cells(wanted, standing=standing), standing=standing), 16, backing=2)
    assert (shown(build, standing=standing) == wanted).all()


@pytest.mark.parametrize("standing", [False, True])
@pytest.mark.parametrize("thickness", [1.6, 4.0, 8.0, 16.0])
def test_back_and_edges_do_not_show_through(standing, thickness):
    """A slab with a picture on the front alone becomes the picture, whatever colour its other sides have."""
    y, x = np.mgrid[: 10 if standing else 12, :16]
    wanted = np.where(x + y > 12, 4, np.where(x > y, 14, 1))
    build = built(slab(of_cells(wanted, standing=standing), standing=standing, back=0, thickness=thickness), 16)
    assert (shown(build, standing=standing) == wanted).all()


@pytest.mark.parametrize("standing", [False, True])
def test_photograph(standing):
    """At least 95 % of the cells have the colour most like their part of the image, or one no eye tells from it."""
    image = photograph()
    build = built(slab(image, standing=standing, thickness=4.0), 32, plates="none")
    colour = shown(build, standing=standing)
    catalogue = load_catalogue()
    bricks = lab_from_srgb(catalogue.rgb)
    difference = ciede2000(lab_from_srgb(image)[:, :, None], bricks)
    mean = difference.reshape(len(colour), -1, colour.shape[1], TEXELS, len(bricks)).mean(axis=(1, 3))
    own = np.take_along_axis(mean, np.searchsorted(catalogue.codes, colour)[..., None], axis=2)[..., 0]
    assert (catalogue.codes[:-1] < catalogue.codes[1:]).all()
    # 1 in CIEDE2000 is what an observer just notices
    assert (own - mean.min(axis=2) < 1).mean() >= 0.95


@pytest.mark.parametrize("standing", [False, True])
def test_extruded_picture(standing):
    """A flat shape cut out of a coloured plate becomes that shape in one coloured layer."""
    disc = turned_about_z([(0, 0), (64, 0), (64, 9.6), (0, 9.6)], 96)
    mesh = painted(disc, np.where(disc.vertices[disc.faces][..., 0].mean(axis=1) > 0, 4, 1))
    build = built(stood_up(mesh) if standing else mesh, 16)
    colour = shown(build, standing=standing)
    rise = (np.arange(len(colour)) + 0.5) / len(colour) * 2 - 1
    x, y = np.meshgrid((np.arange(16) - 7.5) / 8, rise)
    inside = np.hypot(x, y)
    assert (colour[inside < 0.9] >= 0).all()
    assert (colour[inside > 1.1] == COLOUR_EMPTY).all()
    solid = colour >= 0
    assert (colour == np.where(x > 0, 4, 1))[solid].mean() >= 0.95


@pytest.mark.parametrize("standing", [False, True])
def test_relief_stands_on_a_level_back(standing):
    """An open relief gets a level back, lies on the ground with all of it, and is in one piece."""
    hills = sheet(12, 12, lambda x, y: 0.12 * np.sin(4 * x) * np.cos(3 * y))
    hills = painted(replace(hills, vertices=128 * hills.vertices), np.where(np.arange(288) % 24 < 12, 2, 14))
    build = built(stood_up(hills) if standing else hills, 16)
    starts = levels(build.grid.solid, Facing(1, -1) if standing else Facing(2, 1))
    assert (starts == starts[0]).all()


def test_not_flat():
    """Backing for what is not flat is refused in one sentence."""
    with pytest.raises(SettingsError, match=r"as thick as broad: set backing to 0 or make the model flatter\.$"):
        legorize(sphere(4, 40.0), Settings(width=8, backing=2))
