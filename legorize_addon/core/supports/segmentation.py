"""Split assembly: a model built in pieces that are joined, where that saves supports.

A horizontal cut lets what lies above it be built on the table by itself; whatever
hung over the cut lies on the table then. A cut is worth its trouble if it saves
a fifth of the supports.

References
----------
Paper, section on segmentation: parts are legorized one by one, supports inside
are removed, and the parts are joined.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Ints, Mask
from ..model import Assembly, Bricks, Catalogue, ContactGraph, Rows, components
from .demand import support_demand
from .tree import tree

SAVING: Final = 0.2
"""Share of the supports that a cut has to save."""

INTERFACE: Final = 4
"""Studs that hold a piece at least."""

LEAST: Final = 0.02
"""Share of the bricks that a piece has at least."""

TRIED: Final = 4
"""Cuts that are tried in earnest, of those that promise most."""


@dataclass(frozen=True, slots=True, eq=False)
class Joint:
    """Where two pieces meet.

    Attributes
    ----------
    level : int
        Plate on which the upper piece begins.
    piece : int
        Number of the upper piece.
    studs : int
        Studs of other pieces on which it sits.
    before, after : int
        Support bricks without and with the cut, as estimated when it was chosen.
    """

    level: int
    piece: int
    studs: int
    before: int
    after: int


def segment(assembly: Assembly, *, most: int, deepest: int) -> tuple[Assembly, tuple[Joint, ...]]:
    """Cut a model into pieces where that saves supports.

    Parameters
    ----------
    assembly : Assembly
        The model, which hangs together.
    most : int
        Pieces at most.
    deepest : int
        Plates that bricks may hang one under another while building.

    Returns
    -------
    assembly : Assembly
        The same, with the number of the piece of each brick; the first stands on
        the ground.
    joints : tuple of Joint
        By the number of the piece.
    """
    piece = np.zeros(len(assembly.bricks), dtype=np.int16)
    price = {0: _price(assembly.bricks, assembly.catalogue, deepest)}
    joints: list[Joint] = []
    while len(price) < most:
        options = [option for number in price for option in _options(assembly, piece, number, price[number], deepest)]
        if not options:
            break
        best = min(options, key=lambda option: option.price)
        number = len(price)
        before = sum(each.bricks for each in price.values())
        piece = np.where(best.upper, np.int16(number), piece)
        price[best.of], price[number] = best.below, best.above
        joints.append(Joint(best.level, number, best.studs, before, sum(each.bricks for each in price.values())))
    # a piece that is cut again leaves some of the studs below it to its upper part
    graph = assembly.graph
    final = (replace(joint, studs=_joint(graph, piece == joint.piece, piece != joint.piece)) for joint in joints)
    return replace(assembly, bricks=replace(assembly.bricks, piece=piece)), tuple(final)


@dataclass(frozen=True, slots=True, eq=False)
class _Price:
    """What it costs to build a piece: support bricks, and bricks that no support can carry."""

    bricks: int
    heights: Ints
    """Plates from the ground up to each contact."""

    floor: int
    stands: Mask
    """Which of the bricks stand on others, and do not hang."""


@dataclass(frozen=True, slots=True, eq=False)
class _Option:
    """A cut through a piece: which bricks come off, and what both parts cost."""

    of: int
    level: int
    upper: Mask
    studs: int
    below: _Price
    above: _Price

    @property
    def price(self) -> int:
        """Support bricks of both parts, and bricks that none can carry."""
        return self.below.bricks + self.above.bricks


def _price(bricks: Bricks, catalogue: Catalogue, deepest: int) -> _Price:
    need = support_demand(Assembly(bricks, catalogue), deepest=deepest)
    boxes = tree(need.contacts, need.load, need.room, straight=np.zeros(len(need.contacts), dtype=bool))
    floor = int(bricks.corner[:, 2].min())
    return _Price(len(boxes) + len(need.left), need.contacts[:, 2].astype(np.int64), floor, need.depth == 0)


def _options(
    assembly: Assembly,
    piece: NDArray[np.int16],
    number: int,
    price: _Price,
    deepest: int,
) -> Iterator[_Option]:
    """Yield the cuts through a piece that save enough, of the few that promise most."""
    mine = piece == number
    levels = np.unique(assembly.bricks.corner[mine, 2])[1:]
    tried = 0
    for level in levels[np.argsort(_promise(price, levels), kind="stable")].tolist():
        upper = _upper(assembly.bricks, assembly.graph, mine, level)
        lower = mine & ~upper
        studs = _joint(assembly.graph, upper, lower)
        if min(upper.sum(), lower.sum()) < LEAST * len(assembly.bricks) or studs < INTERFACE:
            continue
        # the first piece goes on growing when others are joined to it; each of those is joined as a whole, by what
        # is left of its own joint
        if number and (_n_components(assembly.graph, lower) > 1 or _joint(assembly.graph, lower, ~mine) < INTERFACE):
            continue
        below = _price(assembly.bricks.take(lower), assembly.catalogue, deepest)
        above = _price(assembly.bricks.take(upper), assembly.catalogue, deepest)
        option = _Option(number, level, upper, studs, below, above)
        # what hangs from bricks above the cut is not in place yet when the upper part is joined
        firm = _joint(
            assembly.graph, upper, np.isin(np.arange(len(assembly.bricks)), np.flatnonzero(lower)[below.stands])
        )
        if firm >= INTERFACE and option.price < price.bricks and option.price <= (1 - SAVING) * price.bricks:
            yield option
        tried += 1
        if tried == TRIED:
            return


def _promise(price: _Price, levels: Ints) -> Ints:
    """Return the height of all supports if the piece is cut at each level, as far as its contacts tell."""
    over = price.heights[None, :] - (levels - price.floor)[:, None]
    left: Ints = np.where(over < 0, price.heights[None, :], over).sum(axis=1)
    return left


def _upper(bricks: Bricks, graph: ContactGraph, mine: Mask, level: int) -> Mask:
    """Return the greatest part of a piece that hangs together above a level."""
    above = mine & (bricks.corner[:, 2] >= level)
    component = _components(graph, above)
    upper: Mask = above & (component == np.bincount(component[above]).argmax())
    return upper


def _components(graph: ContactGraph, members: Mask) -> Rows:
    """Label what hangs together among some bricks, (n,)."""
    return components(graph.pairs[members[graph.pairs].all(axis=1)], len(members))


def _n_components(graph: ContactGraph, members: Mask) -> int:
    return len(np.unique(_components(graph, members)[members]))


def _joint(graph: ContactGraph, upper: Mask, lower: Mask) -> int:
    """Count the studs between two parts."""
    first, second = graph.pairs.T
    return int(graph.studs[(lower[first] & upper[second])].sum())
