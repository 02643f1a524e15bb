"""Mutants of the core are what they say, and tests that notice one are believed."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from scripts.benchmarks import mutation
from scripts.benchmarks.mutation import CORE, ROOT, Mutant, constants, turned

MODULE = CORE / "units.py"
PATHS = [path.relative_to(ROOT) for path in sorted((ROOT / CORE).rglob("*.py"))]


def changed(mutant: Mutant) -> list[tuple[str, str]]:
    """Return the lines that a mutant changes, before and after."""
    text = (ROOT / mutant.path).read_text(encoding="utf-8")
    return [(old, new) for old, new in zip(text.split("\n"), mutant.apply(text).split("\n"), strict=True) if old != new]


@pytest.mark.parametrize("kind", [constants, turned])
def test_a_mutant_changes_one_line(kind) -> None:
    """What comes out is Python still, one line is another one, and it is the line that is named."""
    mutants = [each for path in PATHS for each in kind(path)]
    assert len(mutants) > 100
    for mutant in mutants[:: len(mutants) // 60]:
        [(old, new)] = changed(mutant)
        ast.parse(mutant.apply((ROOT / mutant.path).read_text(encoding="utf-8")))
        assert old.encode()[: mutant.start] == new.encode()[: mutant.start]
        assert mutant.new in new


def test_whole_numbers_grow_by_one() -> None:
    """Of a constant the number alone is changed."""
    [mutant] = [each for each in constants(MODULE) if each.name == "PLATES_PER_BRICK"]
    assert changed(mutant)[0][1].endswith("= 4")


def test_shares_are_of_what_was_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each mutant is tried once; those that live are listed, and counted by kind."""
    monkeypatch.setattr(mutation, "survives", lambda mutant, copy: mutant.name == "PLATES_PER_BRICK")
    survived, shares = mutation.measure(["units.py"], logic=5, seed=0)
    assert [row["name"] for row in survived.rows] == ["PLATES_PER_BRICK"]
    [row] = [row for row in shares.rows if row["kind"] == "constant"]
    assert (row["tried"], row["survived"]) == (len(list(constants(MODULE))), 1)


def test_a_moved_constant_is_noticed(tmp_path: Path) -> None:
    """The tests of a module run in the copy, against the changed module; afterwards the copy is as it was."""
    for name in mutation.COPIED:
        (tmp_path / name).symlink_to(ROOT / name)
    (tmp_path / "legorize_addon").unlink()
    mutation.shutil.copytree(ROOT / "legorize_addon", tmp_path / "legorize_addon")
    [mutant] = [each for each in constants(CORE / "colours" / "difference.py") if each.new][:1]
    assert not mutation.survives(mutant, tmp_path)
    assert (tmp_path / mutant.path).read_text(encoding="utf-8") == (ROOT / mutant.path).read_text(encoding="utf-8")
