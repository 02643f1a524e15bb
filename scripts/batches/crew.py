"""All runs of a batch, through joblib: local processes, or a Dask cluster."""

from __future__ import annotations

import os
import pickle
import signal
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any, Final, TextIO

import cloudpickle
import joblib

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.progress import duration

from . import work
from .work import Result, Task

ROUNDS: Final = 5
"""Times that runs are given out again after their workers died, without one of them ending."""


def results_of(tasks: Sequence[Task], *, jobs: int, dask: str | None) -> Iterator[Result]:
    """Do all runs, and yield the result of each as soon as it is there.

    Parameters
    ----------
    tasks : sequence of Task
    jobs : int
        Local processes at the same time.
    dask : str or None
        Address of the scheduler of a cluster, whose workers see the same folders.

    Yields
    ------
    Result

    Raises
    ------
    SettingsError
        Dask is not installed, or there is no scheduler.
    """
    if dask is None:
        with joblib.parallel_config(backend="threading", n_jobs=jobs):
            # each thread waits for a process
            yield from _given_out(tasks)
    else:
        yield from _by_cluster(tasks, dask)


class _Carried:
    """A call that takes along the code that it needs: workers, and the scheduler, need not have this repository."""

    def __init__(self, call: Callable[[], dict[str, Any]]) -> None:
        self._call = call

    def __call__(self) -> dict[str, Any]:
        """Do it."""
        return self._call()

    def __reduce__(self) -> tuple[Callable[[bytes], Any], tuple[bytes]]:
        """Arrive as the call itself."""
        return pickle.loads, (cloudpickle.dumps(self._call),)


def _given_out(tasks: Sequence[Task]) -> Iterator[Result]:
    pool = joblib.Parallel(return_as="generator_unordered", batch_size=1, pre_dispatch="all")
    for found in pool(joblib.delayed(_Carried(partial(work.run_plain, task)))() for task in tasks):
        yield Result(**found)


def _by_cluster(tasks: Sequence[Task], address: str) -> Iterator[Result]:
    """Do runs on a cluster; what a dying worker had is given out again."""
    try:
        from distributed import Client
        from distributed.scheduler import KilledWorker
    except ModuleNotFoundError as missing:
        raise SettingsError(
            f"The Python package {missing.name} is missing: run scripts/run.py setup --dask, or leave --dask out."
        ) from missing
    cloudpickle.register_pickle_by_value(work)
    try:
        client = Client(address, timeout="20s")
    except (OSError, TimeoutError, ValueError) as error:
        raise SettingsError(f"There is no Dask scheduler at {address} ({error}): start one, or correct it.") from error
    left = {task.name: task for task in tasks}
    with client, joblib.parallel_config(backend="dask"):
        for _ in range(ROUNDS):
            before = len(left)
            try:
                for result in _given_out(list(left.values())):
                    del left[result.name]
                    yield result
            except KilledWorker:
                if len(left) < before:
                    continue
            if not left:
                return
    for name in left:
        yield Result(name, "failed", "The workers that did it died again and again: look at their log.")


@contextmanager
def stopping(stop: Path) -> Iterator[None]:
    """Turn the first Ctrl-C or SIGTERM into a file that ends all runs; the next one does as usual."""
    signals = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
    before = {each: signal.getsignal(each) for each in signals}

    def note(number: int, frame: object) -> None:
        stop.touch()
        for each, handler in before.items():
            signal.signal(each, handler)

    for each in signals:
        signal.signal(each, note)
    try:
        yield
    finally:
        for each, handler in before.items():
            signal.signal(each, handler)


class Line:
    """Progress of a batch: one line that changes on a terminal, else a line for each run."""

    def __init__(self, total: int, stream: TextIO = sys.stdout) -> None:
        self._total, self._stream, self._changes = total, stream, stream.isatty()
        self._done = self._kept = self._width = 0
        self._start = time.monotonic()

    def __call__(self, result: Result) -> None:
        """Tell of the end of a run."""
        self._done += 1
        self._kept += result.status == "kept"
        took, new = time.monotonic() - self._start, self._done - self._kept
        left = f", {duration(took / new * (self._total - self._done))} left" if new and self._done < self._total else ""
        text = f"{self._done}/{self._total} {result.name}: {result.status}{left}"
        if self._changes and result.status != "failed":
            self._stream.write(f"\r{text:{self._width}}")
            self._width = len(text)
        else:
            self._stream.write(f"\r{text:{self._width}}\n" if self._changes else f"{text}\n")
            self._width = 0
        self._stream.flush()

    def end(self) -> None:
        """Wipe the line that changes."""
        if self._changes:
            self._stream.write(f"\r{'':{self._width}}\r")
            self._stream.flush()


def usual_jobs() -> int:
    """Return how many processes this machine runs side by side."""
    return max(1, os.cpu_count() or 1)
