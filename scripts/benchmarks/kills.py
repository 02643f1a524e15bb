"""Kill runs and look at the folder of the results: it is the old one or the new one, whole, and nothing else is left.

Two kinds of kills. Whole runs of ``scripts/legorize.py`` are ended at moments
spread evenly over their time, most by SIGKILL, some by SIGINT and SIGTERM.
Publishing alone takes a moment that such kills rarely meet; so small processes
publish files of their own and kill themselves before the n-th thing that they
ask of the file system, for every n, once where folders can change places and
once where files are moved one by one.
"""

from __future__ import annotations

import itertools
import json
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Final

from scripts.benchmarks.tables import Row, Table

ROOT: Final = Path(__file__).resolve().parents[2]
WIDTHS: Final = (5, 7)
"""Studs of the runs that take turns, so that old and new differ."""

SIGNALS: Final = (signal.SIGKILL, signal.SIGKILL, signal.SIGINT, signal.SIGKILL, signal.SIGKILL, signal.SIGTERM)
"""In turn."""

MINE: Final = {"mine.txt": b"the user's", "tables/mine.csv": b"the user's, too"}
LIMIT: Final = 600
"""Seconds for one process."""

TITLE: Final = "Killed runs: the folder holds the old results or the new ones, and nothing is left over"
CHILD: Final = """
import os, signal, sys
from pathlib import Path
from legorize_addon.core.files import publishing
from legorize_addon.core.files.folder import new_folder
out, label, moment, swap = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3]), sys.argv[4] == "swap"
if not swap:
    publishing.exchange = lambda one, other: False
seen = -1
def kill(event, arguments):
    global seen
    if seen >= 0 and event.split(".")[0] in ("os", "open", "shutil", "ctypes"):
        seen += 1
        if seen == moment:
            os.kill(os.getpid(), signal.SIGKILL)
names = ["report.json", "model.ldr", "tables/table_1.csv", f"only-{label}.txt", f"deep/{label}/only.txt"]
with new_folder(out) as folder:
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("{}" if name == "report.json" else label)
    (folder / "report.json").write_text('{"label": "%s"}' % label)
    sys.addaudithook(kill)
    seen = 0
print(seen)
"""
"""Publishes files of a label; ends itself before the moment-th event of the file system after writing."""


@dataclass(slots=True)
class Tally:
    """What was found after the kills of one kind."""

    kind: str
    counts: Counter[str]

    def row(self) -> Row:
        """Return the counts, the faults among them with whether there are none."""
        faults = ("torn_or_mixed", "torn_after_next", "leftovers", "user_files", "wrong_status")
        row: Row = {"kills": self.kind, "done": self.counts["done"], "old": self.counts["old"]}
        row |= {"new": self.counts["new"], "repaired_by_next": self.counts["repaired"]}
        row |= {fault: self.counts[fault] for fault in faults}
        return row | {"met": not any(self.counts[fault] for fault in faults)}


def measure(model: Path, *, runs: int, moments: int) -> list[Table]:
    """Kill whole runs and publishing.

    Parameters
    ----------
    model : pathlib.Path
        A model file; small widths are built of it.
    runs : int
        Whole runs to end.
    moments : int
        Kills within publishing, spread over all of its moments in both ways.
    """
    with tempfile.TemporaryDirectory() as folder:
        tallies = [_publishing(Path(folder) / way, way, moments // 2) for way in ("swap", "moves") if moments]
        if runs:
            tallies.append(_whole_runs(Path(folder) / "runs", model, runs))
    return [Table("kills", TITLE, tuple(tally.row() for tally in tallies))]


def _publishing(place: Path, way: str, kills: int) -> Tally:
    out = place / "above" / "out"
    tally = Tally(f"publishing, {way}", Counter())
    events = int(_child(out, "old", -1, way).stdout)
    _add_mine(out)
    events = int(_child(out, "old", -1, way).stdout)
    for kill in range(kills):
        # old and new, old and new: each is whole before the next one
        _clean(_child(out, "old", -1, way))
        _child(out, "new", 1 + kill * events // kills, way)
        found = state(out)
        # the recovery alone, without new results
        subprocess.run([sys.executable, "-c", _RECOVER, str(out)], cwd=ROOT, check=True, timeout=LIMIT)
        _count(tally, place, out, found, at_once=way == "swap")
    return tally


_RECOVER: Final = """
import sys
from pathlib import Path
from legorize_addon.core.files.folder import new_folder
from legorize_addon.core.errors import BuildError
try:
    with new_folder(Path(sys.argv[1])):
        raise BuildError("nothing new")
except BuildError:
    pass
"""


def _count(tally: Tally, place: Path, out: Path, found: str, *, at_once: bool) -> None:
    tally.counts["done"] += 1
    after = state(out)
    whole = found in ("old", "new")
    tally.counts[found if whole else "repaired" if not at_once else "torn_or_mixed"] += 1
    # what the journal promises is carried out, even if nothing had been moved yet
    begun = not at_once and (found, after) == ("old", "new")
    tally.counts["torn_after_next"] += after not in ("old", "new") or (whole and after != found and not begun)
    tally.counts["leftovers"] += len(leftovers(place))
    tally.counts["user_files"] += not _has_mine(out)


def _child(out: Path, label: str, moment: int, way: str) -> subprocess.CompletedProcess[str]:
    line = [sys.executable, "-c", CHILD, str(out), label, str(moment), way]
    return subprocess.run(line, cwd=ROOT, capture_output=True, text=True, timeout=LIMIT, check=False)


def _clean(done: subprocess.CompletedProcess[str]) -> None:
    if done.returncode:
        raise RuntimeError(done.stderr)


def state(out: Path) -> str:
    """Return the label of the results in a folder, if they are whole and alone but for the user's files."""
    try:
        facts = json.loads((out / "report.json").read_text(encoding="utf-8"))
        listed = facts["files"]
        names = {path.relative_to(out).as_posix() for path in out.rglob("*") if path.is_file()}
        same = all(sha256((out / name).read_bytes()).hexdigest() == listed[name] for name in listed)
    except (OSError, ValueError, KeyError):
        return "torn"
    whole = same and names - MINE.keys() == listed.keys() | {"report.json"}
    return str(facts.get("label", facts.get("grid", {}).get("x"))) if whole else "mixed"


def leftovers(place: Path) -> list[Path]:
    """Return all temporary folders below a folder."""
    return sorted(place.rglob(".legorize-*"))


def _add_mine(out: Path) -> None:
    for name, content in MINE.items():
        (out / name).parent.mkdir(exist_ok=True)
        (out / name).write_bytes(content)


def _has_mine(out: Path) -> bool:
    return all((out / name).is_file() and (out / name).read_bytes() == content for name, content in MINE.items())


def _whole_runs(place: Path, model: Path, runs: int) -> Tally:
    """End runs at moments spread over their time; each begins with what the one before left."""
    out = place / "out"
    tally = Tally("whole runs", Counter())
    place.mkdir()
    labels = []
    for width in WIDTHS:
        start = time.monotonic()
        _finished(_run(model, out, width))
        taken = time.monotonic() - start
        labels.append(state(out))
    _add_mine(out)
    before = labels[-1]
    for kill, number in zip(range(runs), itertools.cycle(SIGNALS)):
        wanted = labels.index(before) ^ 1
        earlier = set(leftovers(place))
        running = _run(model, out, WIDTHS[wanted])
        status = _ended(running, taken * (kill + 0.5) / runs, number)
        after = state(out)
        left = set(leftovers(place))
        tally.counts["done"] += 1
        tally.counts["old" if after == before else "new" if after == labels[wanted] else "torn_or_mixed"] += 1
        tally.counts["wrong_status"] += not _fits(status, number, changed=after != before)
        # who is killed can clear nothing up; the next run does
        tally.counts["leftovers"] += len(left - earlier) if number != signal.SIGKILL else 0
        tally.counts["user_files"] += not _has_mine(out)
        before = after if after in labels else before
    _finished(_run(model, out, WIDTHS[labels.index(before) ^ 1]))
    tally.counts["torn_after_next"] += state(out) not in labels
    tally.counts["leftovers"] += len(leftovers(place))
    return tally


def _fits(status: int, number: int, *, changed: bool) -> bool:
    """Tell whether a status is that of the signal, or of a run that had come too far to be stopped.

    SIGKILL ends a process even then, with its results complete.
    """
    return status in ((0, 2) if changed else (-number, 128 + number)) or status == -number == -signal.SIGKILL


def _run(model: Path, out: Path, width: int) -> subprocess.Popen[bytes]:
    line = [sys.executable, str(ROOT / "scripts" / "legorize.py"), str(model), "--out", str(out), "--width", str(width)]
    return subprocess.Popen(line, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def _ended(running: subprocess.Popen[bytes], after: float, number: int) -> int:
    try:
        return running.wait(after)
    except subprocess.TimeoutExpired:
        running.send_signal(number)
        return running.wait(LIMIT)


def _finished(running: subprocess.Popen[bytes]) -> None:
    if running.wait(LIMIT) not in (0, 2):
        raise RuntimeError(f"{running.args} ended with {running.returncode}")
