"""The choices of what is shown of a build, with their texts."""

from __future__ import annotations

from typing import Final

from ..core.model import Role
from ..scene import AXES

CUTS: Final = ("none", *AXES)
CUT_ITEMS: Final = [("none", "Off", ""), *((axis, axis.upper(), "") for axis in AXES)]
LINE_ITEMS: Final = [
    ("sides", "Blue and Green", "Exterior trajectories blue, interior ones green"),
    ("colours", "Brick Colours", "Each part of a trajectory in the colour of its bricks"),
]
NUMBER_ITEMS: Final = [
    ("none", "Off", "No numbers"),
    ("steps", "Steps", "The building step of each brick"),
    ("parts", "Parts", "The LDraw number of each part"),
]
ROLE_TEXTS: Final = {
    Role.SHELL: "the bricks that can be seen from outside",
    Role.INSIDE: "the bricks inside that carry others",
    Role.PLATE: "the plates of finer layers",
    Role.OFFSET: "the bricks under overhanging faces",
    Role.SUPPORT_OUTSIDE: "the supports that are removed in the end",
    Role.SUPPORT_INSIDE: "the supports that stay inside",
    Role.SUPPORT_KEPT: "the supports outside that stay, because a part of the model would fall without them",
}
