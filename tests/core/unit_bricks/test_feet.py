"""Feet of walls and posts."""

from __future__ import annotations

import math

import numpy as np
import pytest

from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.feet import APART, STANDS, THIN, WIDE, add_feet, said_of_feet
from tests.core.unit_bricks.test_backing import photograph, slab

RED, BLUE = 4, 1


def wall(long, deep, layers, *, axis=1, colour=RED):
    """Return a wall along x (axis 1: it is thin along y) or along y, without any room around it."""
    shape = (layers, 3, deep, long) if axis else (layers, 3, long, deep)
    return UnitGrid(
        np.full(shape, colour, np.int16),
        np.full(shape, Fill.REQUIRED, np.uint8),
        np.zeros(shape, np.uint8),
        np.zeros(3),
    )


def tilt(solid, axis):
    """Return the degrees after which the middle of all cells is over the rim of the lowest ones."""
    cells = np.argwhere(solid.reshape(-1, *solid.shape[2:])) + 0.5
    middle, ground = cells.mean(axis=0), cells[cells[:, 0] == cells[:, 0].min()]
    column = 2 - axis
    rim = min(middle[column] - ground[:, column].min() + 0.5, ground[:, column].max() + 0.5 - middle[column])
    return math.degrees(math.atan2(8 * rim, 3.2 * (middle[0] - cells[:, 0].min() + 0.5)))


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize(("long", "deep", "layers"), [(12, 1, 20), (30, 2, 25), (2, 1, 9), (60, 3, 40)])
def test_a_wall_gets_feet_that_hold_it(long, deep, layers, axis):
    """With as many studs on both sides as are needed, and none too many, its tilt is what a foot was made for."""
    grid, [feet] = add_feet(before := wall(long, deep, layers, axis=axis))
    assert feet.axis == axis
    assert tilt(before.solid, axis) == pytest.approx(feet.before)
    assert feet.before < STANDS
    # the feet weigh little, low down
    assert tilt(grid.solid, axis) > STANDS
    assert feet.after >= STANDS
    assert feet.studs == 1 or math.degrees(math.atan2(8 * (deep / 2 + feet.studs - 1), 9.6 * layers / 2)) < STANDS
    assert grid.solid.shape[3 - axis] == deep + 2 * feet.studs
    assert (grid.solid == np.flip(grid.solid, 3 - axis)).all()
    assert (grid.solid == np.flip(grid.solid, 2 + axis)).all()
    assert grid.origin[axis] == -8 * feet.studs


def test_the_wall_itself_stays():
    """Its cells, colours and all above the second layer are as they were; feet are required and red."""
    before = wall(20, 2, 12)
    before.colour[2:] = BLUE
    grid, [feet] = add_feet(before)
    inner = np.s_[:, :, feet.studs : -feet.studs]
    assert (grid.colour[inner] == before.colour).all()
    added = grid.solid.copy()
    added[inner] = False
    assert not added[2:].any()
    assert (grid.colour[added] == RED).all()
    assert (grid.cover[added] == Fill.REQUIRED).all()
    assert (grid.colour[~grid.solid] == COLOUR_EMPTY).all()
    # the upper half of a foot is half as long
    lower, upper = (added[layer, 0].any(axis=1).sum() for layer in (0, 1))
    assert (lower, upper) == (2 * feet.studs, 2 * math.ceil(feet.studs / 2))


def test_feet_are_near_the_ends_and_not_too_far_apart():
    """Two studs wide, the last one at the end; up to 24 studs from one to the next."""
    for long, places in (
        (1, ()),
        (2, (1,)),
        (3, (1,)),
        (4, (1, 3)),
        (26, (1, 25)),
        (27, (1, 13, 26)),
        (50, (1, 25, 49)),
    ):
        _, feet = add_feet(wall(long, 1, 30))
        assert tuple(place for each in feet if each.axis == 1 for place in each.places) == places
        assert all(np.diff(each.places).max(initial=0) <= APART for each in feet)
    assert WIDE == 2


def test_a_post_gets_feet_on_four_sides():
    """A post of two by two studs falls to each side."""
    grid, feet = add_feet(wall(2, 2, 20))
    assert [each.axis for each in feet] == [0, 1]
    assert min(tilt(grid.solid, 0), tilt(grid.solid, 1)) > STANDS
    # a cross around the post
    r = feet[0].studs
    assert [each.studs for each in feet] == [r, r]
    cross = np.zeros((2 * r + 2, 2 * r + 2), bool)
    cross[r : r + 2] = cross[:, r : r + 2] = True
    np.testing.assert_array_equal(grid.solid[0, 0], cross)


@pytest.mark.parametrize(("long", "deep", "layers"), [(20, THIN, 4), (20, THIN + 1, 40), (8, 8, 60)])
def test_others_stay_as_they_are(long, deep, layers):
    """What is low, and what is thick, comes back."""
    grid = wall(long, deep, layers)
    assert add_feet(grid) == (grid, ())


def test_a_figure_on_a_thin_base_gets_none():
    """What leans out far above a thin base is no wall: where it needs something, forces say where pillars stand."""
    figure = wall(8, 10, 12)
    figure.cover[:4, :, :4] = figure.cover[:4, :, 6:] = Fill.EMPTY
    figure.colour[:4, :, :4] = figure.colour[:4, :, 6:] = COLOUR_EMPTY
    assert tilt(figure.solid, 1) < STANDS
    assert add_feet(figure)[1] == ()
    # a relief of the same base is one
    relief = wall(8, 5, 12)
    relief.cover[:4, :, 2:] = Fill.EMPTY
    relief.colour[:4, :, 2:] = COLOUR_EMPTY
    assert len(add_feet(relief)[1]) == 1


def test_nothing_needs_no_feet():
    """An empty grid comes back."""
    shape = (2, 3, 4, 5)
    grid = UnitGrid(
        np.full(shape, COLOUR_EMPTY, np.int16), np.zeros(shape, np.uint8), np.zeros(shape, np.uint8), np.zeros(3)
    )
    assert add_feet(grid) == (grid, ())


def test_a_wall_of_any_colour_has_feet_of_any_colour():
    """Where nothing is to be seen, the layout may choose."""
    grid, _ = add_feet(wall(6, 1, 20, colour=COLOUR_ANY))
    assert set(np.unique(grid.colour).tolist()) == {COLOUR_EMPTY, COLOUR_ANY}


def test_an_upright_picture_stands_on_its_feet():
    """It is built in one piece with them, which the notes tell; without the setting it is as thin as before."""
    mesh = slab(photograph(), standing=True)
    with_feet, without = (legorize(mesh, Settings(width=16, backing=1, feet=feet)) for feet in (True, False))
    assert with_feet.assembly.graph.n_components == 1
    assert [note for note in with_feet.notes if "feet" in note and "begin at studs 1, 15" in note]
    assert not [note for note in without.notes if "feet" in note]
    deep = [np.ptp(np.nonzero(each.grid.solid)[2]) + 1 for each in (with_feet, without)]
    assert deep[0] > deep[1]


def test_a_builder_is_told_what_feet_are():
    """Where they are, when they are put on, what they are for; how they are left out is for the user alone."""
    _, [feet] = add_feet(wall(12, 1, 20))
    sentence = feet.sentence()
    assert sentence.startswith("Feet of ")
    assert "are put on with its first 2 layers and stay." in sentence
    assert f"with them by {feet.after:.1f} degrees." in sentence
    [said] = said_of_feet(["Something else.", sentence])
    assert sentence == f"{said} Turn feet off to leave them out."


def test_the_feet_are_in_the_first_layers():
    """What the sentence says: nothing above them belongs to a foot."""
    grid, _ = add_feet(wall(12, 1, 20))
    rows = (grid.cover != Fill.EMPTY).any(axis=(1, 3)).sum(axis=1)
    assert (rows[:2] > 1).all()
    assert (rows[2:] == 1).all()
