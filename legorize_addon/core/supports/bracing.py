"""Pillars that stay where a whole model would fall: under what tips over, and under what tears off.

What falls moves in a way that no forces stop; what may fall yields most in the
motion with which the search for forces ended. A pillar below a place that sinks
in that motion stops it, so each round adds some under what tips over, or one
under every part that sinks fast, until forces in balance are found: the cutting
plane method (Kelley 1960) with pillars for cuts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any, Final

import numpy as np

from ..arrays import Floats, Ints
from ..geometry import corners, inside
from ..model import (
    NOBODY,
    Assembly,
    Bricks,
    ContactGraph,
    Verdict,
    column_facts,
    components,
    stud_columns,
)
from ..progress import Progress, silent
from ..statics import SOON, SPARE, Effort, Stability, Statics, stability, torn_by
from .mirrored import Propped, mirror_pillars
from .pillars import Places, kept_pillars, places_below

ROUNDS: Final = 8
"""Times that pillars are added before a model is given up."""

WORK: Final = 100_000
"""Bricks tested in all these rounds, and again while pillars are left out: a large model takes fewer rounds."""

MOVING: Final = 1e-3
"""Share of the fastest motion from which on a brick counts as moving."""

FAST: Final = 0.2
"""Share of the fastest sinking place from which on a part gets its pillar at once; others may not need any."""

SOONER: Final = 2.0
"""By what that share falls from round to round, so that all comes to rest soon."""

SINKING: Final = 0.5
"""Share of the fastest sinking place of a part from which on a shorter pillar is as good."""

SPARING: Final = 8
SPARED: Final = 6_000
"""Times that pillars are left out again to see if the model stands without them, half as many where forces lean,
which takes longer; and bricks tested in all of these up to which one pillar is tried after the other: small models."""

STEADY: Final = 1.0
"""Studs that the weight of what tips over shall come to lie inside of its feet."""


def add_bracing(
    assembly: Assembly,
    found: Stability | None,
    *,
    clutch: float,
    spare: float = SPARE,
    known: Stability | None = None,
    progress: Progress = silent,
) -> tuple[Assembly, Stability]:
    """Put pillars under what falls, or has nothing to spare, if it is proven to stand by its studs with them.

    Parameters
    ----------
    assembly : Assembly
        A model in which nothing floats.
    found : Stability or None
        How it stands by its studs; None if that is to be tested only where it matters.
    clutch : float
        Pull in N that one contact point bears.
    spare : float
        Share of it that is to be left unused, if there are places for pillars enough.
    known : Stability, optional
        How the same bricks stand with that share left, if that was tested.
    progress : Progress
        Told how far the search is.

    Returns
    -------
    assembly : Assembly
        All that came in, in their order, and then the pillars, ``SUPPORT_KEPT``;
        as they came where no pillars are found with which the model stands better.
    found : Stability
        How they stand; of what does not by its studs, whether neighbours hold it.
    """
    if found is not None and found.stable and found.margin.min(initial=1.0) >= spare:
        return assembly, found
    judged = partial(stability, clutch=clutch, progress=progress)
    tested = partial(_tested, assembly, near=found, progress=progress)
    pillars: list[Bricks] = []
    aimed = (1 - spare) * clutch
    first = tested(pillars, clutch=aimed) if known is None else (assembly, known)
    propped = _with_more(partial(tested, clutch=aimed), partial(tested, clutch=clutch), first, pillars)
    if not propped[1].stable:
        found = found or judged(assembly, effort=Effort(near=known, programme=0, neighbours=False))
        if found.stable:
            return assembly, found
        propped = tested(pillars, clutch=clutch, near=propped[1])
        if not propped[1].stable:
            return assembly, judged(assembly)
        # what is left unused shall not shrink while pillars are left out
        aimed = (1 - min(float(propped[1].margin.min(initial=spare)), spare)) * clutch
    tested = partial(tested, clutch=aimed)
    fewer, pillars = _with_fewer(propped, pillars, tested)
    if pillars:
        # the model takes as many tests to be mirrored as it took to leave pillars out
        fewer = mirror_pillars(assembly, fewer, pillars, tested, tests=_turns(fewer))
    more, proof = fewer
    return more, judged(more, effort=Effort(near=proof))


def _with_more(
    tested: Callable[..., Propped], at_all: Callable[..., Propped], propped: Propped, pillars: list[Bricks]
) -> Propped:
    """Put pillars under what yields, round after round, until the model stands or there is no place for more.

    Where it stays open whether as much is left unused as is wanted, and the model stands ``at_all``, there are no more:
    many pillars would only prove sooner what a few may bear as well.
    """
    for turn in range(min(ROUNDS, WORK // max(len(propped[0]), 1))):
        if propped[1].stable:
            break
        if propped[1].standing is Verdict.UNDECIDED and at_all(pillars, near=propped[1], rounds=1)[1].stable:
            break
        places = _chosen(*propped, fast=FAST / SOONER**turn)
        if not len(places):
            break
        pillars += kept_pillars(propped[0], places)
        propped = tested(pillars, near=propped[1])
    return propped


def _tested(
    assembly: Assembly,
    pillars: Sequence[Bricks],
    *,
    clutch: float,
    progress: Progress,
    **effort: Any,
) -> Propped:
    """Return bricks with pillars behind them, and how they stand by their studs alone."""
    more = assembly.with_more(pillars)
    chosen = Effort(**{"aims": SOON, "programme": 0, "neighbours": False, **effort})
    return more, stability(more, clutch=clutch, effort=chosen, progress=progress)


def _turns(propped: Propped) -> int:
    """Return the number of times that pillars are left out or moved to see if the model stands so."""
    n_bricks = len(propped[0])
    turns = SPARING if propped[1].upright else SPARING // 2
    return min(max(turns, SPARED // n_bricks), WORK // n_bricks)


def _with_fewer(
    propped: Propped, pillars: list[Bricks], tested: Callable[..., Propped]
) -> tuple[Propped, list[Bricks]]:
    """Leave out what bears least: half of the pillars, and ever fewer of them where the model would not stand."""
    if not pillars:
        return propped, pillars
    n_bricks = len(propped[0])
    share, needed = len(pillars) // 2, np.zeros(len(pillars), dtype=bool)
    for number in range(_turns(propped)):
        pillar = _pillar_of(propped, pillars)
        order = np.lexsort((_loads(propped[1], pillar, len(pillars)), needed))
        share = min(share, int(np.count_nonzero(~needed)))
        if not share or (needed.any() and number * n_bricks > SPARED):
            break
        left = np.ones(len(pillars) + 1, dtype=bool)
        left[order[:share]] = False
        fewer = [each for each, stays in zip(pillars, left, strict=False) if stays]
        # with the pillars left out, the forces of the proof are nearly in balance
        without = tested(fewer, near=propped[1], rounds=1)
        if without[1].stable:
            propped, pillars, needed = without, fewer, needed[left[:-1]]
            share = min(share, len(fewer) // 2)
        elif share == 1:
            needed[order[0]] = True
        else:
            share //= 2
    return propped, pillars


def _pillar_of(propped: Propped, pillars: Sequence[Bricks]) -> Ints:
    """Return in which pillar the two bricks of each contact lie, (2, k); behind the last for bricks of the model."""
    bricks, found = propped
    lengths = [len(each) for each in pillars]
    pillar = np.full(len(bricks) + 1, len(pillars))
    pillar[len(bricks) - sum(lengths) : -1] = np.repeat(np.arange(len(pillars)), lengths)
    contacts, rows = found.statics.contacts, np.append(found.statics.rows, len(bricks))
    # NOBODY is the last row
    of_both: Ints = pillar[np.stack([rows[contacts.on], rows[contacts.by]])]
    return of_both


def _loads(found: Stability, pillar: Ints, n_pillars: int) -> Floats:
    """Return what lies on each pillar in N, under the forces of the proof."""
    on, by = pillar
    upward = found.forces * found.statics.contacts.direction[:, 2] * (on != by)
    return np.bincount(by, upward, n_pillars + 1)[:-1]


def _chosen(assembly: Assembly, found: Stability, *, fast: float) -> Places:
    """Return where pillars go next: under each piece that tips over, or else under each part that sinks."""
    tipping = np.flatnonzero(found.tipping < 0).tolist()
    under = places_below(assembly, np.abs(found.yielding).max(axis=1) > MOVING)
    if tipping:
        chosen = [place for body in tipping for place in _steadying(assembly, body, under)]
        return under.take(np.array(chosen, dtype=np.int64))
    sinking = _sinking(assembly.graph, found.statics, found.yielding, under)
    part = _parts(assembly.graph, found)[under.brick]
    fastest: list[int] = []
    for number in np.unique(part[sinking > fast * sinking.max(initial=MOVING)]):
        rows = np.flatnonzero(part == number)
        rows = rows[sinking[rows] >= SINKING * sinking[rows].max()]
        fastest.append(int(rows[np.lexsort((-sinking[rows], under.length[rows]))[0]]))
    return under.take(_apart(under, np.array(fastest, dtype=np.int64)))


def _steadying(assembly: Assembly, body: int, under: Places) -> Iterator[int]:
    """Yield places at which pillars to the ground keep a piece that tips over upright, one after the other."""
    mine = assembly.graph.component == body
    brick, columns = stud_columns(assembly.bricks, assembly.catalogue)
    foot = column_facts(assembly.bricks, assembly.catalogue).foot
    standing = mine[brick] & foot & (columns[:, 2] == assembly.bricks.corner[:, 2].min())
    feet = columns[standing, :2] - assembly.graph.low[:2]
    squares = [(int(x), int(y)) for x, y in feet]
    below = list(zip(under.x.tolist(), under.y.tolist(), strict=True))
    middle = assembly.take(mine).centre_of_mass - assembly.graph.low[:2]
    left = np.flatnonzero(mine[under.brick] & ~under.on_brick)
    steady = inside(corners(squares), middle)
    while steady < STEADY and len(left):
        after = np.array([inside(corners([*squares, below[each]]), middle) for each in left])
        best = int(np.lexsort((under.length[left], -np.minimum(after, STEADY)))[0])
        if after[best] <= steady:
            return
        steady = float(after[best])
        squares.append(below[left[best]])
        yield int(left[best])


def _parts(graph: ContactGraph, found: Stability) -> Ints:
    """Return what each brick stays together with as the model yields: contacts hold that do not tear, (n,)."""
    n = len(found.yielding)
    torn = torn_by(found.statics, found.yielding) @ (n, 1)
    moving = (np.abs(found.yielding) > MOVING).any(axis=1)[graph.pairs].all(axis=1)
    kept = moving & ~np.isin(graph.pairs.astype(np.int64) @ (n, 1), torn)
    return components(graph.pairs[kept], n).astype(np.int64)


def _sinking(graph: ContactGraph, equations: Statics, motion: Floats, under: Places) -> Floats:
    """Return how fast the gap that a pillar would fill closes, (k,)."""
    foot = under.top - under.length - 1
    below = graph.owner[foot, under.y, under.x].astype(np.int64)
    closing = -_rising(equations, motion, graph, under.brick, under)
    return np.where(under.on_brick, closing + _rising(equations, motion, graph, below, under), closing)


def _rising(equations: Statics, motion: Floats, graph: ContactGraph, brick: Ints, under: Places) -> Floats:
    """Return the upward velocity of bricks over the middles of stud squares, (k,); 0 where there is no brick."""
    middle = np.zeros((len(motion), 3))
    middle[equations.rows] = equations.middle
    x, y = under.x + graph.low[0] + 0.5, under.y + graph.low[1] + 0.5
    _, _, upward, about_x, about_y, _ = motion[brick].T
    rising: Floats = upward + about_x * (y - middle[brick, 1]) - about_y * (x - middle[brick, 0])
    return np.where(brick == NOBODY, 0.0, rising)


def _apart(under: Places, chosen: Ints) -> Ints:
    """Return places in columns of their own, the first of each column."""
    _, first = np.unique(np.stack([under.x[chosen], under.y[chosen]]), axis=1, return_index=True)
    return chosen[np.sort(first)]
