"""Supports of one kind under one piece, until it stands at every step and they bear what lies on them.

Contacts are added where the piece would fall over while it is built; branches of
trees that do not bear their load become trunks of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Final, Literal

import numpy as np

from ..arrays import Floats, Ints, Mask
from ..building import Tipping
from ..memo import Recall, plainly
from ..model import Assembly, Bricks, Catalogue, ContactGraph, Role, Rows, Verdict, contact_graph
from ..progress import Progress, part, silent
from ..statics import Effort, stability
from .beams import beams
from .boxes import OUTSIDE_COLOUR, bricks_of_boxes, merge_upwards, sizes_in, split_missing
from .chassis import carried_by, chassis, without
from .columns import columns
from .demand import Demand
from .growth import Grown, Growth
from .stacks import widen
from .tree import tree

Way = Literal["tree", "columns", "beams", "none"]

ROUNDS: Final = 6
"""Times that contacts are added or branches straightened."""

BY_HAND: Final = 50.0
"""Weight in g of supports for which it is worth to hold one more tower by hand."""

MOVING: Final = 1e-6
"""Share of the fastest motion of a collapse from which on a brick moves."""


@dataclass(frozen=True, slots=True, eq=False)
class SupportContacts:
    """Where supports touch a piece.

    Attributes
    ----------
    cells : (k, 3) int32 array
        Cells (x, y, z) of the room, z the plate on which the carried brick lies.
    carried : (k,) int64 array
        Rows of the bricks on them.
    load : (k,) float64 array
        Weight in N that lies on each.
    straight : (k,) bool array
        Contacts whose branch shall not join others.
    """

    cells: Rows
    carried: Ints
    load: Floats
    straight: Mask


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Supports of one kind under one piece.

    Attributes
    ----------
    way : {"tree", "columns", "beams", "none"}
    supports : Bricks
        What is taken out again.
    contacts : NearContacts
    grown : Grown
        How it is built: its steps, and the towers that fall over on the way as no
        contact can hold them.
    bears : bool
        Whether the supports are proven to bear what lies on them.
    """

    way: Way
    supports: Bricks
    contacts: SupportContacts
    grown: Grown
    bears: bool

    @property
    def unsteady(self) -> tuple[Tipping, ...]:
        """Towers that fall over on the way."""
        return tuple(self.grown.towers)


def plan_supports(
    assembly: Assembly,
    need: Demand,
    *,
    ways: Sequence[Way],
    clutch: float,
    long_bricks: bool = False,
    progress: Progress = silent,
    recall: Recall = plainly,
) -> Plan:
    """Put supports under a piece.

    Parameters
    ----------
    assembly : Assembly
        The piece, with the pillars that stay in it.
    need : Demand
        Of these bricks.
    ways : sequence of {"tree", "columns", "beams"}
        Kinds to choose from, the most promising first; none of them if nothing
        shall be put under the piece.
    clutch : float
        Pull in N that one contact point bears.
    long_bricks : bool, optional
        Whether trees carry wide undersides by bricks of eight studs, see :func:`~.chassis.chassis`.
    progress : Progress, optional
        Told how far the search is.
    recall : Recall, optional
        Returns supports that were found before.

    Returns
    -------
    Plan
        The lightest of those with the fewest faults.
    """
    contacts = SupportContacts(need.contacts, need.carried, need.load, np.zeros(len(need.contacts), dtype=bool))
    growth = Growth(assembly, need)
    best: Plan | None = None
    for turn, way in enumerate(ways):
        trying = part(progress, turn / len(ways), (turn + 1) / len(ways))
        trying("supports", 0.0)
        if best is not None and not len(contacts.cells):
            break
        laid = partial(_light, best, need, assembly.catalogue, way, long_bricks=long_bricks)
        inputs = assembly, need, contacts, way, clutch, best, long_bricks, growth.arrival
        settle = partial(_settled, growth, contacts, way, clutch, trying, laid)
        # what the piece was found to grow like counts for the next kind
        found, growth.arrival = recall("supports of a kind", inputs, partial(_with_arrival, growth, settle))
        if best is None or (found is not None and _worth(found, assembly.catalogue) < _worth(best, assembly.catalogue)):
            best = found
    return _bare(growth, contacts, progress) if best is None else best


def _with_arrival(growth: Growth, settle: Callable[[], Plan | None]) -> tuple[Plan | None, Ints | None]:
    """Return supports of a kind, and when the bricks of the piece come then."""
    return settle(), growth.arrival


def _worth(plan: Plan, catalogue: Catalogue) -> tuple[bool, float]:
    """Return what a better plan has less of: supports that break, and weight."""
    return not plan.bears, _mass(plan.supports, catalogue) + BY_HAND * len(plan.unsteady)


def _mass(bricks: Bricks, catalogue: Catalogue) -> float:
    return float(catalogue.mass[bricks.part].sum())


def _settled(
    growth: Growth,
    contacts: SupportContacts,
    way: Way,
    clutch: float,
    progress: Progress,
    laid: Callable[[SupportContacts], Bricks | None],
) -> Plan | None:
    """Add contacts and straighten branches until all stands and bears, nothing more helps, or none are laid."""
    need, catalogue = growth.need, growth.assembly.catalogue
    for left in reversed(range(ROUNDS)):
        trying = part(progress, 1 - (left + 1) / ROUNDS, 1 - left / ROUNDS)
        if (offered := laid(contacts)) is None:
            return None
        supports = offered
        giving, bears = np.zeros(len(contacts.cells), dtype=bool), True
        if way != "columns" and len(contacts.cells):
            giving, bears = _giving(contacts, supports, need, catalogue, clutch, trying)
        # what the last round finds is not laid any more
        for planned in (False, True) if growth.known and left else (True,):
            grown = growth.with_supports(supports, contacts.cells, add=left > 0, planned=planned, progress=trying)
            better = contacts if way != "tree" else _straighter(contacts, giving, grown, supports, growth)
            if grown.braces:
                better = _with(better, need, grown.braces)
            if better is not contacts:
                break
        if better is contacts or not left:
            break
        contacts = better
    return Plan(way, supports, contacts, grown, bears)


def _straighter(
    contacts: SupportContacts, giving: Mask, grown: Grown, supports: Bricks, growth: Growth
) -> SupportContacts:
    """Return contacts with those straight that give way, or that rest on trees that fall over."""
    n = len(growth.assembly)
    leaning = [tower.bricks - n for tower in grown.towers if tower.bricks[0] >= n]
    crooked = giving | _resting_on(contacts, supports, growth.need, growth.assembly.catalogue, leaning)
    if not (crooked & ~contacts.straight).any():
        return contacts
    return replace(contacts, straight=contacts.straight | crooked)


def _bare(growth: Growth, contacts: SupportContacts, progress: Progress) -> Plan:
    """Return the plan that puts nothing under a piece."""
    nothing = growth.assembly.bricks.take(np.zeros(0, dtype=np.int64))
    none = SupportContacts(contacts.cells[:0], contacts.carried[:0], contacts.load[:0], contacts.straight[:0])
    grown = growth.with_supports(nothing, none.cells, add=False, planned=True, progress=progress)
    return Plan("none", nothing, none, grown, True)


def _light(
    best: Plan | None, need: Demand, catalogue: Catalogue, way: Way, contacts: SupportContacts, *, long_bricks: bool
) -> Bricks | None:
    """Return the bricks of all supports; None if another plan is better than these can become.

    Contacts are added, never taken away: what is too heavy stays so.
    """
    supports = _laid(contacts, need, catalogue, way, long_bricks=long_bricks)
    heavy = best is not None and _worth(best, catalogue) <= (False, _mass(supports, catalogue))
    return None if heavy else supports


def _laid(contacts: SupportContacts, need: Demand, catalogue: Catalogue, way: Way, *, long_bricks: bool) -> Bricks:
    """Return the bricks of all supports, in the cells of the model's grid."""
    if way == "tree":
        wide = chassis(need.undersides, contacts.cells, need.room) if long_bricks else np.zeros((0, 6), dtype=np.int32)
        cells, load, straight = carried_by(wide, contacts.cells, contacts.load, contacts.straight)
        boxes = np.concatenate([wide, tree(cells, load, without(need.room, wide), straight=straight)])
    elif way == "columns":
        boxes = columns(contacts.cells.tolist(), need.room)
    else:
        boxes = beams(np.unique(np.concatenate([need.cells, contacts.cells]), axis=0), need.room)
    boxes = split_missing(boxes, sizes := sizes_in(catalogue, OUTSIDE_COLOUR))
    boxes = widen(boxes, need.room.open, sizes)
    boxes = merge_upwards(boxes, catalogue, OUTSIDE_COLOUR)
    boxes[:, :3] += need.room.low
    return bricks_of_boxes(boxes, catalogue, colour=OUTSIDE_COLOUR, role=Role.SUPPORT_OUTSIDE)


def _tops(contacts: SupportContacts, need: Demand, graph: ContactGraph) -> Ints:
    """Return the row of the support brick under each contact."""
    x, y, z = (contacts.cells + need.room.low - graph.low).T
    tops: Ints = graph.owner[z - 1, y, x].astype(np.int64)
    return tops


def _giving(
    contacts: SupportContacts, supports: Bricks, need: Demand, catalogue: Catalogue, clutch: float, progress: Progress
) -> tuple[Mask, bool]:
    """Load the supports by themselves; tell which contacts rest on some that give way, and whether none does.

    A straight column stands right under its load, on a foot around it, and needs no proof.
    """
    whole = contact_graph(supports, catalogue)
    under = whole.component[_tops(contacts, need, whole)]
    bent = np.isin(whole.component, under[~contacts.straight])
    if not bent.any():
        return np.zeros(len(under), dtype=bool), True
    loaded = np.isin(under, whole.component[bent])
    crooked = supports.take(bent)
    graph = contact_graph(crooked, catalogue)
    tops = _tops(replace(contacts, cells=contacts.cells[loaded]), need, graph)
    loads = np.zeros((len(crooked), 3))
    np.add.at(loads[:, 2], tops, -contacts.load[loaded])
    # a branch that is not soon proven to bear is straightened as well, which is cheaper than a linear programme
    found = stability(
        Assembly(crooked, catalogue), clutch=clutch, loads=loads, effort=Effort(programme=0), progress=progress
    )
    moving = (np.abs(found.motion) > MOVING).any(axis=1)
    if found.verdict is Verdict.UNDECIDED:
        moving |= found.margin < 0
    # not a number where it floats, which is no support at all
    giving = np.union1d(found.component[moving], np.flatnonzero(~(found.tipping >= 0)))
    weak = np.zeros(len(under), dtype=bool)
    weak[loaded] = np.isin(found.component[tops], giving)
    return weak, found.verdict is Verdict.STABLE


def _resting_on(
    contacts: SupportContacts, supports: Bricks, need: Demand, catalogue: Catalogue, towers: Sequence[Ints]
) -> Mask:
    """Tell which contacts rest on trees of which some bricks are given."""
    if not towers:
        return np.zeros(len(contacts.cells), dtype=bool)
    graph = contact_graph(supports, catalogue)
    tops = _tops(contacts, need, graph)
    return np.isin(graph.component[tops], graph.component[np.concatenate(towers)])


def _with(contacts: SupportContacts, need: Demand, undersides: Sequence[int]) -> SupportContacts:
    """Return contacts with others at undersides."""
    more = list(undersides)
    return SupportContacts(
        cells=np.concatenate([contacts.cells, need.undersides[more]]),
        carried=np.concatenate([contacts.carried, need.over[more]]),
        load=np.concatenate([contacts.load, np.zeros(len(more))]),
        straight=np.concatenate([contacts.straight, np.zeros(len(more), dtype=bool)]),
    )
