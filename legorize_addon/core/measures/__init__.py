"""Figures about a model that building it never needs."""

from __future__ import annotations

from .colour_errors import colour_errors
from .lower_bound import least_cost, lower_bound
from .pass_through import corner_windings, pass_through_types

__all__ = [
    "colour_errors",
    "corner_windings",
    "least_cost",
    "lower_bound",
    "pass_through_types",
]
