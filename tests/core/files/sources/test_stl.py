"""STL: a count that is wrong, and text that ends early."""

from __future__ import annotations

from pathlib import Path

from legorize_addon.core.files.sources.preflight import check_source
from tests.core.files.sources.written import refusal, stl, stl_text


def test_count(tmp_path: Path) -> None:
    """More triangles promised than there are, and fewer."""
    for count in (2**32 - 1, 13, 11, 0):
        (tmp_path / "box.stl").write_bytes(stl()[:80] + count.to_bytes(4, "little") + stl()[84:])
        assert f"says {count} triangles, but 12 whole ones follow" in refusal(tmp_path / "box.stl")


def test_binary_that_calls_itself_solid(tmp_path: Path) -> None:
    """Some programs begin the header of a binary file with the word that stands for text."""
    (tmp_path / "box.stl").write_bytes(b"solid" + stl()[5:])
    assert check_source(tmp_path / "box.stl", ()) == ()
    (tmp_path / "box.stl").write_bytes(b"solid" + stl()[5:-50])
    assert "says 12 triangles, but 11" in refusal(tmp_path / "box.stl")


def test_text(tmp_path: Path) -> None:
    """Text may end after any facet, and not within one."""
    path = tmp_path / "box.stl"
    path.write_bytes(stl_text())
    assert check_source(path, ()) == ()
    path.write_bytes(stl_text()[: stl_text().rfind(b"endsolid")])
    assert check_source(path, ()) == ()
    path.write_bytes(stl_text()[: stl_text().rfind(b"vertex")])
    assert "within a facet" in refusal(path)
