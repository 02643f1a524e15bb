"""Which edit rules where several are about the same cells: the later one."""

from __future__ import annotations

from collections.abc import Sequence, Set
from dataclasses import dataclass, replace

from ..model import Catalogue
from .edit import LAYS, Cell, Edit


@dataclass(frozen=True, slots=True)
class Rule:
    """What an edit still says beside those that came after it.

    Attributes
    ----------
    edit : Edit
        A brick that was laid and recoloured afterwards is laid in the new colour.
    cells : set of (int, int, int)
        Those of its cells that no later edit rules.
    by : int
        Row of the later edit that took its place, -1 where none did.
    """

    edit: Edit
    cells: Set[Cell]
    by: int = -1


def rules_of(edits: Sequence[Edit], catalogue: Catalogue) -> list[Rule]:
    """Return what each edit still says, given all of them in the order in which they were made."""
    cells = [edit.cells(catalogue) for edit in edits]
    return [_rule(row, edits, cells, catalogue) for row in range(len(edits))]


def _rule(row: int, edits: Sequence[Edit], cells: Sequence[Set[Cell]], catalogue: Catalogue) -> Rule:
    rule = Rule(edits[row], cells[row])
    for later in range(row + 1, len(edits)):
        if rule.by < 0 and not cells[row].isdisjoint(cells[later]):
            rule = _after(rule, edits[later], cells[later], later, catalogue)
    return rule


def _after(rule: Rule, later: Edit, there: Set[Cell], row: int, catalogue: Catalogue) -> Rule:
    """Return what an edit still says after one that touches its cells."""
    edit = rule.edit
    same_part = edit.part_of(catalogue) == later.part_of(catalogue)
    if edit.kind == "forbid":
        return replace(rule, by=row) if later.kind in LAYS and same_part else rule
    if later.kind == "forbid":
        return replace(rule, by=row) if edit.kind in LAYS and same_part else rule
    if edit.kind in LAYS:
        return _recoloured(rule, later, there, row, catalogue)
    if edit.kind == "delete" and later.kind == "recolour":
        return rule
    left = rule.cells - there
    return replace(rule, cells=left, by=-1 if left else row)


def _recoloured(rule: Rule, later: Edit, there: Set[Cell], row: int, catalogue: Catalogue) -> Rule:
    """Return what becomes of a brick that was laid: another colour, if all of it gets one that it is made in."""
    whole = later.kind == "recolour" and rule.cells <= there
    made = catalogue.exists_in(catalogue.part_row(rule.edit.part), later.colour)
    if whole and bool(made):
        return replace(rule, edit=replace(rule.edit, colour=later.colour))
    return replace(rule, by=row)
