"""Walls made thicker around weak bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.catalogue import load_catalogue
from legorize_addon.core.hollowing import hollow
from legorize_addon.core.layout import lay
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, Cover
from legorize_addon.core.thickening import thickened
from tests.core.test_joints import grid_of

RED = 4


def test_inside_is_filled_around_weak_bricks_only():
    """Around one brick of a hollow block the model's cells must be built; farther away nothing changes."""
    colour = np.full((8, 3, 16, 16), COLOUR_ANY)
    colour[:, :, [0, -1]] = RED
    colour[:, :, :, [0, -1]] = RED
    colour[3:5, :, 7:9, 1:3] = COLOUR_EMPTY
    model = grid_of(colour)
    shell = hollow(model, shell=1)
    catalogue = load_catalogue()
    bricks = lay(shell, catalogue, rng=np.random.default_rng(0))
    weak = np.flatnonzero((bricks.corner[:, 2] == 12) & (bricks.corner[:, 0] == 0))[:1]
    found = thickened(shell, model, bricks, catalogue, weak=weak, reach=2)
    added = found.solid & ~shell.solid
    assert added.any()
    assert not (found.solid & ~model.solid).any()
    layer, _, y, x = np.nonzero(added)
    assert np.abs(layer - 4).max() <= 2
    assert x.max() <= 8 + 2
    np.testing.assert_array_equal(found.colour[added], model.colour[added])
    changed = found.cover != shell.cover
    assert (found.cover[changed] == Cover.MUST).all()
    np.testing.assert_array_equal(found.colour[shell.solid], shell.colour[shell.solid])
    assert len(y) == len(x)
