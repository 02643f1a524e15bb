"""Half studs: all of a model above a plane lies half a stud beyond what is below, on jumper plates.

Everything until the building order works on one grid. So the mesh is *drawn together* first: what is above a plane is
moved back by half a stud, and the plate below the plane, in which the jumpers will lie, leans from one to the other.
On this grid a jumper is a plate with a stud over one of its squares, and whatever stands on it has its stud there as
on any plate. At the end each brick gets the half studs of its level (``Bricks.half``), and what this changes is looked
at: contacts, collisions, forces, the order of building.
"""

from __future__ import annotations

from .jumpers import NEEDED, lay_jumpers
from .moving import draw_together
from .planes import Plane, choose_planes
from .truth import HalfStudsError, set_apart

__all__ = [
    "NEEDED",
    "HalfStudsError",
    "Plane",
    "choose_planes",
    "draw_together",
    "lay_jumpers",
    "set_apart",
]
