"""The possible verdicts on whether a model stands; separate from the search, which takes long to import."""

from __future__ import annotations

from enum import Enum
from typing import Final

UNSUPPORTED: Final = -1.0
"""Margin of a brick that hangs in the air."""


class Verdict(Enum):
    """The verdict on a model."""

    STABLE = "stable"
    """It stands by its studs alone."""

    WEDGED = "wedged"
    """It stands, but only while bricks side by side press on each other."""

    COLLAPSES = "collapses"
    """It falls, whether they do or not."""

    UNDECIDED = "undecided"
    """There is a proof of neither."""
