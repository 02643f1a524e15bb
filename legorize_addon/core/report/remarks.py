"""What the user should know about connection and stability: what fails, and why, in sentences."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from ..arrays import Ints
from ..model import NOBODY, Assembly, Bricks, Verdict
from ..units import PLATES_PER_BRICK, count_of
from .separation import reasons

if TYPE_CHECKING:
    from ..model import Rows
    from ..statics import Stability


def remarks(assembly: Assembly, found: Stability, *, spare: float = 0.0) -> tuple[str, ...]:
    """Name what does not hold or stand, with the reason.

    Parameters
    ----------
    assembly : Assembly
        The model.
    found : Stability
        Whether they stand.

    spare : float
        Share of its friction that no brick shall need.

    Returns
    -------
    tuple of str
        A sentence each: bricks in the air, pieces that stand apart, what tips
        over, what tears, what only neighbours hold, what has too little to
        spare, what is not decided. Empty if the model stands in one piece by its
        studs alone, with so much to spare.
    """
    why = _why(assembly) if len(np.unique(found.component)) > 1 else ""
    sentences = [*_hanging(assembly.bricks, found, why), *_apart(found, why)]
    if found.standing is Verdict.COLLAPSES:
        sentences += _reasons(assembly, found)
    if found.standing is Verdict.WEDGED:
        sentences.append(_wedged(assembly, found))
    if found.standing is Verdict.STABLE and len(assembly) and found.margin[found.statics.rows].min() < spare:
        sentences.append(_too_little(assembly, found, spare))
    if found.standing is Verdict.UNDECIDED:
        sentences.append(_undecided(assembly, found))
    return tuple(sentences)


def brick_name(assembly: Assembly, row: int) -> str:
    """Return what people see of a brick: colour and part.

    Parameters
    ----------
    assembly : Assembly
        The model.
    row : int
        The brick.

    Returns
    -------
    str
        As "Red Brick 2 x 4".
    """
    colour = assembly.catalogue.colours[assembly.catalogue.colour_row(int(assembly.bricks.colour[row]))]
    return f"{colour.name} {assembly.catalogue.parts[assembly.bricks.part[row]].title}"


def layer_of(bricks: Bricks, row: int) -> int:
    """Return the layer of a brick, counted from 1."""
    return int(bricks.corner[row, 2]) // PLATES_PER_BRICK + 1


def _reasons(assembly: Assembly, found: Stability) -> list[str]:
    """Return why what stands on the ground collapses: a sentence a body that tips over, and one on joints."""
    sentences = list(_tipping(assembly, found))
    if len(found.torn):
        sentences.append(_torn(assembly, found.torn))
    return sentences or ["The model collapses under its own weight: make it thicker where the heat map is red."]


def _why(assembly: Assembly) -> str:
    """Return why the components are not one."""
    # slow to import, and the names above are used without it
    from ..model import contact_graph

    links = contact_graph(assembly.bricks, assembly.catalogue)
    return reasons(links.owner, links.component)


def _hanging(bricks: Bricks, found: Stability, why: str) -> Iterator[str]:
    """Count what touches nothing on the ground."""
    rows = found.unsupported
    if len(rows) == 0:
        return
    bodies = len(np.unique(found.component[rows]))
    low, high = (layer_of(bricks, int(row)) for row in rows[_ends(bricks.corner[rows, 2])])
    where = f"layer {low}" if low == high else f"layers {low} to {high}"
    hang, among = count_of(len(rows), "brick hangs", "bricks hang"), count_of(bodies, "body", "bodies")
    yield f"{hang} in the air in {among} ({where}): no stud joins them to what stands on the ground; {why}."


def _apart(found: Stability, why: str) -> Iterator[str]:
    """Count the pieces that stand beside each other."""
    pieces = np.unique(found.component[found.statics.rows], return_counts=True)[1]
    if len(pieces) > 1:
        yield (
            f"The model stands in {len(pieces)} pieces that are not joined, the smallest of "
            f"{count_of(int(pieces.min()), 'brick', 'bricks')}: {why}."
        )


def _tipping(assembly: Assembly, found: Stability) -> Iterator[str]:
    """Name each body whose weight meets the ground outside of its feet."""
    several = np.count_nonzero(~np.isnan(found.tipping)) > 1
    for body in np.flatnonzero(found.tipping < 0):
        rows = np.flatnonzero(found.component == body)
        feet = rows[assembly.bricks.corner[rows, 2] == assembly.bricks.corner[rows, 2].min()]
        what = f"The piece of {count_of(len(rows), 'brick', 'bricks')}" if several else "The model"
        on = f"{len(feet)} bricks" if len(feet) > 1 else f"one {brick_name(assembly, int(feet[0]))}"
        yield (
            f"{what} tips over: it stands on {on}, and its centre of mass lies {-found.tipping[body]:.1f} mm outside "
            "of these feet; make them wider, turn the mesh, or put it on a base."
        )


def _torn(assembly: Assembly, torn: Ints) -> str:
    """Name the joint that opens widest, and count the others."""
    return (
        f"The model collapses under its own weight: {_tearing(assembly, torn)}; make the model thicker there, or "
        "lighter above."
    )


def _tearing(assembly: Assembly, torn: Ints) -> str:
    """Return which brick tears off which, and how many more do."""
    lower, upper = (int(row) for row in torn[0])
    below = "the ground" if lower == NOBODY else f"the {brick_name(assembly, lower)} below it"
    others = f", the first of {len(torn)} joints" if len(torn) > 1 else ""
    return f"in layer {layer_of(assembly.bricks, upper)} the {brick_name(assembly, upper)} tears off {below}{others}"


def _wedged(assembly: Assembly, found: Stability) -> str:
    """Say that studs alone do not hold the model, and where."""
    if len(found.torn):
        where = f"its studs alone do not hold it, {_tearing(assembly, found.torn)}"
    else:
        moving = int(np.abs(found.yielding).max(axis=1).argmax())
        where = (
            "there is no proof that its studs alone hold it; in doubt is first the "
            f"{brick_name(assembly, moving)} in layer {layer_of(assembly.bricks, moving)}"
        )
    return (
        f"The model stands only while bricks side by side press on each other: {where}; press its bricks close "
        "together, or make the model thicker there."
    )


def _too_little(assembly: Assembly, found: Stability, spare: float) -> str:
    """Name the brick that has the least to spare."""
    weakest = int(found.statics.rows[found.margin[found.statics.rows].argmin()])
    name, layer = brick_name(assembly, weakest), layer_of(assembly.bricks, weakest)
    return (
        f"The model stands, but with less than {100 * spare:.0f} % of its friction to spare: "
        f"the {name} in layer {layer} is known to have {100 * found.margin[weakest]:.0f} % left; "
        "make the model thicker there, or handle it with care."
    )


def _undecided(assembly: Assembly, found: Stability) -> str:
    """Name the brick in doubt."""
    weakest = int(found.statics.rows[found.margin[found.statics.rows].argmin()])
    return (
        "It could not be decided whether the model stands: there is no proof that it does, and none that it "
        f"collapses; the weakest is the {brick_name(assembly, weakest)} in layer "
        f"{layer_of(assembly.bricks, weakest)}; try the exact layout, or make the model thicker there."
    )


def _ends(levels: Rows) -> list[int]:
    return [int(levels.argmin()), int(levels.argmax())]
