"""Bricks look as different from wanted colours as CIEDE2000 says, but Black is as black as pure black."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.colours.brick_difference import BLACK, brick_differences
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.model.catalogue import load_catalogue
from tests.core.textured import rgb_of

CATALOGUE = load_catalogue()


def test_each_with_its_own_and_all_with_all():
    """Shapes broadcast: one brick for each colour, or every brick for every colour."""
    wanted = lab_from_srgb(np.array([[200, 30, 40], [10, 90, 200]], np.uint8))
    codes = np.array([1, 4], np.int16)
    bricks = lab_from_srgb(rgb_of(codes))
    np.testing.assert_array_equal(brick_differences(wanted, codes, CATALOGUE), ciede2000(wanted, bricks))
    table = brick_differences(wanted[:, None], codes, CATALOGUE)
    np.testing.assert_array_equal(table, ciede2000(wanted[:, None], bricks[None]))


def test_black_is_black():
    """Both pure black and LDraw's dark blue-grey are the colour of a black brick; other bricks have one colour."""
    blacks = np.stack([np.zeros(3), lab_from_srgb(rgb_of([BLACK]))[0]])
    np.testing.assert_allclose(brick_differences(blacks, np.array([BLACK, BLACK], np.int16), CATALOGUE), 0, atol=1e-9)
    white = np.array([15, 15], np.int16)
    assert (brick_differences(blacks, white, CATALOGUE) > 70).all()


def test_no_bricks():
    """Of nothing there is no difference."""
    assert brick_differences(np.zeros((0, 3)), np.zeros(0, np.int16), CATALOGUE).shape == (0,)
