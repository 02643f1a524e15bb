"""Results as Markdown for people, CSV and JSON for programs."""

from __future__ import annotations

import csv
import json
import os
import platform
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

Value = str | int | float | bool | None
Row = dict[str, Value]

PACKAGES = ("numpy", "scipy", "scikit-learn", "trimesh", "shapely")


@dataclass(frozen=True, slots=True)
class Table:
    """Rows with the same columns.

    Attributes
    ----------
    name : str
        Name of the CSV file.
    title : str
        What is measured, and what is wanted.
    rows : tuple of dict
        Values by column; ``None`` where there is none.
    """

    name: str
    title: str
    rows: tuple[Row, ...]

    def markdown(self) -> str:
        """Return the title and a Markdown table; missed goals are bold."""
        lines = [list(self.rows[0]), ["---" if isinstance(value, str) else "--:" for value in self.rows[0].values()]]
        for row in self.rows:
            missed = {column for column, value in row.items() if value is False and column.endswith("met")}
            lines.append([f"**{shown(value)}**" if column in missed else shown(value) for column, value in row.items()])
        return "\n".join([f"**{self.title}**", "", *(f"| {' | '.join(line)} |" for line in lines), ""])


def shown(value: Value) -> str:
    """Return a value for people: four digits of a number, yes or no."""
    if value is None:
        return "–"  # noqa: RUF001 - a dash, not a minus
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"
    return str(value)


def write(folder: Path, name: str, tables: Sequence[Table]) -> None:
    """Write one CSV file a table, and all tables with the machine's description as one JSON file."""
    folder.mkdir(parents=True, exist_ok=True)
    for table in tables:
        with (folder / f"{table.name}.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(table.rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(table.rows)
    facts = {"machine": machine(), "tables": {table.name: table.rows for table in tables}}
    (folder / f"{name}.json").write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def machine() -> Row:
    """Return what ran the measurements."""
    facts: Row = {"python": platform.python_version(), "system": platform.platform(), "cores": os.cpu_count()}
    return facts | {package: _version(package) for package in PACKAGES}


def _version(package: str) -> str | None:
    try:
        return version(package)
    except PackageNotFoundError:
        return None
