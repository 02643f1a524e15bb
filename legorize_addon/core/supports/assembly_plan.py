"""All supports of a model and the order in which it is built."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Final, Literal

import numpy as np

from ..arrays import Ints, Mask
from ..building import Links, Moves, Tipping, Walk, links, ordered, walk
from ..model import Bricks, Catalogue, Role, connect, joined
from ..progress import Progress, part, silent
from ..statics import HOLD
from .clearance import Room, room_around
from .demand import Need, needed
from .pillars import with_inside_carried
from .plan import Plan, Way, planned

Wish = Literal["best", Way]

WAYS: Final[tuple[Way, ...]] = ("tree", "columns", "beams")
"""Kinds of supports, the one that is mostly best first."""

LOW: Final = 36
"""Plates up to which supports count as low."""


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """One piece with its supports.

    Attributes
    ----------
    rows : (k,) int64 array
        Rows of its bricks in the model as it came in.
    posts : Bricks
        What was put into it to stay.
    need : Need
        Of the bricks and then the posts.
    plan : Plan
    """

    rows: Ints
    posts: Bricks
    need: Need
    plan: Plan


@dataclass(frozen=True, slots=True, eq=False)
class Supports:
    """A model with its supports, and how it is built.

    Attributes
    ----------
    bricks : Bricks
        The model with all that stays in it, then the supports that are taken out.
    contacts : Links
        What touches what while it is built.
    pieces : tuple of Piece
        By ascending number.
    moves : Moves
        Order in which all is built.
    walk : Walk
        What the check of the order found.
    """

    bricks: Bricks
    contacts: Links
    pieces: tuple[Piece, ...]
    moves: Moves
    walk: Walk

    @property
    def temporary(self) -> Mask:
        """Which bricks are taken out again, (n,) bool."""
        taken: Mask = self.bricks.role == Role.SUPPORT_OUTSIDE
        return taken

    @property
    def stays(self) -> Bricks:
        """The model that is there in the end, each brick with the step in which it is placed."""
        return self.bricks.take(~self.temporary)

    @property
    def removed(self) -> Bricks:
        """What is taken out again."""
        return self.bricks.take(self.temporary)

    @property
    def clinging(self) -> Ints:
        """Rows of carried bricks that hold on to the model by no more studs than to their support.

        They are to be held by hand while the support is pulled off.
        """
        lower, upper = self.contacts.pairs.T
        studs = self.contacts.studs
        n = len(self.bricks)
        temporary = self.temporary
        support = np.bincount(upper, studs * temporary[lower], n)
        model = np.bincount(upper, studs * ~temporary[lower], n) + np.bincount(lower, studs, n)
        return np.flatnonzero((support > 0) & (model <= support) & ~temporary)

    @property
    def unsteady(self) -> tuple[Tipping, ...]:
        """Towers that have to be held by hand while they grow."""
        return tuple(tower for piece in self.pieces for tower in piece.plan.unsteady)


def supported(
    bricks: Bricks,
    catalogue: Catalogue,
    *,
    wish: Wish = "best",
    deepest: int,
    hold: float = HOLD,
    progress: Progress = silent,
) -> Supports:
    """Put supports under a model, piece by piece, and find the order in which it is built.

    Parameters
    ----------
    bricks : Bricks
        The model. Its pieces stand on the table each by itself.
    catalogue : Catalogue
    wish : {"best", "tree", "columns", "beams", "none"}
        Kind of the supports that are taken out again; "best" is for each piece
        the lightest of those that fail least, beams only where they are low;
        "none" adds nothing at all.
    deepest : int
        Plates that bricks may hang one under another while building.
    hold : float
        Pull in N that one contact point bears.
    progress : Progress

    Returns
    -------
    Supports
    """
    numbers = np.unique(bricks.piece).tolist()
    pieces = []
    for turn, number in enumerate(numbers):
        here = part(progress, 0.8 * turn / len(numbers), 0.8 * (turn + 1) / len(numbers))
        here("supports", 0.0)
        # supports of the first piece are still there when the others are joined to it
        room = room_around(connect(bricks, catalogue)) if number == 0 and len(numbers) > 1 else None
        pieces.append(
            _piece(bricks, np.flatnonzero(bricks.piece == number), catalogue, room, wish, deepest, hold, here)
        )
    posts = [_numbered(piece.posts, number) for piece, number in zip(pieces, numbers, strict=True)]
    added = [_numbered(piece.plan.supports, number) for piece, number in zip(pieces, numbers, strict=True)]
    everything = joined([bricks, *posts, *added])
    temporary = everything.role == Role.SUPPORT_OUTSIDE
    contacts = links(everything, catalogue, temporary=temporary)
    moves = ordered(everything, contacts.pairs, temporary=temporary, progress=part(progress, 0.8, 0.9))
    everything = replace(everything, step=moves.step_of(len(everything)))
    found = walk(moves, everything, catalogue, contacts, temporary=temporary, progress=part(progress, 0.9, 1.0))
    return Supports(everything, contacts, tuple(pieces), moves, found)


def _worth_trying(need: Need) -> tuple[Way, ...]:
    """Return the kinds of supports that can be the lightest: beams only where they are low, as in the paper."""
    low = len(need.cells) > 0 and float(np.median(need.cells[:, 2])) <= LOW
    return WAYS if low else WAYS[:2]


def _numbered(bricks: Bricks, number: int) -> Bricks:
    return replace(bricks, piece=np.full(len(bricks), number, dtype=np.int16))


def _piece(
    model: Bricks,
    rows: Ints,
    catalogue: Catalogue,
    room: Room | None,
    wish: Wish,
    deepest: int,
    hold: float,
    progress: Progress,
) -> Piece:
    """Support one piece."""
    bricks = _numbered(model.take(rows), 0)
    connection = connect(bricks, catalogue)
    need = needed(bricks, catalogue, connection, deepest=deepest, room=room)
    plan = partial(planned, hold=hold, progress=progress)
    if wish == "none":
        return Piece(rows, bricks.take(rows[:0]), need, plan(bricks, catalogue, need, ways=()))
    if len(need.enclosed):
        bricks, connection = with_inside_carried(bricks, catalogue, connection, need.enclosed)
        need = needed(bricks, catalogue, connection, deepest=deepest, room=room)
    found = plan(bricks, catalogue, need, ways=_worth_trying(need) if wish == "best" else (wish,))
    return Piece(rows, bricks.take(np.arange(len(rows), len(bricks))), need, found)
