"""Ceilings: what is carried, by what, at which price, and what is left alone."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.shell.ceilings import Columns, carriers
from legorize_addon.core.shell.hollowing import erode, peel

WAYS = ("cheaper", "corbels", "pillars")
SQUARE = np.ones((1, 3, 3), bool)


def shelled(solid, deep=None):
    """Return the columns of a model of whole bricks, hollowed with a shell of one cell."""
    deep = erode(np.repeat(solid[:, None], 3, axis=1), 1) if deep is None else deep
    required = solid & ~deep
    return Columns(required, required, required, deep)


def box(n_layers, n_y, n_x):
    """Return a hollowed box."""
    return shelled(np.ones((n_layers, n_y, n_x), bool))


def blob(seed, shape=(14, 16, 18)):
    """Return a random solid with overhangs, terraces and cavities."""
    noise = ndimage.gaussian_filter(np.random.default_rng(seed).normal(size=shape), 2, mode="wrap")
    return noise > np.quantile(noise, 0.25)


seeds = st.integers(0, 2**20)


@pytest.mark.parametrize("width", range(3, 12))
def test_bricks_reach_two_studs(width):
    """Of a ceiling between two walls and two far ones, all but two studs at each wall needs carrying."""
    middle = box(6, width, 40).uncarried[5, :, 20]
    assert np.count_nonzero(middle) == max(width - 6, 0)
    assert not box(6, width, 40).uncarried[:5].any()


@given(seeds, st.sampled_from(WAYS), st.booleans())
def test_everything_is_carried(seed, way, upper):
    """Nothing stays uncarried over a hollow; only hollow cells are filled, each for one purpose."""
    solid = blob(seed)
    columns = shelled(solid, peel(np.repeat(solid[:, None], 3, axis=1), 1) if upper else None)
    corbels, pillars = carriers(columns, way)
    assert not (corbels & pillars).any()
    assert not ((corbels | pillars) & ~columns.hollow).any()
    # a hollow that is open below gives no hold to what stands in it
    assert upper or not columns.filled(corbels | pillars).uncarried.any()


@given(seeds)
def test_corbels_lean_one_stud_a_layer(seed):
    """Every cell of a corbel lies beside or on a cell of its layer that stands on something."""
    columns = shelled(blob(seed))
    corbels, _ = carriers(columns, "corbels")
    standing = columns.filled(corbels).standing
    assert not (corbels & ~ndimage.binary_dilation(standing, SQUARE)).any()


@given(seeds)
def test_pillars_stand_upright(seed):
    """Every cell of a pillar stands on another one, on the floor or on the ground."""
    columns = shelled(blob(seed))
    _, pillars = carriers(columns, "pillars")
    assert not (pillars & ~columns.filled(pillars).standing).any()


@pytest.mark.parametrize(("n_layers", "upright"), [(4, True), (40, False)])
def test_the_cheaper_way_is_taken(n_layers, upright):
    """Under a low ceiling stand pillars, under a high one corbels, as few as the fewer of both."""
    columns = box(n_layers, 14, 14)
    corbels, pillars = carriers(columns, "cheaper")
    counts = [np.count_nonzero(mask) for way in ("corbels", "pillars") for mask in carriers(columns, way) if mask.any()]
    assert np.count_nonzero(corbels | pillars) == min(counts)
    assert pillars.any() == upright
    assert corbels.any() != upright


def test_each_hollow_chooses_for_itself():
    """A low hollow gets pillars and a high one corbels, in one model."""
    solid = np.ones((40, 14, 28), bool)
    solid[4:, :, 14:] = False
    solid[:, :, 13] = False
    corbels, pillars = carriers(shelled(solid), "cheaper")
    assert corbels[..., :13].any()
    assert not pillars[..., :13].any()
    assert pillars[..., 14:].any()
    assert not corbels[..., 14:].any()


def test_free_ceilings_and_solid_models_get_nothing():
    """Nothing is filled where nothing is asked for, or nothing is hollow."""
    solid = Columns(*[np.ones((9, 14, 14), bool)] * 3, np.zeros((9, 14, 14), bool))
    for columns, way in ((box(9, 14, 14), "free"), (solid, "cheaper")):
        assert not np.any(carriers(columns, way))


def test_cavities_of_the_input_stay_open():
    """The ceiling of a cavity that the model itself has is not ours to carry; its floating walls are."""
    solid = np.ones((24, 16, 16), bool)
    solid[9:15, 4:12, 4:12] = False
    columns = shelled(solid)
    corbels, pillars = carriers(columns, "pillars")
    assert not (corbels | pillars)[9:15, 4:12, 4:12].any()
    below, above = pillars[:8].any(axis=(1, 2)), pillars[16:].any(axis=(1, 2))
    assert below[1:].all()
    assert above.any()
    assert not columns.uncarried[15].any()


def test_a_plate_and_a_brick_beside_it_share_no_brick():
    """A roof of plates amid bricks is carried from below, however near the walls are."""
    columns = box(5, 9, 9)
    whole = columns.whole.copy()
    whole[4, 4, 1:3] = False
    plates = Columns(columns.bottom, columns.top & whole, whole, columns.hollow)
    assert not columns.uncarried[4, 4, 1:3].any()
    assert plates.uncarried[4, 4, 1:3].all()
    filled = plates.filled(carriers(plates, "corbels")[0])
    assert not filled.uncarried.any()
    assert filled.top[3, 4, 1:3].any()


def test_equal_hollows_are_filled_alike():
    """The choice depends on nothing but the cells."""
    first, again = (carriers(shelled(blob(3)), "cheaper") for _ in range(2))
    np.testing.assert_array_equal(first, again)
