"""Texels are found where they lie, and boxes of one colour are told from others."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.colours.texels import border_table, boxes_varied, texel_at

SHAPE = (3, 5)


@pytest.mark.parametrize("clamp", [True, False])
def test_the_middle_of_a_texel_is_in_it(clamp):
    """Every texel is found at its middle, whatever happens outside the image."""
    row, column = np.indices(SHAPE).reshape(2, -1)
    uv = np.column_stack([(column + 0.5) / SHAPE[1], (row + 0.5) / SHAPE[0]])
    found = texel_at(uv, SHAPE, clamp=clamp)
    np.testing.assert_array_equal(found, (column, row))


@given(st.integers(-3, 3), st.integers(-3, 3))
def test_outside_the_image_repeats_or_its_edge_goes_on(right, up):
    """Whole images away lies the same texel, or the edge texel on that side."""
    uv = np.array([[0.5 + right, 0.5 + up]])
    np.testing.assert_array_equal(texel_at(uv, SHAPE, clamp=False), [[2], [1]])
    edge = [[(0, 2, 4)[np.sign(right) + 1]], [(0, 1, 2)[np.sign(up) + 1]]]
    np.testing.assert_array_equal(texel_at(uv, SHAPE, clamp=True), edge)


@given(st.integers(0, 2**32 - 1))
def test_boxes_of_several_colours_are_found(seed):
    """No box inside an image that holds two colours is taken for one of a single colour."""
    rng = np.random.default_rng(seed)
    codes = np.repeat(np.repeat(rng.choice([4, 15], (3, 4)).astype(np.int16), 2, axis=0), 2, axis=1)
    low, high = np.sort(rng.random((2, 20, 2)), axis=0)
    varied = boxes_varied(border_table(codes), low, high, clamp=True)
    for box, (first, last) in zip(varied, zip(low, high, strict=True), strict=True):
        x, y = np.floor([first, last] * np.array([8, 6])).astype(int).T
        assert box or len(np.unique(codes[y[0] : y[1] + 1, x[0] : x[1] + 1])) == 1


def test_an_image_of_one_colour_never_varies():
    """Even boxes over the rim of a repeated image of one colour lie within one colour's table of no borders."""
    table = border_table(np.full(SHAPE, 4, np.int16))
    assert not table.any()
    assert not boxes_varied(table, np.array([[0.1, 0.1]]), np.array([[0.9, 0.9]]), clamp=False).any()
