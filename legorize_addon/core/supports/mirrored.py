"""Pillars that stay, on mirrored stud squares of a symmetric model.

A pillar goes where it stops the motion of a collapse best, and that motion need
not be symmetric. Mostly another pillar stands near the image of each: one of the
two moves to the image of the other, if the model stands as well so. One that has
no such counterpart gets its image, where that takes few bricks.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Final

import numpy as np

from ..arrays import Ints
from ..building import MirrorPlane, mirror_plane
from ..model import Assembly, Bricks
from ..statics import Stability
from ..units import PLATES_PER_BRICK
from .pillars import Places, kept_pillars, places_below

NEAR: Final = 8
"""Studs by which a pillar lies off the image of its counterpart at most: farther off, it holds another part."""

MORE: Final = 0.01
"""Share of the bricks of the model that images of pillars take at most."""

Propped = tuple[Assembly, Stability]
"""Bricks with pillars behind them, and how they stand."""

_Stand = frozenset[int]
"""Places at which pillars stand, by their rows."""

_Change = tuple[_Stand, tuple[_Stand, ...]]
"""Places that are given up, and those that may take their part, the best first."""


def mirror_pillars(
    model: Assembly, propped: Propped, pillars: Sequence[Bricks], tested: Callable[..., Propped], *, tests: int
) -> Propped:
    """Move pillars to mirrored squares where the model is symmetric and stands as well.

    Parameters
    ----------
    model : Assembly
        What the pillars stand in.
    propped : (Assembly, Stability)
        The model with the pillars behind it, which stands.
    pillars : sequence of Bricks
        A column each.
    tested : callable
        Returns the model with other pillars, and how it stands.
    tests : int
        Times that this is asked at most.

    Returns
    -------
    (Assembly, Stability)
        What stands with the pillars on other squares; as it came if the model is
        not symmetric, or pillars stand on others.
    """
    plane = mirror_plane(model.bricks, model.catalogue)
    if plane is None:
        return propped
    site = _Site(model, plane)
    rows = [site.row_of(pillar) for pillar in pillars]
    if None in rows:
        return propped
    search = _Search(site, propped, frozenset(row for row in rows if row is not None), tested, tests)
    search.make(list(site.moved(search.stand)))
    search.make(list(site.doubled(search.stand)))
    return search.propped


class _Site:
    """Where pillars can stand in a symmetric model."""

    def __init__(self, model: Assembly, plane: MirrorPlane) -> None:
        self.model = model
        self.under: Places = places_below(model, np.ones(len(model), dtype=bool), between=True)
        self.places: Ints = np.stack([self.under.x, self.under.y, self.under.top], axis=1) + model.graph.low
        self.mirrored = self.places.copy()
        self.mirrored[:, plane.axis] = plane.total - self.places[:, plane.axis]
        self.known = {tuple(place): row for row, place in enumerate(self.places.tolist())}
        self.side: Ints = np.sign(2 * self.places[:, plane.axis] - plane.total)

    def row_of(self, pillar: Bricks) -> int | None:
        """Return the place of a pillar, None if there is no brick of the model on it or below it."""
        ends = pillar.corner[:, 2] + self.model.catalogue.height[pillar.part]
        top = int(ends.argmax())
        return self.known.get((*pillar.corner[top, :2].tolist(), int(ends[top])))

    def pillars(self, stand: _Stand) -> list[Bricks]:
        """Return the pillars at some places, from the lowest row."""
        return kept_pillars(self.model, self.under.take(np.array(sorted(stand), dtype=np.int64)))

    def image(self, row: int) -> int | None:
        """Return the place on the mirrored square whose top is nearest, None if none is within a brick's height."""
        here = np.flatnonzero((self.places[:, :2] == self.mirrored[row, :2]).all(axis=1))
        off = np.abs(self.places[here, 2] - self.places[row, 2])
        if not len(here) or off.min() > PLATES_PER_BRICK:
            return None
        return int(here[off.argmin()])

    def lonely(self, stand: _Stand) -> list[int]:
        """Return the places on whose mirrored square is none of them."""
        squares = set(map(tuple, self.places[list(stand), :2].tolist()))
        return [row for row in sorted(stand) if tuple(self.mirrored[row, :2].tolist()) not in squares]

    def moved(self, stand: _Stand) -> Iterator[_Change]:
        """Yield for two places, of which each is near the image of the other, the ways to make them mirrored."""
        lonely = self.lonely(stand)
        ways = sorted(
            (int(np.abs(self.places[one] - self.mirrored[other]).max()), one, other)
            for one in lonely
            for other in lonely
            if self.side[one] < 0 < self.side[other]
        )
        for way, one, other in ways:
            if way > NEAR or not {one, other} <= set(lonely):
                continue
            lonely = [each for each in lonely if each not in (one, other)]
            both = [(each, image) for each in (one, other) if (image := self.image(each)) is not None]
            both.sort(key=lambda rows: int(self.under.length[list(rows)].sum()))
            if both:
                yield frozenset((one, other)), tuple(map(frozenset, both))

    def doubled(self, stand: _Stand) -> Iterator[_Change]:
        """Yield for each place whose image is free that with its image."""
        for row in self.lonely(stand):
            if (image := self.image(row)) is not None:
                yield frozenset((row,)), (frozenset((row, image)),)


class _Search:
    """Pillars on their way to mirrored squares."""

    def __init__(
        self, site: _Site, propped: Propped, stand: _Stand, tested: Callable[..., Propped], tests: int
    ) -> None:
        self.site, self.propped, self.stand, self.tested, self.left = site, propped, stand, tested, tests
        self.most = len(propped[0]) + int(MORE * len(site.model))

    def make(self, changes: Sequence[_Change]) -> None:
        """Make all changes together, or else those of them that can be made one after the other."""
        together = self.stand
        for old, (best, *_) in changes:
            together = together - old | best
        if not changes or self._stands(together):
            return
        for old, ways in changes:
            for way in ways:
                if self._stands(self.stand - old | way):
                    break

    def _stands(self, stand: _Stand) -> bool:
        """Tell whether the model stands with pillars at some places, and if so, leave them there."""
        squares = self.site.places[sorted(stand), :2]
        if not self.left or len(np.unique(squares, axis=0)) < len(squares):
            return False
        pillars = self.site.pillars(stand)
        if len(self.site.model) + sum(map(len, pillars)) > self.most:
            return False
        self.left -= 1
        trial = self.tested(pillars, near=self.propped[1])
        if trial[1].stable:
            self.propped, self.stand = trial, stand
        return bool(trial[1].stable)
