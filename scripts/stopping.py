"""What ends a run early: Ctrl-C, SIGTERM and SIGHUP give the statuses 130, 143 and 129, and leave nothing behind.

To be imported first, as importing Blender's module takes seconds and a stop
counts from the beginning. Only the standard library is used.

A stop raises :class:`Stopped` in the main thread, so that temporary files are
removed on the way out. Code in C notices it only when it returns, and code in
between may swallow it: so a thread waits, and if the main thread does not finish
in time, it removes the temporary folder and ends the process.
"""

from __future__ import annotations

import io
import os
import shutil
import signal
import sys
import threading
from pathlib import Path
from types import FrameType
from typing import Final, TextIO

GRACE: Final = 3.0
"""Seconds that the main thread has to clean up by itself."""

ENDED: Final = 128
"""What shells add to the number of a signal for the exit status."""

NAMES: Final = ("SIGINT", "SIGTERM", "SIGHUP")
"""Not every system has all of them."""


class Stopped(KeyboardInterrupt):
    """The user or the system asked the run to end."""


class Stop:
    """The request to end a run.

    Attributes
    ----------
    status : int
        Exit status that it asks for; 0 as long as there was none.
    temporary : pathlib.Path or None
        Folder to remove if the main thread cannot do it.
    """

    def __init__(self) -> None:
        self.status = 0
        self.temporary: Path | None = None
        self._loading = True
        self._signals: list[signal.Signals] = []

    def listen(self) -> None:
        """Take over the signals of this process; until :meth:`loaded` a stop ends it on the spot."""
        reading, writing = os.pipe()
        os.set_blocking(writing, False)
        signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
        self._signals = [getattr(signal, name) for name in NAMES if hasattr(signal, name)]
        for each in self._signals:
            # nohup lets a process ignore the end of its terminal
            if not (each.name == "SIGHUP" and signal.getsignal(each) is signal.SIG_IGN):
                signal.signal(each, self._stop)
        threading.Thread(target=self._watch, args=(reading,), name="stop", daemon=True).start()

    def loaded(self) -> None:
        """Note that everything is imported: from here on there is something to clean up."""
        self._loading = False

    def too_late(self) -> None:
        """Ignore signals from here on: the rest takes a moment and must not be interrupted.

        Raises
        ------
        Stopped
            There was a signal before, and its exception was swallowed.
        """
        self._ignore()
        if self.status:
            raise Stopped

    def end(self) -> None:
        """End the process as the stop asks for, without the exit of Blender, which may take its time."""
        if self.temporary:
            shutil.rmtree(self.temporary, ignore_errors=True)
        session = getattr(getattr(sys.modules.get("bpy"), "app", None), "tempdir", "")
        if session:
            shutil.rmtree(session, ignore_errors=True)
        os._exit(self.status)

    def _ignore(self) -> None:
        for each in self._signals:
            signal.signal(each, signal.SIG_IGN)

    def _stop(self, number: int, frame: FrameType | None) -> None:
        self._ignore()
        self.status = ENDED + number
        if self._loading:
            self.end()
        raise Stopped

    def _watch(self, reading: int) -> None:
        numbers = {int(each) for each in self._signals}
        while (number := os.read(reading, 1)[0]) not in numbers:
            pass
        threading.Event().wait(GRACE)
        self.status = ENDED + number
        self.end()


class _Forgiving(io.FileIO):
    """A file that takes everything: a full disk or a closed pipe does not undo what a run did."""

    def write(self, data: bytes | memoryview, /) -> int:
        """Write what can be written."""
        try:
            return super().write(data)
        except OSError:
            return memoryview(data).nbytes


def forgive_streams() -> None:
    """Let printing never fail, wherever it is done, and never reach a file of the run.

    A number that was closed is opened: else the next file would get it, and
    Blender writes to the number of the standard output, whatever it is.
    """
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            # the lowest free number is this one
            os.open(os.devnull, os.O_RDWR)
    sys.stdout, sys.stderr = (_forgiving(stream, number) for stream, number in ((sys.stdout, 1), (sys.stderr, 2)))


def _forgiving(stream: TextIO | None, number: int) -> TextIO:
    """Return a stream to a number; what its encoding lacks is shown by its code."""
    file = io.BufferedWriter(_Forgiving(number, "w", closefd=False))
    encoding = stream.encoding if stream else "utf-8"
    by_line = number == 2 or file.isatty()
    return io.TextIOWrapper(file, encoding=encoding, errors="backslashreplace", line_buffering=by_line)
