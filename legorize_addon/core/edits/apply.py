"""Making edits in a layout, one after the other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Final

import numpy as np

from ..arrays import Ints
from ..layout import smooth_tops
from ..layout.problem import Bar
from ..model import SUPPORTS, Bricks, Catalogue, column_facts, footprint, stud_columns
from .edit import LAYS, Cell, Edit
from .outcomes import ruled
from .rules import Rule, rules_of
from .workpiece import Workpiece

NOT_OURS: Final = "a support lies there, which is planned anew with the model"
NO_BRICK: Final = "the model has no brick there any more"
OUTSIDE: Final = "it would stand out of the grid of the model"
ALOFT: Final = "nothing would hold it there"
TAKEN: Final = "what another edit laid is in its way"
NARROW: Final = "only a part of one stud fits there: what is beside it is empty, has another colour, or must stay"


def apply_edits(
    bricks: Bricks, catalogue: Catalogue, edits: Sequence[Edit], *, shape: tuple[int, ...] | None = None
) -> tuple[Bricks, Mapping[int, str]]:
    """Make edits in a layout.

    Parameters
    ----------
    bricks : Bricks
        Without collisions, none at negative coordinates.
    catalogue : Catalogue
        Parts that may be laid.
    edits : sequence of Edit
        In the order in which they were made: where two are about the same cells, the later one rules.
    shape : (int, int, int), optional
        Plates, rows and columns of the grid; that of the bricks if it is left out.

    Returns
    -------
    bricks : Bricks
        The same object if nothing had to change. In no more components than before, and no more bricks float.
    refused : mapping of int to str
        Numbers of the edits that cannot be made, and why, as the end of a sentence.
    """
    work = Workpiece(bricks, catalogue, shape)
    refused = {}
    for number, rule in enumerate(rules_of(edits, catalogue)):
        reason = "" if rule.by >= 0 else _made(work, rule)
        if reason:
            refused[number] = reason
    return (bricks if work.bricks is bricks else _tiled_again(work.bricks, bricks, catalogue, edits)), refused


def _tiled_again(bricks: Bricks, before: Bricks, catalogue: Catalogue, edits: Sequence[Edit]) -> Bricks:
    """Lay tiles where some lay before, as far as nothing needs the studs that windows have brought."""
    brick, columns = stud_columns(before, catalogue)
    tile = np.array([part.profile == "tile" for part in catalogue.parts])
    there = set(map(tuple, columns[tile[before.part[brick]]].tolist()))
    if not there:
        return bricks
    brick, columns = stud_columns(bricks, catalogue)
    columns[:, 2] += column_facts(bricks, catalogue).high - 1 - column_facts(bricks, catalogue).low
    may = np.zeros(len(bricks), dtype=bool)
    may[brick[[tuple(each) in there for each in columns.tolist()]]] = True
    return smooth_tops(bricks, catalogue, price=0.0, may=may & ~ruled(bricks, catalogue, edits)).bricks


def _made(work: Workpiece, rule: Rule) -> str:
    """Make an edit; return why not, and change nothing then."""
    cells = work.inside(rule.cells)
    if rule.edit.kind in LAYS:
        return _lay(work, rule.edit, cells, missing=len(rule.cells) - len(cells))
    filled = work.filled(cells)
    if not filled and rule.edit.kind == "recolour":
        return NO_BRICK
    rows = work.rows_in(filled)
    if np.isin(work.bricks.role[rows], SUPPORTS).any():
        return NOT_OURS
    make = {"recolour": _recolour, "delete": _delete, "forbid": _forbid}[rule.edit.kind]
    return make(work, rule.edit, cells if rule.edit.kind == "forbid" else filled, rows)


def _recolour(work: Workpiece, edit: Edit, filled: Sequence[Cell], rows: Ints) -> str:
    """Let cells have a colour: their bricks, where these lie in no others and are made in it, else smaller ones."""
    wrong = rows[work.bricks.colour[rows] != edit.colour]
    made = work.catalogue.exists_in(work.bricks.part[wrong], edit.colour)
    cut = wrong[~(made & work.lie_in(wrong, filled))]
    if not work.may_change(cut):
        return TAKEN
    before = work.settle(filled, edit.colour)
    reason = work.relay(cut) if len(cut) else ""
    if reason:
        work.settle(filled, before)
        return reason
    work.paint(work.rows_in(filled), edit.colour)
    return ""


def _delete(work: Workpiece, edit: Edit, filled: Sequence[Cell], rows: Ints) -> str:
    """Leave cells empty."""
    cut = rows[~work.lie_in(rows, filled)]
    if not work.may_change(cut):
        return TAKEN
    return work.relay(rows, emptied=filled) if len(rows) else ""


def _lay(work: Workpiece, edit: Edit, cells: Sequence[Cell], missing: int) -> str:
    """Lay a brick, or let the one that lies there stay."""
    part = work.catalogue.part_row(edit.part)
    if missing:
        return OUTSIDE
    filled = work.filled(cells)
    if edit.kind == "lock" and len(filled) < len(cells):
        return NO_BRICK
    if not work.catalogue.exists_in(part, edit.colour):
        return f"{work.catalogue.parts[part].title} is not to be had in its colour"
    there, rows = edit.rows_of(work.bricks, work.catalogue), work.rows_in(filled)
    if np.isin(work.bricks.role[rows], SUPPORTS).any():
        return NOT_OURS
    if len(there):
        work.fix(int(there[0]))
        return ""
    if not work.may_change(rows):
        return TAKEN
    reason = work.relay(rows, put=edit)
    return ALOFT if reason and not len(rows) else reason


def _widened(work: Workpiece, edit: Edit, gone: Ints, bar: Bar) -> str:
    """Lay a part of two studs where a part of one has to go, and others around it; return why not."""
    reason = NARROW
    for put in _wider(work, edit):
        rows = np.union1d(gone, work.rows_in(sorted(put.cells(work.catalogue))))
        if not work.may_change(np.setdiff1d(rows, gone)):
            continue
        reason = work.relay(rows, put=put, bars=[bar])
        if not reason:
            # another edit may take it away again
            work.fix(int(put.rows_of(work.bricks, work.catalogue)[0]), fixed=False)
            return ""
    return reason


def _wider(work: Workpiece, edit: Edit) -> Iterator[Edit]:
    """Yield the bricks of two studs that can lie on the stud of another one in the colours that are seen there."""
    catalogue, own = work.catalogue, edit.part_of(work.catalogue)
    for part in catalogue.parts:
        squares = len(footprint(part, 0))
        if part.use != "model" or (squares, part.height) != (2, own.height):
            continue
        for turn, second in product(range(2), range(2)):
            dx, dy = footprint(part, turn)[second].tolist()
            x, y, z = edit.cell
            put = Edit("force", part.number, turn, (x - dx, y - dy, z), edit.colour)
            cells = work.inside(put.cells(catalogue))
            if len(work.filled(cells)) < 2 * part.height:
                continue
            colours = work.shown(cells) or {edit.colour}
            if len(colours) == 1 and catalogue.exists_in(catalogue.part_row(part.number), *colours):
                yield replace(put, colour=min(colours))


def _forbid(work: Workpiece, edit: Edit, cells: Sequence[Cell], rows: Ints) -> str:
    """Lay others in the place of a part, and keep it away."""
    part = work.catalogue.part_row(edit.part)
    bar, gone = work.bar(part, cells), rows[work.bricks.part[rows] == part]
    if not work.may_go(gone):
        return TAKEN
    reason = work.relay(gone, bars=[bar]) if len(gone) else ""
    if reason and len(footprint(edit.part_of(work.catalogue), 0)) == 1:
        # a window is laid in bricks where bricks fit: a single plate among them finds no other plate to join
        reason = _widened(work, edit, gone, bar)
    if not reason:
        work.keep(bar)
    return reason
