"""How a long computation reports its progress.

A progress callback is called with the name of the stage and a share done in
[0, 1]. It may raise :class:`~legorize_addon.core.errors.Cancelled`; the core
lets that through, so that a request to stop ends the run at the next call.

Stages only know their own share. :class:`Overall` turns these into the share of the whole run, which never decreases,
and :class:`Meter` keeps what is shown: the stage, the share, and the time left.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import Final

Progress = Callable[[str, float], None]
"""Called with (stage, share done); may raise ``Cancelled``."""

_SOONEST: Final = 0.005
"""Share from which a time left is shown: before that, the estimate is too uncertain."""


def silent(stage: str, share: float) -> None:
    """Ignore the progress."""


def part(progress: Progress, low: float, high: float) -> Progress:
    """Return the progress of a part of a stage.

    Parameters
    ----------
    progress : Progress
        Of the stage.
    low, high : float
        Shares of the stage at which the part begins and ends.

    Returns
    -------
    Progress
        Its shares from 0 to 1 become those from `low` to `high`.
    """
    return lambda stage, share: progress(stage, low + (high - low) * share)


class Overall:
    """The shares of stages, one after the other, as one share of the whole run.

    Parameters
    ----------
    seconds : mapping of str to float
        Estimated time of each stage; only the proportions count.
    progress : Progress
        Called with the stage, and the share of the whole run, which never
        decreases.

    Notes
    -----
    Within a stage an object of this class is itself the :data:`Progress` of that
    stage. Stages may name their parts: the name is passed on.
    """

    def __init__(self, seconds: Mapping[str, float], progress: Progress) -> None:
        self._seconds = dict(seconds)
        self._total = sum(seconds.values())
        self._progress = progress
        self._before = self._now = self._share = 0.0
        self._stage = ""

    def __call__(self, stage: str, share: float) -> None:
        """Report the share of the current stage that is done."""
        done = (self._before + self._now * min(max(share, 0.0), 1.0)) / self._total if self._total else 0.0
        # a stage without an expected time may have ended before
        self._stage, self._share = stage, max(self._share, min(done, 1.0))
        self._progress(stage, self._share)

    @contextmanager
    def stage(self, name: str, *, shown: str | None = None) -> Iterator[Overall]:
        """Report the beginning and the end of a stage.

        Parameters
        ----------
        name : str
            A name of `seconds`; any other stage counts as no time at all.
        shown : str, optional
            The name to report, if it differs.

        Yields
        ------
        Overall
            The progress of the stage.
        """
        self._now = self._seconds.pop(name, 0.0)
        self(shown or name, 0.0)
        yield self
        self(shown or name, 1.0)
        self._before, self._now = self._before + self._now, 0.0

    def finish(self) -> None:
        """Report that everything is done, even if more was expected."""
        self._share = 1.0
        self._progress(self._stage, 1.0)


class Meter:
    """A progress callback that keeps the last report, with a clock.

    Parameters
    ----------
    clock : callable, optional
        Returns seconds.

    Attributes
    ----------
    told : tuple of str and float
        The stage and the share of the whole run as last reported; one object, because another thread may read it.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock, self._start = clock, clock()
        self._first: str | None = None
        self._done_before = 0.0
        self._open = False
        self.told = ("Starting", 0.0)

    def __call__(self, stage: str, share: float) -> None:
        """Keep a report."""
        self._first = stage if self._first is None else self._first
        self.told = (stage, share)

    def leave_open(self) -> None:
        """Give no time left until :meth:`start_anew`: nobody knows yet how long the longest part will take."""
        self._open = True

    def start_anew(self) -> None:
        """Judge the rest by what is done from now on: its pace has nothing to do with what was done before."""
        self._start, self._done_before = self._clock(), self.told[1]
        self._open, self._first = False, ""

    @property
    def seconds_left(self) -> float | None:
        """Seconds that the rest takes at the speed so far; ``None`` (unknown) in the first stage."""
        stage, share = self.told
        done = share - self._done_before
        if self._open or self._first in (stage, None) or done < _SOONEST * (1 - self._done_before):
            return None
        return (self._clock() - self._start) * (1 - share) / done if share < 1 else 0.0


def duration(seconds: float) -> str:
    """Return a time in words that are short enough for a progress bar, as ``"45 s"`` or ``"3 min"``."""
    if seconds < 60:
        return f"{max(round(seconds), 1)} s"
    return f"{seconds / 60:.0f} min" if seconds < 5400 else f"{seconds / 3600:.1f} h"
