"""The folder of the results: whole or as it was."""

from __future__ import annotations

from pathlib import Path

import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.files.folder import new_folder


def test_results_arrive_in_a_new_folder(tmp_path: Path) -> None:
    """A folder that was not there is made with its parents."""
    with new_folder(tmp_path / "a" / "b") as folder:
        (folder / "model.ldr").write_text("bricks")
    assert (tmp_path / "a" / "b" / "model.ldr").read_text() == "bricks"
    assert [path.name for path in tmp_path.rglob(".legorize-*")] == []


def test_failure_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    """Neither the new file nor a temporary folder stays."""
    (tmp_path / "model.ldr").write_text("earlier")

    def fail() -> None:
        with new_folder(tmp_path) as folder:
            (folder / "model.ldr").write_text("later")
            raise BuildError("No.")

    with pytest.raises(BuildError):
        fail()
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("model.ldr", "earlier")]
