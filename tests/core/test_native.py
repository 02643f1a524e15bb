"""Work that calls native code: never silent, left when somebody stops, on one thread of linear algebra."""

from __future__ import annotations

import subprocess
import sys
import threading

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from legorize_addon.core.errors import BuildError, Cancelled
from legorize_addon.core.native import one_thread, watched
from legorize_addon.core.progress import Progress


def _silent(stage: str, share: float) -> None:
    """Take no notice."""


def test_words_and_result_pass_through() -> None:
    """All that the work tells arrives in order, in the thread that asked, before the work goes on."""
    heard: list[tuple[str, float, int]] = []

    def work(progress: Progress) -> tuple[int, list[int]]:
        seen = []
        for step in range(5):
            progress("work", step / 5)
            seen.append(len(heard))
        return threading.get_ident(), seen

    there, seen = watched(work, lambda *word: heard.append((*word, threading.get_ident())), pause=60)
    here = threading.get_ident()
    assert there != here
    assert heard == [("work", step / 5, here) for step in range(5)]
    assert seen == [1, 2, 3, 4, 5]


def test_silence_is_filled() -> None:
    """Work that is silent until it was told of three times more gets that: the last word again and again."""
    heard: list[tuple[str, float]] = []
    enough = threading.Event()

    def hear(stage: str, share: float) -> None:
        heard.append((stage, share))
        if len(heard) == 4:
            enough.set()

    def work(progress: Progress) -> bool:
        progress("solver", 0.5)
        return enough.wait(60)

    assert watched(work, hear, pause=0.001)
    assert set(heard) == {("solver", 0.5)}


def test_nothing_is_told_before_the_work_does() -> None:
    """Nobody knows yet what stage is at work."""
    heard: list[tuple[str, float]] = []

    def work(progress: Progress) -> None:
        threading.Event().wait(0.05)
        progress("first", 0.0)

    watched(work, lambda *word: heard.append(word), pause=0.001)
    assert heard[0] == ("first", 0.0)


def test_errors_come_out() -> None:
    """Errors of the work are those of who asked, of whatever kind."""

    def fail(progress: Progress) -> None:
        raise BuildError("no")

    with pytest.raises(BuildError, match="no"):
        watched(fail, _silent)
    with pytest.raises(ZeroDivisionError):
        watched(lambda progress: 1 / 0, _silent)


def test_a_stop_at_a_word_ends_the_work() -> None:
    """Who raises when something is told gets that error out, and the work is over."""
    ended = threading.Event()

    def work(progress: Progress) -> None:
        try:
            progress("work", 0.0)
        finally:
            ended.set()

    def stop(stage: str, share: float) -> None:
        raise KeyError(stage)

    with pytest.raises(KeyError, match="work"):
        watched(work, stop, pause=60)
    assert ended.is_set()


def test_a_stop_does_not_wait_for_silent_work() -> None:
    """A stop amid silence leaves the work, which ends at its next word."""
    silent, release, ended = threading.Event(), threading.Event(), threading.Event()

    def work(progress: Progress) -> None:
        progress("work", 0.0)
        silent.set()
        release.wait(60)
        try:
            progress("work", 0.5)
        except Cancelled:
            ended.set()

    def stop(stage: str, share: float) -> None:
        if silent.is_set():
            raise Cancelled

    with pytest.raises(Cancelled):
        watched(work, stop, pause=0.001)
    assert not ended.is_set()
    release.set()
    assert ended.wait(60)


def test_a_process_ends_with_a_solver_left_behind() -> None:
    """A solver at work keeps no process from ending with its own status, and nothing is said."""
    script = """
import sys
import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import random_array
from legorize_addon.core.errors import Cancelled
from legorize_addon.core.native import watched

rows = random_array((3000, 6000), density=.002, rng=0)

def solve(progress):
    progress("solver", 0.0)
    milp(np.ones(6000), integrality=np.ones(6000), bounds=Bounds(0, 1), constraints=LinearConstraint(rows, .5, np.inf))

words = []

def stop(stage, share):
    words.append(share)
    if len(words) == 3:
        raise Cancelled

try:
    watched(solve, stop)
except Cancelled:
    sys.exit(3)
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=300, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (3, "", "")


def test_linear_algebra_runs_on_one_thread() -> None:
    """Within, no library of linear algebra has more than one thread; afterwards each has what it had before."""
    np.linalg.inv(np.eye(2))
    before = threadpool_info()
    with one_thread():
        assert [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"] == [1] * sum(
            pool["user_api"] == "blas" for pool in before
        )
    assert threadpool_info() == before
