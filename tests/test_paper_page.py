"""The page on the paper's systems: all of them, and every test and command that it names is there."""

from __future__ import annotations

import re
from pathlib import Path

from scripts.benchmark import BENCHMARKS
from scripts.research.paper_tables import TITLES

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "paper.md").read_text(encoding="utf-8")
SYSTEMS = 65


def rows() -> list[list[str]]:
    """Return the cells of each row of the table."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in re.findall(r"^\| \d+ \|.*$", PAGE, re.M)]


def test_every_system_has_a_row() -> None:
    """65 rows in order, each with a name, a place, an answer and what shows it."""
    found = rows()
    assert [int(row[0]) for row in found] == list(range(1, SYSTEMS + 1))
    assert all(len(row) == 5 and all(row) for row in found)


def test_tests_are_there() -> None:
    """A row names a test function of the file, or a command."""
    for number, *_, shown in rows():
        named = re.findall(r"`([^`]+)`", shown)
        assert named, number
        for each in named:
            if each.startswith("benchmark.py "):
                assert each.removeprefix("benchmark.py ") in BENCHMARKS, each
            else:
                file, _, function = each.partition("::")
                assert re.search(rf"^def {function}\(", (ROOT / file).read_text(encoding="utf-8"), re.M), each


def test_commands_and_tables_are_there() -> None:
    """Every command that the text names exists, and the tables have the names that it promises."""
    assert set(re.findall(r"`benchmark\.py (\w[\w-]*)`", PAGE)) <= set(BENCHMARKS)
    assert {f"tables_{number}" for number in range(1, 5)} <= set(TITLES)
    assert (ROOT / "scripts" / "gallery.py").is_file()
