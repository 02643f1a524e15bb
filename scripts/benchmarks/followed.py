"""A building order followed cell by cell, from its file alone: a second opinion on the product's own check."""

from __future__ import annotations

import csv
import io
from collections import Counter, defaultdict
from dataclasses import dataclass
from typing import Final

import numpy as np

from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.catalogue import Catalogue, footprint

Cell = tuple[int, int, int]

NEVER: Final = 10**9


@dataclass(slots=True)
class Faults:
    """What cannot be done, counted; and the bricks that are left in the end, by their line.

    Attributes
    ----------
    in_air : int
        Bricks that touch no stud as they are placed, or are left without a way to the table.
    overlapping : int
        Bricks placed into others.
    squeezed : int
        Bricks placed between studs below and above.
    covered : int
        Bricks placed from above though others lie over them.
    stuck : int
        Bricks taken out that others lie below.
    loose : int
        Pieces joined that touch nothing, or that have bricks above them in their way.
    """

    in_air: int = 0
    overlapping: int = 0
    squeezed: int = 0
    covered: int = 0
    stuck: int = 0
    loose: int = 0

    def total(self) -> int:
        """Return the number of all faults."""
        return self.in_air + self.overlapping + self.squeezed + self.covered + self.stuck + self.loose


def follow(text: str, catalogue: Catalogue) -> tuple[Faults, Counter[str]]:
    """Follow ``build_order.csv`` from its first row to its last.

    Parameters
    ----------
    text : str
        The file.
    catalogue : Catalogue
        Sizes of the parts.

    Returns
    -------
    faults : Faults
    left : Counter
        Lines of the bricks that are there at the end.
    """
    rows = list(csv.DictReader(io.StringIO(text)))
    places = _cells([row["ldraw"] for row in rows if row["action"] == "place"], catalogue)
    tables = {name: _Table(level) for name, level in _floors(rows, places).items()}
    faults, removing = Faults(), ""
    for row in rows:
        if removing and row["action"] != "remove":
            faults.in_air += tables[removing].in_the_air()
        removing = row["assembly"] if row["action"] == "remove" else ""
        table = tables[row["assembly"]]
        if row["action"] == "place":
            table.place(row["ldraw"], places[row["ldraw"]], faults, pressed=row["pressed"] == "1")
        elif row["action"] == "remove":
            table.remove(row["ldraw"], faults)
        else:
            tables[row["onto"]].join(table, faults)
    faults.in_air += tables["model"].in_the_air()
    return faults, Counter(list(tables["model"].bricks))


def _floors(rows: list[dict[str, str]], places: dict[str, list[Cell]]) -> dict[str, int]:
    """Return the plate on which each assembly stands; the lower end of a small one may be that of a piece."""
    floor: dict[str, int] = defaultdict(lambda: NEVER)
    piece = {row["assembly"]: row["piece"] for row in rows}
    for row in rows:
        name, onto = row["assembly"], row["onto"]
        if row["action"] == "place":
            floor[name] = min(floor[name], min(z for _, _, z in places[row["ldraw"]]))
        elif onto and piece[onto] == row["piece"]:
            floor[onto] = min(floor[onto], floor[name])
    return floor


def _cells(lines: list[str], catalogue: Catalogue) -> dict[str, list[Cell]]:
    """Return the cells of each line's brick."""
    bricks = read_ldraw("\n".join(lines), catalogue).bricks
    found = {}
    for line, part, corner, turn in zip(lines, bricks.part, bricks.corner.tolist(), bricks.turn, strict=True):
        x, y, z = corner
        squares = footprint(catalogue.parts[part], int(turn)).tolist()
        height = catalogue.parts[part].height
        found[line] = [(x + i, y + j, z + k) for i, j in squares for k in range(height)]
    return found


class _Table:
    """What stands on one table."""

    def __init__(self, floor: int) -> None:
        self.floor = floor
        self.owner: dict[Cell, str] = {}
        self.bricks: dict[str, list[Cell]] = {}
        self.high = -NEVER

    def place(self, line: str, cells: list[Cell], faults: Faults, *, pressed: bool) -> None:
        faults.overlapping += any(cell in self.owner for cell in cells)
        below, above = self._touched(line, cells)
        standing = min(z for _, _, z in cells) == self.floor
        faults.in_air += not (below or above or standing)
        faults.squeezed += bool((below or standing) and above)
        faults.covered += not pressed and self._covered(cells)
        self.bricks[line] = cells
        self.owner.update(dict.fromkeys(cells, line))
        self.high = max(self.high, *(z for _, _, z in cells))

    def remove(self, line: str, faults: Faults) -> None:
        cells = self.bricks.pop(line)
        for cell in cells:
            del self.owner[cell]
        lowest = min(z for _, _, z in cells)
        squares = {(x, y) for x, y, _ in cells}
        faults.stuck += any((x, y, z) in self.owner for x, y in squares for z in range(self.floor, lowest))

    def join(self, other: _Table, faults: Faults) -> None:
        touching = sum(bool(set(self._touched(line, cells)[0])) for line, cells in other.bricks.items())
        standing = any(z == self.floor for _, _, z in other.owner)
        faults.loose += not (touching or standing) or self._covered(list(other.owner))
        self.high = max(self.high, other.high)
        self.bricks |= other.bricks
        self.owner |= other.owner

    def _covered(self, cells: list[Cell]) -> bool:
        """Whether something lies over cells that come from above."""
        low: dict[tuple[int, int], int] = defaultdict(lambda: NEVER)
        for x, y, z in cells:
            low[x, y] = min(low[x, y], z)
        return any((x, y, z) in self.owner for (x, y), start in low.items() for z in range(start, self.high + 1))

    def in_the_air(self) -> int:
        """Count the bricks from which no way over studs leads to the table."""
        number = {line: row for row, line in enumerate(self.bricks)}
        near: list[list[int]] = [[] for _ in number]
        for line, cells in self.bricks.items():
            for other in (*self._touched(line, cells)[0], *self._touched(line, cells)[1]):
                near[number[line]].append(number[other])
        agenda = [number[line] for line, cells in self.bricks.items() if min(z for _, _, z in cells) == self.floor]
        seen = np.zeros(len(number), dtype=bool)
        while agenda:
            row = agenda.pop()
            if not seen[row]:
                seen[row] = True
                agenda += near[row]
        return int(np.count_nonzero(~seen))

    def _touched(self, line: str, cells: list[Cell]) -> tuple[list[str], list[str]]:
        """Return the bricks right below and right above a brick."""
        low, high = min(z for _, _, z in cells), max(z for _, _, z in cells)
        squares = {(x, y) for x, y, _ in cells}
        below = {self.owner.get((x, y, low - 1), line) for x, y in squares} - {line}
        above = {self.owner.get((x, y, high + 1), line) for x, y in squares} - {line}
        return sorted(below), sorted(above)
