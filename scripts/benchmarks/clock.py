"""CPU seconds, which a busy machine disturbs less than the time on the wall."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable
from typing import Final

_LEAST: Final = 1.0
"""CPU seconds of all turns together: what is fast needs more turns for its least time to be steady."""


def least_seconds(*runs: Callable[[], object], repeats: int) -> list[float]:
    """Return the least CPU seconds that each function takes.

    The functions take turns, so that a slow spell of the machine meets them all.

    Parameters
    ----------
    *runs : callable
        Functions without arguments.
    repeats : int
        Turns, at least one; more are taken until the turns together last ``_LEAST``.

    Returns
    -------
    list of float
        One for each function.
    """
    turns: list[list[float]] = []
    while len(turns) < repeats or sum(map(sum, turns)) < _LEAST:
        turns.append([seconds(run) for run in runs])
    return [min(taken) for taken in zip(*turns, strict=True)]


def seconds(run: Callable[[], object]) -> float:
    """Return the CPU seconds of one run, all threads together."""
    gc.collect()
    start = time.process_time()
    run()
    return time.process_time() - start
