"""The steps that somebody else gave a model, as its bricks tell them."""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Iterator

import numpy as np

from ..arrays import Ints
from ..model import NOBODY, Assembly, Rows
from .moves import Action, Moves
from .steps import MAIN, Kind, Steps, Submodel


def given_steps(assembly: Assembly, pairs: Rows) -> Steps:
    """Return steps in which bricks are placed as their table says, none of them taken out again.

    Parameters
    ----------
    assembly : Assembly
        n bricks, each with its step.
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.

    Returns
    -------
    Steps
        All on one table. Within a step bricks come from below where they can,
        and those that only touch what is above them are pressed from below.
        Numbers of steps are without gaps.
    """
    n = len(assembly)
    order = _Order(assembly, pairs)
    steps = np.unique(assembly.bricks.step, return_inverse=True)[1].reshape(-1)
    moves = [
        (row, pressed, step) for step, rows in enumerate(_groups(steps)) for row, pressed in order.of(rows.tolist())
    ]
    table = np.array(moves, np.int64).reshape(-1, 3)
    return Steps(
        Moves(
            action=np.full(n, Action.PLACE, np.uint8),
            brick=table[:, 0].astype(np.int32),
            piece=np.zeros(n, np.int16),
            submodel=np.full(n, MAIN, np.int32),
            pressed=table[:, 1].astype(bool),
            step=table[:, 2].astype(np.int32),
        ),
        (Submodel(MAIN, Kind.MAIN, NOBODY, 0, table[:, 0].copy(), MAIN),),
    )


def _groups(steps: Ints) -> Iterable[Ints]:
    """Return the rows of each step."""
    order = np.argsort(steps, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(steps[order])) + 1) if len(order) else []


class _Order:
    """Which brick of a step comes next."""

    def __init__(self, assembly: Assembly, pairs: Rows) -> None:
        level = assembly.bricks.corner[:, 2]
        self.level = level.tolist()
        self.ground = int(level.min(initial=np.iinfo(level.dtype).max))
        self.placed: set[int] = set()
        self.above = _neighbours(pairs, len(level))
        self.below = _neighbours(pairs[:, ::-1], len(level))

    def of(self, rows: list[int]) -> Iterator[tuple[int, bool]]:
        """Yield the bricks of a step, and whether each is pressed from below."""
        waiting = set(rows)
        left = sorted(rows, key=lambda row: (-self.level[row], -row))
        ready: list[tuple[bool, int, int]] = []
        for row in rows:
            if self.level[row] == self.ground or any(other in self.placed for other in self.below[row]):
                heapq.heappush(ready, (False, self.level[row], row))
            elif any(other in self.placed for other in self.above[row]):
                heapq.heappush(ready, (True, self.level[row], row))
        while waiting:
            if ready:
                pressed, _, row = heapq.heappop(ready)
            else:
                # nothing holds it: the check of the order says so
                pressed, row = False, left.pop()
            if row not in waiting:
                continue
            waiting.remove(row)
            self.placed.add(row)
            yield row, pressed
            for others, from_below in ((self.above[row], False), (self.below[row], True)):
                for other in others:
                    if other in waiting:
                        heapq.heappush(ready, (from_below, self.level[other], other))


def _neighbours(pairs: Rows, n: int) -> list[list[int]]:
    """Return of each brick those that pairs give as its second one."""
    found: list[list[int]] = [[] for _ in range(n)]
    for one, other in pairs.tolist():
        found[one].append(other)
    return found
