"""Mutants of the core are what they say, and tests that notice one are believed."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from scripts.benchmarks import mutation
from scripts.benchmarks.mutation import CORE, ROOT, Mutant, Trial, moved, turned

MODULE = CORE / "units.py"
PATHS = [path.relative_to(ROOT) for path in sorted((ROOT / CORE).rglob("*.py"))]


def changed(mutant: Mutant) -> list[tuple[str, str]]:
    """Return the lines that a mutant changes, before and after."""
    text = (ROOT / mutant.path).read_text(encoding="utf-8")
    return [(old, new) for old, new in zip(text.split("\n"), mutant.apply(text).split("\n"), strict=True) if old != new]


@pytest.mark.parametrize("kind", [moved, turned])
def test_a_mutant_changes_one_line(kind) -> None:
    """What comes out is Python still, one line is another one, and it is the line that is named."""
    mutants = [each for path in PATHS for each in kind(path)]
    assert len(mutants) > 100
    for mutant in mutants[:: len(mutants) // 60]:
        [(old, new)] = changed(mutant)
        ast.parse(mutant.apply((ROOT / mutant.path).read_text(encoding="utf-8")))
        assert old.encode()[: mutant.start] == new.encode()[: mutant.start]
        assert mutant.new in new


@pytest.mark.parametrize(("number", "other"), [("3", 4), ("40", 60), ("0.2", 0.3), ("0.0", 1.0)])
def test_numbers_are_moved_by_what_can_be_noticed(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, number, other
) -> None:
    """Of a constant the number alone is changed: small whole ones by one, others by half."""
    monkeypatch.setattr(mutation, "ROOT", tmp_path)
    (tmp_path / "some.py").write_text(f"SOME = {number}\n", encoding="utf-8")
    [mutant] = moved(Path("some.py"))
    assert float(mutant.new) == pytest.approx(other)


def test_shares_are_of_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each mutant is tried once; those that live are listed, and counted by kind."""
    monkeypatch.setattr(Trial, "survives", lambda _, mutant: mutant.name == "PLATES_PER_BRICK")
    survived, shares = mutation.measure(["units.py"], constants=99, logic=5, seed=0)
    assert [row["name"] for row in survived.rows] == ["PLATES_PER_BRICK"]
    [row] = [row for row in shares.rows if row["kind"] == "constant"]
    assert (row["tried"], row["survived"]) == (len(list(moved(MODULE))), 1)


def test_a_moved_constant_is_noticed(tmp_path: Path) -> None:
    """The tests of a module run in the copy, against the changed module; afterwards the copy is as it was."""
    for name in mutation.COPIED:
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "legorize_addon").unlink()
    mutation.shutil.copytree(ROOT / "legorize_addon", tmp_path / "legorize_addon")
    mutant = next(each for each in moved(CORE / "model" / "catalogue.py") if each.name == "ASSETS")
    with Trial(tmp_path) as trial:
        assert not trial.survives(mutant)
        assert trial.survives(Mutant(mutant.path, "constant", mutant.line, mutant.end, mutant.end, "", "unchanged"))
    assert (tmp_path / mutant.path).read_text(encoding="utf-8") == (ROOT / mutant.path).read_text(encoding="utf-8")
