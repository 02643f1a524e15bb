"""The largest model with a number of parts, or for an amount of money.

Parts grow about with the square of the size, but not evenly: a larger model may
have fewer parts. So models are built at sizes that a power law proposes, which goes
through what was built before, and the largest of those that are not above the
number is taken. Most are built in haste, without supports and strong joints, which
add few parts; how many is learned from those that are built whole.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
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
WHOLE: Final = 5
"""Most models built in haste, and built whole."""

_POWER: Final = (1.0, 3.0)
_USUAL_POWER: Final = 2.0
"""Exponents of the power law: of a rod, of a solid body; of a surface, where no two sizes are known yet."""

_STRONG: Final = 5.0
"""Clutch in N with which models built in haste need no strong joints."""

_STEP: Final = 3.0
"""Largest factor from one size to the next one."""

_BESIDE: Final = 1.01
"""Factor to a size beside one that was built already, and would come out the same."""

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
        self._left, self._runs = 1.0, 0
        # scale and amount of what was built in haste, and the factor from there to what is built whole
        self._known: list[tuple[float, float]] = []
        self._more = 1.0

    def best(self) -> Build | None:
        """Return the largest model that was found; None if none is small enough."""
        best, most = None, 0.0
        scale = counted_size(self._mesh, self._settings).scale
        for _ in range(WHOLE):
            scale = self._close(scale)
            build = self._built(scale, hasty=False)
            amount = measured(build, self._settings)
            if most < amount <= self._wanted:
                best, most = build, amount
            if CLOSE * self._wanted <= most:
                break
            self._more = amount / self._known[-1][1]
            scale = self._next_scale()
        return best

    def _close(self, scale: float) -> float:
        """Return a scale at which a model built in haste promises the number, as near as some tries come."""
        for _ in range(HASTY // WHOLE + 1 if self._known else HASTY):
            amount = max(measured(self._built(scale, hasty=True), self._settings), 1e-9)
            self._known.append((scale, amount))
            if CLOSE <= amount * self._more / self._wanted <= 1:
                break
            scale = self._next_scale()
        promising = [known for known in self._known if known[1] * self._more <= self._wanted] or self._known
        nearest = min(promising, key=lambda known: abs(math.log(known[1] * self._more / self._wanted)))
        # the last one is what the next whole model is compared with
        self._known.append(nearest)
        return nearest[0]

    def _built(self, scale: float, *, hasty: bool) -> Build:
        """Build a model of some size."""
        before, self._left, self._runs = self._left, self._left * _LEFT, self._runs + 1
        sized = replace(self._settings, size_by="scale", scale=scale)
        if hasty:
            sized = replace(sized, supports="none", prove_steps=False, clutch=_STRONG, spare=0.0, split=1)
        return self._make(self._mesh, sized, part(self._progress, 1 - before, 1 - self._left))

    def _next_scale(self) -> float:
        """Return the scale at which a power law through the nearest sizes has the number."""
        aim = _AIM * self._wanted / self._more
        near = sorted(set(self._known), key=lambda known: abs(math.log(known[1] / aim)))[:2]
        (scale, found), power = near[0], _USUAL_POWER
        if len(near) > 1 and near[0][1] != near[1][1]:
            power = math.log(near[0][1] / near[1][1]) / math.log(near[0][0] / near[1][0])
        # counts that hardly change, or fall, say nothing of the power
        power = min(max(power, _POWER[0]), _POWER[1])
        scale *= min(max(math.exp(math.log(aim / found) / power), 1 / _STEP), _STEP)
        while any(abs(math.log(scale / known)) < math.log(_BESIDE) / 2 for known, _ in self._known):
            scale *= _BESIDE if aim > found else 1 / _BESIDE
        return scale

    def refusal(self) -> str:
        """Say that no model is small enough."""
        least = min(amount for _, amount in self._known) * self._more
        if self._settings.size_by == "parts":
            return f"parts is {self._settings.parts}, but the smallest model found has {least:.0f}: allow more parts."
        return f"budget is {self._settings.budget:g}, but the cheapest model found costs {least:.2f}: allow more."

    def remark(self, best: Build) -> str:
        """Say what was found."""
        amount, runs = measured(best, self._settings), f"the largest that {self._runs} tries found"
        if self._settings.size_by == "parts" or best.prices is None:
            return f"The model has {amount:.0f} of at most {self._settings.parts} parts, {runs}."
        wanted = best.prices.money(self._settings.budget)
        return f"The model and its supports cost {best.prices.money(amount)} of at most {wanted}, {runs}."
