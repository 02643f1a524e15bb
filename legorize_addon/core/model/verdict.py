"""What can be known of whether a model stands; apart from the search, which takes long to import."""

from __future__ import annotations

from enum import Enum
from typing import Final

UNSUPPORTED: Final = -1.0
"""Margin of a brick that hangs in the air."""


class Verdict(Enum):
    """What is known of the model."""

    STABLE = "stable"
    COLLAPSES = "collapses"
    UNDECIDED = "undecided"
