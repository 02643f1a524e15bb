"""What must hold of every model, whatever it was made of, found out without the code that made it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from typing import Final

import numpy as np
from scipy import ndimage

from legorize_addon.core.build import Build
from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.model.bricks import SUPPORTS
from legorize_addon.core.model.catalogue import Catalogue, Part
from legorize_addon.core.model.profiles import columns
from legorize_addon.core.model.unit_grid import Fill
from legorize_addon.core.report.checks import failed_checks
from legorize_addon.core.report.report import report

Cell = tuple[int, int, int]

_PLATES: Final = 3


def faults(build: Build, catalogue: Catalogue) -> list[str]:
    """Return what is wrong with a build, a sentence each; empty if nothing is."""
    parts = cells_of(build, catalogue)
    found = faults_of_bricks(build, catalogue)
    n = n_components(parts)
    if n != build.graph.n_components:
        found.append(f"The connection has {build.graph.n_components} components, but there are {n}.")
    checks = failed_checks(report(build, catalogue, version="0", mm_per_unit=1.0))
    if (n > 1) != any(check.startswith("Components") for check in checks):
        found.append(f"There are {n} components, but the checks say: {checks}.")
    if n > 1 and not any("in the air" in note or "pieces" in note for note in build.notes):
        found.append(f"There are {n} components, of which no remark tells.")
    if len(set(build.notes)) < len(build.notes):
        found.append("A remark stands there twice.")
    return found


def faults_of_bricks(build: Build, catalogue: Catalogue) -> list[str]:
    """Return what is wrong with the bricks alone: cells without or with several of them, colours."""
    return [*_cover(build, cells_of(build, catalogue)), *_colours(build, catalogue)]


def cells_of(build: Build, catalogue: Catalogue) -> list[set[Cell]]:
    """Return the cells (plate, y, x) of every brick of a build."""
    bricks = build.bricks
    rows = zip(bricks.part.tolist(), bricks.turn.tolist(), bricks.corner.tolist(), strict=True)
    return [
        {
            (z + up, y + dy, x + dx)
            for dx, dy, low, high in _columns(catalogue.parts[part], turn)
            for up in range(low, high)
        }
        for part, turn, (x, y, z) in rows
    ]


def _columns(part: Part, turn: int) -> Iterator[tuple[int, int, int, int]]:
    """Return the stud squares of a part, and from which plate to which its cells are."""
    if not part.shaped:
        yield from ((x, y, 0, part.height) for x, y in _squares(part, turn))
        return
    facts = columns(part, turn)
    yield from (
        (x, y, low, high)
        for (x, y), low, high in zip(facts.xy.tolist(), facts.low.tolist(), facts.high.tolist(), strict=True)
    )


def _squares(part: Part, turn: int) -> set[tuple[int, int]]:
    """Return the stud squares of a part, turned counter-clockwise and put back to its lowest corner."""
    squares = {(x, y) for x in range(part.length) for y in range(part.width)} - ({(1, 1)} if part.corner else set())
    for _ in range(turn):
        squares = {(-y, x) for x, y in squares}
    low = min(x for x, _ in squares), min(y for _, y in squares)
    return {(x - low[0], y - low[1]) for x, y in squares}


def _cover(build: Build, parts: list[set[Cell]]) -> Iterator[str]:
    """Compare the cells of the bricks with those that must and may be built."""
    count = Counter(cell for cells in parts for cell in cells)
    twice = sum(n > 1 for n in count.values())
    if twice:
        yield f"{twice} cells are in more than one brick."
    roles = build.bricks.role.tolist()
    # pillars under ceilings are cells that must be built as well; pillars that came later are not
    own = {cell for cells, role in zip(parts, roles, strict=True) if role not in SUPPORTS for cell in cells}
    cover = build.hollow.cover.reshape(-1, *build.hollow.cover.shape[2:])
    required, optional = (
        {tuple(cell) for cell in np.argwhere(cells).tolist()} for cells in (cover == Fill.REQUIRED, cover != Fill.EMPTY)
    )
    if required - set(count):
        yield f"{len(required - set(count))} cells that must be built are empty."
    if own - optional:
        yield f"{len(own - optional)} cells are built that must be empty."


def _colours(build: Build, catalogue: Catalogue) -> Iterator[str]:
    """Find bricks of parts that do not exist in their colour, or in another colour than their cells show."""
    bricks = build.bricks
    codes = [colour.code for colour in catalogue.colours]
    never = sum(
        code not in codes or not catalogue.exists[part, codes.index(code)]
        for part, code in zip(bricks.part.tolist(), bricks.colour.tolist(), strict=True)
    )
    if never:
        yield f"{never} bricks were never made in their colour."
    shown = build.hollow.colour.reshape(-1, *build.hollow.colour.shape[2:])
    lab, parts = lab_from_srgb(catalogue.rgb), cells_of(build, catalogue)
    # small lots take other colours: any where nobody sees them, else close ones
    hidden = _hidden(parts) if build.settings.few_lots else set()

    def shows(code: int, cells: set[Cell]) -> bool:
        """Return whether a colour is that of a cell, or close enough to it."""
        rows = [codes.index(seen) for seen in {int(shown[cell]) for cell in cells} if seen >= 0]
        return (
            not rows
            or code not in codes
            or bool((ciede2000(lab[[codes.index(code)]], lab[rows]) <= build.settings.few_lots).any())
        )

    wrong = sum(
        not cells <= hidden and not shows(code, cells)
        for cells, code, role in zip(parts, bricks.colour.tolist(), bricks.role.tolist(), strict=True)
        if role not in SUPPORTS
    )
    if wrong:
        yield f"{wrong} bricks show a colour that none of their cells has."


def _hidden(parts: list[set[Cell]]) -> set[Cell]:
    """Return the cells of bricks beside which there is no air from outside; the ground is none."""
    cells = np.array([cell for each in parts for cell in each])
    there = np.zeros(cells.max(axis=0) + 3, bool)
    there[tuple((cells + 1).T)] = True
    there[0] = True
    air, _ = ndimage.label(~there)
    seen = there & ndimage.binary_dilation(air == air[-1, 0, 0])
    return set(map(tuple, (np.argwhere(there & ~seen) - 1).tolist()))


def n_components(parts: list[set[Cell]]) -> int:
    """Count what hangs together by studs: a cell of one brick right above a cell of another."""
    owner = {cell: number for number, cells in enumerate(parts) for cell in cells}
    home = list(range(len(parts)))
    for (z, y, x), number in owner.items():
        other = owner.get((z + 1, y, x), number)
        home[_root(home, number)] = _root(home, other)
    return len({_root(home, number) for number in range(len(parts))})


def n_lumps(build: Build) -> int:
    """Count what hangs together by the faces of the cells that must be built."""
    cover = build.hollow.cover.reshape(-1, *build.hollow.cover.shape[2:])
    cells = [tuple(cell) for cell in np.argwhere(cover == Fill.REQUIRED).tolist()]
    number = {cell: row for row, cell in enumerate(cells)}
    home = list(range(len(cells)))
    for (z, y, x), row in number.items():
        for beside in ((z + 1, y, x), (z, y + 1, x), (z, y, x + 1)):
            home[_root(home, row)] = _root(home, number.get(beside, row))
    return len({_root(home, row) for row in range(len(cells))})


def _root(home: list[int], number: int) -> int:
    while home[number] != number:
        home[number] = home[home[number]]
        number = home[number]
    return number


def same(first: Build, second: Build) -> bool:
    """Tell whether two builds are the same, brick by brick and sentence by sentence."""
    tables = all(
        np.array_equal(getattr(first.supports.bricks, name), getattr(second.supports.bricks, name))
        for name in first.bricks.__slots__
    )
    return tables and _timeless(first.notes) == _timeless(second.notes)


def _timeless(notes: tuple[str, ...]) -> list[str]:
    """Return remarks without the seconds that something took."""
    return [re.sub(r"[\d.,]+ s\b", "", note) for note in notes]
