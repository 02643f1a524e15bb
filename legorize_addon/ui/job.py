"""A computation in a worker thread: progress comes out, a request to stop goes in.

This is the only module that knows of this thread; previews have one of their own,
in :mod:`.live`. It needs no Blender, and the work that it runs must not touch
Blender either.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from ..core.errors import Cancelled
from ..core.progress import Meter, Progress

Result = TypeVar("Result")


class Job(threading.Thread, Generic[Result]):
    """A function at work in a thread of its own, from :meth:`start` on.

    Parameters
    ----------
    work : callable
        Called with a progress callback, which raises ``Cancelled`` once
        :meth:`cancel` was called.
    """

    def __init__(self, work: Callable[[Progress], Result]) -> None:
        super().__init__(name="Legorize", daemon=True)
        self._work = work
        self._stop_request = threading.Event()
        self._results: list[Result] = []
        self._error: Exception | None = None
        self._meter = Meter()

    def run(self) -> None:
        """Do the work and keep what comes of it; called by :meth:`start`."""
        try:
            self._results.append(self._work(self._tell))
        except Exception as error:  # noqa: BLE001 - raised again by result(), in the thread that asks for it
            self._error = error

    def cancel(self) -> None:
        """Ask the work to stop at its next word of progress."""
        self._stop_request.set()

    @property
    def progress(self) -> tuple[str, float]:
        """Stage and share done of all the work, as last told by it."""
        return self._meter.told

    @property
    def seconds_left(self) -> float | None:
        """How long the rest takes at a guess, unknown (``None``) in the first stage."""
        return self._meter.seconds_left

    @property
    def stopping(self) -> bool:
        """Whether the work was asked to stop."""
        return self._stop_request.is_set()

    def result(self) -> Result:
        """Wait for the end of the work and return its result.

        Raises
        ------
        Exception
            Whatever the work raised, ``Cancelled`` included.
        """
        self.join()
        if self._error is not None:
            raise self._error
        return self._results[0]

    def _tell(self, stage: str, share: float) -> None:
        if self.stopping:
            raise Cancelled
        self._meter(stage, share)


def running() -> Job[object] | None:
    """Return the job at work, or None."""
    return next((thread for thread in threading.enumerate() if isinstance(thread, Job)), None)


def stop() -> None:
    """Cancel every job and wait for its end, before what it belongs to goes away."""
    jobs = [thread for thread in threading.enumerate() if isinstance(thread, Job)]
    for job in jobs:
        job.cancel()
    for job in jobs:
        job.join()
