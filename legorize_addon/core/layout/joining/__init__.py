"""Joining loose components into one model: exchanges, small windows laid anew, plates across the seams."""

from __future__ import annotations

from .across import tie_across
from .repair import connect_loose
from .ties import add_ties
from .windows import join_by_windows

__all__ = [
    "add_ties",
    "connect_loose",
    "join_by_windows",
    "tie_across",
]
