"""Native calls: told of while they last, left alone when somebody stops, on one thread of linear algebra."""

from __future__ import annotations

import subprocess
import sys
import threading

import numpy as np
import pytest
from threadpoolctl import threadpool_info

from legorize_addon.core.errors import BuildError, Cancelled
from legorize_addon.core.native import one_thread, watched


def _nothing() -> None:
    """Take no notice."""


def test_result_is_that_of_the_call() -> None:
    """What the call returns comes back, from another thread than the one that asked."""
    here = threading.get_ident()
    assert watched(lambda: (7, threading.get_ident() != here), _nothing) == (7, True)


def test_progress_is_told_while_the_call_lasts() -> None:
    """A call that waits for three ticks gets them, in the thread that asked."""
    ticks: list[int] = []
    enough = threading.Event()

    def tick() -> None:
        ticks.append(threading.get_ident())
        if len(ticks) == 3:
            enough.set()

    assert watched(lambda: enough.wait(60), tick, pause=0.001)
    assert len(ticks) >= 3
    assert set(ticks) == {threading.get_ident()}


def test_errors_come_out() -> None:
    """Errors of the call are those of who asked, of whatever kind."""

    def fail() -> None:
        raise BuildError("no")

    with pytest.raises(BuildError, match="no"):
        watched(fail, _nothing)
    with pytest.raises(ZeroDivisionError):
        watched(lambda: 1 / 0, _nothing)


def test_a_stop_does_not_wait_for_the_call() -> None:
    """A tick that raises ends the waiting, while the call still goes on."""
    release, ended = threading.Event(), threading.Event()

    def call() -> None:
        release.wait(60)
        ended.set()

    def stop() -> None:
        raise Cancelled

    with pytest.raises(Cancelled):
        watched(call, stop, pause=0.001)
    assert not ended.is_set()
    release.set()
    assert ended.wait(60)


def test_a_process_ends_with_a_call_left_behind() -> None:
    """A solver at work keeps no process from ending with its own status, and nothing is said."""
    script = """
import sys
import numpy as np
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import random_array
from legorize_addon.core.errors import Cancelled
from legorize_addon.core.native import watched

def solve():
    rows = random_array((3000, 6000), density=.002, rng=0)
    milp(np.ones(6000), integrality=np.ones(6000), bounds=Bounds(0, 1), constraints=LinearConstraint(rows, .5, np.inf))

def stop():
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
