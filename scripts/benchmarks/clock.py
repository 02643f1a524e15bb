"""CPU seconds, which a busy machine disturbs less than the time on the wall."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from typing import Final

_FAST: Final = 1.0
_MORE: Final = 4


def least_seconds(*runs: Callable[[], object], repeats: int) -> list[float]:
    """Return the least CPU seconds that each function takes.

    The functions take turns, so that a slow spell of the machine meets them all.

    Parameters
    ----------
    *runs : callable
        Functions without arguments.
    repeats : int
        Turns, at least one. What is fast needs more for its least time to be
        steady: four times as many are taken if they last below a second.

    Returns
    -------
    list of float
        One for each function.
    """
    gc.collect()
    turns = [[seconds(run) for run in runs] for _ in range(repeats)]
    if sum(map(sum, turns)) < _FAST:
        turns += [[seconds(run) for run in runs] for _ in range((_MORE - 1) * repeats)]
    return [min(taken) for taken in zip(*turns, strict=True)]


def seconds(run: Callable[[], object]) -> float:
    """Return the CPU seconds of one run, all threads together."""
    start = time.process_time()
    run()
    return time.process_time() - start
