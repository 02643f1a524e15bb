"""The cases published with the StableLego article, from an arm that holds to a stair that just falls.

Liu et al., "StableLego: Stability Analysis of Block Stacking Assembly" (2024):
stairs of 2 x 4 bricks, long arms with a light and a heavy load, an arm in which
bricks push each other sideways, and a weight of 0.2 kg on a short stair. All
stand on a baseplate.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import Catalogue
from legorize_addon.core.statics.forces import GRAVITY

Place = tuple[str, int, int, int, int]
"""LDraw number, x and y in studs, z in plates, quarter turns."""

BALLAST: Final = 0.2
"""kg of the weight, which takes the place of a 2 x 2 brick."""

NARROW: Final = {1: "3005", 2: "3004", 4: "3010", 6: "3009", 8: "3008"}
"""Bricks one stud wide by their length."""

LIGHT: Final = (
    *((8, 0, 0), (4, 6, 1), (4, 8, 2), (8, 10, 3), (8, 16, 2), (6, 22, 3), (6, 26, 2), (6, 30, 3)),
    *((6, 34, 2), (6, 38, 3), (6, 42, 2), (4, 44, 3), (4, 44, 4)),
)
"""Arm of bricks one stud wide: length, first stud and layer of each; the last two are its load."""

TWO_LAYERS: Final = (
    *((8, 0, 0), (4, 6, 1), (6, 8, 2), (6, 12, 1), (6, 16, 2), (6, 20, 1), (6, 24, 2), (8, 28, 1)),
    *((8, 34, 2), (8, 40, 1), (6, 42, 2), (4, 44, 3), (4, 44, 4), (4, 44, 5), (2, 8, 0), (2, 10, 1)),
)
"""The same for an arm of two layers, in which bricks side by side have to push each other."""


@dataclass(frozen=True, slots=True)
class Case:
    """A case of the article.

    Attributes
    ----------
    name : str
        What it is.
    places : tuple
        Its bricks.
    stands : bool
        The article's verdict, which it tried on real bricks.
    ballast : bool
        Whether the last brick is the weight.
    """

    name: str
    places: tuple[Place, ...]
    stands: bool
    ballast: bool = False

    def bricks(self, catalogue: Catalogue) -> Bricks:
        """Return the bricks as a table."""
        return placed(self.places, catalogue)

    def loads(self, catalogue: Catalogue) -> NDArray[np.float64]:
        """Return what the bricks carry besides their own weight, (n, 3) in N."""
        loads = np.zeros((len(self.places), 3))
        if self.ballast:
            own = catalogue.parts[catalogue.part_row(self.places[-1][0])].mass / 1000
            loads[-1, 2] = -GRAVITY * (BALLAST - own)
        return loads


def placed(places: Sequence[Place], catalogue: Catalogue) -> Bricks:
    """Return red bricks at given places."""
    n = len(places)
    return Bricks(
        part=np.array([catalogue.part_row(place[0]) for place in places], dtype=np.int16),
        corner=np.array([place[1:4] for place in places], dtype=np.int32).reshape(-1, 3),
        turn=np.array([place[4] for place in places], dtype=np.uint8),
        colour=np.full(n, 4, dtype=np.int16),
        role=np.zeros(n, dtype=np.uint8),
        piece=np.zeros(n, dtype=np.int16),
        step=np.zeros(n, dtype=np.int32),
    )


def stair(levels: int) -> tuple[Place, ...]:
    """Return 2 x 4 bricks, each two studs further than the one below."""
    return tuple(("3001", 2 * level, 0, 3 * level, 0) for level in range(levels))


def arm(*bricks: tuple[int, int, int]) -> tuple[Place, ...]:
    """Return bricks one stud wide, given length, first stud and layer of each."""
    return tuple((NARROW[length], x, 0, 3 * layer, 0) for length, x, layer in bricks)


HEAVY: Final = (*LIGHT, (4, 44, 5))

CASES: Final = (
    Case("stair of 19", stair(19), stands=True),
    Case("stair of 20", stair(20), stands=False),
    Case("stair of 20 with a foot", (*stair(20), ("3004", 4, 0, 0, 1)), stands=True),
    Case("arm, light load", arm(*LIGHT), stands=True),
    Case("arm, heavy load", arm(*HEAVY), stands=False),
    Case("arm, heavy load, with a foot", arm(*HEAVY, (2, 8, 0)), stands=True),
    Case("arm of two layers", arm(*TWO_LAYERS), stands=True),
    Case("0.2 kg on a stair of 3", (*stair(3), ("3003", 5, 0, 9, 0)), stands=True, ballast=True),
    Case("0.2 kg on a stair of 4", (*stair(4), ("3003", 7, 0, 12, 0)), stands=False, ballast=True),
)
"""All nine, with the article's verdicts."""
