"""The largest model with a number of parts, or for an amount of money.

Parts grow about with the square of the size, but not evenly: a larger model may
have fewer parts. So models are built at sizes that a power law proposes until one is
below the number and one above it, and then at sizes between two neighbours of which
this is true. The largest of those that are not above the number is taken. Most are
built in haste, without supports and strong joints, which add few parts; how many is
learned from those that are built whole.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Final

from .build import Build
from .errors import SettingsError
from .estimate import counted_size
from .mesh import TriangleMesh
from .progress import Progress, part
from .settings import Settings

CLOSE: Final = 0.97
"""Share of the number from which a model is large enough."""

_AIM: Final = 0.985
"""Share of the number that is aimed at: the middle of what is good."""

HASTY: Final = 12
MANY: Final = 30
WORK: Final = 9_000
"""Models built in haste: as many at least; as many at most, while they have no more bricks together than the third."""

LATER: Final = 3
"""Models built in haste after each that is built whole."""

WHOLE: Final = 5
"""Most models built whole."""

_POWER: Final = (1.0, 3.0)
_USUAL_POWER: Final = 2.0
"""Exponents of the power law: of a rod, of a solid body; of a surface, where no two sizes are known yet."""

_STRONG: Final = 5.0
"""Clutch in N with which models built in haste need no strong joints."""

_STEP: Final = 3.0
"""Largest factor from one size to the next one."""

_BESIDE: Final = 1.01
"""Least factor to a size beyond all that were built."""

_FINE: Final = 1.002
"""Factor between two sizes between which no other one is tried: a few hundredths of a stud at twenty."""

_NEAR: Final = 1.25
"""Factor to the number within which a size in between may have it, where none of two neighbours is above it."""

_INSIDE: Final = (0.25, 0.75)
"""Where between two sizes the next one lies, as a share of their distance."""

_LEFT: Final = 0.75
"""Share of the rest of the progress bar that is left after a model."""

Making = Callable[[TriangleMesh, Settings, Progress], Build]


def fit(mesh: TriangleMesh, settings: Settings, make: Making, progress: Progress) -> Build:
    """Build the largest model with at most so many parts, or that costs at most so much.

    Parameters
    ----------
    mesh : TriangleMesh
    settings : Settings
        Its size is set by parts or by a budget.
    make : callable
        Builds a model of a given size.
    progress : Progress

    Returns
    -------
    Build
        With the settings that were given, and a remark on the search.

    Raises
    ------
    SettingsError
        No model is that small, or there is no price file for a budget.
    """
    if settings.size_by == "budget" and not settings.prices:
        raise SettingsError("size_by is 'budget' but prices is empty: give a price file, or set the size otherwise.")
    search = _Search(mesh, settings, make, progress)
    best = search.best()
    if best is None:
        raise SettingsError(search.refusal())
    return replace(best, settings=settings, notes=(*best.notes, search.remark(best)))


def measured(build: Build, settings: Settings) -> float:
    """Return how many parts a model has without its temporary supports, or what it costs with them."""
    if settings.size_by == "parts" or build.prices is None:
        return float(len(build.bricks))
    tables = (build.bricks, build.supports.removed)
    return sum(float(build.prices.each(bricks, build.assembly.catalogue).sum()) for bricks in tables)


class _Search:
    """A search for a size.

    Parameters
    ----------
    mesh, settings, make, progress
        As for :func:`fit`.
    """

    def __init__(self, mesh: TriangleMesh, settings: Settings, make: Making, progress: Progress) -> None:
        self._mesh, self._settings, self._make, self._progress = mesh, settings, make, progress
        self._wanted = float(settings.parts if settings.size_by == "parts" else settings.budget)
        self._left, self._runs, self._bricks = 1.0, 0, 0
        # by scale: the amount of what was built in haste, and of what was built whole; and the factor between them
        self._known: dict[float, float] = {}
        self._whole: dict[float, float] = {}
        self._more, self._most = 1.0, 0.0

    def best(self) -> Build | None:
        """Return the largest model that was found; None if none is small enough."""
        best, scale = None, self._close(counted_size(self._mesh, self._settings).scale)
        while scale is not None:
            build = self._built(scale, hasty=False)
            amount = self._whole[scale] = measured(build, self._settings)
            if self._most < amount <= self._wanted:
                best, self._most = build, amount
            if CLOSE * self._wanted <= self._most or len(self._whole) == WHOLE:
                break
            self._more = max(amount, 1e-9) / self._known[scale]
            scale = self._close(self._next_scale())
        return best

    def _close(self, scale: float) -> float | None:
        """Return a scale at which a model built in haste promises the number, or more than was found so far."""
        tried = 0
        while (good := self._promising(CLOSE)) is None and self._may_try(tried):
            self._known[scale] = max(measured(self._built(scale, hasty=True), self._settings), 1e-9)
            scale, tried = self._next_scale(), tried + 1
        if good is None:
            good = self._promising(self._most / self._wanted)
        # what is built in haste may promise too much: what is just above, if nothing else is known
        above = [each for each in self._known if each not in self._whole]
        if good is None and not self._most and above:
            good = min(above, key=self._known.__getitem__)
        return good

    def _may_try(self, tried: int) -> bool:
        """Tell whether one more model is built in haste."""
        if self._whole:
            return tried < LATER
        return tried < HASTY or (tried < MANY and self._bricks < WORK)

    def _promising(self, share: float) -> float | None:
        """Return the scale, not built whole yet, that promises most of what is above a share of the number."""
        promise = {each: amount * self._more / self._wanted for each, amount in self._known.items()}
        good = [each for each in promise if each not in self._whole and share <= promise[each] <= 1]
        return max(good, key=promise.__getitem__, default=None)

    def _built(self, scale: float, *, hasty: bool) -> Build:
        """Build a model of some size."""
        before, self._left, self._runs = self._left, self._left * _LEFT, self._runs + 1
        sized = replace(self._settings, size_by="scale", scale=scale)
        if hasty:
            sized = replace(sized, supports="none", prove_steps=False, clutch=_STRONG, spare=0.0, split=1)
        build = self._make(self._mesh, sized, part(self._progress, 1 - before, 1 - self._left))
        self._bricks += len(build.bricks) * hasty
        return build

    def _next_scale(self) -> float:
        """Return the scale to try next: between two neighbours if one of them is above the number, else beyond all."""
        scales = sorted(self._known)
        gaps = [(low, high) for low, high in pairwise(scales) if high / low > _FINE]
        most = self._wanted / self._more
        across = [gap for gap in gaps if (self._known[gap[0]] <= most) != (self._known[gap[1]] <= most)]
        if across:
            return self._between(*min(across, key=self._far))
        if all((amount <= most) == (self._known[scales[0]] <= most) for amount in self._known.values()):
            return self._beyond()
        near = [gap for gap in gaps if self._far(gap) < 2 * math.log(_NEAR)]
        if near:
            low, high = max(near, key=lambda gap: gap[1] / gap[0])
            return math.sqrt(low * high)
        return scales[-1] * _BESIDE

    def _far(self, gap: tuple[float, float]) -> float:
        """Return how far the amounts of two scales are from what is aimed at, as the sum of logarithms."""
        return sum(abs(math.log(self._known[scale] / self._aim)) for scale in gap)

    @property
    def _aim(self) -> float:
        """What a model built in haste shall have."""
        return _AIM * self._wanted / self._more

    def _between(self, low: float, high: float) -> float:
        """Return where a power law through two scales has the number."""
        below, above = (math.log(self._known[scale]) for scale in (low, high))
        share = (math.log(self._aim) - below) / (above - below)
        share = min(max(share, _INSIDE[0]), _INSIDE[1])
        return low * math.exp(share * math.log(high / low))

    def _beyond(self) -> float:
        """Return the scale, larger or smaller than all, at which a power law through the nearest has the number."""
        near = sorted(self._known, key=lambda scale: abs(math.log(self._known[scale] / self._aim)))[:2]
        found, power = self._known[near[0]], _USUAL_POWER
        if len(near) > 1 and self._known[near[1]] != found:
            power = math.log(found / self._known[near[1]]) / math.log(near[0] / near[1])
        # counts that hardly change, or fall, say nothing of the power
        power = min(max(power, _POWER[0]), _POWER[1])
        factor = min(max(math.exp(math.log(self._aim / found) / power), 1 / _STEP), _STEP)
        if found <= self._wanted / self._more:
            return max(near[0] * factor, max(self._known) * _BESIDE)
        return min(near[0] * factor, min(self._known) / _BESIDE)

    def refusal(self) -> str:
        """Say that no model is small enough."""
        least = min((*self._whole.values(), *(amount * self._more for amount in self._known.values())))
        if self._settings.size_by == "parts":
            return f"parts is {self._settings.parts}, but the smallest model found has {least:.0f}: allow more parts."
        return f"budget is {self._settings.budget:g}, but the cheapest model found costs {least:.2f}: allow more."

    def remark(self, best: Build) -> str:
        """Say what was found, and what the next larger model would have if this one is far below the number."""
        amount, runs = measured(best, self._settings), f"the largest that {self._runs} tries found"
        above = self._above() if amount < CLOSE * self._wanted else None
        if self._settings.size_by == "parts" or best.prices is None:
            more = "" if above is None else f"; the next larger size has about {above:.0f}"
            return f"The model has {amount:.0f} of at most {self._settings.parts} parts, {runs}{more}."
        wanted, money = best.prices.money(self._settings.budget), best.prices.money
        more = "" if above is None else f"; the next larger size costs about {money(above)}"
        return f"The model and its supports cost {money(amount)} of at most {wanted}, {runs}{more}."

    def _above(self) -> float | None:
        """Return the least amount above the number that was found."""
        found = {each: amount * self._more for each, amount in self._known.items()} | self._whole
        return min((amount for amount in found.values() if amount > self._wanted), default=None)
