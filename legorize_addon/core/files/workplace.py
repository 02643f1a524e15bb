"""A temporary folder that belongs to one run, and what killed runs left.

The run holds a lock on a file in it, which the system gives back when the
process ends, however it ends. So another run can distinguish a folder in use from
an abandoned one, without relying on process numbers.
"""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from secrets import token_hex
from typing import BinaryIO, Final

PREFIX: Final = ".legorize-"
LOCK: Final = "lock"
JOURNAL: Final = "journal.json"
"""A list of moves that have begun: a folder with it is finished by the next run, not thrown away."""

if sys.platform == "win32":
    import msvcrt

    def _lock(file: BinaryIO) -> None:
        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)

else:
    import fcntl

    def _lock(file: BinaryIO) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


@contextmanager
def workplace(near: Path) -> Iterator[Path]:
    """Yield a new folder that is removed at the end, unless moves out of it have begun and could not be finished.

    Parameters
    ----------
    near : pathlib.Path
        Folder to make it in.
    """
    folder = near / f"{PREFIX}{token_hex(8)}"
    try:
        # closed before it is removed: an open file cannot be removed everywhere
        with _claimed(folder):
            yield folder
    finally:
        discard(folder)


def _claimed(folder: Path) -> BinaryIO:
    """Make a folder and return its locked file; another run that clears up may be faster than the lock."""
    while True:
        folder.mkdir(mode=0o700, exist_ok=True)
        with suppress(FileNotFoundError):
            lock = (folder / LOCK).open("wb")
            with suppress(OSError):
                # without locks in this file system nobody clears up either
                _lock(lock)
            if (folder / LOCK).exists():
                return lock
            lock.close()


def clear_abandoned(near: Path, finish: Callable[[Path], None]) -> None:
    """Remove the folders of runs that are no longer alive.

    Parameters
    ----------
    near : pathlib.Path
        Folder to look in.
    finish : callable
        Called first with a folder whose moves have begun.
    """
    for folder in sorted(near.glob(f"{PREFIX}*")):
        if folder.is_dir() and not folder.is_symlink() and _abandoned(folder):
            if (folder / JOURNAL).exists():
                finish(folder)
            with suppress(OSError):
                discard(folder)


def _abandoned(folder: Path) -> bool:
    try:
        with (folder / LOCK).open("r+b") as lock:
            _lock(lock)
    except FileNotFoundError:
        # created, and not locked yet or any more; only an empty one is certainly worthless
        with suppress(OSError):
            folder.rmdir()
        return False
    except OSError:
        # locked, or another user's
        return False
    return True


def discard(folder: Path) -> None:
    """Remove a folder whose moves have not begun, its lock at last: if this is cut short, the next run goes on."""
    if (folder / JOURNAL).exists() or not folder.exists():
        return
    for entry in folder.iterdir():
        if entry.name != LOCK:
            shutil.rmtree(entry) if entry.is_dir() and not entry.is_symlink() else entry.unlink()
    (folder / LOCK).unlink(missing_ok=True)
    folder.rmdir()


@contextmanager
def alone(near: Path) -> Iterator[None]:
    """Let one run at a time move files in a folder, where the system can lock folders."""
    if sys.platform == "win32":
        yield
        return
    folder = os.open(near, os.O_RDONLY)
    try:
        with suppress(OSError):
            fcntl.flock(folder, fcntl.LOCK_EX)
        yield
    finally:
        os.close(folder)
