"""Fewer parts: lone plates and lone colours give way, runs and clear details stay, nothing tears."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.unit_bricks.colour_votes import CLEAR, Ballot
from legorize_addon.core.unit_bricks.plates import Detail, settle_colours
from legorize_addon.core.unit_bricks.smoothing import smooth_colours, smooth_shapes
from tests.core.solids import sphere
from tests.core.textured import painted, turned_about_z

RED, BLUE = 4, 1
GAIN, WORTH = 0.1, 0.25


def row_of(*heights: int) -> np.ndarray:
    """Return a layer whose columns are so many plates high, one behind another, (3, n, 1)."""
    return np.array([[[height > level] for height in heights] for level in range(3)], dtype=float)


def shaped(share, *, worth=WORTH) -> list[int]:
    """Let the columns of a layer agree; return how many plates each has."""
    found = smooth_shapes(share >= 0.5, share, least_gain=GAIN, worth=worth)
    return found.sum(axis=0).ravel().tolist()


def test_lone_plates_between_bricks_are_filled_up():
    """Two plates between bricks become a brick, for a third of a brick; where parts are worth little they stay."""
    assert shaped(row_of(3, 3, 2, 3, 3)) == [3] * 5
    assert shaped(row_of(3, 3, 2, 3, 3), worth=0.05) == [3, 3, 2, 3, 3]


def test_runs_of_plates_stay():
    """Columns of two plates in a run are few parts: none is filled up."""
    assert shaped(row_of(*[3] * 4, *[2] * 6, *[3] * 4)) == [*[3] * 4, *[2] * 6, *[3] * 4]


def test_a_gap_in_a_run_is_closed():
    """A single column of one plate in a run of two takes the second one."""
    share = row_of(2, 2, 2, 1, 2, 2, 2)
    share[1, 3] = 0.4
    assert shaped(share) == [2] * 7


def test_two_thirds_of_a_brick_are_too_much():
    """One plate that a row of bricks ends with stays: as a brick it would err more than its part is worth."""
    assert shaped(row_of(3, 3, 3, 1)) == [3, 3, 3, 1]


def test_a_slit_that_hardly_pays_is_closed():
    """A gap of one plate through two columns, which neither would close alone, is closed; an open one stays."""
    share = np.ones((3, 2, 1))
    share[1] = 0.45
    assert shaped(share) == [3, 3]
    share[1] = 0.0
    assert shaped(share) == [2, 2]


def random_layers(seed) -> tuple[np.ndarray, np.ndarray]:
    """Return the share of cells inside something lumpy, and which of them are solid."""
    rng = np.random.default_rng(seed)
    share = np.clip(ndimage.gaussian_filter(rng.normal(0, 1, (9, 8, 7)), 1) * 2 + 0.5, 0, 1)
    return share, share >= 0.5


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0, 1))
def test_only_columns_of_plates_change_and_only_by_plates_more(seed, worth):
    """What is solid stays; bricks and empty columns stay as they are."""
    share, solid = random_layers(seed)
    found = smooth_shapes(solid, share, least_gain=GAIN, worth=worth)
    assert not (solid & ~found).any()
    before, after = (each.reshape(3, 3, 8, 7).swapaxes(0, 1) for each in (solid, found))
    partial = before.any(axis=0) & ~before.all(axis=0)
    np.testing.assert_array_equal(after[:, ~partial], before[:, ~partial])


def test_without_worth_and_gain_nothing_changes():
    """What is half covered is the best of all shapes if neither parts nor plates count."""
    share, solid = random_layers(3)
    np.testing.assert_array_equal(smooth_shapes(solid, share, least_gain=0.0, worth=0.0), solid)


# ---------------------------------------------------------------- colours


def ballot_of(surface: np.ndarray, difference: float) -> Ballot:
    """Let each visible cell vote for the colour of its surface; blue and red differ by so much."""
    votes = (surface[:, None] == np.array([BLUE, RED])).astype(float)
    return Ballot(np.array([BLUE, RED], np.int16), votes, votes, difference * (1 - np.eye(2)))


@pytest.mark.parametrize("code", [BLUE + 1, RED + 1])
def test_a_colour_that_nobody_voted_for_is_dearer_than_all_others(code):
    """A plate in a colour that is not on the ballot takes one that is, and no neighbour follows it."""
    red = np.full((3, 5, 1), RED, dtype=np.int16)
    everywhere, ballot = np.ones(red.shape, dtype=bool), ballot_of(red.ravel(), 90.0)
    plate, wall = red.copy(), np.full_like(red, code)
    plate[0, 2], wall[:, 2] = code, RED
    settled = settle_colours(plate, everywhere, ballot, Detail(np.array([True]), 0.0))
    np.testing.assert_array_equal(settled, red)
    agreed = smooth_colours(wall, everywhere, ballot, np.array([True]), least_gain=0.2, worth=WORTH)
    np.testing.assert_array_equal(agreed[:, 1:4], red[:, 1:4])


def coloured(colour: np.ndarray, difference: float, *, marked=True) -> np.ndarray:
    """Let the colours of a layer, (3, n_y, n_x), agree."""
    colour = colour.astype(np.int16)
    seen = colour >= 0
    ballot = ballot_of(colour[seen], difference)
    return smooth_colours(colour, seen, ballot, np.array([marked]), least_gain=0.2, worth=WORTH)


@pytest.mark.parametrize("plates", [slice(0, 1), slice(1, 2), slice(0, 3)], ids=["plate", "middle", "brick"])
def test_a_lone_cell_in_another_shade_takes_its_neighbours_colour(plates):
    """A red plate or brick in a blue wall turns blue where hardly anybody sees it, and stays where everybody does."""
    wall = np.full((3, 5, 1), BLUE)
    wall[plates, 2] = RED
    assert (coloured(wall, 3.0) == BLUE).all()
    np.testing.assert_array_equal(coloured(wall, 90.0), wall)


def test_a_level_border_inside_a_layer_stays():
    """Where all columns of a wall change their colour at the same plate, there are few parts: nothing changes."""
    wall = np.full((3, 8, 1), BLUE)
    wall[2] = RED
    np.testing.assert_array_equal(coloured(wall, 2 * CLEAR), wall)


def test_a_column_joins_the_border_beside_it():
    """A column that changes its colour a plate higher than all others follows them, if that is not clear."""
    wall = np.full((3, 8, 1), BLUE)
    wall[1:] = RED
    wall[1, 3] = BLUE
    assert (coloured(wall, CLEAR)[1] == RED).all()
    np.testing.assert_array_equal(coloured(wall, 2 * CLEAR), wall)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.floats(0, 100), st.booleans())
def test_only_visible_cells_change_and_take_visible_colours(seed, difference, marked):
    """What is empty or hidden stays so, what is seen keeps a colour, plain layers get no columns of several."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, BLUE, RED], size=(3, 6, 5), p=[0.1, 0.2, 0.4, 0.3])
    if not marked:
        colour = np.repeat(colour[:1], 3, axis=0)
    found = coloured(colour, difference, marked=marked)
    np.testing.assert_array_equal(np.where(found >= 0, 0, found), np.where(colour >= 0, 0, colour))
    if not marked:
        assert (found.min(axis=0) == found.max(axis=0)).all()


# ---------------------------------------------------------------- whole models


def lone_plates(build) -> tuple[int, int]:
    """Count the plates of a model of one colour that no other plate lies beside, and all of them."""
    solid = build.grid.solid
    plate = np.pad(solid & ~solid.all(axis=1)[:, None], ((0, 0), (0, 0), (1, 1), (1, 1)))
    beside = plate[:, :, 2:, 1:-1] | plate[:, :, :-2, 1:-1] | plate[:, :, 1:-1, 2:] | plate[:, :, 1:-1, :-2]
    inner = plate[:, :, 1:-1, 1:-1]
    return int((inner & ~beside).sum()), int(inner.sum())


@pytest.mark.parametrize("mesh", [sphere(24), turned_about_z([(0, 0), (30, 0), (0, 40)], n=64)], ids=["ball", "cone"])
def test_plates_of_round_models_lie_in_runs(mesh):
    """A ball and a cone have plates, but hardly any alone, where every other one may be if columns do not agree."""
    alone, agreed = (
        lone_plates(legorize(painted(mesh, RED), Settings(width=24, fewer_parts=worth)))
        for worth in (0.0, Settings().fewer_parts)
    )
    assert agreed[1] > 0
    assert agreed[0] / agreed[1] < 0.05
    assert alone[0] > 3 * agreed[0]
