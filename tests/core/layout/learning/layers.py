"""Layers to fill, drawn in letters."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.learning.layer import Layer
from legorize_addon.core.layout.problem import placements, pose, shapes, split, with_margins
from legorize_addon.core.model import COLOUR_ANY, COLOUR_EMPTY, NOBODY, Fill
from tests.core.layout.cells import CATALOGUE, grid_of

CODES = {"r": (4, Fill.REQUIRED), "b": (1, Fill.REQUIRED), "o": (COLOUR_ANY, Fill.OPTIONAL), ".": (COLOUR_EMPTY, 0)}
CODES["?"] = (COLOUR_ANY, Fill.REQUIRED)


def layer_of(*rows: str, below: np.ndarray | None = None, above: np.ndarray | None = None) -> Layer:
    """Return a layer of bricks: r red, b blue, ? required in any colour, o optional; the ground below by default."""
    cells = [[CODES[letter] for letter in row] for row in rows]
    colour, cover = (np.array([[cell[part] for cell in row] for row in cells]) for part in (0, 1))
    shape = (1, 3, *colour.shape)
    grid = grid_of(np.broadcast_to(colour, shape), np.broadcast_to(cover, shape))
    [sheets] = split(grid)
    among = shapes(CATALOGUE, 3, np.unique(colour[colour >= 0]), 71)
    found = placements(sheets, among)
    owner = np.full((5, *colour.shape), NOBODY, dtype=np.int32)
    owner[0] = NOBODY - 1 if below is None else below
    problem = pose(sheets, among, found, owner, with_margins(grid.cover == Fill.REQUIRED, False))
    return Layer.of(problem, owner[0], np.zeros(colour.shape, bool) if above is None else above)


def random_layer(seed: int, n_y: int = 7, n_x: int = 9) -> Layer:
    """Return a layer at random upon random bricks."""
    rng = np.random.default_rng(seed)
    rows = ["".join(rng.choice(list("rrrbo?."), n_x)) for _ in range(n_y - 1)] + ["r" * n_x]
    below = np.where(rng.random((n_y, n_x)) < 0.2, NOBODY, rng.integers(0, 6, (n_y, n_x)))
    return layer_of(*rows, below=below, above=rng.random((n_y, n_x)) < 0.5)
