"""Counting colours: nothing is lost or added, however many texels there are."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from legorize_addon.core.colours import counted
from legorize_addon.core.colours.counted import count_colours, count_texels, packed, unpacked


@given(arrays(np.uint8, (7, 3)))
def test_packing_is_undone(rgb):
    """Bytes packed into a number come back."""
    np.testing.assert_array_equal(unpacked(packed(rgb)), rgb)


@given(arrays(np.uint8, st.tuples(st.integers(1, 30), st.integers(1, 9), st.just(3)), elements=st.integers(0, 2)))
def test_every_texel_counts_once(image):
    """Both ways of counting give each different colour with its number, in the same order."""
    whole, plain = count_texels([image, image[:1]]), count_colours(np.concatenate([image, image[:1]]).reshape(-1, 3))
    np.testing.assert_array_equal(whole.totals, plain.totals)
    np.testing.assert_array_equal(whole.counts, plain.counts)
    assert whole.counts.sum() == image[..., 0].size + image.shape[1]
    expected = np.unique(image.reshape(-1, 3), axis=0)
    np.testing.assert_array_equal(whole.means, expected)


def test_hidden_texels_do_not_count():
    """Texels under the least alpha are left out; of an image that is hidden as a whole all count."""
    image = np.zeros((2, 3, 3), dtype=np.uint8)
    image[0, 0] = 200
    alpha = np.array([[0, 127, 128], [255, 255, 0]], dtype=np.uint8)
    seen = count_texels([image], [alpha], least=0.5)
    assert (seen.counts.tolist(), seen.totals.tolist()) == ([3], [[0, 0, 0]])
    whole = count_texels([image, image], [alpha * 0, None], least=0.5)
    assert whole.counts.tolist() == [10, 2]


def test_very_many_colours_are_gathered_exactly(monkeypatch):
    """All of 2^21 different colours count: gathered to no more than 2^18, with their exact sum and number."""
    monkeypatch.setattr(counted, "_AT_ONCE", 100_001)
    number = np.arange(1 << 21, dtype=np.uint32) * 8
    image = unpacked(number).reshape(1 << 10, 1 << 11, 3)
    found = count_texels([image])
    assert len(found.counts) <= 1 << 18
    assert found.counts.sum() == 1 << 21
    np.testing.assert_array_equal(found.totals.sum(axis=0), image.reshape(-1, 3).astype(np.int64).sum(axis=0))
    # a mean is within the cell that it stands for
    cells = np.unique(packed(image.reshape(-1, 3) >> 2))
    np.testing.assert_array_equal(packed(found.means.astype(np.uint8) >> 2), cells)
