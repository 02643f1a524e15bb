"""Names of files in other files."""

from __future__ import annotations

from pathlib import Path

import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.core.files.sources.references import beside, check_regular, is_missing


def test_missing(tmp_path: Path) -> None:
    """Files that are there, in whatever way their folder is separated, and names that no file can have."""
    (tmp_path / "inner").mkdir()
    (tmp_path / "inner" / "paint.png").touch()
    source = tmp_path / "box.obj"
    assert not is_missing(source, "inner/paint.png")
    assert not is_missing(source, "inner\\paint.png")
    for name in ("paint.png", "inner", "a" * 5000, "zero\0.png", "box.obj/paint.png"):
        assert is_missing(source, name)
    assert beside(source, "zero\0.png") is None


def test_regular(tmp_path: Path) -> None:
    """Only what is there and is no file is refused."""
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "paint.png").touch()
    check_regular(tmp_path / "box.obj", ["paint.png", "missing.png", "a" * 5000, "zero\0.png"])
    with pytest.raises(MeshError, match="which is not a file"):
        check_regular(tmp_path / "box.obj", ["paint.png", "folder.png"])
