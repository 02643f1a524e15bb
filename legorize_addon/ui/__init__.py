"""What a person clicks: operators, panels, and the properties behind them."""

from __future__ import annotations

from .registration import register, unregister

__all__ = [
    "register",
    "unregister",
]
