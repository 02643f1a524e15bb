"""Half studs: regions of a model lie half a stud beyond the rest, on jumper plates.

Everything until the building order works on one grid. So the mesh is *drawn together* first: a region (a head, a tail,
a wheel, or all above some layer) is moved back by half a stud, and the plate below the jumps, in which the jumpers will
lie, leans from one to the other. On this grid a jumper is a plate with a stud over one of its squares, and whatever
stands on it has its stud there as on any plate. At the end each brick gets the half studs of its cells
(``Bricks.half``), and what this changes is looked at: contacts, collisions, forces, the order of building.
"""

from __future__ import annotations

from .halves import Halves, grid_together, halves_in, halves_of
from .islands import find_islands
from .jumpers import NEEDED, lay_jumpers
from .moving import draw_together
from .regions import Region, choose_regions
from .truth import HalfStudsError, check_apart, lies_in_several, set_apart

__all__ = [
    "NEEDED",
    "HalfStudsError",
    "Halves",
    "Region",
    "check_apart",
    "choose_regions",
    "draw_together",
    "find_islands",
    "grid_together",
    "halves_in",
    "halves_of",
    "lay_jumpers",
    "lies_in_several",
    "set_apart",
]
