"""What a brick is held by while the model is built from below.

A brick is pushed onto bricks that lie below it, or pressed from below under one
that is held already. What is pressed so hangs; plates under a slope do, and no
builder would put a pillar under each of them. But what hangs on hanging bricks
reaches farther and farther out: a limit says how deep bricks may hang one under
another, in plates, and beyond it something has to stand below.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..model import ContactGraph, stacked

NOT_HELD: Final = np.iinfo(np.int32).max
"""Depth of a brick that nothing holds."""


class Hanging:
    """How deep each brick hangs, as more and more of them are held.

    Attributes
    ----------
    depth : (n,) int32 array
        Plates by which a brick and those that hold it hang one under another: 0
        of what stands on standing bricks alone, ``NOT_HELD`` of the rest.
    """

    def __init__(self, graph: ContactGraph, height: NDArray[np.integer], *, deepest: int) -> None:
        """Begin with no brick held.

        Parameters
        ----------
        graph : ContactGraph
            Of n bricks.
        height : (n,) integer array
            Of each brick in plates.
        deepest : int
            Greatest depth in plates at which bricks hold.
        """
        self._below, self._above = stacked(graph.pairs, len(height))
        self._height = height.tolist()
        self._deepest = deepest
        self._depth = [int(NOT_HELD)] * len(height)

    @property
    def depth(self) -> NDArray[np.int32]:
        """Depth of each brick."""
        return np.array(self._depth, dtype=np.int32)

    def held(self, brick: int) -> bool:
        """Whether something holds a brick."""
        return self._depth[brick] != NOT_HELD

    def clutch(self, bricks: Iterable[int]) -> list[int]:
        """Let bricks stand, and all that they hold; return those that are held from now on."""
        reached: list[int] = []
        self._spread([entry for brick in bricks for entry in self._lift(brick, 0, reached)], reached)
        return reached

    def deepen(self, deepest: int) -> list[int]:
        """Raise the limit; return the bricks that are held from now on."""
        self._deepest = deepest
        reached: list[int] = []
        self._spread([(depth, brick) for brick, depth in enumerate(self._depth) if depth != NOT_HELD], reached)
        return reached

    def _lift(self, brick: int, depth: int, reached: list[int]) -> list[tuple[int, int]]:
        """Note a lesser depth of a brick; return what then has to be looked at."""
        if depth >= self._depth[brick]:
            return []
        if self._depth[brick] == NOT_HELD:
            reached.append(brick)
        self._depth[brick] = depth
        return [(depth, brick)]

    def _spread(self, agenda: list[tuple[int, int]], reached: list[int]) -> None:
        """Follow the least depths first, as in Dijkstra's shortest paths."""
        heapq.heapify(agenda)
        while agenda:
            depth, brick = heapq.heappop(agenda)
            if depth > self._depth[brick]:
                continue
            lifted = [entry for above in self._above[brick] for entry in self._lift(above, depth, reached)]
            for below in self._below[brick]:
                hanging = depth + self._height[below]
                if hanging <= self._deepest:
                    lifted += self._lift(below, hanging, reached)
            for entry in lifted:
                heapq.heappush(agenda, entry)
