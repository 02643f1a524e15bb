"""Where shapes fit: by merging planes, or by looking under every one."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.problem.planes import Planes, spread
from legorize_addon.core.layout.problem.shapes import shapes
from legorize_addon.core.layout.problem.sheets import split
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from tests.core.layout.cells import CATALOGUE, brick_grid

FILLER = 71
RED, WHITE = 4, 15


def planes_of(colour, cover=None):
    """Return the planes of whole bricks in given colours, the shapes for them, and the sheets."""
    grid = brick_grid(colour, cover)
    among = shapes(CATALOGUE, 3, np.array([RED, WHITE]), FILLER)
    (sheets,) = split(grid)
    return Planes.of(sheets, among), among, sheets


@pytest.mark.parametrize(
    ("marked", "reach", "range_"),
    [([0, 0, 1, 0, 0, 0], 1, (1, 4)), ([1, 0, 0, 1], 9, (0, 13)), ([0, 0], 3, (0, 0)), ([0, 1, 1], 0, (1, 3))],
)
def test_spread(marked, reach, range_):
    """From as far before the first mark as after the last one, but not from before the beginning."""
    assert spread(np.array(marked, dtype=bool), reach) == slice(*range_)


def test_far_cells_are_left_out():
    """Of a wide sheet with one required cell only what the longest shape reaches is looked at."""
    colour = np.full((1, 40, 50), COLOUR_ANY)
    cover = np.full(colour.shape, Fill.OPTIONAL)
    cover[0, 20, 30] = Fill.REQUIRED
    planes, among, _ = planes_of(colour, cover)
    reach = among.extent.max() - 1
    assert planes.low == (30 - reach, 20 - reach)
    assert planes.extent <= (3 * reach + 2) ** 2


def test_shapes_fit_beside_a_border():
    """In a row of two red and two white cells, two studs fit twice, in a colour each, and nothing longer does."""
    planes, among, _ = planes_of(np.array([[[RED, RED, WHITE, WHITE]]]))
    expected = {1: [RED, RED, WHITE, WHITE], 2: [RED, WHITE]}
    for (wide, deep), (_, column) in zip(among.extent.tolist(), planes.fitting(among), strict=True):
        assert sorted(among.codes[column].tolist()) == (expected.get(wide, []) if deep == 1 else [])


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=40)
def test_same_as_looking_under_each(seed):
    """A place is found exactly if no cell under the shape is empty, one must be covered, and the colours agree."""
    rng = np.random.default_rng(seed)
    colour = rng.choice([COLOUR_EMPTY, COLOUR_ANY, COLOUR_ANY, RED, WHITE], (2, 4, 5))
    cover = np.where(colour == COLOUR_EMPTY, Fill.EMPTY, rng.choice([Fill.OPTIONAL, Fill.REQUIRED], colour.shape))
    cover[0, 0, 0], colour[0, 0, 0] = Fill.REQUIRED, RED
    planes, among, sheets = planes_of(colour, cover)
    shape = (len(sheets), -1, planes.stride)
    least, most, required = planes.least.reshape(shape), planes.most.reshape(shape), planes.required.reshape(shape)
    n_y, n_x = sheets.colour.shape[1:]
    for row, (place, _) in enumerate(planes.fitting(among)):
        x, y = among.cells[row].T
        wide, deep = among.extent[row]
        for sheet, j, i in np.ndindex(len(sheets), max(n_y - deep + 1, 0), max(n_x - wide + 1, 0)):
            under = sheet, j + y - planes.low[1], i + x - planes.low[0]
            low, high = least[under].min(), most[under].max()
            fits = low >= high and required[under].any() and among.made[row][high]
            at = np.ravel_multi_index((sheet, j - planes.low[1], i - planes.low[0]), least.shape)
            assert (at in place) == fits
