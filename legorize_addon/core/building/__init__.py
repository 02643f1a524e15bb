"""The order in which a model is built, so that every brick is pushed onto something that holds."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..on_demand import on_demand
from .moves import Action, Moves
from .steps import MAIN, Kind, Step, Steps, Submodel

if TYPE_CHECKING:
    from .alike import still_alike
    from .alone import steps_alone
    from .blocking import column_pairs, tangled
    from .check import Walk, walk
    from .contacts import BuildingContacts, building_contacts
    from .given import given_steps
    from .mirror import MirrorPlane, mirror_plane
    from .order import plan_steps, steps_of
    from .proof import Proof, prove_steps
    from .tiles import SIDE, tile_places
    from .towers import STEADY, Tipping, falling, no_prop, tipping, unbalanced
    from .units import presses
    from .views import quarter_turns
else:
    # a scene needs the moves alone, long before anything is ordered
    __getattr__ = on_demand(
        __name__,
        alike=("still_alike",),
        alone=("steps_alone",),
        blocking=("column_pairs", "tangled"),
        check=("Walk", "walk"),
        contacts=("BuildingContacts", "building_contacts"),
        given=("given_steps",),
        mirror=("MirrorPlane", "mirror_plane"),
        order=("plan_steps", "steps_of"),
        proof=("Proof", "prove_steps"),
        tiles=("SIDE", "tile_places"),
        towers=("STEADY", "Tipping", "falling", "no_prop", "tipping", "unbalanced"),
        units=("presses",),
        views=("quarter_turns",),
    )

__all__ = [
    "MAIN",
    "SIDE",
    "STEADY",
    "Action",
    "BuildingContacts",
    "Kind",
    "MirrorPlane",
    "Moves",
    "Proof",
    "Step",
    "Steps",
    "Submodel",
    "Tipping",
    "Walk",
    "building_contacts",
    "column_pairs",
    "falling",
    "given_steps",
    "mirror_plane",
    "no_prop",
    "plan_steps",
    "presses",
    "prove_steps",
    "quarter_turns",
    "steps_alone",
    "steps_of",
    "still_alike",
    "tangled",
    "tile_places",
    "tipping",
    "unbalanced",
    "walk",
]
