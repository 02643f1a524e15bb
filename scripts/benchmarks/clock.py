"""CPU seconds, which a busy machine disturbs less than the time on the wall."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable


def least_seconds(*runs: Callable[[], object], repeats: int) -> list[float]:
    """Return the least CPU seconds that each function takes.

    The functions take turns, so that a slow spell of the machine meets them all.

    Parameters
    ----------
    *runs : callable
        Functions without arguments.
    repeats : int
        Turns, at least one.

    Returns
    -------
    list of float
        One for each function.
    """
    return [min(turns) for turns in zip(*([seconds(run) for run in runs] for _ in range(repeats)), strict=True)]


def seconds(run: Callable[[], object]) -> float:
    """Return the CPU seconds of one run, all threads together."""
    gc.collect()
    start = time.process_time()
    run()
    return time.process_time() - start
