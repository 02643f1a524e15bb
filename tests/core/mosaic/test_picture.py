"""The image of a mosaic."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.mosaic.picture import picture_of


def test_without_alpha_everything_is_opaque():
    """The size is width by height."""
    found = picture_of(np.zeros((2, 3, 3), np.uint8))
    assert found.size == (3, 2)
    assert (found.alpha == 255).all()


@pytest.mark.parametrize(
    ("shape", "alpha", "message"), [((0, 3, 3), None, "no pixels"), ((2, 2, 3), 0, "transparent everywhere")]
)
def test_what_shows_nothing_is_refused(shape, alpha, message):
    """There is one sentence for an empty image, and one for a transparent one."""
    with pytest.raises(MeshError, match=message):
        picture_of(np.zeros(shape, np.uint8), None if alpha is None else np.full(shape[:2], alpha, np.uint8))
