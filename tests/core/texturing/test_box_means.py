"""Means over the boxes of a coarser lattice."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.texturing.box_means import box_means


@pytest.mark.parametrize("shape", [(1, 1), (3, 2), (7, 5), (4, 9)])
def test_means_over_boxes_are_exact(shape) -> None:
    """Each box has the mean of the texels it covers, those at its rim by the part that lies in it."""
    rng = np.random.default_rng(0)
    values = rng.random((12, 10))
    # an image so much finer that no texel lies in two boxes
    fine = np.repeat(np.repeat(values, shape[0], axis=0), shape[1], axis=1)
    expected = fine.reshape(shape[0], 12, shape[1], 10).mean(axis=(1, 3))
    np.testing.assert_allclose(box_means(values, shape), expected, atol=1e-6)
