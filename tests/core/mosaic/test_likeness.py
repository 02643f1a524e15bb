"""How like its image a mosaic looks from afar."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.colours.difference import linear_from_srgb
from legorize_addon.core.mosaic.likeness import seen_from_afar
from legorize_addon.core.mosaic.studs import Goal
from tests.core.mosaic.pictures import CATALOGUE


def light_of(codes):
    """Return the linear light of brick colours."""
    return linear_from_srgb(CATALOGUE.rgb[np.searchsorted(CATALOGUE.codes, codes)])


def test_the_same_colours_do_not_differ():
    """Nothing is lost by the blur."""
    codes = np.random.default_rng(0).choice(CATALOGUE.codes, (9, 12))
    assert seen_from_afar(Goal(light_of(codes), np.ones((9, 12), bool)), codes, CATALOGUE) == 0


def test_a_pattern_of_two_greys_looks_like_their_mean():
    """A chequerboard is near to its mean from afar, one of its colours alone is not."""
    board = np.where(np.indices((20, 20)).sum(axis=0) % 2, 0, 15).astype(np.int16)
    mean = np.broadcast_to((light_of([0]) + light_of([15])) / 2, (20, 20, 3))
    assert seen_from_afar(Goal(mean, np.ones((20, 20), bool)), board, CATALOGUE) < 2
    assert seen_from_afar(Goal(mean, np.ones((20, 20), bool)), np.full((20, 20), 0), CATALOGUE) > 40


def test_bare_studs_do_not_count():
    """Neither they nor what is blurred out of them."""
    codes, there = np.full((6, 6), 4, np.int16), np.ones((6, 6), bool)
    there[:, 3:] = False
    light = light_of(codes)
    light[:, 3:] = 1
    assert seen_from_afar(Goal(light, there), np.where(there, codes, -2), CATALOGUE) < 1e-6
