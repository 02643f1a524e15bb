"""Texture that changes within a stud becomes its mean; what can be seen stays."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.texturing.fine_textures import FineTextures


def checker(n: int, first: int = 0, second: int = 255) -> np.ndarray:
    """Return an image of n x n texels in two greys by turns."""
    odd = np.indices((n, n)).sum(axis=0) % 2
    return np.repeat(np.where(odd, second, first)[..., None], 3, axis=2).astype(np.uint8)


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_checkers_finer_than_a_block_become_grey(size: int) -> None:
    """Squares of an eighth to half of a block have no colour of their own; their mean is that of their light."""
    image = np.repeat(np.repeat(checker(64 // size), size, axis=0), size, axis=1)
    found = FineTextures(image, clamp=False).averaged((8, 8))
    assert np.abs(found.astype(int) - 188).max() <= 12


def test_noise_becomes_its_mean_and_features_on_it_stay() -> None:
    """Noise finer than a block takes its mean, but not across the rim of what is on it."""
    rng = np.random.default_rng(5)
    image = rng.choice(np.array([60, 200], np.uint8), (128, 128))[..., None].repeat(3, axis=2)
    image[40:72, 40:72] = (255, 0, 0)
    found = FineTextures(image, clamp=False).averaged((8, 8))
    np.testing.assert_array_equal(found[40:72, 40:72], image[40:72, 40:72])
    assert np.ptp(found[:24, :24].astype(int)) < 24


def test_borders_and_stripes_stay_crisp() -> None:
    """Halves in black and white, and a stripe of two thirds of a block, keep every texel."""
    image = np.full((96, 96, 3), 255, np.uint8)
    image[:, :50] = 0
    assert FineTextures(image, clamp=True).averaged((9, 9)) is image
    image = np.full((96, 96, 3), 255, np.uint8)
    image[:, 50:56] = 0
    assert FineTextures(image, clamp=True).averaged((9, 9)) is image


@pytest.mark.parametrize("clamp", [False, True])
def test_what_was_asked_before_changes_nothing(clamp: bool) -> None:
    """Blocks put together from smaller ones are those of the texels, whatever was asked for first."""
    image = np.random.default_rng(3).choice(np.array([20, 90, 230], np.uint8), (64, 32, 3), p=(0.6, 0.2, 0.2))
    known = FineTextures(image, clamp=clamp)
    for window in [(1, 2), (2, 1), (2, 2), (4, 8), (8, 4), (16, 16)]:
        fresh = FineTextures(image, clamp=clamp).averaged(window)
        np.testing.assert_array_equal(known.averaged(window), fresh)
    assert (fresh != image).any()
