"""A layer's terms: with those of the paper's energies of the whole layout, whatever lies there."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.layout.learning import energies
from legorize_addon.core.layout.learning.fill import simulated
from legorize_addon.core.layout.learning.layer import HANGING, LOOSE, OPTIONAL, SINGLE
from legorize_addon.core.model import NOBODY
from tests.core.layout.learning.layers import layer_of, random_layer


def planes_of(layer, chosen):
    """Return the layout as a plane of owners."""
    sheets = layer.problem.sheets
    plane = np.full(sheets.colour[0].size, NOBODY)
    plane[sheets.cells] = layer.problem.owner(chosen)
    return plane.reshape(sheets.colour[0].shape)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=6, deadline=None)
def test_terms_add_up_to_the_energies_of_the_layout(seed):
    """Stability and efficiency of a layout are the means of its bricks' terms."""
    rng = np.random.default_rng(seed)
    below = np.where(rng.random((7, 9)) < 0.2, NOBODY, rng.integers(0, 6, (7, 9)))
    above = rng.random((7, 9)) < 0.5
    layer = layer_of(*["".join(rng.choice(list("rrrbo."), 9)) for _ in range(6)], "r" * 9, below=below, above=above)
    chosen = simulated(layer)
    owner, found, n = planes_of(layer, chosen), layer.problem.placements, len(chosen)
    vertical = energies.vertical_stability(owner, n, above, below != NOBODY)
    horizontal = energies.horizontal_stability(owner, n, None, below)
    assert layer.unstable[chosen].mean() == pytest.approx(vertical + horizontal)
    corner = np.isin(found.size[chosen], [3]) & (layer.problem.shapes.extent[found.shape[chosen]] == 2).all(axis=1)
    assert layer.small[chosen].mean() == pytest.approx(energies.efficiency(found.size[chosen], corner))


def test_what_a_brick_costs():
    """One brick, with all that it may cost besides: being single, loose, in the air, on optional cells."""
    layer = layer_of("ro", below=np.full((1, 2), NOBODY))
    size = layer.problem.placements.size
    assert layer.cost[size == 1] == pytest.approx([1 + SINGLE + LOOSE + HANGING])
    assert layer.cost[size == 2] == pytest.approx([1 + LOOSE + HANGING + OPTIONAL])


def test_mirror_images():
    """About the middle of what has to be covered; an image in another colour is none."""
    layer = layer_of("rrrr", "obbo")
    found, among = layer.problem.placements, layer.problem.shapes
    wide = among.extent[found.shape, 0]
    row = {(x, y, n): k for k, ((x, y, _), n) in enumerate(zip(found.corner.tolist(), wide, strict=True)) if n > 1}
    assert layer.mirror[0, row[0, 0, 2]] == row[2, 0, 2]
    assert layer.mirror[0, row[0, 0, 4]] == row[0, 0, 4]
    # what mirrors the red bricks along y would be blue
    assert layer.mirror[1, row[1, 0, 2]] == len(found)


def test_polygons_are_regions_of_one_colour():
    """Cells of one colour that touch at a corner are one polygon, others are not."""
    layer = layer_of("r.b", ".r.", "b.r")
    polygon = dict(zip(map(tuple, layer.problem.corner[:, :2].tolist()), layer.polygon.tolist(), strict=True))
    assert polygon[0, 0] == polygon[1, 1] == polygon[2, 2]
    assert len({polygon[0, 0], polygon[2, 0], polygon[0, 2]}) == 3


def test_what_may_join():
    """Cells of the same colour or of any."""
    layer = layer_of("rbo?")
    assert layer.may_join(0).tolist() == [True, False, True, True]
    assert layer.may_join(2).tolist() == [True] * 4


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=5, deadline=None)
def test_orders_are_orders(seed):
    """Every placement has a place of its own in each of the three."""
    layer = random_layer(seed)
    for rank in layer.ranks:
        np.testing.assert_array_equal(np.sort(rank), np.arange(len(layer.cost)))
