"""The benchmark of killed runs: it finds nothing in what is whole, and what is torn."""

from __future__ import annotations

from pathlib import Path

from scripts.benchmarks import kills


def test_kills_find_what_is_torn(tmp_path: Path) -> None:
    """A few kills within publishing find nothing; a folder with a file changed, missing or too many is not whole."""
    [table] = kills.measure(Path(), runs=0, moments=4)
    assert [row["done"] for row in table.rows] == [2, 2]
    assert all(row["met"] for row in table.rows)
    kills._clean(kills._child(tmp_path / "out", "new", -1, "swap"))
    assert kills.state(tmp_path / "out") == "new"
    model = tmp_path / "out" / "model.ldr"
    for change, undo in (
        (lambda: model.write_text("old"), lambda: model.write_text("new")),
        (model.unlink, lambda: model.write_text("new")),
        ((tmp_path / "out" / "old.txt").touch, (tmp_path / "out" / "old.txt").unlink),
    ):
        change()
        assert kills.state(tmp_path / "out") in ("mixed", "torn")
        undo()
        assert kills.state(tmp_path / "out") == "new"
