"""In which order the bricks are placed, so that every one is pushed onto something that holds.

Level by level, bricks are pushed from above onto those that lie there. What has
nothing below it waits until a brick above it is in place, and is pressed under
that one from below; bricks are not pushed in between two others that are in
place already, where their studs could not go.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator

import numpy as np

from ..arrays import Mask
from ..model import NOBODY, Bricks, Rows, stacked
from ..progress import Progress, silent
from .moves import Action, Moves


def order_moves(bricks: Bricks, pairs: Rows, *, temporary: Mask, progress: Progress = silent) -> Moves:
    """Find a building order.

    Parameters
    ----------
    bricks : Bricks
        Model and supports, n rows. Pieces above 0 are built on the table first,
        one by one, and lose their supports; then the first piece grows up to
        each of them in turn, from the lowest, and it is joined.
    pairs : (n_pairs, 2) int32 array
        Lower and upper brick of each contact.
    temporary : (n,) bool array
        Bricks of supports that are taken out again.
    progress : Progress, optional
        Told how many bricks are placed, level by level.

    Returns
    -------
    Moves
        Every brick placed once, every temporary one removed, every piece joined.
        Bricks that nothing holds are placed last.
    """
    site = _Site(bricks, pairs, temporary, progress)
    pieces = [piece for piece in np.unique(bricks.piece).tolist() if piece]
    floor = {piece: int(bricks.corner[bricks.piece == piece, 2].min()) for piece in pieces}
    for piece in pieces:
        site.build(piece)
        site.clear(piece)
    site.start(0)
    for piece in sorted(pieces, key=lambda each: floor[each]):
        site.grow(0, floor[piece])
        site.join(piece)
    site.grow(0)
    site.clear(0)
    return site.moves()


class _Site:
    """Bricks in place, and those that could be next."""

    def __init__(self, bricks: Bricks, pairs: Rows, temporary: Mask, progress: Progress) -> None:
        self.bricks, self.temporary, self.progress = bricks, temporary, progress
        self.key = [tuple(row) for row in np.column_stack([bricks.corner[:, ::-1], np.arange(len(bricks))]).tolist()]
        self.below, self.above = stacked(pairs, len(bricks))
        self.assembly = bricks.piece.astype(np.int64).tolist()
        self.placed = [False] * len(bricks)
        self.waiting = [True] * len(bricks)
        # bricks still to come from which others still to come lead up, or down, to one in place
        self.under_placed = [False] * len(bricks)
        self.over_placed = [False] * len(bricks)
        self.rows: list[tuple[int, int, int, bool, int]] = []
        self.step = NOBODY
        self.kind: object = None
        self.on_top: list[tuple[tuple[int, ...], int]] = []
        self.from_below: list[tuple[tuple[int, ...], int]] = []

    def build(self, piece: int) -> None:
        """Build a piece from its lowest level to the top."""
        self.start(piece)
        self.grow(piece)

    def start(self, piece: int) -> None:
        """Let the lowest bricks of a piece stand on the table."""
        mine = np.flatnonzero(self.bricks.piece == piece)
        levels = self.bricks.corner[mine, 2]
        self.on_top = [(self.key[brick], brick) for brick in mine[levels == levels.min()].tolist()]
        self.from_below = []
        heapq.heapify(self.on_top)

    def grow(self, piece: int, end: int | None = None) -> None:
        """Place the bricks of a piece whose undersides lie below a level, or all of them."""
        mine = np.flatnonzero(self.bricks.piece == piece)
        levels = np.unique(self.bricks.corner[mine, 2])
        for level in levels[levels < end].tolist() if end is not None else levels.tolist():
            self.progress("supports", len(self.rows) / max(len(self.bricks), len(self.rows)))
            self._level(piece, level)
        if end is None:
            self._place_all(piece, [brick for brick in mine.tolist() if self.waiting[brick]], "loose")

    def clear(self, piece: int) -> None:
        """Take out the supports of a piece, from the lowest brick."""
        mine = np.flatnonzero((self.bricks.piece == piece) & self.temporary)
        for brick in sorted(mine.tolist(), key=lambda each: self.key[each]):
            self.placed[brick] = False
            self._note(Action.REMOVE, brick, piece, kind=(piece, "remove"))

    def join(self, piece: int) -> None:
        """Put a piece onto the first one."""
        mine = np.flatnonzero(np.array(self.assembly) == piece)
        for brick in mine.tolist():
            self.assembly[brick] = 0
        self._note(Action.JOIN, NOBODY, piece, kind=(piece, "join"))
        for brick in mine.tolist():
            if self.placed[brick]:
                self._offer(brick, 0)

    def moves(self) -> Moves:
        """Return all moves so far."""
        table = np.array(self.rows, dtype=np.int64).reshape(-1, 5)
        return Moves(
            action=table[:, 0].astype(np.uint8),
            brick=table[:, 1].astype(np.int32),
            piece=table[:, 2].astype(np.int16),
            pressed=table[:, 3].astype(bool),
            step=table[:, 4].astype(np.int32),
        )

    def _level(self, piece: int, level: int) -> None:
        """Place what lies on others up to a level, press what hangs under that, and so on until nothing is left."""
        turn = 0
        while True:
            while batch := self._next(self.on_top, level):
                supports = [brick for brick in batch if self.temporary[brick]]
                self._place_all(piece, supports, (level, turn, "support"))
                self._place_all(piece, [brick for brick in batch if not self.temporary[brick]], (level, turn, "on top"))
            batch = self._next(self.from_below, level)
            if not batch:
                return
            # the highest first: what hangs lower may belong under it
            self._place_all(piece, batch[::-1], (level, turn, "from below"))
            turn += 1

    def _next(self, agenda: list[tuple[tuple[int, ...], int]], level: int) -> list[int]:
        """Take out the bricks of an agenda that lie no higher than a level."""
        batch = []
        while agenda and agenda[0][0][0] <= level:
            _, brick = heapq.heappop(agenda)
            if self.waiting[brick]:
                batch.append(brick)
        return list(dict.fromkeys(batch))

    def _place_all(self, piece: int, batch: list[int], kind: object) -> None:
        for brick in batch:
            for each in self._first(brick):
                self._place(each, piece, kind)

    def _first(self, brick: int) -> Iterator[int]:
        """Yield the bricks that must be in place before one, else they would have to be squeezed in, and it."""
        agenda, seen = [brick], {brick}
        while agenda:
            each = agenda[-1]
            # whatever was yielded is in place by now, which may have brought others into a squeeze
            sooner = [one for one in self._squeezed_by(each) if one not in seen] if self.waiting[each] else []
            if sooner:
                seen.update(sooner)
                agenda += sooner
                continue
            agenda.pop()
            if self.waiting[each]:
                yield each

    def _squeezed_by(self, brick: int) -> Iterator[int]:
        """Yield the bricks still to come that lead from one to others in place.

        The last brick that closes such a gap, however high, would be squeezed in.
        """
        assembly = self.assembly[brick]
        for beside, closed in ((self.above, self.under_placed), (self.below, self.over_placed)):
            for one in beside[brick]:
                if self.waiting[one] and self.assembly[one] == assembly and closed[one]:
                    yield one

    def _any(self, bricks: list[int], assembly: int) -> bool:
        """Whether one of some bricks is in place in an assembly."""
        return any(self.placed[brick] and self.assembly[brick] == assembly for brick in bricks)

    def _place(self, brick: int, piece: int, kind: object) -> None:
        pressed = self._any(self.above[brick], self.assembly[brick]) and not self._any(
            self.below[brick], self.assembly[brick]
        )
        self.placed[brick], self.waiting[brick] = True, False
        self._note(Action.PLACE, brick, piece, kind=(piece, kind), pressed=pressed)
        self._offer(brick, self.assembly[brick])

    def _offer(self, brick: int, assembly: int) -> None:
        """Put the neighbours of a brick in place on the agendas, and mark what leads to it."""
        for other in self.above[brick]:
            if self.waiting[other] and self.assembly[other] == assembly:
                heapq.heappush(self.on_top, (self.key[other], other))
        for other in self.below[brick]:
            if self.waiting[other] and self.assembly[other] == assembly:
                heapq.heappush(self.from_below, (self.key[other], other))
        self._mark(brick, assembly, self.below, self.under_placed)
        self._mark(brick, assembly, self.above, self.over_placed)

    def _mark(self, brick: int, assembly: int, beside: list[list[int]], marks: list[bool]) -> None:
        """Mark the bricks still to come that lead to a brick in place, in one direction."""
        agenda = [brick]
        while agenda:
            for other in beside[agenda.pop()]:
                if self.waiting[other] and self.assembly[other] == assembly and not marks[other]:
                    marks[other] = True
                    agenda.append(other)

    def _note(self, action: Action, brick: int, piece: int, *, kind: object, pressed: bool = False) -> None:
        if kind != self.kind:
            self.step += 1
            self.kind = kind
        self.rows.append((action, brick, piece, pressed, self.step))
