"""Studs of an image: their number and their light."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.colours.difference import linear_from_srgb
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.mosaic.picture import picture_of
from legorize_addon.core.mosaic.studs import canvas_of, goal_of, longer_side


@pytest.mark.parametrize(
    ("size", "longer", "border", "expected"),
    [
        ((400, 300), 48, 0, (48, 36)),
        ((300, 400), 48, 0, (36, 48)),
        ((400, 300), 48, 2, (44, 33)),
        ((1000, 1), 48, 0, (48, 1)),
        ((7, 7), 1, 0, (1, 1)),
    ],
)
def test_proportions_are_kept(size, longer, border, expected):
    """The longer side, with the border, has the studs that were asked for."""
    found = canvas_of(size, longer=longer, border=border)
    assert (found.columns, found.rows) == expected
    assert max(found.size) == longer
    assert found.size == (expected[0] + 2 * border, expected[1] + 2 * border)


@given(st.integers(1, 5000), st.integers(1, 5000), st.integers(1, 200))
def test_proportions_are_as_near_as_whole_studs_can_be(width, height, longer):
    """The shorter side is off by half a stud at most, or it is one stud."""
    found = canvas_of((width, height), longer=longer, border=0)
    short, exact = min(found.size), longer * min(width, height) / max(width, height)
    assert short == 1 or abs(short - exact) <= 0.5


def test_a_border_that_leaves_nothing_is_refused():
    """It says how wide both are."""
    with pytest.raises(SettingsError, match="border of 4 studs on each side leaves nothing of the 8"):
        canvas_of((10, 10), longer=8, border=4)


@pytest.mark.parametrize(("size_by", "studs"), [("width", 24), ("cm", 48)])
def test_size_in_studs_or_cm(size_by, studs):
    """A stud is 8 mm."""
    assert longer_side(size_by=size_by, width=24, cm=38.4) == pytest.approx(studs)


@pytest.mark.parametrize("size_by", ["height", "scale", "parts"])
def test_sizes_without_a_meaning_are_refused(size_by):
    """An image has no height in bricks, and no size to be scaled."""
    with pytest.raises(SettingsError, match=f"sized by {size_by}"):
        longer_side(size_by=size_by, width=24, cm=1)


def test_light_is_the_mean_of_the_pixels():
    """Black and white pixels give half of the light, not the middle of the bytes."""
    rgb = np.zeros((2, 4, 3), np.uint8)
    rgb[:, ::2] = 255
    found = goal_of(picture_of(rgb), canvas_of((4, 2), longer=2, border=0), least=0.5, behind=None)
    np.testing.assert_allclose(found.light, 0.5, atol=1e-6)
    assert found.there.all()


def test_clear_pixels_do_not_colour_a_stud():
    """A stud takes the colour of what is seen of it; below the least alpha it stays bare."""
    rgb = np.zeros((1, 8, 3), np.uint8)
    rgb[0, :, 1] = 255
    rgb[0, ::2] = (255, 0, 0)
    alpha = np.array([[255, 0, 255, 0, 100, 0, 0, 0]], np.uint8)
    canvas = canvas_of((8, 1), longer=4, border=0)
    found = goal_of(picture_of(rgb, alpha), canvas, least=0.5, behind=None)
    assert found.there.tolist() == [[True, True, False, False]]
    np.testing.assert_allclose(found.light[0, :2], [[1, 0, 0]] * 2, atol=1e-6)


def test_a_background_shines_through():
    """Every stud is covered then, in the mixture."""
    rgb, alpha = np.full((1, 2, 3), 255, np.uint8), np.array([[255, 0]], np.uint8)
    behind = linear_from_srgb(np.array([200, 0, 0], np.uint8))
    found = goal_of(picture_of(rgb, alpha), canvas_of((2, 1), longer=2, border=0), least=0.5, behind=behind)
    assert found.there.all()
    np.testing.assert_allclose(found.light[0], [np.ones(3), behind], atol=1e-6)


def test_nothing_opaque_enough_is_refused():
    """The sentence names the setting."""
    faint = picture_of(np.zeros((2, 2, 3), np.uint8), np.full((2, 2), 60, np.uint8))
    with pytest.raises(SettingsError, match="least_alpha"):
        goal_of(faint, canvas_of((2, 2), longer=2, border=0), least=0.5, behind=None)
