"""Texture that changes within a stud becomes its mean; what can be seen stays."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.texturing.fine_textures import average_windows


def checker(n: int, first: int = 0, second: int = 255) -> np.ndarray:
    """Return an image of n x n texels in two greys by turns."""
    odd = np.indices((n, n)).sum(axis=0) % 2
    return np.repeat(np.where(odd, second, first)[..., None], 3, axis=2).astype(np.uint8)


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_checkers_finer_than_a_block_become_grey(size: int) -> None:
    """Squares of an eighth to half of a block have no colour of their own; their mean is that of their light."""
    image = np.repeat(np.repeat(checker(64 // size), size, axis=0), size, axis=1)
    found = average_windows(image, (8, 8), clamp=False)
    assert np.abs(found.astype(int) - 188).max() <= 12


def test_noise_becomes_its_mean_and_features_on_it_stay() -> None:
    """Noise finer than a block takes its mean, but not across the rim of what is on it."""
    rng = np.random.default_rng(5)
    image = rng.choice(np.array([60, 200], np.uint8), (128, 128))[..., None].repeat(3, axis=2)
    image[40:72, 40:72] = (255, 0, 0)
    found = average_windows(image, (8, 8), clamp=False)
    np.testing.assert_array_equal(found[40:72, 40:72], image[40:72, 40:72])
    assert np.ptp(found[:24, :24].astype(int)) < 24


def test_borders_and_stripes_stay_crisp() -> None:
    """Halves in black and white, and a stripe of two thirds of a block, keep every texel."""
    image = np.full((96, 96, 3), 255, np.uint8)
    image[:, :50] = 0
    assert average_windows(image, (9, 9), clamp=True) is image
    image = np.full((96, 96, 3), 255, np.uint8)
    image[:, 50:56] = 0
    assert average_windows(image, (9, 9), clamp=True) is image
