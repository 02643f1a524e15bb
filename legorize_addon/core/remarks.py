"""What the user should know of how the bricks hold and stand: what cannot, and why, in sentences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from .building.proof import Proof
from .catalogue import Catalogue
from .connection import NOBODY, Rows
from .model import Bricks, Ints, Role
from .stability import Stability, Verdict
from .supports import Supports
from .units import PLATES_PER_BRICK

SHOWN: Final = 5
"""Steps that a sentence names."""


def remarks(bricks: Bricks, found: Stability, catalogue: Catalogue) -> tuple[str, ...]:
    """Name what does not hold or stand, with the reason.

    Parameters
    ----------
    bricks : Bricks
        The model.
    found : Stability
        Whether they stand.
    catalogue : Catalogue
        Whose parts and colours the bricks are.

    Returns
    -------
    tuple of str
        A sentence each: bricks in the air, pieces that stand apart, what tips
        over, what tears, what is not decided. Empty if the model stands in one
        piece.
    """
    sentences = [*_hanging(bricks, found), *_apart(found)]
    if found.standing is Verdict.COLLAPSES:
        sentences += _reasons(bricks, found, catalogue)
    if found.standing is Verdict.UNDECIDED:
        sentences.append(_undecided(bricks, found, catalogue))
    return tuple(sentences)


def remarks_on_building(supports: Supports, catalogue: Catalogue) -> tuple[str, ...]:
    """Name what a builder has to know of the supports, and what cannot be built.

    Parameters
    ----------
    supports : Supports
        The model with its supports and its order.
    catalogue : Catalogue
        Whose parts and colours the bricks are.

    Returns
    -------
    tuple of str
        A sentence each; empty if every brick finds hold, every support comes
        out, and nothing has to stay or to be held.
    """
    sentences = []
    posts = sum(len(piece.posts) for piece in supports.pieces)
    outside = int(np.count_nonzero(supports.stays.role == Role.SUPPORT_KEPT))
    if outside:
        carried = _count(outside, "support brick stays", "support bricks stay")
        sentences.append(f"{carried} in the model, under parts of it that touch nothing else.")
    if posts:
        sentences.append(
            f"{_count(posts, 'support brick stays', 'support bricks stay')} inside, under closed ceilings."
        )
    if len(supports.unsteady):
        towers = _count(len(supports.unsteady), "tower has", "towers have")
        step = supports.unsteady[0].step + 1
        sentences.append(f"{towers} to be held by hand while it grows, the first in step {step}.")
    found = supports.walk
    for rows, what in (
        (found.in_air, "hang in the air when they are placed: let supports stand under them"),
        (found.squeezed, "have to be squeezed in between others: place them together with those above"),
        (found.stuck, "are supports that cannot be pulled out: take them apart by hand"),
    ):
        if len(rows):
            first = int(rows[0])
            sentences.append(
                f"{_count(len(rows), 'brick', 'bricks')} {what}; the first is the "
                f"{brick_name(supports.bricks, first, catalogue)} in layer {layer_of(supports.bricks, first)}."
            )
    return tuple(sentences)


def remarks_on_proof(proof: Proof | None) -> tuple[str, ...]:
    """Name the building steps that do not stand by forces.

    Parameters
    ----------
    proof : Proof or None
        What was found, None where nobody asked.

    Returns
    -------
    tuple of str
        A sentence for the steps that collapse, and one for those in doubt.
    """
    if proof is None:
        return ()
    sentences = []
    for steps, what in (
        (proof.collapsing, "fall unless they are held"),
        (proof.undecided, "may fall: no proof was found"),
    ):
        if len(steps):
            which = ", ".join(str(step + 1) for step in steps[:SHOWN].tolist())
            more = f" and {len(steps) - SHOWN} more" if len(steps) > SHOWN else ""
            sentences.append(f"Bricks in place after {_count(len(steps), 'step', 'steps')} ({which}{more}) {what}.")
    return tuple(sentences)


def brick_name(bricks: Bricks, row: int, catalogue: Catalogue) -> str:
    """Return what people see of a brick: colour and part.

    Parameters
    ----------
    bricks : Bricks
        The model.
    row : int
        The brick.
    catalogue : Catalogue
        Whose parts and colours the bricks are.

    Returns
    -------
    str
        As "Red Brick 2 x 4".
    """
    colour = catalogue.colours[catalogue.colour_row(int(bricks.colour[row]))]
    return f"{colour.name} {catalogue.parts[bricks.part[row]].title}"


def layer_of(bricks: Bricks, row: int) -> int:
    """Return the layer of a brick, counted from 1."""
    return int(bricks.corner[row, 2]) // PLATES_PER_BRICK + 1


def _reasons(bricks: Bricks, found: Stability, catalogue: Catalogue) -> list[str]:
    """Return why what stands on the ground collapses: a sentence a body that tips over, and one on joints."""
    sentences = list(_tipping(bricks, found, catalogue))
    if len(found.torn):
        sentences.append(_torn(bricks, found.torn, catalogue))
    return sentences or ["The model collapses under its own weight: make it thicker where the heat map is red."]


def _hanging(bricks: Bricks, found: Stability) -> Iterator[str]:
    """Count what touches nothing on the ground."""
    rows = found.unsupported
    if len(rows) == 0:
        return
    bodies = len(np.unique(found.component[rows]))
    low, high = (layer_of(bricks, int(row)) for row in rows[_ends(bricks.corner[rows, 2])])
    where = f"layer {low}" if low == high else f"layers {low} to {high}"
    hang, among = _count(len(rows), "brick hangs", "bricks hang"), _count(bodies, "body", "bodies")
    yield (
        f"{hang} in the air in {among} ({where}): no stud joins them to what stands on the ground; let these parts of "
        "the mesh touch the others."
    )


def _apart(found: Stability) -> Iterator[str]:
    """Count the pieces that stand beside each other."""
    pieces = np.unique(found.component[found.statics.rows], return_counts=True)[1]
    if len(pieces) > 1:
        yield (
            f"The model stands in {len(pieces)} pieces that no brick joins, the smallest of "
            f"{_count(int(pieces.min()), 'brick', 'bricks')}: let their meshes touch if it should be one."
        )


def _tipping(bricks: Bricks, found: Stability, catalogue: Catalogue) -> Iterator[str]:
    """Name each body whose weight meets the ground outside of its feet."""
    several = np.count_nonzero(~np.isnan(found.tipping)) > 1
    for body in np.flatnonzero(found.tipping < 0):
        rows = np.flatnonzero(found.component == body)
        feet = rows[bricks.corner[rows, 2] == bricks.corner[rows, 2].min()]
        what = f"The piece of {_count(len(rows), 'brick', 'bricks')}" if several else "The model"
        on = f"{len(feet)} bricks" if len(feet) > 1 else f"one {brick_name(bricks, int(feet[0]), catalogue)}"
        yield (
            f"{what} tips over: it stands on {on}, and its centre of mass lies {-found.tipping[body]:.1f} mm outside "
            "of these feet; make them wider, turn the mesh, or put it on a base."
        )


def _torn(bricks: Bricks, torn: Ints, catalogue: Catalogue) -> str:
    """Name the joint that opens widest, and count the others."""
    lower, upper = (int(row) for row in torn[0])
    below = "the ground" if lower == NOBODY else f"the {brick_name(bricks, lower, catalogue)} below it"
    others = f", the first of {len(torn)} joints" if len(torn) > 1 else ""
    return (
        f"The model collapses under its own weight: in layer {layer_of(bricks, upper)} the "
        f"{brick_name(bricks, upper, catalogue)} tears off {below}{others}; make the model thicker there, or lighter "
        "above."
    )


def _undecided(bricks: Bricks, found: Stability, catalogue: Catalogue) -> str:
    """Name the brick in doubt."""
    weakest = int(found.statics.rows[found.margin[found.statics.rows].argmin()])
    return (
        "Whether the model stands could not be decided: there is no proof that it does, and none that it collapses; in "
        f"doubt is first the {brick_name(bricks, weakest, catalogue)} in layer {layer_of(bricks, weakest)}; try the "
        "exact layout, or make the model thicker there."
    )


def _ends(levels: Rows) -> list[int]:
    return [int(levels.argmin()), int(levels.argmax())]


def _count(n: int, one: str, more: str) -> str:
    return f"{n} {one if n == 1 else more}"
