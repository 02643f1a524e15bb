"""How C and gamma are chosen: folds by model, the smoothest of equal machines, and the averages."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.layout.learning.cross_validation import FOLDS, cross_validated, folds


def test_folds_keep_models_together():
    """All samples of a model are in one fold, no fold is empty, and too few models are refused."""
    model = np.repeat(np.arange(12), 5).astype(np.int16)
    fold = folds(model, np.random.default_rng(0))
    assert set(fold) == set(range(FOLDS))
    assert all(len(set(fold[model == number])) == 1 for number in range(12))
    with pytest.raises(BuildError, match="from 4 models"):
        folds(np.arange(4, dtype=np.int16), np.random.default_rng(0))


def test_the_best_pair_is_chosen():
    """The first pair of those with most right answers; nothing is said of a sample by a machine that knew its model."""
    model = np.repeat(np.arange(10), 3).astype(np.int16)
    label = np.tile([0, 1, 2], 10).astype(np.int16)
    asked = []

    def said(out, c, gamma):
        asked.append(out)
        # C = 2 is right but for the last class, whatever gamma is; C = 1 says always the same
        return np.minimum(label[out], 1) if c == 2 else np.zeros(out.sum(), dtype=np.int16)

    found = cross_validated("samples", label, model, said, np.random.default_rng(0), costs=[1, 2], gammas=[3, 4])
    assert (found.samples, found.c, found.gamma) == ("samples", 2, 3)
    assert found.grid == {(1, 3): 1 / 3, (1, 4): 1 / 3, (2, 3): 2 / 3, (2, 4): 2 / 3}
    assert found.confusion.tolist() == [[10, 0, 0], [0, 10, 0], [0, 10, 0]]
    assert found.micro == pytest.approx(2 / 3)
    # F1 of the three classes: 1, 2 / 3 and 0
    assert found.macro == pytest.approx(5 / 9)
    assert len(asked) == 4 * FOLDS
    np.testing.assert_array_equal(np.sum(asked[:FOLDS], axis=0), 1)
    assert all(set(model[out]).isdisjoint(model[~out]) for out in asked)
