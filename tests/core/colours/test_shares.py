"""What brick colours stand for, and how much of the textures that is."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.colours.shares import colour_shares
from tests.core.colours.test_dominant import colours_of
from tests.core.solids import sheet
from tests.core.textured import textured


def test_replaced_colours_and_their_shares():
    """What stands for a colour is another one, and shares stay."""
    image = np.zeros((4, 4, 3), np.uint8)
    image[:, :2], image[:, 2:], image[:, 3] = (201, 26, 9), (255, 255, 255), (0, 85, 191)
    found = colours_of(textured(sheet(), image))
    before = colour_shares(found)
    assert [round(share, 2) for *_, share in before] == [0.5, 0.25, 0.25]
    assert all(nearest == code for _, nearest, code, _ in before)
    red = before[0][1]
    others = {code: red for _, code, _, _ in before[1:]}
    one = found.replaced(others)
    assert set(one.codes.tolist()) == {red}
    assert [each[:2] for each in colour_shares(one)] == [each[:2] for each in before]
    assert {code for _, _, code, _ in colour_shares(one)} == {red}
    assert found.replaced({}) is found
