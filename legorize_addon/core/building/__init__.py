"""The order in which a model is built, so that every brick is pushed onto something that holds."""

from __future__ import annotations

from .check import Walk, walk
from .contacts import Links, links
from .moves import Action, Moves
from .order import ordered
from .proof import Proof, prove_steps
from .towers import STEADY, Tipping, no_prop, tipping

__all__ = [
    "STEADY",
    "Action",
    "Links",
    "Moves",
    "Proof",
    "Tipping",
    "Walk",
    "links",
    "no_prop",
    "ordered",
    "prove_steps",
    "tipping",
    "walk",
]
