"""One run of a batch: a process of its own, locked, never done twice.

Only the standard library is used, as workers of a cluster get this module as it
is. They see the folders of the batch under the same paths.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

try:
    import fcntl
except ImportError:  # Windows: two batches into one folder are not kept apart there
    fcntl = None

POLL: Final = 0.1
"""Seconds between two looks at a run."""

GRACE: Final = 15.0
"""Seconds in which a run that is stopped may clean up."""

COMPLETE: Final = ("model.ldr", "parts.csv", "report.json")
"""Files without which a run is not complete."""


@dataclass(frozen=True, slots=True)
class Task:
    """One run.

    Attributes
    ----------
    name : str
        Its folder below the folder of runs, with ``/``.
    key : str
        What it is made of: checksum of input, settings, flags and version.
    command : tuple of str
        What to start.
    root : str
        Folder of the batch.
    stop : str
        File whose being there ends all runs.
    """

    name: str
    key: str
    command: tuple[str, ...]
    root: str
    stop: str

    @property
    def out(self) -> Path:
        """Folder of the results."""
        return Path(self.root) / "runs" / self.name

    def beside(self, kind: str) -> Path:
        """Return a file of the batch about this run."""
        return Path(self.root) / "log" / f"{self.name.replace('/', '--')}.{kind}"


@dataclass(frozen=True, slots=True)
class Result:
    """What came of a run.

    Attributes
    ----------
    name : str
    status : {"built", "kept", "failed", "stopped"}
        Kept is what was complete before.
    sentence : str
        Why it failed.
    seconds : float
        That it took now.
    """

    name: str
    status: str
    sentence: str = ""
    seconds: float = 0.0


def is_complete(task: Task) -> bool:
    """Return whether a run's results are there in full, and of just these inputs."""
    try:
        facts = json.loads((task.out / "report.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    there = all((task.out / name).is_file() for name in COMPLETE)
    return there and isinstance(facts, dict) and facts.get("tag") == task.key


def run(task: Task) -> Result:
    """Do one run, unless it is complete; wait for whoever else is doing it.

    Parameters
    ----------
    task : Task

    Returns
    -------
    Result
    """
    task.beside("lock").parent.mkdir(parents=True, exist_ok=True)
    with _locked(task) as lock:
        if lock is None:
            return Result(task.name, "stopped")
        if is_complete(task):
            return Result(task.name, "kept")
        start = time.monotonic()
        _note(task, "start")
        status = _done(task, lock)
        _note(task, "end", status=status)
        seconds = time.monotonic() - start
        if is_complete(task):
            return Result(task.name, "built", seconds=seconds)
        if os.path.exists(task.stop):
            return Result(task.name, "stopped", seconds=seconds)
        return Result(task.name, "failed", _sentence(task, status), seconds)


def run_plain(task: Task) -> dict[str, Any]:
    """Do one run; return the result as a dictionary, which every machine understands."""
    return asdict(run(task))


@contextmanager
def _locked(task: Task) -> Iterator[int | None]:
    """Yield the open lock of a run, None if all is stopped before it is free.

    The process of the run inherits it: if a worker dies and its run goes on, the
    next one waits for its end.
    """
    number = os.open(task.beside("lock"), os.O_RDWR | os.O_CREAT)
    try:
        while not os.path.exists(task.stop):
            if _try_lock(number):
                yield number
                return
            time.sleep(POLL)
        yield None
    finally:
        # never unlocked by hand: that would unlock it for the process, too
        os.close(number)


def _try_lock(number: int) -> bool:
    if fcntl is None:
        return True
    try:
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _done(task: Task, lock: int) -> int:
    """Start the process of a run, wait for its end or the stop, and return its exit status."""
    inherited = {"pass_fds": (lock,)} if fcntl is not None else {}
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    task.out.parent.mkdir(parents=True, exist_ok=True)
    with task.beside("out").open("wb") as out, task.beside("err").open("wb") as err:
        # in a session of its own, so that Ctrl-C reaches the batch alone
        process = subprocess.Popen(
            task.command, stdin=subprocess.DEVNULL, stdout=out, stderr=err, env=environment, start_new_session=True,
            **inherited,
        )  # fmt: skip
        while process.poll() is None:
            if os.path.exists(task.stop):
                return _ended(process)
            time.sleep(POLL)
        return process.returncode


def _ended(process: subprocess.Popen[bytes]) -> int:
    """End a process, which may clean up."""
    process.terminate()
    try:
        return process.wait(GRACE)
    except subprocess.TimeoutExpired:
        process.kill()
        return process.wait()


def _note(task: Task, event: str, **more: object) -> None:
    """Add a line to the journal of the batch."""
    line = {"run": task.name, "event": event, "time": round(time.time(), 2), "process": os.getpid(), **more}
    number = os.open(Path(task.root) / "journal.jsonl", os.O_WRONLY | os.O_APPEND | os.O_CREAT)
    try:
        os.write(number, (json.dumps(line) + "\n").encode())
    finally:
        os.close(number)


def _sentence(task: Task, status: int) -> str:
    """Return why a run failed: the last thing that it said."""
    said = task.beside("err").read_text(encoding="utf-8", errors="replace").split("\n")
    last = next((line.strip() for line in reversed(said) if line.strip()), "")
    if status < 0:
        return f"It was ended by the signal {signal.Signals(-status).name}. {last}".strip()
    return last or f"It ended with the status {status} and without a word."
