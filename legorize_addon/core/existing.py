"""Brick models that exist already, from a file or the scene: what the stages need to judge them, or lay them again."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Final, Literal, Self

import numpy as np

from .layout import as_good, cells_of, lay_again
from .ldraw import LdrawModel
from .model import Assembly, Bricks, Catalogue, Role, column_facts, contact_graph, stud_columns
from .run import Run
from .stages import lay_freely
from .strength import strengthen_joints
from .supports import AssemblyPlan, plan_as_given, plan_assembly

StepsFrom = Literal["file", "new"]
"""Whether the steps of the model's author are kept, or planned."""

SHOWN: Final = 0.1
"""Model mm per world mm: in the scene a stud is 8 cm wide, because Blender's view shows nothing nearer than 1 cm."""

EXPECTED: Final = {"layout": 3.0, "strengthening": 1.0, "stability": 1.0, "supports": 2.0}
"""Shares of the time that stages take; without a mesh nothing better is known before."""


@dataclass(frozen=True, slots=True, eq=False)
class Existing:
    """Bricks that somebody laid.

    Attributes
    ----------
    bricks : Bricks
        Supports that are taken out again have the role for it.
    has_steps : bool
        Whether their steps are an author's.
    notes : tuple of str
        What was left out of them or changed, a sentence each.
    left_out : mapping of str to int
        Numbers of parts that the catalogue does not have, and how many of each there were.
    """

    bricks: Bricks
    has_steps: bool = False
    notes: tuple[str, ...] = ()
    left_out: Mapping[str, int] = field(default_factory=dict)

    @classmethod
    def of(cls, found: LdrawModel) -> Self:
        """Return what a file has."""
        return cls(found.bricks, found.has_steps, found.remarks, found.left_out)


def moved_up(bricks: Bricks) -> Bricks:
    """Return bricks of which none lies at negative coordinates: all moved by as much as that takes."""
    low = np.minimum(bricks.corner.min(axis=0), 0)
    return replace(bricks, corner=bricks.corner - low) if low.any() else bricks


def without_overlaps(bricks: Bricks, catalogue: Catalogue) -> tuple[Bricks, tuple[str, ...]]:
    """Return bricks of which no two fill a cell, the first ones first, and a sentence on those left out.

    Supports that are taken out again may lie where other pieces are put later;
    they stay.
    """
    lasting = np.flatnonzero(bricks.role != Role.SUPPORT_OUTSIDE)
    model = bricks.take(lasting)
    if not contact_graph(model, catalogue).collisions:
        return bricks, ()
    taken: set[tuple[int, int, int]] = set()
    dropped = []
    for row, cells in zip(lasting.tolist(), _cells(model, catalogue), strict=True):
        if taken.isdisjoint(cells):
            taken.update(cells)
        else:
            dropped.append(row)
    if not dropped:
        # studs alone that stand in what lies half a stud off: no contact counts there
        return bricks, ()
    kept = np.setdiff1d(np.arange(len(bricks)), dropped)
    what = "1 brick lies" if len(dropped) == 1 else f"{len(dropped)} bricks lie"
    return bricks.take(kept), (f"{what} in others, left out.",)


def _cells(bricks: Bricks, catalogue: Catalogue) -> Sequence[list[tuple[int, int, int]]]:
    """Return the cells of each brick; quarters of them, as something may lie half a stud further on."""
    brick, columns = stud_columns(bricks, catalogue)
    facts = column_facts(bricks, catalogue)
    height = (facts.high - facts.low).tolist()
    found: list[list[tuple[int, int, int]]] = [[] for _ in range(len(bricks))]
    places = (2 * (columns + bricks.shift[brick])).astype(np.int64)
    for row, (x, y, _), z, high in zip(brick.tolist(), places.tolist(), columns[:, 2].tolist(), height, strict=True):
        found[row] += [(x + u, y + v, z + level) for level in range(high) for u in (0, 1) for v in (0, 1)]
    return found


def laid_again(run: Run, given: Bricks) -> tuple[Bricks, tuple[str, ...]]:
    """Return the model without supports that are taken out, in better bricks if they were found, and what to tell.

    Better is what the settings ask for: fewer bricks, cheaper ones, or lighter ones.
    """
    if given.halved:
        return given, ("Bricks half a stud off each other cannot be laid again: the model stays as it is.",)
    given = given.take(given.role != Role.SUPPORT_OUTSIDE)
    given = replace(given, piece=np.zeros_like(given.piece))
    with run.stage("layout"):
        laid = lay_again(given, run.catalogue, partial(lay_freely, run), run.parts.burden)
    if laid is given:
        return given, (f"No better layout than that of {run.parts.told(given)} was found: the model stays as it is.",)
    with run.stage("strengthening"):
        laid = _strengthened(run, laid, given)
    return laid, (f"Laid again in {run.parts.told(laid)} instead of {run.parts.told(given)}.",)


def _strengthened(run: Run, laid: Bricks, given: Bricks) -> Bricks:
    """Return a layout with ties where it is weak, as far as that shows nowhere and it stays better than before."""
    tied, _, _ = strengthen_joints(run, laid, cells_of(laid, run.catalogue))
    better = run.parts.burden(tied) < run.parts.burden(given)
    return tied if better and as_good(tied, given, run.catalogue) else laid


def plan_existing(run: Run, assembly: Assembly, *, own_steps: bool, planned: bool) -> AssemblyPlan:
    """Return how a model is built: as it says itself, or by supports and an order of our own."""
    settings, bricks = run.settings, assembly.bricks
    outside = bricks.role == Role.SUPPORT_OUTSIDE
    as_given = partial(plan_as_given, assembly, deepest=settings.hanging, clutch=settings.clutch, progress=run.progress)
    if outside.any() and (bricks.halved or not planned):
        # our own: its steps follow from its bricks
        return as_given(own_steps=False)
    if own_steps and not bricks.piece.any():
        return as_given(own_steps=True)
    # supports are planned on one grid of studs alone
    wish = "none" if bricks.halved else settings.supports
    return plan_assembly(
        assembly.take(~outside), wish=wish, deepest=settings.hanging, clutch=settings.clutch, progress=run.progress
    )


def remarks_on_plan(bricks: Bricks, final: Bricks, *, own_steps: bool) -> tuple[str, ...]:
    """Say what a plan has that nobody asked for, or lacks."""
    lasting, told = np.count_nonzero(bricks.role != Role.SUPPORT_OUTSIDE), []
    if bricks.halved and not own_steps and lasting == len(bricks):
        told.append("No supports are planned for bricks half a stud off each other.")
    if len(final) > lasting:
        told.append("Pillars that stay were added, without which the model cannot be built.")
    return tuple(told)
