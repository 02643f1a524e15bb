"""Names of models, as texts and as outlines."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Text
from legorize_addon.core.instructions.lettering import Lettering, Title

SQUARE = Lettering(np.array([(0, 0), (2.0, 0), (2.0, -1.0), (0, -1.0)]), np.array([4]), 2.0)
"""A letter twice as wide as high."""


@pytest.mark.parametrize("outlines", [None, SQUARE])
def test_a_name_in_letters_of_the_fonts_is_a_text(outlines):
    """It can be searched for, and is cut off where there is no room."""
    [item] = Title("Fox", outlines).items((5, 6), 10, 100, bold=True, after="!")
    assert isinstance(item, Text)
    assert (item.text, item.x, item.y, item.size, item.bold) == ("Fox!", 5, 6, 10, True)
    [item] = Title("Fox" * 20).items((5, 6), 10, 40)
    assert item.text.endswith("...")


@pytest.mark.parametrize(("room", "scale"), [(100, 10), (10, 5)])
def test_other_names_are_outlines(room, scale):
    """They are as large as there is room."""
    [item] = Title("狐", SQUARE).items((5, 6), 10, room)
    assert isinstance(item, Group)
    assert item.matrix == (scale, 0, 0, scale, 5, 6)
    assert item.items[0].points is SQUARE.points


def test_what_is_written_behind_a_name_follows_it():
    """The two lie in the middle together."""
    shape, text = Title("狐", SQUARE).items((50, 6), 10, 100, after=", x", anchor="middle")
    left, right = shape.matrix[4], text.x
    assert right == left + 20
    from legorize_addon.core.instructions.fonts import width

    assert left + (20 + width(", x", 10)) / 2 == pytest.approx(50)


def test_missing_letters_are_told_where_they_are_drawn():
    """A sentence for the user."""
    assert not Title("狐", SQUARE).lost
    assert "狐" in Title("狐", Lettering(SQUARE.points, SQUARE.count, 2.0, "狐")).lost
    assert not Title("a", Lettering(SQUARE.points, SQUARE.count, 2.0, "a")).lost
