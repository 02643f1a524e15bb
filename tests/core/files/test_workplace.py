"""Temporary folders: gone at the end, those of dead runs removed, those of living runs left alone."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from legorize_addon.core.files import workplace as module
from legorize_addon.core.files.workplace import JOURNAL, LOCK, PREFIX, alone, clear_abandoned, discard, workplace

ROOT = Path(__file__).resolve().parents[3]
HOLD = """
import sys
from pathlib import Path
from legorize_addon.core.files.workplace import workplace
with workplace(Path(sys.argv[1])) as folder:
    (folder / "big").mkdir()
    print(folder, flush=True)
    sys.stdin.read()
"""


def no_moves(folder: Path) -> None:
    """Stand for the end of begun moves, of which there are none."""
    raise AssertionError(folder)


def test_gone_at_the_end(tmp_path: Path) -> None:
    """Whatever is in it, and whether all went well or not."""
    for error in (None, KeyboardInterrupt):
        try:
            with workplace(tmp_path) as folder:
                (folder / "a" / "b").mkdir(parents=True)
                (folder / "a" / "link").symlink_to(tmp_path)
                if error:
                    raise error
        except KeyboardInterrupt:
            pass
        assert list(tmp_path.iterdir()) == []


def test_only_folders_of_dead_runs_are_removed(tmp_path: Path) -> None:
    """While a process holds its folder nobody removes it; once it is killed, the next one does."""
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(tmp_path)], cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    )
    folder = Path(process.stdout.readline().strip())
    clear_abandoned(tmp_path, no_moves)
    assert (folder / "big").is_dir()
    process.kill()
    process.communicate(timeout=60)
    assert folder.is_dir()
    clear_abandoned(tmp_path, no_moves)
    assert list(tmp_path.iterdir()) == []


def test_what_is_cut_short_can_be_gone_on_with(tmp_path: Path) -> None:
    """A folder that was made and not yet locked, or all but removed, goes too; other people's folders stay."""
    (tmp_path / f"{PREFIX}empty").mkdir()
    (tmp_path / f"{PREFIX}other").mkdir()
    (tmp_path / f"{PREFIX}other" / "file").touch()
    (tmp_path / f"{PREFIX}file").touch()
    (tmp_path / f"{PREFIX}link").symlink_to(tmp_path)
    clear_abandoned(tmp_path, no_moves)
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"{PREFIX}{name}" for name in ("file", "link", "other")]


def test_begun_moves_are_finished_first(tmp_path: Path) -> None:
    """Moves that have begun are handed over, and as long as they are not ended the folder stays."""
    folder = tmp_path / f"{PREFIX}0"
    folder.mkdir()
    for name in (LOCK, JOURNAL):
        (folder / name).touch()
    discard(folder)
    clear_abandoned(tmp_path, lambda work: None)
    assert folder.is_dir()
    clear_abandoned(tmp_path, lambda work: (work / JOURNAL).unlink())
    assert not folder.exists()


def test_somebody_may_clear_up_before_the_lock(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that another run takes for abandoned between making and locking is made again."""
    lock, calls = module._lock, []

    def late(file: object) -> None:
        calls.append(file)
        if len(calls) == 1:
            [folder] = tmp_path.iterdir()
            (folder / LOCK).unlink()
            folder.rmdir()
        lock(file)

    monkeypatch.setattr(module, "_lock", late)
    with workplace(tmp_path) as folder:
        assert (folder / LOCK).exists()
    assert len(calls) == 2
    assert list(tmp_path.iterdir()) == []


def test_one_at_a_time(tmp_path: Path) -> None:
    """A second process waits until the first has moved its files."""
    code = "import sys; from pathlib import Path; from legorize_addon.core.files.workplace import alone\n"
    code += "print('ready', flush=True)\nwith alone(Path(sys.argv[1])): print('mine', flush=True)"
    with alone(tmp_path):
        process = subprocess.Popen(
            [sys.executable, "-c", code, str(tmp_path)], cwd=ROOT, stdout=subprocess.PIPE, text=True
        )
        assert process.stdout.readline() == "ready\n"
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(0.5)
    assert process.communicate(timeout=60)[0] == "mine\n"
