"""Colours of studs: nearest, mixed, few, and those that win."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.unit_grid import COLOUR_EMPTY
from legorize_addon.core.mosaic.likeness import seen_from_afar
from legorize_addon.core.mosaic.picture import picture_of
from legorize_addon.core.mosaic.studs import Goal, canvas_of, goal_of
from legorize_addon.core.mosaic.tints import fewer_colours, stud_colours, winning_colours
from tests.core.mosaic.pictures import CATALOGUE, painted, ramp

GREYS = np.array([0, 15, 71, 72], np.int16)


def goal_for(picture, longer):
    """Return the goal of an image without a border."""
    return goal_of(picture, canvas_of(picture.size, longer=longer, border=0), least=0.5, behind=None)


@pytest.mark.parametrize("dithering", ["none", "ordered", "diffusion"])
def test_brick_colours_stay_what_they_are(dithering):
    """An image in brick colours is hardly mixed, and is neither turned nor mirrored."""
    codes = np.repeat(np.repeat(np.array([[4, 15, 1], [14, 2, 72]], np.int16), 4, axis=0), 4, axis=1)
    found = stud_colours(goal_for(painted(codes, 2), 12), CATALOGUE.codes, CATALOGUE, dithering=dithering)
    assert (found == codes).mean() > 0.9


@pytest.mark.parametrize("dithering", ["ordered", "diffusion"])
def test_mixed_greys_look_more_like_a_ramp(dithering):
    """From afar, four greys that are mixed are nearer to a ramp than four bands."""
    goal = goal_for(ramp(), 60)
    bands, mixed = (stud_colours(goal, GREYS, CATALOGUE, dithering=kind) for kind in ("none", dithering))
    assert set(np.unique(mixed)) <= set(GREYS.tolist())
    assert seen_from_afar(goal, mixed, CATALOGUE) < 0.7 * seen_from_afar(goal, bands, CATALOGUE)


def test_bare_studs_have_no_colour():
    """Whatever the way of choosing."""
    goal = Goal(np.full((2, 2, 3), 0.5), np.array([[True, False], [True, True]]))
    for dithering in ("none", "ordered", "diffusion"):
        found = stud_colours(goal, GREYS, CATALOGUE, dithering=dithering)
        assert (found == COLOUR_EMPTY).tolist() == [[False, True], [False, False]]


def test_fewer_colours_leave_out_what_is_missed_least():
    """Of three colours, the one of a single stud goes, and the palette keeps its order."""
    codes = np.full((4, 4), 4, np.int16)
    codes[:2], codes[0, 0] = 15, 320
    palette = np.array([15, 320, 4], np.int16)
    assert fewer_colours(goal_for(painted(codes), 4), palette, CATALOGUE, 2).tolist() == [15, 4]
    assert fewer_colours(goal_for(painted(codes), 4), palette, CATALOGUE, 3).tolist() == [15, 320, 4]
    assert fewer_colours(goal_for(painted(codes), 4), palette, CATALOGUE, 1).tolist() == [4]


def test_the_colour_of_most_pixels_wins():
    """A stud that is two thirds red and a third white is red, not pink."""
    picture = painted(np.array([[4, 4, 15, 15, 15, 15]], np.int16), 3)
    palette = np.array([4, 15, 29], np.int16)
    goal = goal_for(picture, 2)
    assert winning_colours(picture, goal, palette, CATALOGUE).tolist() == [[4, 15]]
    assert stud_colours(goal, palette, CATALOGUE, dithering="none")[0, 0] == 29


def test_what_cannot_be_seen_does_not_win():
    """Clear pixels have no vote."""
    rgb = CATALOGUE.rgb[np.searchsorted(CATALOGUE.codes, [[4, 15, 15]])]
    picture = picture_of(rgb, np.array([[255, 100, 100]], np.uint8))
    goal = Goal(np.zeros((1, 1, 3)), np.ones((1, 1), bool))
    assert winning_colours(picture, goal, np.array([15, 4], np.int16), CATALOGUE).tolist() == [[4]]
