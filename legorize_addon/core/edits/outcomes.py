"""Which edits a finished model has, and why not the others: read off its bricks, whoever laid them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model import NOBODY, SUPPORTS, Bricks, Catalogue, ContactGraph, contact_graph
from .edit import LAYS, Cell, Edit
from .rules import Rule, rules_of

CHANGED = "bricks were laid there after it"


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of an edit.

    Attributes
    ----------
    edit : Edit
        As it was made.
    reason : str
        Why the model does not have it, as the end of a sentence; empty if it has.
    """

    edit: Edit
    reason: str = ""

    def sentence(self, catalogue: Catalogue) -> str:
        """Say that it no longer fits, where and why."""
        return f"An edit no longer fits: {self.edit.told(catalogue)}, because {self.reason}."


def outcomes_of(
    bricks: Bricks, catalogue: Catalogue, edits: Sequence[Edit], refused: Mapping[int, str]
) -> tuple[Outcome, ...]:
    """Compare edits with the bricks of a model.

    Parameters
    ----------
    bricks : Bricks
        All that stay in the model, pillars among them.
    catalogue : Catalogue
    edits : sequence of Edit
    refused : mapping of int to str
        Numbers of those that could not be made, and why.

    Returns
    -------
    tuple of Outcome
        One an edit, in their order: whatever is not in the bricks has a reason.
    """
    graph = contact_graph(bricks, catalogue)
    found = []
    for number, rule in enumerate(rules_of(edits, catalogue)):
        reason = refused.get(number, "")
        if rule.by >= 0:
            reason = f"edit {rule.by + 1} was made later in the same place"
        elif not reason:
            reason = _missing(rule, bricks, graph, catalogue)
        found.append(Outcome(edits[number], reason))
    return tuple(found)


def ruled(bricks: Bricks, catalogue: Catalogue, edits: Sequence[Edit]) -> NDArray[np.bool_]:
    """Return which bricks no later stage may exchange: those that edits laid, or where edits forbid a part, (n,)."""
    found = np.zeros(len(bricks), dtype=bool)
    graph = contact_graph(bricks, catalogue) if edits else None
    for rule in rules_of(edits, catalogue):
        if graph is not None and rule.by < 0 and rule.edit.kind in (*LAYS, "forbid"):
            found[_owners(graph, sorted(rule.cells))] = True
    return found


def _missing(rule: Rule, bricks: Bricks, graph: ContactGraph, catalogue: Catalogue) -> str:
    """Return why a model does not have an edit, empty if it has."""
    edit = rule.edit
    if edit.kind in LAYS:
        return "" if len(edit.rows_of(bricks, catalogue)) else CHANGED
    rows = _owners(graph, sorted(rule.cells))
    if edit.kind == "recolour":
        return "" if len(rows) and (bricks.colour[rows] == edit.colour).all() else CHANGED
    if edit.kind == "forbid":
        return "" if (bricks.part[rows] != catalogue.part_row(edit.part)).all() else CHANGED
    if np.isin(bricks.role[rows], SUPPORTS).any():
        return "a pillar had to be put there"
    return CHANGED if len(rows) else ""


def _owners(graph: ContactGraph, cells: Sequence[Cell]) -> NDArray[np.int32]:
    """Return the bricks in some cells, which may lie outside of all."""
    at = np.array(cells, dtype=np.int64).reshape(-1, 3)[:, ::-1] - graph.low[::-1]
    at = at[((at >= 0) & (at < graph.owner.shape)).all(axis=1)]
    owner = graph.owner[tuple(at.T)]
    rows: NDArray[np.int32] = owner[owner != NOBODY]
    return rows
