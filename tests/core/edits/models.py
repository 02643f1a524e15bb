"""Small models to edit, and edits at random."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np

from legorize_addon.core.edits import Edit, edit_of
from legorize_addon.core.layout import lay
from legorize_addon.core.model import COLOUR_EMPTY, Bricks
from tests.core.any_bricks import CATALOGUE, table
from tests.core.layout.cells import brick_grid

ROW = CATALOGUE.part_row
RED, WHITE, BLUE, SAND_GREEN = 4, 15, 1, 378
BRICK_2X4, BRICK_2X2, BRICK_1X1, PLATE_2X4 = "3001", "3003", "3005", "3020"
KINDS = ("recolour", "delete", "force", "lock", "forbid")


@cache
def shell() -> Bricks:
    """Return a hollow box of bricks, white with a red belt, that stands on the ground and hangs together."""
    colour = np.full((5, 9, 12), WHITE)
    colour[2] = RED
    colour[1:-1, 2:-2, 2:-2] = COLOUR_EMPTY
    return lay(brick_grid(colour), CATALOGUE, rng=np.random.default_rng(0))


def wall(layers: int = 3) -> Bricks:
    """Return 2 x 4 bricks on each other, each half a brick further than the one below."""
    rows = [(ROW(BRICK_2X4), 2 * (z % 2) + x, 0, 3 * z, 0, RED, 0, 0, z) for z in range(layers) for x in (0, 4)]
    return table(rows)


def edit(kind: str, part: str, cell: tuple[int, int, int], colour: int = RED, turn: int = 0) -> Edit:
    """Return an edit."""
    return Edit(kind, part, turn, cell, colour)


def random_edits(bricks: Bricks, count: int, seed: int) -> list[Edit]:
    """Return edits of bricks chosen at random; what is laid by force is another part in their place."""
    rng = np.random.default_rng(seed)
    model, codes = np.flatnonzero(CATALOGUE.used_for("model")), CATALOGUE.codes
    edits: list[Edit] = []
    while len(edits) < count:
        row, kind = int(rng.integers(len(bricks))), str(rng.choice(KINDS))
        made = edit_of(kind, bricks, row, CATALOGUE, int(rng.choice(codes)) if kind == "recolour" else None)
        if kind == "force":
            part = int(rng.choice(model[CATALOGUE.height[model] == CATALOGUE.height[bricks.part[row]]]))
            if not CATALOGUE.exists_in(part, made.colour):
                continue
            made = replace(made, part=CATALOGUE.parts[part].number, turn=int(rng.integers(4)))
        edits.append(made)
    return edits
