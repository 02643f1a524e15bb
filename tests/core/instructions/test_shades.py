"""Colours of the pictures."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.shades import DARK, SUPPORT_TINT, brightness, lit, mixed, pale, tint_for, tinted
from legorize_addon.core.model.catalogue import load_catalogue

COLOURS = [colour.rgb for colour in load_catalogue().colours]


def test_sides_are_told_apart():
    """Of every colour the top is brighter than the left side, and that than the right one."""
    for rgb in COLOURS:
        top, left, right = (brightness(lit(rgb, side)) for side in range(3))
        assert top > left > right


def test_what_was_there_is_paler():
    """Pale colours are brighter than their own, and still differ from white."""
    for rgb in COLOURS:
        assert brightness(pale(rgb)) >= brightness(rgb)
        assert pale(rgb) != (255, 255, 255)


def test_supports_are_tinted():
    """Supports of any colour are more orange than anything: red leads blue by far."""
    for rgb in COLOURS:
        red, _, blue = tinted(rgb)
        assert red - blue > (rgb[0] - rgb[2]) * 0.45


def test_mixtures_and_brightness():
    """Halves are the mean; white is 1, black 0; black plastic counts as dark, yellow does not."""
    assert mixed((0, 100, 200), (100, 200, 0), 0.5) == (50, 150, 100)
    assert brightness((255, 255, 255)) == pytest.approx(1)
    assert brightness((0, 0, 0)) == 0
    assert brightness((27, 42, 52)) < DARK < brightness((250, 200, 10))


def test_the_tint_differs_from_the_model():
    """An orange model has supports of another colour, an odd orange brick changes nothing."""
    assert tint_for(np.array([[0, 0, 200]] * 99 + [[255, 130, 40]])) == SUPPORT_TINT
    assert tint_for(np.array([[250, 120, 40]] * 9)) != SUPPORT_TINT
