"""Whether a piece and its supports keep their balance as they grow, and which undersides need one more support.

The steps say when each brick comes, and to plan them takes longer than all else here. Supports that are added in one
round change little of them: so whether these are enough is asked of the steps that were planned before, in which new
supports come right before what they carry. What stands then is asked of steps planned anew, which decide.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ..arrays import Ints
from ..building import (
    STEADY,
    BuildingContacts,
    Steps,
    Tipping,
    building_contacts,
    falling,
    no_prop,
    plan_steps,
    tipping,
)
from ..geometry import beyond, corners, hull, inside_with
from ..model import Assembly, Bricks, Rows, concatenate
from ..progress import Progress, part
from .demand import Demand

ENOUGH: Final = 1.0
"""Studs inside of its feet from which on a tower is as steady as it needs to be."""


@dataclass(frozen=True, slots=True, eq=False)
class Grown:
    """How a piece grows with some supports.

    Attributes
    ----------
    towers : list of Tipping
        What falls over on the way; the rows count the bricks of the piece and then the supports.
    braces : list of int
        Undersides at which supports save others.
    steps : Steps or None
        In which all is built; None if they were not planned anew.
    contacts : BuildingContacts
        Of piece and supports.
    """

    towers: list[Tipping]
    braces: list[int]
    steps: Steps | None
    contacts: BuildingContacts


class Growth:
    """A piece on its way to supports with which it grows steadily.

    Parameters
    ----------
    assembly : Assembly
        The piece, n bricks.
    need : Demand
        Its undersides.

    Attributes
    ----------
    arrival : (n,) int64 array or None
        Steps in which its bricks come, as they were planned last.
    """

    def __init__(self, assembly: Assembly, need: Demand) -> None:
        self.assembly, self.need = assembly, need
        self.arrival: Ints | None = None
        # whether supports are enough is asked twice: of steps planned before, and of their own
        self._last: tuple[Bricks, Assembly, BuildingContacts] | None = None

    @property
    def known(self) -> bool:
        """Whether steps were planned before."""
        return self.arrival is not None

    def with_supports(self, supports: Bricks, touched: Rows, *, add: bool, planned: bool, progress: Progress) -> Grown:
        """Return what falls over, and what undersides, if some may be added, save more.

        Parameters
        ----------
        supports : Bricks
        touched : (k, 3) int32 array
            Cells of the room where they touch the piece.
        add : bool
            Whether undersides are looked for.
        planned : bool
            Whether steps are planned anew; else those planned before count.
        progress : Progress
        """
        everything, contacts = self._together(supports)
        bricks, temporary = everything.bricks, np.arange(len(everything)) >= len(self.assembly)
        braces: list[int] = []

        def prop(tower: Tipping) -> tuple[int, int] | None:
            """Note the underside that saves a tower."""
            best = _steadying(tower, touched, self.need, braces)
            if best is None:
                return None
            braces.append(best)
            x, y = (self.need.undersides[best] + self.need.room.low)[:2].tolist()
            return x, y

        asked = prop if add else no_prop
        if planned or self.arrival is None:
            ordering, watching = part(progress, 0.0, 0.5), part(progress, 0.5, 1.0)
            steps = plan_steps(bricks, everything.catalogue, contacts.pairs, temporary=temporary, progress=ordering)
            self.arrival = steps.arrival(len(bricks))[: len(self.assembly)].astype(np.int64)
            towers = tipping(steps, everything, contacts.pairs, prop=asked, progress=watching)
            return Grown(towers, braces, steps, contacts)
        arrivals = _guessed(self.arrival, bricks, contacts)
        floor = int(bricks.corner[:, 2].min(initial=0))
        towers = falling(arrivals, everything, contacts.pairs, floor=floor, prop=asked, progress=progress)
        return Grown(towers, braces, None, contacts)

    def _together(self, supports: Bricks) -> tuple[Assembly, BuildingContacts]:
        """Return the piece with some supports, and their contacts."""
        if self._last is None or self._last[0] is not supports:
            bricks = concatenate([self.assembly.bricks, supports])
            everything = Assembly(bricks, self.assembly.catalogue)
            temporary = np.arange(len(bricks)) >= len(self.assembly)
            contacts = building_contacts(everything, temporary=temporary, model=self.assembly.graph)
            self._last = supports, everything, contacts
        return self._last[1:]


def _guessed(arrival: Ints, bricks: Bricks, contacts: BuildingContacts) -> list[tuple[int, list[int]]]:
    """Return when all bricks arrive: supports, which come last in the table, right before what lies on them."""
    n = len(arrival)
    # room for a step before each one
    step = np.full(len(bricks), np.iinfo(np.int64).max)
    step[:n] = 2 * arrival + 1
    lower, upper = contacts.pairs[contacts.pairs[:, 0] >= n].T
    # what lies higher first: it hands its own down
    order = np.argsort(-bricks.corner[upper, 2], kind="stable")
    for below, above in zip(lower[order].tolist(), upper[order].tolist(), strict=True):
        step[below] = min(step[below], step[above] - (above < n))
    # what carries nothing is there from the beginning
    step[step == np.iinfo(np.int64).max] = 0
    rows = np.argsort(step, kind="stable")
    ends = np.flatnonzero(np.diff(step[rows])) + 1
    return [(int(step[group[0]]), group.tolist()) for group in np.split(rows, ends) if len(group)]


def _steadying(tower: Tipping, touched: Rows, need: Demand, braces: Sequence[int]) -> int | None:
    """Return the underside at which a support keeps a tower upright best, if one helps."""
    under = np.flatnonzero(np.isin(need.over, tower.bricks))
    taken = np.concatenate([touched, need.undersides[list(braces)]])[:, :2]
    under = under[~(need.undersides[under, None, :2] == taken[None]).all(axis=2).any(axis=1)]
    cells = need.undersides[under] + need.room.low
    outline = hull(tower.feet)
    squares = corners(cells[:, :2]).reshape(4, -1, 2).transpose(1, 0, 2)
    # what stands on the feet already changes nothing
    wider = (squares @ outline[:, :2].T + outline[:, 2] > 0).any(axis=(1, 2))
    under, cells, squares = under[wider], cells[wider], squares[wider]
    before = -beyond(outline, tower.middle).max()
    after = inside_with(tower.feet, squares, tower.middle)
    if not len(after) or after.max() <= before + STEADY:
        return None
    return int(under[np.lexsort((cells[:, 2], -np.minimum(after, ENOUGH)))[0]])
