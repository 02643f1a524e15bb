"""Hollowing: shells of the right thickness, cavities, plates, and what stays as it was."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.shell.hollowing import erode, hollow
from legorize_addon.core.shell.regions import kept
from tests.core.light import holes


def grid_of(colour):
    """Return a solid grid, given the colours (n_layers, 3, n_y, n_x)."""
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, Fill.REQUIRED).astype(np.uint8)
    return UnitGrid(colour.astype(np.int16), cover, np.zeros(colour.shape, np.uint8), np.zeros(3))


def bricks_of(solid):
    """Return a solid grid of whole bricks of any colour, given a mask (n_layers, n_y, n_x)."""
    colour = np.where(solid, COLOUR_ANY, COLOUR_EMPTY)
    return grid_of(np.repeat(colour[:, None], 3, axis=1))


def stepped(seed):
    """Return a random solid of plates with overhangs and cavities, (n_layers, 3, n_y, n_x)."""
    noise = ndimage.gaussian_filter(np.random.default_rng(seed).normal(size=(36, 14, 15)), (5, 2, 2), mode="wrap")
    return (noise > np.quantile(noise, 0.2)).reshape(12, 3, 14, 15)


solids = st.integers(0, 2**60 - 1).map(lambda bits: np.array([bits >> n & 1 for n in range(60)], bool).reshape(3, 4, 5))


@pytest.mark.parametrize("shell", [1, 2, 3])
def test_a_cube_keeps_a_shell_and_one_optional_cell(shell):
    """Of a cube of n bricks, n^3 - (n - 2t)^3 must be built and one more layer may be."""
    cover = hollow(bricks_of(np.ones((20, 20, 20), bool)), shell=shell).cover[:, 0]
    core, rest = (20 - 2 * shell) ** 3, (18 - 2 * shell) ** 3
    assert np.count_nonzero(cover == Fill.REQUIRED) == 20**3 - core
    assert np.count_nonzero(cover == Fill.OPTIONAL) == core - rest
    assert np.count_nonzero(cover == Fill.EMPTY) == rest


def test_a_thick_shell_leaves_nothing_out():
    """A shell of half the model or more builds everything."""
    grid = bricks_of(np.ones((4, 5, 6), bool))
    assert (hollow(grid, shell=100).cover == Fill.REQUIRED).all()


def test_no_shell_means_solid():
    """Without a thickness every cell of the model must be built, and nothing else changes."""
    grid = grid_of(np.random.default_rng(0).integers(COLOUR_EMPTY, 3, (4, 3, 5, 6)))
    solid = hollow(grid, shell=None)
    np.testing.assert_array_equal(solid.cover == Fill.REQUIRED, grid.solid)
    np.testing.assert_array_equal(solid.colour, grid.colour)


def test_cavities_stay_empty_and_get_a_shell():
    """An enclosed cavity is left empty, and every cell around it must be built."""
    solid = np.ones((11, 11, 11), bool)
    solid[5, 5, 5] = False
    cover = hollow(bricks_of(solid), shell=1).cover[:, 0]
    around = cover[4:7, 4:7, 4:7]
    assert cover[5, 5, 5] == Fill.EMPTY
    assert np.count_nonzero(around == Fill.REQUIRED) == 26


@given(solids)
def test_shell_is_what_has_an_empty_neighbour(solid):
    """A brick must be built exactly if one of its 26 neighbours is empty or outside."""
    whole = np.pad(solid, 1)
    deep = ndimage.minimum_filter(whole, size=3)[1:-1, 1:-1, 1:-1]
    cover = hollow(bricks_of(solid), shell=1).cover
    np.testing.assert_array_equal(cover == Fill.REQUIRED, np.repeat((solid & ~deep)[:, None], 3, axis=1))


@given(solids, st.booleans())
def test_shell_equals_the_four_cases_in_both_directions(solid, open_bottom):
    """The paper's rule for the layers above and below, with contours of eight neighbours, gives the same shell."""
    shell = kept(solid, open_bottom=open_bottom, corners=True)
    cover = hollow(bricks_of(solid), shell=1, open_bottom=open_bottom).cover
    np.testing.assert_array_equal(cover[:, 1] == Fill.REQUIRED, shell)


@given(solids, st.integers(1, 2))
def test_upper_rule_is_the_paper_s(solid, shell):
    """With the layer above alone the shell is the paper's, taken off as often as the shell is thick."""
    rest = solid
    for _ in range(shell):
        rest = rest & ~kept(rest, upper_only=True)
    cover = hollow(bricks_of(solid), shell=shell, rule="upper").cover
    np.testing.assert_array_equal(cover == Fill.REQUIRED, np.repeat((solid & ~rest)[:, None], 3, axis=1))


@given(st.integers(0, 2**20), st.integers(1, 2))
def test_columns_are_deep_where_all_around_is_solid(seed, thickness):
    """A column is deep exactly if all plates within reach are solid: two plates for the last brick."""
    solid = np.random.default_rng(seed).random((6, 3, 7, 7)) < 0.97
    deep = erode(solid, thickness)
    height = 3 * (thickness - 1) + 2
    plates = np.pad(solid.reshape(-1, 7, 7), ((height,) * 2, (thickness,) * 2, (thickness,) * 2))
    span = 2 * thickness + 1
    for layer, y, x in np.ndindex(deep.shape):
        around = plates[3 * layer : 3 * layer + 3 + 2 * height, y : y + span, x : x + span]
        assert deep[layer, y, x] == around.all()


@given(st.integers(0, 2**20), st.sampled_from(["both", "upper"]), st.sampled_from(["cheaper", "pillars", "free"]))
def test_no_brick_becomes_plates(seed, rule, ceilings):
    """Full columns keep one cover; plates of other columns are all built."""
    solid = stepped(seed)
    cover = hollow(grid_of(np.where(solid, COLOUR_ANY, COLOUR_EMPTY)), shell=1, rule=rule, ceilings=ceilings).cover
    full = np.broadcast_to(solid.all(axis=1, keepdims=True), solid.shape)
    assert (cover.min(axis=1) == cover.max(axis=1))[full[:, 0]].all()
    assert (cover[solid & ~full] == Fill.REQUIRED).all()


@given(st.integers(0, 2**20), st.sampled_from(["corbels", "pillars", "cheaper", "free"]))
def test_no_hole_shows(seed, ceilings):
    """Light from 26 directions meets the shell first, through every opening; plates and bricks alike."""
    solid = stepped(seed)
    cover = hollow(grid_of(np.where(solid, COLOUR_ANY, COLOUR_EMPTY)), shell=1, ceilings=ceilings).cover
    plates = (-1, *solid.shape[2:])
    assert holes(solid.reshape(plates), (cover == Fill.REQUIRED).reshape(plates)) == 0


def test_light_finds_holes():
    """A shell that closes faces alone lets light through its edges, and an open bottom shows from below only."""
    ball = np.linalg.norm(np.indices((13, 13, 13)) - 6, axis=0) < 6.5
    faces = ball & ~ndimage.binary_erosion(ball)
    assert holes(ball, faces) > 0
    assert holes(ball, kept(ball, corners=True)) == 0
    assert holes(ball, kept(ball)) > 0
    cut = kept(ball[6:], corners=True, open_bottom=True)
    assert holes(ball[6:], cut) > 0
    assert holes(ball[6:], cut, ground=True) == 0


@given(st.integers(0, 2**20), st.sampled_from(["corbels", "pillars", "cheaper"]), st.booleans())
def test_the_shell_hangs_together(seed, ceilings, open_bottom):
    """What must be built is joined by faces, through cells that may be, wherever the solid model is."""
    solid = stepped(seed)
    grid = grid_of(np.where(solid, COLOUR_ANY, COLOUR_EMPTY))
    cover = hollow(grid, shell=1, ceilings=ceilings, open_bottom=open_bottom).cover.reshape(-1, *solid.shape[2:])
    part, _ = ndimage.label(cover != Fill.EMPTY)
    whole, n_whole = ndimage.label(solid.reshape(cover.shape))
    required = cover == Fill.REQUIRED
    assert len(np.unique(np.stack([part[required], whole[required]]), axis=1)[0]) == n_whole


def test_the_shell_is_sealed():
    """Water around a hollowed model never gets in."""
    solid = stepped(5)
    cover = hollow(grid_of(np.where(solid, COLOUR_ANY, COLOUR_EMPTY)), shell=1, ceilings="cheaper").cover
    required = np.pad((cover == Fill.REQUIRED).reshape(-1, *solid.shape[2:]), 1)
    water, _ = ndimage.label(~required, np.ones((3, 3, 3)))
    whole = np.pad(solid.reshape(-1, *solid.shape[2:]), 1)
    assert (whole & ~required).any()
    assert not (whole & (water == water[0, 0, 0])).any()


def test_tunnels_stay_open():
    """A tunnel is left open from end to end and gets walls of its own."""
    solid = np.ones((12, 12, 20), bool)
    solid[5:7, 5:7] = False
    cover = hollow(bricks_of(solid), shell=1, ceilings="cheaper").cover[:, 0]
    assert (cover[5:7, 5:7] == Fill.EMPTY).all()
    assert (cover[4:8, 4:8][:, [0, 3]] == Fill.REQUIRED).all()
    assert (cover[[4, 7], 4:8] == Fill.REQUIRED).all()


@pytest.mark.parametrize(("plates", "cover_below"), [(1, Fill.REQUIRED), (2, Fill.OPTIONAL), (3, Fill.OPTIONAL)])
def test_two_plates_make_a_roof(plates, cover_below):
    """Under a roof of one plate the next brick must be there too; under two plates, or a brick, it may be."""
    solid = np.ones((9, 3, 9, 9), bool)
    solid[8, plates:] = False
    cover = hollow(grid_of(np.where(solid, COLOUR_ANY, COLOUR_EMPTY)), shell=1).cover
    assert (cover[8][solid[8]] == Fill.REQUIRED).all()
    assert (cover[7, :, 4, 4] == cover_below).all()


def test_the_ground_covers_an_open_bottom():
    """A cube of n bricks open below must have n^2 + (n - 1) (4 n - 4) of them, and may have a layer inside."""
    n = 12
    cover = hollow(bricks_of(np.ones((n, n, n), bool)), shell=1, open_bottom=True).cover[:, 0]
    assert np.count_nonzero(cover == Fill.REQUIRED) == n**2 + (n - 1) * (4 * n - 4)
    assert np.count_nonzero(cover == Fill.OPTIONAL) == (n - 2) ** 2 + (n - 2) * (4 * n - 12)


@pytest.mark.parametrize(("ceilings", "role"), [("corbels", Role.INSIDE), ("pillars", Role.SUPPORT_INSIDE)])
def test_what_carries_ceilings_has_its_role(ceilings, role):
    """Carriers must be built, in any colour, with optional cells around; nothing else changes."""
    colour = np.full((12, 3, 16, 16), 4)
    free = hollow(grid_of(colour), shell=1)
    carried = hollow(grid_of(colour), shell=1, ceilings=ceilings)
    added = (carried.cover == Fill.REQUIRED) & (free.cover != Fill.REQUIRED)
    assert added.any()
    assert (carried.role[added] == role).all()
    assert (carried.colour[added] == COLOUR_ANY).all()
    assert (carried.colour[~added & (carried.cover != Fill.EMPTY)] == 4).all()
    required = (carried.cover == Fill.REQUIRED)[:, 0]
    near = ndimage.binary_dilation(required, np.ones((3, 3, 3)))
    np.testing.assert_array_equal((carried.cover == Fill.OPTIONAL)[:, 0], near & ~required)


def test_pillars_may_have_a_colour():
    """Only what carries ceilings as pillars takes it."""
    colour = np.full((12, 3, 16, 16), COLOUR_ANY)
    plain, red = (hollow(grid_of(colour), shell=1, ceilings="pillars", pillar_colour=c) for c in (COLOUR_ANY, 4))
    np.testing.assert_array_equal(red.colour == 4, red.role == Role.SUPPORT_INSIDE)
    assert (red.colour == 4).any()
    np.testing.assert_array_equal(red.cover, plain.cover)


def test_colours_and_roles():
    """Kept cells keep their colour, emptied ones lose it, and hidden cells of the shell are inside."""
    colour = np.full((9, 3, 9, 9), COLOUR_ANY)
    colour[0] = 4
    grid = grid_of(colour)
    shell = hollow(grid, shell=1)
    kept = shell.cover != Fill.EMPTY
    np.testing.assert_array_equal(shell.colour[kept], grid.colour[kept])
    np.testing.assert_array_equal(shell.colour == COLOUR_EMPTY, ~kept)
    assert (shell.role[0] == Role.SHELL).all()
    assert (shell.role[4][kept[4]] == Role.INSIDE).all()
    assert (grid.cover == Fill.REQUIRED).all()
