"""What the commands of scripts/run.py run."""

from __future__ import annotations

import ast
import re
from pathlib import Path

from scripts import run

ROOT = Path(__file__).resolve().parents[2]


def lines(command: str, *rest: str) -> list[list[str]]:
    """Return the command lines of a command."""
    return list(run._lines(command, list(rest)))


def test_quick_leaves_out_what_is_listed() -> None:
    """The choice is taken out of the words for pytest; other words are handed on."""
    [[_, _, *words]] = lines("test", "--quick", "-x")
    assert "--quick" not in words
    assert words[-1] == "-x"
    assert "tests/core" in words
    assert sum(word.startswith("--deselect=tests/core/") for word in words) > 50
    assert lines("test", "tests/core/mesh")[0][2:] == ["tests/core/mesh"]


def test_listed_tests_exist() -> None:
    """A name that went would hide that its test is quick, or missing."""
    listed = [word.removeprefix("--deselect=") for word in run._quick() if word.startswith("--deselect=")]
    assert listed == sorted(set(listed))
    for entry in listed:
        file, name = entry.split("::")
        tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
        assert name in {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}, entry


def test_python_takes_all_that_follows() -> None:
    """Flags behind the command belong to what it runs, not to the script."""
    assert run._words(["--blender", "4.5", "python", "-m", "ruff", "--help"]) == (
        ["--blender", "4.5", "python"],
        ["-m", "ruff", "--help"],
    )
    assert run._words(["test", "-q"]) == (["test", "-q"], [])
    assert lines("python", "-m", "ruff") == [["-m", "ruff"]]


def test_every_command_runs_something() -> None:
    """Each command but setup and docs, which have ways of their own, has a line; the help names all of them."""
    assert all(lines(command, "x") for command in set(run.COMMANDS) - {"setup", "docs"})
    assert set(run.COMMANDS) == set(re.findall(r"scripts/run\.py (\w+)  ", str(run.__doc__)))


def test_documentation_has_its_own_environment() -> None:
    """It has Sphinx and what the core imports, and no Blender."""
    names = {pin.split("==")[0].lower() for pin in run._pins(run.DOCS)}
    assert {"sphinx", "numpy", "scipy", "scikit-learn"} <= names
    assert "bpy" not in names
