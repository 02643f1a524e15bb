"""The report lists the files of its run, and whose they are now is told by their contents."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.manifest import changed, checksum, listed, names_in, ours, refuse_strangers, seal


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """Return a folder with a report that lists two files."""
    (tmp_path / "tables").mkdir()
    (tmp_path / "report.json").write_text('{"version": "1"}')
    (tmp_path / "model.ldr").write_text("bricks")
    (tmp_path / "tables" / "table_1.csv").write_text("volumes")
    seal(tmp_path)
    (tmp_path / "mine.txt").write_text("mine")
    return tmp_path


def test_report_lists_what_was_written(folder: Path) -> None:
    """All files that were there, with / between folders, and what the report said before."""
    assert json.loads((folder / "report.json").read_text()) == {
        "version": "1",
        "files": {name: checksum(folder / name) for name in ("model.ldr", "tables/table_1.csv")},
    }
    assert names_in(folder) == ["mine.txt", "model.ldr", "tables/table_1.csv", "report.json"]
    # SHA-256 of "bricks"
    assert checksum(folder / "model.ldr") == "bad48609bec87ad5fac3cfecdd146c4d37893a0f1d4f8ab44dce94f5c127a85d"


def test_results_of_the_first_version_are_replaced(tmp_path: Path) -> None:
    """Its report listed no files: a folder with one holds results; with any other report it holds a user's files."""
    (tmp_path / "model.ldr").write_text("bricks")
    (tmp_path / "report.json").write_text('{"schema": 1, "version": "0.1.0"}')
    refuse_strangers(tmp_path, ["model.ldr"])
    for other in ('{"schema": 2, "version": "0.2.0"}', '{"version": "0.1.0"}', "[]", "mine"):
        (tmp_path / "report.json").write_text(other)
        with pytest.raises(BuildError, match="no earlier run wrote"):
            refuse_strangers(tmp_path, ["model.ldr"])


def test_what_was_changed_is_the_users(folder: Path) -> None:
    """Only what is still as it was written is ours; what is gone is nobody's."""
    assert ours(folder) == {"report.json", "model.ldr", "tables/table_1.csv"}
    assert changed(folder) == []
    (folder / "model.ldr").write_text("my own bricks")
    assert ours(folder) == {"report.json", "tables/table_1.csv"}
    assert changed(folder) == ["model.ldr"]
    (folder / "tables" / "table_1.csv").unlink()
    assert ours(folder) == {"report.json"}
    (folder / "tables" / "table_1.csv").symlink_to("table_1.csv")
    assert ours(folder) == {"report.json"}


@pytest.mark.parametrize(
    "text", ["", "[]", "{", '{"files": 3}', '{"files": ["model.ldr"]}', "[" * 100_000, '{"files": {}}', "\udcff"]
)
def test_other_reports_list_nothing(folder: Path, text: str) -> None:
    """A report of somebody else's makes no file ours."""
    (folder / "report.json").write_bytes(text.encode("utf-8", "surrogateescape"))
    assert listed(folder) == {}
    assert ours(folder) == set()
    assert changed(folder) == []


@pytest.mark.parametrize("name", ["../model.ldr", "/model.ldr", "a/../../model.ldr", "", "..", "a\\..\\b"])
def test_names_stay_in_the_folder(folder: Path, name: str) -> None:
    """A name that leads out of the folder is never ours."""
    (folder / "report.json").write_text(json.dumps({"files": {name: checksum(folder / "model.ldr")}}))
    assert listed(folder) == {}


def test_folder_without_a_report_is_left_alone(tmp_path: Path) -> None:
    """Nothing is added where there is no report."""
    (tmp_path / "model.ldr").write_text("bricks")
    seal(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["model.ldr"]
    assert listed(tmp_path / "nowhere") == {}
