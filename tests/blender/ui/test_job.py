"""A job tells its progress, stops on request, and hands over whatever comes of its work."""

from __future__ import annotations

import threading
import time

import pytest

from legorize_addon.core.errors import Cancelled, MeshError
from legorize_addon.core.progress import Progress
from legorize_addon.ui import job
from legorize_addon.ui.job import Job


def endless(progress: Progress) -> None:
    """Work until told to stop."""
    while True:
        progress("working", 0.5)
        time.sleep(0.005)


def begun(work: Job) -> Job:
    """Start a job and wait for its first word."""
    work.start()
    while work.progress[0] != "working":
        time.sleep(0.001)
    return work


def test_result_comes_out() -> None:
    """The result is what the work returned, in another thread than the one that asks."""
    work = Job(lambda progress: threading.current_thread())
    work.start()
    assert work.result() is work


@pytest.mark.parametrize("error", [MeshError("too small"), ZeroDivisionError()])
def test_failure_comes_out(error: Exception) -> None:
    """What the work raised is raised again where the result is asked for, with its traceback."""

    def fail(progress: Progress) -> None:
        raise error

    work = Job(fail)
    work.start()
    with pytest.raises(type(error)) as caught:
        work.result()
    assert caught.value is error
    assert [entry.name for entry in caught.traceback][-1] == "fail"


def test_progress_is_seen_from_outside() -> None:
    """The stage and share of the last word can be read while the work goes on."""
    gate = threading.Event()

    def work(progress: Progress) -> str:
        progress("cutting", 0.25)
        gate.wait(10)
        progress("cutting", 1.0)
        return "done"

    task = Job(work)
    assert task.progress == ("Starting", 0.0)
    task.start()
    while task.progress[1] == 0:
        time.sleep(0.001)
    assert task.progress == ("cutting", 0.25)
    assert job.running() is task
    gate.set()
    assert task.result() == "done"
    assert task.progress == ("cutting", 1.0)
    assert job.running() is None


def test_cancel_stops_soon() -> None:
    """A job stops at its next word of progress, and says that it was cancelled."""
    work = begun(Job(endless))
    assert not work.stopping
    work.cancel()
    assert work.stopping
    with pytest.raises(Cancelled):
        work.result()


def test_stop_ends_all() -> None:
    """Stopping waits until no job is left."""
    both = [begun(Job(endless)), begun(Job(endless))]
    job.stop()
    assert not any(work.is_alive() for work in both)
    assert job.running() is None
    job.stop()
