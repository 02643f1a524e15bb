"""Hollowing: shells of the right thickness, cavities, plates, and what stays as it was."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.hollowing import eroded, hollow
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, Cover, Role, UnitGrid


def grid_of(colour):
    """Return a solid grid, given the colours (n_layers, 3, n_y, n_x)."""
    cover = np.where(colour == COLOUR_EMPTY, Cover.EMPTY, Cover.MUST).astype(np.uint8)
    return UnitGrid(colour.astype(np.int16), cover, np.zeros(colour.shape, np.uint8), np.zeros(3))


def bricks_of(solid):
    """Return a solid grid of whole bricks of any colour, given a mask (n_layers, n_y, n_x)."""
    colour = np.where(solid, COLOUR_ANY, COLOUR_EMPTY)
    return grid_of(np.repeat(colour[:, None], 3, axis=1))


def contour(layer):
    """Return the cells of a layer that have an empty one among their eight neighbours."""
    return layer & ~ndimage.binary_erosion(layer, np.ones((3, 3)))


solids = st.integers(0, 2**60 - 1).map(lambda bits: np.array([bits >> n & 1 for n in range(60)], bool).reshape(3, 4, 5))


@pytest.mark.parametrize("shell", [1, 2, 3])
def test_a_cube_keeps_a_shell_and_one_optional_cell(shell):
    """Of a cube of n bricks, n^3 - (n - 2t)^3 must be built and one more layer may be."""
    cover = hollow(bricks_of(np.ones((20, 20, 20), bool)), shell=shell).cover[:, 0]
    core, rest = (20 - 2 * shell) ** 3, (18 - 2 * shell) ** 3
    assert np.count_nonzero(cover == Cover.MUST) == 20**3 - core
    assert np.count_nonzero(cover == Cover.MAY) == core - rest
    assert np.count_nonzero(cover == Cover.EMPTY) == rest


def test_a_thick_shell_leaves_nothing_out():
    """A shell of half the model or more builds everything."""
    grid = bricks_of(np.ones((4, 5, 6), bool))
    assert (hollow(grid, shell=100).cover == Cover.MUST).all()


def test_no_shell_means_solid():
    """Without a thickness every cell of the model must be built, and nothing else changes."""
    grid = grid_of(np.random.default_rng(0).integers(COLOUR_EMPTY, 3, (4, 3, 5, 6)))
    solid = hollow(grid, shell=None)
    np.testing.assert_array_equal(solid.cover == Cover.MUST, grid.solid)
    np.testing.assert_array_equal(solid.colour, grid.colour)


def test_cavities_stay_empty_and_get_a_shell():
    """An enclosed cavity is left empty, and every cell around it must be built."""
    solid = np.ones((11, 11, 11), bool)
    solid[5, 5, 5] = False
    cover = hollow(bricks_of(solid), shell=1).cover[:, 0]
    around = cover[4:7, 4:7, 4:7]
    assert cover[5, 5, 5] == Cover.EMPTY
    assert np.count_nonzero(around == Cover.MUST) == 26


@given(solids)
def test_shell_is_what_has_an_empty_neighbour(solid):
    """A brick must be built exactly if one of its 26 neighbours is empty or outside."""
    whole = np.pad(solid, 1)
    deep = ndimage.minimum_filter(whole, size=3)[1:-1, 1:-1, 1:-1]
    cover = hollow(bricks_of(solid), shell=1).cover
    np.testing.assert_array_equal(cover == Cover.MUST, np.repeat((solid & ~deep)[:, None], 3, axis=1))


@given(solids)
def test_shell_equals_the_four_cases_in_both_directions(solid):
    """The paper's rule for the layers above and below, with contours of eight neighbours, gives the same shell."""
    padded = np.pad(solid, 1)
    shell = np.zeros_like(padded)
    for layer in range(1, len(padded) - 1):
        here = padded[layer]
        for other in (padded[layer - 1], padded[layer + 1]):
            shell[layer] |= contour(here) | (here & ~other) | (contour(other) & here)
    np.testing.assert_array_equal(hollow(bricks_of(solid), shell=1).cover[:, 1] == Cover.MUST, shell[1:-1, 1:-1, 1:-1])


@given(st.integers(0, 2**20), st.integers(1, 2))
def test_plates_of_a_brick_are_deep_together(seed, thickness):
    """The three plates of a cell are deep all or none, and only if every plate within reach is solid."""
    solid = np.random.default_rng(seed).random((6, 3, 7, 7)) < 0.97
    deep = eroded(solid, thickness)
    assert (deep.all(axis=1) == deep.any(axis=1)).all()
    plates = np.pad(solid.reshape(-1, 7, 7), ((3 * thickness,) * 2, (thickness,) * 2, (thickness,) * 2))
    span = 2 * thickness + 1
    for layer, y, x in np.argwhere(deep[:, 0]):
        assert plates[3 * layer : 3 * layer + 3 * span, y : y + span, x : x + span].all()


def test_a_missing_plate_keeps_the_bricks_around_it():
    """Under a plate of a stepped top the whole bricks of the shell are kept, not single plates of them."""
    solid = np.ones((9, 3, 9, 9), bool)
    solid[8, 1:] = False
    colour = np.where(solid, COLOUR_ANY, COLOUR_EMPTY)
    cover = hollow(grid_of(colour), shell=1).cover
    assert (cover[7] == Cover.MUST).all()
    assert (cover[8, 0] == Cover.MUST).all()
    assert (cover[8, 1:] == Cover.EMPTY).all()
    assert (cover[6, :, 4, 4] == Cover.MAY).all()


def test_colours_and_roles():
    """Kept cells keep their colour, emptied ones lose it, and hidden cells of the shell are inside."""
    colour = np.full((9, 3, 9, 9), COLOUR_ANY)
    colour[0] = 4
    grid = grid_of(colour)
    shell = hollow(grid, shell=1)
    kept = shell.cover != Cover.EMPTY
    np.testing.assert_array_equal(shell.colour[kept], grid.colour[kept])
    np.testing.assert_array_equal(shell.colour == COLOUR_EMPTY, ~kept)
    assert (shell.role[0] == Role.SHELL).all()
    assert (shell.role[4][kept[4]] == Role.INSIDE).all()
    assert (grid.cover == Cover.MUST).all()
