"""Rows of long tables, kept as they come, so that a run that was stopped goes on where it was."""

from __future__ import annotations

import hashlib
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path

from scripts.benchmarks.tables import Row

ROOT = Path(__file__).resolve().parents[2]


class Kept:
    """Rows in a folder, each in a file of its own.

    Parameters
    ----------
    folder : pathlib.Path
        For the files; made when the first row is there.
    minutes : float
        No row is begun later than that; 0 for no limit.
    """

    def __init__(self, folder: Path, minutes: float) -> None:
        self._folder, self._end = folder, time.monotonic() + 60 * minutes if minutes else None
        self._program = program()
        self._left = 0

    def row(self, name: str, make: Callable[[], Row]) -> list[Row]:
        """Return a row, measured now if it was not by the same program before; none if there is no time left.

        Parameters
        ----------
        name : str
            Of its file.
        make : callable
            Measures it.
        """
        path = self._folder / f"{name}.json"
        if path.exists():
            kept = json.loads(path.read_text(encoding="utf-8"))
            if kept["program"] == self._program:
                row: Row = kept["row"]
                return [row]
        if self._end is not None and time.monotonic() > self._end:
            self._left += 1
            return []
        row = make()
        self._folder.mkdir(parents=True, exist_ok=True)
        part = path.with_suffix(".part")
        part.write_text(json.dumps({"program": self._program, "row": row}) + "\n", encoding="utf-8")
        part.replace(path)
        return [row]

    def tell_left(self) -> None:
        """Say how many rows are missing."""
        if self._left:
            print(f"{self._left} rows are left: run the same command again.", file=sys.stderr)


def program() -> str:
    """Return a digest of all that decides what is measured: sources of the core, its data, and the benchmarks."""
    found = hashlib.sha256()
    folders = ((ROOT / "legorize_addon" / "core", "*.py"), (ROOT / "assets", "*.csv"), (ROOT / "scripts", "*.py"))
    for folder, pattern in folders:
        for path in sorted(folder.rglob(pattern)):
            found.update(path.relative_to(ROOT).as_posix().encode())
            found.update(path.read_bytes())
    return found.hexdigest()
