"""Simulated annealing of a layer: a brick is thrown in, what it breaks is filled up again.

References
----------
T. Kozaki, H. Tedenuma and T. Maekawa, "Automatic generation of LEGO building
instructions from multiple photographic images of real objects", CAD 70, 2016,
anneal for few bricks; their energy was not to be had, so it is that of Min, Park,
Yang and Yun (see :mod:`.seams`).
"""

from __future__ import annotations

from math import exp
from typing import Final

import numpy as np

from scripts.research.rules import Index, by_key, largest_in_rows
from scripts.research.seams import FEW, LARGEST, Layer

MOVES: Final = 60
"""Tried for each cell."""

HOT: Final = 0.1
COLD: Final = 0.005
"""Temperatures at the beginning and the end: what a change for the worse may cost
in energy, times the number of bricks (found by trial)."""


def annealed(layer: Layer, rng: np.random.Generator, moves: int = MOVES) -> Index:
    """Lay a layer greedily and anneal it.

    Parameters
    ----------
    layer : Layer
    rng : numpy.random.Generator
        Throws the bricks and the dice.
    moves : int
        Tried for each cell.

    Returns
    -------
    (n_bricks,) intp array
        Rows of the placements of the best layout met.
    """
    state = _State(layer, by_key(largest_in_rows)(layer.problem, rng))
    count = moves * len(layer.problem.required)
    thrown = rng.integers(len(layer.cells), size=count).tolist()
    dice = rng.random(count).tolist()
    cooling = (COLD / HOT) ** (1 / max(count, 1))
    temperature, least, best = HOT, state.energy, list(state.laid)
    scale = len(state.laid)
    for row, die in zip(thrown, dice, strict=True):
        temperature *= cooling
        before = state.energy
        broken, laid = state.exchange(row)
        worse = scale * (state.energy - before)
        if worse > 0 and die >= exp(-worse / temperature):
            state.swap(laid, broken)
        elif state.energy < least - 1e-12:
            least, best = state.energy, list(state.laid)
    return np.array(sorted(best), dtype=np.intp)


class _State:
    """A layout of all cells that knows its energy.

    Attributes
    ----------
    laid : dict
        Rows of the placements that lie, in the order of laying.
    """

    def __init__(self, layer: Layer, chosen: Index) -> None:
        self._layer = layer
        self._brick = [-1] * len(layer.problem.required)
        self._lines = {line: number for number, line in enumerate(dict.fromkeys(layer.line))}
        self._losses: dict[tuple[int, int], float] = {}
        self._bridged, self._alone, self._loss = 0, 0, sum(self._lost(line, 0) for line in self._lines)
        self.laid: dict[int, None] = {}
        self.swap([], chosen.tolist())

    @property
    def energy(self) -> float:
        """Weighted sum of the three energies."""
        n, n_cells, n_seams = len(self.laid), len(self._brick), max(len(self._layer.near), 1)
        efficiency = (LARGEST - n_cells / n) / (LARGEST - 1)
        return FEW[0] * self._loss / n_seams + FEW[1] * self._alone / n + FEW[2] * efficiency

    def exchange(self, row: int) -> tuple[list[int], list[int]]:
        """Throw a brick in and fill up what it leaves of others; return what was broken and what was laid."""
        layer = self._layer
        broken = list(dict.fromkeys(self._brick[cell] for cell in layer.cells[row]))
        free = 0
        for each in broken:
            free |= layer.mask[each]
        free &= ~layer.mask[row]
        laid = [row]
        while free:
            cell = (free & -free).bit_length() - 1
            fill = next(each for each in layer.first[cell] if not layer.mask[each] & ~free)
            laid.append(fill)
            free &= ~layer.mask[fill]
        self.swap(broken, laid)
        return broken, laid

    def swap(self, old: list[int], new: list[int]) -> None:
        """Take bricks away and lay others on the same cells."""
        layer = self._layer
        changed = 0
        images = {*old, *new, *(layer.mirror[row] for row in (*old, *new))}
        self._alone -= self._lonely(images)
        for row in old:
            del self.laid[row]
            changed ^= layer.bridged[row]
        for row in new:
            self.laid[row] = None
            changed ^= layer.bridged[row]
            for cell in layer.cells[row]:
                self._brick[cell] = row
        self._alone += self._lonely(images)
        self._bridge(changed)

    def _lonely(self, rows: set[int]) -> int:
        """Count those of some bricks that lie and have no mirror image."""
        return sum(row in self.laid and self._layer.mirror[row] not in self.laid for row in rows)

    def _bridge(self, changed: int) -> None:
        """Turn bridged seams into others and back."""
        after = self._bridged ^ changed
        while changed:
            line = self._layer.line[(changed & -changed).bit_length() - 1]
            self._loss += self._lost(line, after & line) - self._lost(line, self._bridged & line)
            changed &= ~line
        self._bridged = after

    def _lost(self, line: int, bridged: int) -> float:
        """Return the loss at the seams of a line."""
        question = (self._lines[line], bridged)
        if question not in self._losses:
            seams = (seam for seam in range(line.bit_length()) if (line & ~bridged) >> seam & 1)
            self._losses[question] = sum(self._layer.penalty(seam, bridged) for seam in seams)
        return self._losses[question]
