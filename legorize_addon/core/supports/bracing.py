"""Posts that stay where a whole model would fall: under what tips over, and under what tears off.

What falls moves in a way that no forces stop; what may fall yields most in the
motion with which the search for forces ended. A post below a place that sinks
in that motion stops it, so each round adds some under what tips over, or one
under every part that sinks fast, until forces in balance are found: the cutting
plane method (Kelley 1960) with posts for cuts.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Final

import numpy as np

from ..arrays import Floats, Ints
from ..geometry import corners, inside
from ..model import NOBODY, Bricks, Catalogue, Connection, Verdict, components, connect, joined, stud_columns
from ..progress import Progress, silent
from ..statics import AIMS, Aim, Stability, Statics, stability, torn_by
from .pillars import Places, kept_post, middle_of_weight, places_below

ROUNDS: Final = 8
"""Times that posts are added before a model is given up."""

WORK: Final = 100_000
"""Bricks tested in all these rounds together, and again while posts are left out: a large model takes fewer rounds."""

MOVING: Final = 1e-3
"""Share of the fastest motion from which on a brick counts as moving."""

FAST: Final = 0.2
"""Share of the fastest sinking place from which on a part gets its post at once; others may not need any."""

SOONER: Final = 2.0
"""By what that share falls from round to round, so that all comes to rest soon."""

SINKING: Final = 0.5
"""Share of the fastest sinking place of a part from which on a shorter post is as good."""

SPARING: Final = 8
SPARED: Final = 6_000
"""Times that posts are left out again to see if the model stands without them; and bricks
tested in all of these up to which one post is tried after the other: small models take it."""

PATIENCE: Final = 60
"""Projections more than with all posts to look for a proof without some of them."""

STEADY: Final = 1.0
"""Studs that the weight of what tips over shall come to lie inside of its feet."""

Propped = tuple[Bricks, Connection, Stability]
"""Bricks with posts behind them, their connection, and how they stand."""


def with_falling_propped(
    bricks: Bricks,
    catalogue: Catalogue,
    connection: Connection,
    found: Stability,
    *,
    hold: float,
    progress: Progress = silent,
) -> tuple[Bricks, Connection, Stability]:
    """Put posts under what falls, if it is proven to stand with them.

    Parameters
    ----------
    bricks : Bricks
        A model in which nothing floats.
    catalogue : Catalogue
    connection : Connection
        Of these bricks.
    found : Stability
        How they stand.
    hold : float
        Pull in N that one contact point bears.
    progress : Progress
        Told how far the search is.

    Returns
    -------
    bricks : Bricks
        All that came in, in their order, and then the posts, ``SUPPORT_KEPT``;
        as they came where no posts are found with which the model stands.
    connection : Connection
        Of those.
    found : Stability
        How they stand.
    """
    tested = partial(_tested, bricks, catalogue=catalogue, hold=hold, progress=progress)
    posts: list[Bricks] = []
    propped = bricks, connection, found
    for turn in range(min(ROUNDS, WORK // max(len(bricks), 1))):
        if propped[2].standing is Verdict.STABLE:
            break
        places = _chosen(*propped, catalogue, fast=FAST / SOONER**turn)
        if not len(places):
            break
        posts += [kept_post(propped[0], propped[1], catalogue, places, number) for number in range(len(places))]
        propped = tested(posts)
    if not propped[2].stable:
        return bricks, connection, found
    return _with_fewer(propped, posts, tested)


def _tested(
    bricks: Bricks,
    posts: Sequence[Bricks],
    *,
    catalogue: Catalogue,
    hold: float,
    progress: Progress,
    aims: tuple[Aim, ...] = AIMS,
    start: Floats | None = None,
) -> Propped:
    """Return bricks with posts behind them, and how they stand."""
    more = joined([bricks, *posts])
    connection = connect(more, catalogue)
    found = stability(more, catalogue, connection, hold=hold, aims=aims, start=start, programme=0, progress=progress)
    return more, connection, found


def _with_fewer(propped: Propped, posts: Sequence[Bricks], tested: Callable[..., Propped]) -> Propped:
    """Leave out what bears least: half of the posts, and ever fewer of them where the model would not stand."""
    aims = (AIMS[-1]._replace(turns=PATIENCE + propped[2].iterations),)
    n_bricks = len(propped[0])
    share, needed = len(posts) // 2, np.zeros(len(posts), dtype=bool)
    for number in range(min(max(SPARING, SPARED // n_bricks), WORK // n_bricks)):
        post = _post_of(propped, posts)
        order = np.lexsort((_loads(propped[2], post, len(posts)), needed))
        share = min(share, int(np.count_nonzero(~needed)))
        if not share or (needed.any() and number * n_bricks > SPARED):
            break
        left = np.ones(len(posts) + 1, dtype=bool)
        left[order[:share]] = False
        fewer = [each for each, stays in zip(posts, left, strict=False) if stays]
        # with the posts left out, the forces of the proof are nearly in balance
        near = propped[2].forces[left[post].all(axis=0)]
        without = tested(fewer, aims=aims, start=near)
        if without[2].stable:
            propped, posts, needed = without, fewer, needed[left[:-1]]
            share = min(share, len(fewer) // 2)
        elif share == 1:
            needed[order[0]] = True
        else:
            share //= 2
    return propped


def _post_of(propped: Propped, posts: Sequence[Bricks]) -> Ints:
    """Return in which post the two bricks of each contact lie, (2, k); behind the last for bricks of the model."""
    bricks, _, found = propped
    lengths = [len(each) for each in posts]
    post = np.full(len(bricks) + 1, len(posts))
    post[len(bricks) - sum(lengths) : -1] = np.repeat(np.arange(len(posts)), lengths)
    contacts, rows = found.statics.contacts, np.append(found.statics.rows, len(bricks))
    # NOBODY is the last row
    of_both: Ints = post[np.stack([rows[contacts.on], rows[contacts.by]])]
    return of_both


def _loads(found: Stability, post: Ints, n_posts: int) -> Floats:
    """Return what lies on each post in N, under the forces of the proof."""
    on, by = post
    upward = found.forces * found.statics.contacts.direction[:, 2] * (on != by)
    return np.bincount(by, upward, n_posts + 1)[:-1]


def _chosen(bricks: Bricks, connection: Connection, found: Stability, catalogue: Catalogue, *, fast: float) -> Places:
    """Return where posts go next: under each piece that tips over, or else under each part that sinks."""
    tipping = np.flatnonzero(found.tipping < 0).tolist()
    under = places_below(bricks, catalogue, connection, np.abs(found.yielding).max(axis=1) > MOVING)
    if tipping:
        chosen = [place for body in tipping for place in _steadying(bricks, connection, catalogue, body, under)]
        return under.take(np.array(chosen, dtype=np.int64))
    sinking = _sinking(connection, found.statics, found.yielding, under)
    part = _parts(connection, found)[under.brick]
    fastest: list[int] = []
    for number in np.unique(part[sinking > fast * sinking.max(initial=MOVING)]):
        rows = np.flatnonzero(part == number)
        rows = rows[sinking[rows] >= SINKING * sinking[rows].max()]
        fastest.append(int(rows[np.lexsort((-sinking[rows], under.length[rows]))[0]]))
    return under.take(_apart(under, np.array(fastest, dtype=np.int64)))


def _steadying(bricks: Bricks, connection: Connection, catalogue: Catalogue, body: int, under: Places) -> Iterator[int]:
    """Yield places at which posts to the ground keep a piece that tips over upright, one after the other."""
    mine = connection.component == body
    brick, columns = stud_columns(bricks, catalogue)
    feet = columns[mine[brick] & (columns[:, 2] == bricks.corner[:, 2].min()), :2] - connection.low[:2]
    squares = [(int(x), int(y)) for x, y in feet]
    below = list(zip(under.x.tolist(), under.y.tolist(), strict=True))
    middle = middle_of_weight(bricks.take(mine), catalogue) - connection.low[:2]
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


def _parts(connection: Connection, found: Stability) -> Ints:
    """Return what each brick stays together with as the model yields: contacts hold that do not tear, (n,)."""
    n = len(found.yielding)
    torn = torn_by(found.statics, found.yielding) @ (n, 1)
    moving = (np.abs(found.yielding) > MOVING).any(axis=1)[connection.pairs].all(axis=1)
    kept = moving & ~np.isin(connection.pairs.astype(np.int64) @ (n, 1), torn)
    return components(connection.pairs[kept], n).astype(np.int64)


def _sinking(connection: Connection, equations: Statics, motion: Floats, under: Places) -> Floats:
    """Return how fast the gap that a post would fill closes, (k,)."""
    foot = under.top - under.length - 1
    below = connection.owner[foot, under.y, under.x].astype(np.int64)
    closing = -_rising(equations, motion, connection, under.brick, under)
    return np.where(under.on_brick, closing + _rising(equations, motion, connection, below, under), closing)


def _rising(equations: Statics, motion: Floats, connection: Connection, brick: Ints, under: Places) -> Floats:
    """Return the upward velocity of bricks over the middles of stud squares, (k,); 0 where there is no brick."""
    middle = np.zeros((len(motion), 3))
    middle[equations.rows] = equations.middle
    x, y = under.x + connection.low[0] + 0.5, under.y + connection.low[1] + 0.5
    _, _, upward, about_x, about_y = motion[brick].T
    rising: Floats = upward + about_x * (y - middle[brick, 1]) - about_y * (x - middle[brick, 0])
    return np.where(brick == NOBODY, 0.0, rising)


def _apart(under: Places, chosen: Ints) -> Ints:
    """Return places in columns of their own, the first of each column."""
    _, first = np.unique(np.stack([under.x[chosen], under.y[chosen]]), axis=1, return_index=True)
    return chosen[np.sort(first)]
