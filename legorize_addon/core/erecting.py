"""The stages from cells on, in order: to a model that stands, with its supports and the order in which it is built."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .build import Draft
from .by_hand import ByHand, edit_bricks
from .edits import Edits
from .half_stages import given_bricks, lie_apart
from .half_studs import HalfStudsError
from .model import Assembly, UnitGrid
from .painting import NotMadeError, cells_to_lay, paint_bricks, paint_cells, paint_draft, paint_plan
from .run import Run
from .slope_stages import lay_with_slopes, tries_of, without_weak_slopes
from .slopes import Slopes
from .stages import cut_pieces, plan_pieces
from .statics import Stability
from .strength import (
    brace,
    carry,
    check_final,
    check_strong,
    show_colours,
    strengthen_joints,
    take_fewer_lots,
    tie_parts,
)
from .supports import AssemblyPlan, Joint, LooseError
from .tile_stages import smooth_surface
from .units import PLATES_PER_BRICK


@dataclass(frozen=True, slots=True, eq=False)
class Erected:
    """A model that stands.

    Attributes
    ----------
    made : Draft
        What was known before its bricks were laid, in its colours, the cells of jumpers included.
    shell : UnitGrid
        The cells that the bricks cover.
    by_hand : ByHand
        Edits, and what became of them.
    plan : AssemblyPlan
    joints : tuple of Joint
        Between the pieces.
    found : Stability
        Whether it stands.
    remarks : tuple of str
        On lots and tiles.
    """

    made: Draft
    shell: UnitGrid
    by_hand: ByHand
    plan: AssemblyPlan
    joints: tuple[Joint, ...]
    found: Stability
    remarks: tuple[str, ...]


def erect(run: Run, made: Draft, edits: Edits) -> Erected:
    """Lay the bricks of a draft in the colours that were found and paint them, or lay them in those that are wanted."""
    with run.stage("colours"):
        cells, last = run.once(cells_to_lay, made.hollow)
        made = replace(made, hollow=cells)
    if last:
        numbers = run.answer("rng")
        try:
            return _erected(run, made, edits, last=True)
        except NotMadeError:
            # another layout may do without the parts that do not exist in the new colours: as if none had been tried
            run.ties.clear()
            run.rng.bit_generator.state = numbers
    return _erected(run, run.once(paint_draft, made), edits)


def _erected(run: Run, made: Draft, edits: Edits, *, last: bool = False) -> Erected:
    """Go through the stages; paint what was laid in other colours, unless there are edits, before them."""
    made, given = given_bricks(run, made)
    try:
        assembly, shell, found, by_hand = put_up(run, made.hollow, edits, made.scale, given, last=last)
    except LooseError as error:
        if made.halves is None:
            raise
        # where no jumper fits there are tiles
        raise HalfStudsError(made.halves.near(error.levels.astype(np.int64) // PLATES_PER_BRICK)) from error
    with run.stage("pieces"):
        assembly, found, exchanged = run.once(take_fewer_lots, assembly, found)
        assembly, found, smoothed = run.once(smooth_surface, assembly, found, by_hand.made)
        pieces = run.once(cut_pieces, assembly)
    with run.stage("supports"):
        plan, joints = plan_pieces(run, assembly, *pieces, made.halves.half if made.halves is not None else None)
    if made.halves is not None or len(plan.final) > len(assembly):
        with run.stage("stability again"):
            found = run.once(check_final, plan.final, found)
            if made.halves is not None:
                plan, found = run.once(lie_apart, plan, made.halves, found)
    if last:
        with run.stage("colours"):
            made = run.once(paint_draft, made)
            if not edits.edits:
                plan, shell = run.once(paint_plan, plan), run.once(paint_cells, shell)
                by_hand = replace(by_hand, before=run.once(paint_bricks, by_hand.before))
    return Erected(made, shell, by_hand, plan, joints, found, (*exchanged, *smoothed))


def put_up(
    run: Run, shell: UnitGrid, edits: Edits, scale: float, slopes: Slopes | None = None, *, last: bool = False
) -> tuple[Assembly, UnitGrid, Stability, ByHand]:
    """Lay the bricks of cells around slopes, edit them, and let them hold and stand.

    Parameters
    ----------
    run : Run
    shell : UnitGrid
    edits : Edits
    scale : float
        Model mm per world mm.
    slopes : Slopes, optional
    last : bool, optional
        Whether the bricks are painted once they stand; before edits, if there are any.

    Returns
    -------
    tuple
        The model, the cells that its bricks cover, whether it stands, and the edits.

    Raises
    ------
    NotMadeError
        A brick that is to be painted does not exist in its new colour.
    """
    whole = shell
    with run.stage("layout"):
        bricks, shell = run.once(lay_with_slopes, whole, slopes)
        if last:
            # what cannot be painted does not have to hold
            run.once(paint_bricks, bricks)
    with run.stage("ties"):
        before = len(bricks)
        bricks, shell = run.once(tie_parts, bricks, shell)
        run.ties.append(len(bricks) - before)
    with run.stage("strengthening"):
        strong = run.once(strengthen_joints, bricks, shell, most=tries_of(slopes))
        bricks, shell, sparing = run.once(without_weak_slopes, whole, slopes, bricks, strong)
        bricks = run.once(show_colours, bricks, shell)
    by_hand = ByHand(edits, {}, bricks)
    if edits.edits:
        with run.stage("edits"):
            if last:
                bricks, shell = run.once(paint_bricks, bricks), run.once(paint_cells, shell)
            # whether it returns the same object says whether there was anything to edit: no work for a memo
            laid, (bricks, shell, by_hand) = bricks, edit_bricks(run, edits, scale, bricks, shell)
            sparing = sparing if bricks is laid else None
    with run.stage("stability"):
        assembly = run.once(carry, Assembly(bricks, run.catalogue))
        found = run.once(check_strong, assembly, sparing)
    with run.stage("bracing"):
        assembly, found = run.once(brace, assembly, found, sparing)
    return assembly, shell, found, by_hand
