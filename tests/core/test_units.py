"""Units, and numbers with what they count."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.units import BRICK, LDU_PER_MM, PLATE, PLATE_LDU, PLATES_PER_BRICK, STUD, STUD_LDU, count_of


@pytest.mark.parametrize(
    ("number", "said"), [(0, "0 bricks"), (1, "1 brick"), (2, "2 bricks"), (np.int64(1), "1 brick")]
)
def test_one_is_singular(number: int, said: str) -> None:
    """Only one of a thing stands in the singular."""
    assert count_of(number, "brick", "bricks") == said


def test_units_fit() -> None:
    """Three plates are a brick, and LDraw has the same lengths."""
    assert pytest.approx(BRICK) == PLATES_PER_BRICK * PLATE
    assert (STUD * LDU_PER_MM, PLATE * LDU_PER_MM) == (STUD_LDU, PLATE_LDU)
