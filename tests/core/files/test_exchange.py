"""Folders change places in one step, or nothing happens."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from legorize_addon.core.files.exchange import exchange


def test_folders_change_places(tmp_path: Path) -> None:
    """Both are there afterwards, each with what the other had."""
    for name in "ab":
        (tmp_path / name).mkdir()
        (tmp_path / name / name).touch()
    done = exchange(tmp_path / "a", tmp_path / "b")
    assert done or sys.platform != "linux"
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["b" if done else "a"]
    assert [path.name for path in (tmp_path / "b").iterdir()] == ["a" if done else "b"]


@pytest.mark.parametrize("other", ["nothing", "a/inside"])
def test_what_cannot_be_changes_nothing(tmp_path: Path, other: str) -> None:
    """A folder that is missing, or that lies in the other one."""
    (tmp_path / "a" / "inside").mkdir(parents=True)
    assert not exchange(tmp_path / "a", tmp_path / other)
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["inside"]


def test_systems_without_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no such call, it says so."""
    monkeypatch.setattr(sys, "platform", "win32")
    assert not exchange(tmp_path, tmp_path)
