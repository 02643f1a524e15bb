"""Work that calls native code: on one thread of linear algebra, and never silent.

A call of a solver may take minutes without reporting progress. Other threads can run meanwhile, so the work gets a
thread of its own, and the calling thread keeps reporting progress and can stop the work.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from typing import Final, Generic, TypeVar

from .errors import Cancelled
from .progress import Progress

Result = TypeVar("Result")

PAUSE: Final = 0.2
"""Seconds of silence after which the last progress is reported again."""


@contextmanager
def one_thread() -> Iterator[None]:
    """Let linear algebra run on the thread that calls it; also a decorator.

    Several threads add in an order that depends on their number, and so would the result. They are not faster on the
    small blocks here either, because they wait for each other.
    """
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield


def watched(work: Callable[[Progress], Result], progress: Progress, *, pause: float = PAUSE) -> Result:
    """Do some work, and report progress even while it is silent.

    Parameters
    ----------
    work : callable
        Called once, in a thread of its own, with a progress callback that passes everything on and waits for the
        answer.
    progress : Progress
        Called in this thread: with everything that the work reports, in order, and with the last report again after
        each `pause`. If it raises, the work is stopped at its next report, and not waited for.
    pause : float
        Seconds.

    Returns
    -------
    object
        What the work returned.

    Raises
    ------
    Exception
        Whatever the work or `progress` raised.
    """
    worker = _Worker(work)
    worker.start()
    last: tuple[str, float] | None = None
    try:
        while not worker.ended:
            told = worker.listen(pause)
            last = told or last
            if last is not None and not worker.ended:
                progress(*last)
            if told is not None:
                worker.answer()
    finally:
        worker.stop(pause)
    return worker.result()


class _Worker(threading.Thread, Generic[Result]):
    """Work in a daemon thread; it waits for an answer to each report."""

    def __init__(self, work: Callable[[Progress], Result]) -> None:
        super().__init__(name="Legorize: work", daemon=True)
        self._work = work
        self._words: SimpleQueue[tuple[str, float] | None] = SimpleQueue()
        self._answers: SimpleQueue[None] = SimpleQueue()
        self._abandoned = False
        self._results: list[Result] = []
        self._error: BaseException | None = None
        self.ended = False

    def run(self) -> None:
        """Do the work in a thread of its own, and keep what came of it."""
        try:
            self._results.append(self._work(self._tell))
        except BaseException as error:  # noqa: BLE001 - raised again by result(), in the thread that asks for it
            self._error = error
        self._words.put(None)

    def _tell(self, stage: str, share: float) -> None:
        self._words.put((stage, share))
        self._answers.get()
        if self._abandoned:
            raise Cancelled

    def listen(self, pause: float) -> tuple[str, float] | None:
        """Return what the work reports within some seconds; it has ended after its last report."""
        try:
            word = self._words.get(timeout=pause)
        except Empty:
            return None
        self.ended = word is None
        return word

    def answer(self) -> None:
        """Let the work continue after a report."""
        self._answers.put(None)

    def stop(self, pause: float) -> None:
        """Let the work end at its next report, and wait some seconds for that."""
        self._abandoned = True
        self.answer()
        self.join(pause)

    def result(self) -> Result:
        """Return what came of the work, or raise what ended it."""
        if self._error is not None:
            raise self._error
        return self._results[0]
