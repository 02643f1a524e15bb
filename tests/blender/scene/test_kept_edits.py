"""Bricks as a packed text."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.scene.kept_edits import bricks_text, read_bricks_text
from tests.core.any_bricks import everything

CATALOGUE = load_catalogue()
NUMBERS = [part.number for part in CATALOGUE.parts]


def test_there_and_back():
    """Every column comes back as it was, with its type."""
    bricks = everything()
    found = read_bricks_text(bricks_text(bricks), NUMBERS, CATALOGUE)
    for name in bricks.__slots__:
        np.testing.assert_array_equal(getattr(found, name), getattr(bricks, name))
        assert getattr(found, name).dtype == getattr(bricks, name).dtype


def test_a_catalogue_in_another_order():
    """Parts are known by their numbers; one that is not there any more is told."""
    bricks = everything().take(np.arange(3))
    found = read_bricks_text(bricks_text(bricks), NUMBERS[::-1], CATALOGUE)
    assert [NUMBERS[len(NUMBERS) - 1 - part] for part in bricks.part] == [NUMBERS[part] for part in found.part]
    with pytest.raises(BuildError, match="Part gone"):
        read_bricks_text(bricks_text(bricks), [*NUMBERS[:-1], "gone"], CATALOGUE)
