"""What a builder must know about supports and steps, in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np

from ..building import Proof
from ..model import Role
from ..supports import SAVING, SLIM, AssemblyPlan, slim_stacks
from ..units import PLATES_PER_BRICK, count_of
from .places import listed, pillar_places
from .remarks import brick_name, layer_of

SHOWN: Final = 5
"""Steps that a sentence names."""


def remarks_on_building(supports: AssemblyPlan) -> tuple[str, ...]:
    """Say what a builder must know about the supports, and what cannot be built.

    Parameters
    ----------
    supports : AssemblyPlan
        The model with its supports and its order.

    Returns
    -------
    tuple of str
        A sentence each; empty if every brick is held when placed, every support comes out, and nothing has to stay or
        to be held.
    """
    return (*_staying(supports), *_by_hand(supports), *_faults(supports))


def remarks_on_split(supports: AssemblyPlan, *, most: int) -> tuple[str, ...]:
    """Say why a model that might be built in pieces is in one.

    Parameters
    ----------
    supports : AssemblyPlan
        The model with its supports and its order.
    most : int
        Pieces at most that were asked for.

    Returns
    -------
    tuple of str
        One sentence, or none if it has pieces or nobody asked for any.
    """
    if most == 1 or len(supports.pieces) > 1:
        return ()
    hanging = any(len(piece.need.bricks) for piece in supports.pieces)
    cuts = f"no cut that was tried saves {SAVING:.0%} of its supports"
    saving = cuts if hanging else "it needs no supports that a cut could save"
    return (f"The model stays in one piece, although {most} are allowed: {saving}.",)


def remarks_on_proof(proof: Proof | None) -> tuple[str, ...]:
    """Name the building steps that do not stand by forces.

    Parameters
    ----------
    proof : Proof or None
        What was found, None where nobody asked.

    Returns
    -------
    tuple of str
        A sentence for the steps that collapse, one for those in doubt, and one for those that only neighbours hold.
    """
    if proof is None:
        return ()
    sentences = []
    for steps, what in (
        (proof.collapsing, "fall unless they are held"),
        (proof.undecided, "may fall (there is no proof that they stand)"),
        (proof.wedged, "stand only while neighbouring bricks press on each other"),
    ):
        if len(steps):
            after = f"{count_of(len(steps), 'step', 'steps')} ({_named(steps.tolist())})"
            sentences.append(f"The bricks placed so far {what} after {after}.")
    return tuple(sentences)


def _named(steps: Sequence[int]) -> str:
    """Name the first of some steps, and count the others."""
    more = f" and {len(steps) - SHOWN} more" if len(steps) > SHOWN else ""
    return ", ".join(str(step + 1) for step in steps[:SHOWN]) + more


def _staying(supports: AssemblyPlan) -> Iterator[str]:
    """Count the supports that are never taken out, and say where they are."""
    final = supports.final.bricks.role
    for role, where in (
        (Role.SUPPORT_KEPT, "in the model, under parts that would fall without them"),
        (Role.SUPPORT_INSIDE, "inside, under closed ceilings"),
    ):
        if number := int(np.count_nonzero(final == role)):
            places = pillar_places(supports.assembly, supports.bricks.role == role)
            stays = count_of(number, "support brick stays", "support bricks stay")
            yield f"{stays} {where}: {listed(places)}."


def _by_hand(supports: AssemblyPlan) -> Iterator[str]:
    """Count what supports cannot hold on the way."""
    deep = sum(len(piece.need.left) for piece in supports.pieces)
    if deep and any(piece.plan.way != "none" for piece in supports.pieces):
        yield (
            f"{count_of(deep, 'brick hangs', 'bricks hang')} deeper than the limit while building, because supports "
            "there could not be taken out again: press them from below under the bricks above."
        )
    if supports.unsteady:
        towers = count_of(len(supports.unsteady), "tower has", "towers have")
        yield f"{towers} to be held by hand while building, the first in step {supports.unsteady[0].step + 1}."
    if supports.leaning:
        one, steps = len(supports.leaning) == 1, sorted({tower.step for tower in supports.leaning})
        yield (
            f"{count_of(len(supports.leaning), 'sub-assembly', 'sub-assemblies')} would fall over on the table while "
            f"{'it is' if one else 'they are'} built, because the weight is not above the lowest bricks: hold "
            f"{'it' if one else 'them'} in {'step' if len(steps) == 1 else 'steps'} {_named(steps)}."
        )
    slim = slim_stacks(supports.assembly)
    if len(slim.top):
        which = np.isin(np.arange(len(supports.bricks)), slim.top)
        stacks = count_of(len(slim.top), "support column is", "support columns are")
        bricks = SLIM // PLATES_PER_BRICK
        yield (
            f"{stacks} one stud wide and more than {bricks} bricks high, because there is no room for a wider one: "
            f"hold {'it' if len(slim.top) == 1 else 'them'} with the other hand while building, "
            f"{listed(pillar_places(supports.assembly, which))}."
        )


def _faults(supports: AssemblyPlan) -> Iterator[str]:
    """Name what the check of the order found."""
    found = supports.walk
    for rows, what in (
        (found.in_air, "with nothing to hold them when placed: turn supports on"),
        (
            found.squeezed,
            "with no way in between bricks that are in place already: join them first to the bricks above",
        ),
        (found.covered, "under bricks that are in place already: put them in from the side"),
        (found.cramped, "pressed from below with less than three bricks of room: put them in from the side"),
        (found.stuck, "of supports that cannot be pulled out: take them apart by hand"),
    ):
        if len(rows):
            first = int(rows[0])
            yield (
                f"The building order has {count_of(len(rows), 'brick', 'bricks')} {what}; the first is the "
                f"{brick_name(supports.assembly, first)} in layer {layer_of(supports.bricks, first)}."
            )
    if loose := len(found.loose_pieces):
        pieces = count_of(loose, "piece that has", "pieces that have")
        yield (
            f"The building order has {pieces} nothing to hold or no way in when joined: build the model in fewer "
            "pieces."
        )
