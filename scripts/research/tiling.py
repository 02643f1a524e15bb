"""A* over tilings of a layer, limited in memory: the first free cell is covered in every way, the best go on.

References
----------
K. Min, C. Park, H. Yang and G. Yun 2018 (see :mod:`.seams`) tile layer by layer by
A*. The list of open tilings is limited here: a brick covers 16 cells at most, so
that open tilings differ by so many covered cells, and of each number the best
``OPEN / 16`` are kept. Of tilings that cover the same cells only the best is.
"""

from __future__ import annotations

from heapq import nsmallest
from typing import Final

import numpy as np

from legorize_addon.core.layout.problem.candidates import Candidates
from scripts.research.rules import Index
from scripts.research.seams import EQUAL, LARGEST, Layer, Weights

OPEN: Final = 2000
"""Open tilings at most."""

State = tuple[float, int, int, int, int, float, int]
"""Energy so far; laid placements and covered cells as bits; bricks; bricks without
mirror image; loss at seams; bridged seams as bits."""


def tiled(layer: Layer, rng: np.random.Generator, most: int = OPEN, weights: Weights = EQUAL) -> Index:
    """Tile a layer, each component of it by itself.

    Parameters
    ----------
    layer : Layer
    rng : numpy.random.Generator
        Not asked: nothing is left to chance.
    most : int
        Open tilings at most.
    weights : tuple of float
        Of the energies.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements.
    """
    del rng
    candidates = Candidates.of(layer.problem.placements)
    group = candidates.groups(len(layer.problem.required))
    everything = (1 << len(layer.problem.required)) - 1
    chosen = 0
    for number in np.unique(group):
        inside = 0
        for row in np.flatnonzero((group == number) & (candidates.size == 1)).tolist():
            inside |= layer.mask[row]
        chosen = _tiled(layer, everything & ~inside, chosen, most // LARGEST, weights)
    return np.flatnonzero(np.array(list(reversed(f"{chosen:b}"))) == "1")


def _tiled(layer: Layer, outside: int, chosen: int, width: int, weights: Weights) -> int:
    """Tile what is not outside, beside what is chosen already, and return both."""
    n_cells = len(layer.problem.required) - outside.bit_count()
    opened: list[dict[int, State]] = [{} for _ in range(n_cells + 1)]
    opened[0][outside] = (0.0, chosen, outside, 0, 0, 0.0, 0)
    for count in range(n_cells):
        states = opened[count].values()
        opened[count] = {}
        for state in nsmallest(width, states) if len(states) > width else states:
            _expand(layer, state, count, n_cells, opened, weights)
    [last] = opened[n_cells].values()
    return last[1]


def _expand(
    layer: Layer, state: State, count: int, n_cells: int, opened: list[dict[int, State]], weights: Weights
) -> None:
    """Cover the first free cell in every way."""
    _, chosen, covered, n, alone, loss, bridged = state
    n += 1
    cell = (~covered & (covered + 1)).bit_length() - 1
    for row in layer.first[cell]:
        mask = layer.mask[row]
        if mask & covered:
            continue
        total = count + len(layer.cells[row])
        image = layer.mirror[row]
        lonely = alone + (0 if image == row else -1 if image >= 0 and chosen >> image & 1 else 1)
        # every seam on a rim is met twice, from both of its sides
        lost = loss + sum([layer.penalty(seam, bridged) for seam in layer.rim[row]]) / 2
        stability = lost * n_cells / (total * max(len(layer.near), 1))
        efficiency = (LARGEST - total / n) / (LARGEST - 1)
        energy = weights[0] * stability + weights[1] * lonely / n + weights[2] * efficiency
        known = opened[total].get(covered | mask)
        if known is None or energy < known[0]:
            bridges = bridged | layer.bridged[row]
            opened[total][covered | mask] = (energy, chosen | 1 << row, covered | mask, n, lonely, lost, bridges)
