"""Colour differences against the published pairs, and what any difference must keep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb

# Sharma, Wu and Dalal 2005, table 1: all 34 pairs, made to meet every branch of the formula
BLUE = (50, 0, -82.7485)
PAIRS = [
    ((50, 2.6772, -79.7751), BLUE, 2.0425),
    ((50, 3.1571, -77.2803), BLUE, 2.8615),
    ((50, 2.8361, -74.0200), BLUE, 3.4412),
    ((50, -1.3802, -84.2814), BLUE, 1.0000),
    ((50, -1.1848, -84.8006), BLUE, 1.0000),
    ((50, -0.9009, -85.5211), BLUE, 1.0000),
    ((50, 0, 0), (50, -1, 2), 2.3669),
    ((50, -1, 2), (50, 0, 0), 2.3669),
    ((50, 2.4900, -0.0010), (50, -2.4900, 0.0009), 7.1792),
    ((50, 2.4900, -0.0010), (50, -2.4900, 0.0010), 7.1792),
    ((50, 2.4900, -0.0010), (50, -2.4900, 0.0011), 7.2195),
    ((50, 2.4900, -0.0010), (50, -2.4900, 0.0012), 7.2195),
    ((50, -0.0010, 2.4900), (50, 0.0009, -2.4900), 4.8045),
    ((50, -0.0010, 2.4900), (50, 0.0010, -2.4900), 4.8045),
    ((50, -0.0010, 2.4900), (50, 0.0011, -2.4900), 4.7461),
    ((50, 2.5, 0), (50, 0, -2.5), 4.3065),
    ((50, 2.5, 0), (73, 25, -18), 27.1492),
    ((50, 2.5, 0), (61, -5, 29), 22.8977),
    ((50, 2.5, 0), (56, -27, -3), 31.9030),
    ((50, 2.5, 0), (58, 24, 15), 19.4535),
    ((50, 2.5, 0), (50, 3.1736, 0.5854), 1.0000),
    ((50, 2.5, 0), (50, 3.2972, 0), 1.0000),
    ((50, 2.5, 0), (50, 1.8634, 0.5757), 1.0000),
    ((50, 2.5, 0), (50, 3.2592, 0.3350), 1.0000),
    ((60.2574, -34.0099, 36.2677), (60.4626, -34.1751, 39.4387), 1.2644),
    ((63.0109, -31.0961, -5.8663), (62.8187, -29.7946, -4.0864), 1.2630),
    ((61.2901, 3.7196, -5.3901), (61.4292, 2.2480, -4.9620), 1.8731),
    ((35.0831, -44.1164, 3.7933), (35.0232, -40.0716, 1.5901), 1.8645),
    ((22.7233, 20.0904, -46.6940), (23.0331, 14.9730, -42.5619), 2.0373),
    ((36.4612, 47.8580, 18.3852), (36.2715, 50.5065, 21.2231), 1.4146),
    ((90.8027, -2.0831, 1.4410), (91.1528, -1.6435, 0.0447), 1.4441),
    ((90.9257, -0.5406, -0.9208), (88.6381, -0.8985, -0.7239), 1.5381),
    ((6.7747, -0.2908, -2.4247), (5.8714, -0.0985, -2.2286), 0.6377),
    ((2.0776, 0.0795, -1.1350), (0.9033, -0.0636, -0.5514), 0.9082),
]

colours = arrays(np.uint8, 3)


@pytest.mark.parametrize(("first", "second", "difference"), PAIRS)
def test_published_pairs(first, second, difference):
    """Every published pair gives its difference to the last printed digit, in both orders."""
    first, second = np.array(first, float), np.array(second, float)
    assert ciede2000(first, second) == pytest.approx(difference, abs=5e-5)
    assert ciede2000(second, first) == pytest.approx(difference, abs=5e-5)


@given(colours, colours)
def test_difference_is_symmetric_and_zero_only_for_equals(one, other):
    """The order of two colours does not matter; only equal colours do not differ."""
    first, second = lab_from_srgb(one), lab_from_srgb(other)
    assert ciede2000(first, second) == pytest.approx(ciede2000(second, first), abs=1e-9)
    assert ciede2000(first, first) == 0
    assert (ciede2000(first, second) < 1e-9) == np.array_equal(one, other)


def test_opposite_hues_do_not_depend_on_the_order():
    """Hues exactly opposite, where the mean hue could be either of two, take the same one both ways."""
    turn = np.radians(np.arange(0, 360, 7.5))
    first = np.stack([np.full(len(turn), 50), 30 * np.cos(turn), 30 * np.sin(turn)], axis=1)
    second = first * [1, -1, -1]
    np.testing.assert_allclose(ciede2000(first, second), ciede2000(second, first), rtol=1e-9)


def test_shapes_broadcast():
    """A column of colours against a row gives the table of all differences."""
    lab = np.array([first for first, _, _ in PAIRS], float)
    table = ciede2000(lab[:, None], lab[None])
    assert table.shape == (len(lab), len(lab))
    assert table[3, 20] == ciede2000(lab[3], lab[20])


def test_lab_of_known_colours():
    """White, black and the pure colours have their published CIELAB."""
    rgb = np.array([[255, 255, 255], [0, 0, 0], [255, 0, 0], [0, 255, 0], [0, 0, 255]], np.uint8)
    lab = [[100, 0, 0], [0, 0, 0], [53.24, 80.09, 67.20], [87.73, -86.18, 83.18], [32.30, 79.19, -107.86]]
    np.testing.assert_allclose(lab_from_srgb(rgb), lab, atol=0.02)


@given(st.integers(0, 254))
def test_greys_have_no_hue_and_rise_in_lightness(value):
    """A grey lies on the axis of CIELAB, a lighter one above it."""
    darker, lighter = lab_from_srgb(np.array([[value] * 3, [value + 1] * 3], np.uint8))
    assert np.abs(darker[1:]).max() < 0.01
    assert lighter[0] > darker[0]


@pytest.mark.parametrize(("degrees", "opposite"), [(0.0, True), (9e-10, True), (-9e-10, True), (1.3e-9, False)])
def test_opposite_hues_are_those_up_to_a_billionth_of_a_degree(degrees, opposite):
    """What rounding turns by less does not change the mean hue; what lies farther on is nearer the other way round."""
    turned = np.radians(180 + degrees)
    colours = np.array([[50, 20, 0.0], [50, 20 * np.cos(turned), 20 * np.sin(turned)]])
    exact = ciede2000(np.array([50, 20, 0.0]), np.array([50, -20, 0.0]))
    assert (ciede2000(*colours) == pytest.approx(exact, rel=1e-6)) == opposite
