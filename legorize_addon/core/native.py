"""Calls of native code: on one thread of its own mathematics, and watched while they last.

A solver that is called once may work for minutes. It lets other threads run
meanwhile, so one of these can tell progress, and can be told to stop.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final, Generic, TypeVar

Result = TypeVar("Result")

PAUSE: Final = 0.2
"""Seconds between two looks at whether somebody wants a watched call to stop."""


@contextmanager
def one_thread() -> Iterator[None]:
    """Let linear algebra run on the thread that calls it; also a decorator.

    Several threads add up in an order that depends on how many there are, and
    so would the result; of the small blocks here they make no quick work
    either, as they wait for each other.
    """
    from threadpoolctl import threadpool_limits

    with threadpool_limits(limits=1, user_api="blas"):
        yield


def watched(call: Callable[[], Result], tick: Callable[[], None], *, pause: float = PAUSE) -> Result:
    """Call a function that takes long and lets other threads run.

    Parameters
    ----------
    call : callable
        Called once, in a thread of its own. It must not change anything that
        others see: nobody stops it.
    tick : callable
        Called again and again in this thread while the call lasts. If it
        raises, the call is left to itself, and ends with the process.
    pause : float
        Seconds between two of its calls.

    Returns
    -------
    object
        What the call returned.

    Raises
    ------
    Exception
        Whatever the call or `tick` raised.
    """
    thread = _Call(call)
    thread.start()
    thread.join(pause)
    while thread.is_alive():
        tick()
        thread.join(pause)
    return thread.result()


class _Call(threading.Thread, Generic[Result]):
    """A call at work, which keeps nothing alive that ends."""

    def __init__(self, call: Callable[[], Result]) -> None:
        super().__init__(name="Legorize: solver", daemon=True)
        self._call = call
        self._results: list[Result] = []
        self._error: BaseException | None = None

    def run(self) -> None:
        try:
            self._results.append(self._call())
        except BaseException as error:  # raised again by result(), in the thread that asks for it
            self._error = error

    def result(self) -> Result:
        if self._error is not None:
            raise self._error
        return self._results[0]
