"""Sizes of the building system.

Lengths are millimetres unless a name says LDU (LDraw units, 1 LDU = 0.4 mm).
The world is right-handed with z up; LDraw is right-handed with -y up.

References
----------
LDraw.org, "LDraw File Format Specification": a stud pitch is 20 LDU, a brick
24 LDU high, a plate 8 LDU.
"""

from __future__ import annotations

from typing import Final

STUD: Final = 8.0
"""Pitch of the studs, the side of a grid cell, in mm."""

PLATE: Final = 3.2
"""Height of a plate in mm."""

PLATES_PER_BRICK: Final = 3
"""Plates that stack to the height of one brick."""

BRICK: Final = 9.6
"""Height of a brick in mm."""

CELL_AREA: Final = STUD * STUD
"""Area of a grid cell in mm^2."""

MM_PER_CM: Final = 10.0

MM_PER_METRE: Final = 1000.0
"""A Blender unit is a metre times the scene's unit scale."""

LDU_PER_MM: Final = 2.5
STUD_LDU: Final = 20
PLATE_LDU: Final = 8


def count_of(number: int, one: str, more: str) -> str:
    """Return a number with its noun in singular or plural, such as "1 brick" and "2 bricks"."""
    return f"{number} {one if number == 1 else more}"
