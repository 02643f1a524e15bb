"""Split assembly: a model built in pieces that are joined, where that saves supports.

A horizontal cut lets what lies above it be built on the table by itself; whatever
hung over the cut lies on the table then. A cut is worth its trouble if it saves
a fifth of the supports. Each piece hangs together by itself: where a cut leaves
several parts below it, as wheels, each of them becomes a piece of its own.

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
from ..building import column_pairs, presses, tangled
from ..model import Assembly, Bricks, Catalogue, ContactGraph, Rows, components
from .demand import support_demand
from .tree import tree

SAVING: Final = 0.2
"""Share of the supports that a cut has to save."""

INTERFACE: Final = 4
"""Studs that hold a piece at least."""

LEAST: Final = 0.02
"""Share of the bricks that lie on either side of a cut at least."""

SMALLEST: Final = 4
"""Bricks of each part at least where a cut leaves several below it: less is no work of its own."""

ROUNDS: Final = 4
"""Times that a cut is moved up where something would hang from it."""

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
        Studs of other pieces on which it sits; 0 if it stands on the table beside them.
    before, after : int
        Support bricks without and with the cut, as estimated when it was chosen.
    """

    level: int
    piece: int
    studs: int
    before: int
    after: int


def segment(
    assembly: Assembly, *, most: int, deepest: int, barred: frozenset[int] = frozenset()
) -> tuple[Assembly, tuple[Joint, ...]]:
    """Cut a model into pieces where that is expected to save supports.

    Parameters
    ----------
    assembly : Assembly
        The model, which hangs together.
    most : int
        Pieces at most.
    deepest : int
        Plates that bricks may hang one under another while building.
    barred : frozenset of int
        Plates on which no upper piece may begin.

    Returns
    -------
    assembly : Assembly
        The same, with the number of the piece of each brick; the first stands on
        the ground.
    joints : tuple of Joint
        By the number of the piece.
    """
    bricks, catalogue, graph = assembly.bricks, assembly.catalogue, assembly.graph
    piece = np.zeros(len(bricks), dtype=np.int16)
    price = {0: _price(bricks, catalogue, deepest)}
    joints: list[Joint] = []
    below = column_pairs(bricks, catalogue)
    while len(price) < most:
        options = [
            option
            for number in price
            for option in _options(assembly, piece, number, price[number], deepest)
            if option.level(bricks) not in barred
            if len(price) + len(option.lower) <= most and _fits(assembly, below, option.pieces(piece))
        ]
        if not options:
            break
        best = min(options, key=lambda option: option.price)
        before = sum(each.bricks for each in price.values())
        new = range(len(price), len(price) + len(best.lower))
        piece = best.pieces(piece)
        for number in (best.of, *new):
            price[number] = _price(bricks.take(piece == number), catalogue, deepest)
        after = sum(each.bricks for each in price.values())
        levels = [int(bricks.corner[piece == number, 2].min()) for number in new]
        joints += [Joint(level, number, 0, before, after) for level, number in zip(levels, new, strict=True)]
    # a piece that is cut again leaves some of the studs below it to its upper part
    final = (replace(joint, studs=_joint(graph, piece == joint.piece, piece != joint.piece)) for joint in joints)
    return replace(assembly, bricks=replace(bricks, piece=piece)), tuple(final)


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
    """A cut through a piece: which bricks come off, and what both sides cost."""

    of: int
    upper: Mask
    lower: tuple[Mask, ...]
    """Parts below the cut, the greatest first."""

    below: _Price
    above: _Price

    @property
    def price(self) -> int:
        """Support bricks of both sides, and bricks that none can carry."""
        return self.below.bricks + self.above.bricks

    def level(self, bricks: Bricks) -> int:
        """Return the plate on which the upper piece begins."""
        return int(bricks.corner[self.upper, 2].min())

    def pieces(self, piece: NDArray[np.int16]) -> NDArray[np.int16]:
        """Return the piece of each brick after the cut: the greatest lower part keeps the number, the upper is last."""
        found, number = piece.copy(), int(piece.max())
        for part in (*self.lower[1:], self.upper):
            number += 1
            found[part] = number
        return found


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
    bricks, catalogue, graph = assembly.bricks, assembly.catalogue, assembly.graph
    mine = piece == number
    levels = np.unique(bricks.corner[mine, 2])[1:]
    tried = 0
    for level in levels[np.argsort(_promise(price, levels), kind="stable")].tolist():
        upper = _whole(bricks, graph, mine, _upper(graph, mine & (bricks.corner[:, 2] >= level)), first=number == 0)
        lower = mine & ~upper
        studs = _joint(graph, upper, lower)
        if min(upper.sum(), lower.sum()) < LEAST * len(bricks) or studs < INTERFACE:
            continue
        parts = _parts(graph, lower)
        if len(parts) > 1 and min(int(part.sum()) for part in parts) < SMALLEST:
            continue
        if not all(_is_piece(bricks, graph, part, mine, first=number == 0) for part in parts):
            continue
        below = _price(bricks.take(lower), catalogue, deepest)
        above = _price(bricks.take(upper), catalogue, deepest)
        option = _Option(number, upper, parts, below, above)
        # what hangs from bricks above the cut is not in place yet when the upper part is joined
        firm = _joint(graph, upper, np.isin(np.arange(len(bricks)), np.flatnonzero(lower)[below.stands]))
        if firm >= INTERFACE and pays(price.bricks, option.price):
            yield option
        tried += 1
        if tried == TRIED:
            return


def pays(before: int, after: int) -> bool:
    """Tell whether cuts save enough of the support bricks, given how many there are without and with them."""
    return after < before and after <= (1 - SAVING) * before


def _promise(price: _Price, levels: Ints) -> Ints:
    """Return the height of all supports if the piece is cut at each level, as far as its contacts tell."""
    over = price.heights[None, :] - (levels - price.floor)[:, None]
    left: Ints = np.where(over < 0, price.heights[None, :], over).sum(axis=1)
    return left


def _upper(graph: ContactGraph, above: Mask) -> Mask:
    """Return the greatest part that hangs together of what lies above a level."""
    component = _components(graph, above)
    upper: Mask = above & (component == np.bincount(component[above]).argmax())
    return upper


def _whole(bricks: Bricks, graph: ContactGraph, mine: Mask, upper: Mask, *, first: bool) -> Mask:
    """Leave to the lower part what hangs below a cut from the upper one alone, with the bricks that it hangs from."""
    first_row, second_row = graph.pairs.T
    for _ in range(ROUNDS):
        parts = _parts(graph, mine & ~upper)
        loose = np.zeros(len(upper), dtype=bool)
        for part in parts[1:]:
            if not _is_piece(bricks, graph, part, mine, first=first) or part.sum() < SMALLEST:
                loose |= part
        if not loose.any():
            break
        hold = np.zeros(len(upper), dtype=bool)
        hold[second_row[loose[first_row] & upper[second_row]]] = True
        if not (upper & ~hold).any():
            break
        upper = _upper(graph, upper & ~hold)
    return upper


def _components(graph: ContactGraph, members: Mask) -> Rows:
    """Label what hangs together among some bricks, (n,)."""
    return components(graph.pairs[members[graph.pairs].all(axis=1)], len(members))


def _parts(graph: ContactGraph, members: Mask) -> tuple[Mask, ...]:
    """Return what hangs together among some bricks, the greatest part first."""
    component = _components(graph, members)
    number, first, count = np.unique(component[members], return_index=True, return_counts=True)
    order = np.lexsort((first, -count))
    return tuple(members & (component == each) for each in number[order].tolist())


def _is_piece(bricks: Bricks, graph: ContactGraph, part: Mask, mine: Mask, *, first: bool) -> bool:
    """Whether a part below a cut can be a piece: on the table, or held by other pieces below."""
    level = bricks.corner[:, 2]
    stands = first and level[part].min() == level[mine].min()
    return bool(stands or _joint(graph, part, ~mine) >= INTERFACE)


def _fits(assembly: Assembly, below: Rows, piece: NDArray[np.int16]) -> bool:
    """Whether pieces can be put on one after the other, and nothing hangs from them that would have to be pressed."""
    nodes = _nodes(piece)
    return not tangled(below, nodes) and not presses(assembly, below, nodes)


def _nodes(piece: NDArray[np.int16]) -> Ints:
    """Return what bricks are put on with: those of the first piece one by one, the others as pieces."""
    node = np.arange(len(piece), dtype=np.int64)
    return np.where(piece > 0, len(piece) + piece.astype(np.int64), node)


def _joint(graph: ContactGraph, upper: Mask, lower: Mask) -> int:
    """Count the studs between two parts."""
    first, second = graph.pairs.T
    return int(graph.studs[(lower[first] & upper[second])].sum())
