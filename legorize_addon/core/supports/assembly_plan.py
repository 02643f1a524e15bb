"""All supports of a model and the order in which it is built."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, Literal

import numpy as np

from ..arrays import Ints, Mask
from ..building import (
    Action,
    BuildingContacts,
    Moves,
    Steps,
    Tipping,
    Walk,
    building_contacts,
    given_steps,
    plan_steps,
    steps_alone,
    unbalanced,
    walk,
)
from ..memo import Recall, plainly
from ..model import Assembly, Bricks, Role, concatenate
from ..progress import Progress, part, silent
from ..statics import HOLD
from .clearance import Clearance, Kinds, clearance_around
from .demand import Demand, support_demand
from .pillars import add_inner_pillars
from .plan import Plan, Way, plan_supports

Wish = Literal["best", Way]

KINDS: Final[tuple[Way, ...]] = ("tree", "columns", "beams")
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
    pillars : Bricks
        What was put into it to stay.
    need : Demand
        Of the bricks and then the pillars.
    plan : Plan
    """

    rows: Ints
    pillars: Bricks
    need: Demand
    plan: Plan


@dataclass(frozen=True, slots=True, eq=False)
class AssemblyPlan:
    """A model with its supports, and how it is built.

    Attributes
    ----------
    assembly : Assembly
        The model with all that stays in it, then the supports that are taken out.
    contacts : BuildingContacts
        What touches what while it is built.
    pieces : tuple of Piece
        By ascending number.
    steps : Steps
        Order and steps in which all is built, and the submodels that are built by themselves.
    walk : Walk
        What the check of the order found.
    unsteady : tuple of Tipping
        Towers that have to be held by hand while they grow, by step.
    leaning : tuple of Tipping
        Sub-assemblies that would fall over while they are built by themselves, by step.
    """

    assembly: Assembly
    contacts: BuildingContacts
    pieces: tuple[Piece, ...]
    steps: Steps
    walk: Walk
    unsteady: tuple[Tipping, ...]
    leaning: tuple[Tipping, ...]

    @property
    def bricks(self) -> Bricks:
        """The bricks of the model and its supports."""
        return self.assembly.bricks

    @property
    def moves(self) -> Moves:
        """The moves of all steps, one after the other."""
        return self.steps.moves

    @property
    def temporary(self) -> Mask:
        """Which bricks are taken out again, (n,) bool."""
        taken: Mask = self.bricks.role == Role.SUPPORT_OUTSIDE
        return taken

    @property
    def final(self) -> Assembly:
        """The model that is there in the end, each brick with the step in which it is placed."""
        return self.assembly.take(~self.temporary)

    @property
    def final_alone(self) -> Assembly:
        """The model that is there in the end, each brick with the step from which on it stands without supports."""
        final, bricks = self.final, self.bricks
        arrival = self.steps.arrival(len(bricks), within_pieces=True)[~self.temporary]
        level = final.bricks.corner[:, 2]
        step = steps_alone(arrival, final.graph.pairs, ground=level == level.min(initial=0))
        return replace(final, bricks=replace(final.bricks, step=step))

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
    def by_hand(self) -> Mask:
        """Which moves need a hand that holds, (n_moves,) bool.

        Bricks of a tower or a sub-assembly in the step in which it would fall over,
        and supports that are pulled off bricks that cling to them.
        """
        moves = self.moves
        held = np.zeros(len(moves), dtype=bool)
        owner = self.steps.submodel_of(len(self.bricks))
        for tower in (*self.unsteady, *self.leaning):
            joins = (moves.action == Action.JOIN) & np.isin(moves.submodel, owner[tower.bricks])
            held |= (moves.step == tower.step) & (np.isin(moves.brick, tower.bricks) | joins)
        lower, upper = self.contacts.pairs.T
        under = lower[np.isin(upper, self.clinging) & self.temporary[lower]]
        held |= (moves.action == Action.REMOVE) & np.isin(moves.brick, under)
        return held


def plan_assembly(  # noqa: PLR0913
    assembly: Assembly,
    *,
    wish: Wish = "best",
    deepest: int,
    clutch: float = HOLD,
    long_bricks: bool = False,
    kinds: Kinds | None = None,
    progress: Progress = silent,
    recall: Recall = plainly,
) -> AssemblyPlan:
    """Put supports under a model, piece by piece, and find the order in which it is built.

    Parameters
    ----------
    assembly : Assembly
        The model. Its pieces stand on the table each by itself.
    wish : {"best", "tree", "columns", "beams", "none"}
        Kind of the supports that are taken out again; "best" is for each piece
        the lightest of those that fail least, beams only where they are low;
        "none" adds nothing at all.
    deepest : int
        Plates that bricks may hang one under another while building.
    clutch : float
        Pull in N that one contact point bears.
    long_bricks : bool
        Whether trees carry wide undersides by bricks of eight studs, see :mod:`.chassis`.
    kinds : (n_layers, n_y, n_x) uint8 array, optional
        The half studs of cells, see :func:`~.clearance.clearance_around`.
    progress : Progress
    recall : Recall
        Returns supports that were found before.

    Returns
    -------
    AssemblyPlan
    """
    numbers = np.unique(assembly.bricks.piece).tolist()
    pieces = []
    for turn, number in enumerate(numbers):
        here = part(progress, 0.8 * turn / len(numbers), 0.8 * (turn + 1) / len(numbers))
        here("supports", 0.0)
        # supports of the first piece are still there when the others are joined to it
        rows = np.flatnonzero(assembly.bricks.piece == number)
        whole = assembly if number == 0 and len(numbers) > 1 else assembly.take(rows)
        room = clearance_around(whole.graph, kinds) if kinds is not None or whole is assembly else None
        look = partial(plan_supports, clutch=clutch, long_bricks=long_bricks, progress=here, recall=recall)
        pieces.append(_piece(assembly, rows, room, wish, deepest, look))
    pillars = [_numbered(piece.pillars, number) for piece, number in zip(pieces, numbers, strict=True)]
    added = [_numbered(piece.plan.supports, number) for piece, number in zip(pieces, numbers, strict=True)]
    everything = concatenate([assembly.bricks, *pillars, *added])
    temporary = everything.role == Role.SUPPORT_OUTSIDE
    catalogue, ordering = assembly.catalogue, part(progress, 0.8, 0.9)
    contacts, steps = _known(pieces, everything)
    if contacts is None:
        contacts = building_contacts(Assembly(everything, catalogue), temporary=temporary)
    if steps is None:
        steps = plan_steps(everything, catalogue, contacts.pairs, temporary=temporary, progress=ordering)
    planned = Assembly(replace(everything, step=steps.moves.step_of(len(everything))), catalogue)
    found = walk(steps, planned, contacts, temporary=temporary, progress=part(progress, 0.9, 1.0))
    return AssemblyPlan(planned, contacts, tuple(pieces), steps, found, *unbalanced(steps, planned, contacts.pairs))


def plan_as_given(
    assembly: Assembly, *, own_steps: bool, deepest: int, clutch: float = HOLD, progress: Progress = silent
) -> AssemblyPlan:
    """Find how a model is built without adding anything to it.

    Parameters
    ----------
    assembly : Assembly
        The model; supports that are taken out again have their role.
    own_steps : bool
        Whether the steps are those of its bricks, which then are all on one table
        and stay; else they are planned.
    deepest : int
        Plates that bricks may hang one under another while building.
    clutch : float
        Pull in N that one contact point bears.
    progress : Progress

    Returns
    -------
    AssemblyPlan
        Rows of the bricks are those of the model.
    """
    bricks, temporary = assembly.bricks, assembly.bricks.role == Role.SUPPORT_OUTSIDE
    model = assembly.take(~temporary)
    look = partial(plan_supports, clutch=clutch, progress=part(progress, 0.0, 0.5))
    pieces = [
        _piece(model, np.flatnonzero(model.bricks.piece == number), None, "none", deepest, look)
        for number in np.unique(model.bricks.piece).tolist()
    ]
    contacts, steps = _known(pieces, bricks)
    if contacts is None:
        contacts = building_contacts(assembly, temporary=temporary)
    if own_steps:
        steps = given_steps(assembly, contacts.pairs)
    if steps is None:
        ordering = part(progress, 0.5, 0.8)
        steps = plan_steps(bricks, assembly.catalogue, contacts.pairs, temporary=temporary, progress=ordering)
    planned = Assembly(replace(bricks, step=steps.moves.step_of(len(bricks))), assembly.catalogue)
    found = walk(steps, planned, contacts, temporary=temporary, progress=part(progress, 0.8, 1.0))
    return AssemblyPlan(planned, contacts, tuple(pieces), steps, found, *unbalanced(steps, planned, contacts.pairs))


def walk_apart(plan: AssemblyPlan, apart: Assembly) -> AssemblyPlan:
    """Return a plan of bricks that lie half studs off the places that they were planned for, its order checked anew."""
    found = walk(plan.steps, apart, plan.contacts, temporary=plan.temporary)
    unsteady, leaning = unbalanced(plan.steps, apart, plan.contacts.pairs)
    return replace(plan, assembly=apart, walk=found, unsteady=unsteady, leaning=leaning)


def _known(pieces: Sequence[Piece], bricks: Bricks) -> tuple[BuildingContacts | None, Steps | None]:
    """Return contacts and steps of a model that is its first piece, found with just its supports; None of any other."""
    taken_out = np.count_nonzero(bricks.role == Role.SUPPORT_OUTSIDE)
    if len(pieces) != 1 or bricks.piece.any() or taken_out != len(pieces[0].plan.supports):
        return None, None
    grown = pieces[0].plan.grown
    return grown.contacts, grown.steps


def _worth_trying(need: Demand) -> tuple[Way, ...]:
    """Return the kinds of supports that can be the lightest: beams only where they are low, as in the paper."""
    low = len(need.cells) > 0 and float(np.median(need.cells[:, 2])) <= LOW
    return KINDS if low else KINDS[:2]


def _numbered(bricks: Bricks, number: int) -> Bricks:
    return replace(bricks, piece=np.full(len(bricks), number, dtype=np.int16))


def _piece(
    model: Assembly,
    rows: Ints,
    room: Clearance | None,
    wish: Wish,
    deepest: int,
    plan: Callable[..., Plan],
) -> Piece:
    """Support one piece."""
    piece = Assembly(_numbered(model.bricks.take(rows), 0), model.catalogue)
    need = support_demand(piece, deepest=deepest, room=room)
    if wish == "none":
        return Piece(rows, piece.bricks.take(rows[:0]), need, plan(piece, need, ways=()))
    if len(need.enclosed):
        piece = add_inner_pillars(piece, need.enclosed)
        need = support_demand(piece, deepest=deepest, room=room)
    found = plan(piece, need, ways=_worth_trying(need) if wish == "best" else (wish,))
    return Piece(rows, piece.bricks.take(np.arange(len(rows), len(piece))), need, found)
