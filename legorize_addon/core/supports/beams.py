"""Beams and steady pillars: beams cover all that needs support, pillars stand under them, links tie them together.

Along the paper's direction y each row of cells is cut into beams of constant
lengths, neighbouring rows that were cut alike share beams of double width, and
single cells become beams across. Each beam has its pillars, so it needs no
other beam to stand.

References
----------
Paper, section on segmentation: the types of bricks, the distribution along the
length, the pillars' heights, and Figures 21 and 22.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from ..arrays import Ints
from ..units import PLATES_PER_BRICK
from .beam_links import beam_links
from .boxes import TALL, Area, Boxes, boxes_of, cells_of
from .clearance import Clearance
from .columns import Cells, covered, within_clearance

LONGEST: Final = 6
"""Studs of the longest beam."""

_REST: Final = {0: (), 1: (1,), 2: (2,), 3: (3,), 4: (4,), 5: (3, 2), 7: (4, 3)}
"""Beams for what is left of a row beside the longest ones; 7 instead of 6 and a single stud."""

_ENDS_FREE: Final = 4
"""Length in studs from which on a beam's pillars keep away from its ends."""

_PILLAR_SIZES: Final = ((4, 2), (2, 2), (2, 1), (1, 1))


def distribution(length: int) -> list[int]:
    """Cut a row into beams: as many of 6 as can be, then 4, 3 and 2, and none of 1 but for a row of 1.

    Parameters
    ----------
    length : int
        Studs, not negative.

    Returns
    -------
    list of int
        The fewest beams of 6, 4, 3, 2 and 1 that are as long together, the
        longest first; only 6 occurs more than once.

    Examples
    --------
    >>> distribution(13)
    [6, 4, 3]
    """
    longest, rest = divmod(length, LONGEST)
    if rest == 1 and longest:
        longest, rest = longest - 1, rest + LONGEST
    return [LONGEST] * longest + list(_REST[rest])


def beams(cells: Cells, room: Clearance) -> Boxes:
    """Build beams on pillars under cells.

    Parameters
    ----------
    cells : (n, 3) integer array
        Cells (x, y, z) in the room, z the plate on which the carried brick lies.
        Beams end at those without room down to the ground.
    room : Clearance

    Returns
    -------
    (m, 6) int32 array
        Boxes in the room's cells: bricks, tall bricks, and plates of the size of
        a beam between it and what it carries.
    """
    rows: list[tuple[int, int, int, int, int, int]] = []
    by_layer: dict[int, list[Area]] = {}
    for x, y, z, a, b in areas(within_clearance(cells, room)).tolist():
        layer, plates = divmod(z, PLATES_PER_BRICK)
        rows += [(x, y, z - plate - 1, a, b, 1) for plate in range(plates)]
        if layer:
            by_layer.setdefault(layer - 1, []).append((x, y, a, b))
    for layer, laid in by_layer.items():
        rows += [(x, y, layer * PLATES_PER_BRICK, a, b, PLATES_PER_BRICK) for x, y, a, b in laid]
        rows += _standing(laid, layer)
    return boxes_of(rows)


def areas(cells: Cells) -> Ints:
    """Cut the cells of each level into the areas of beams.

    Parameters
    ----------
    cells : (n, 3) integer array
        Cells (x, y, z), each once.

    Returns
    -------
    (m, 5) int64 array
        Lowest x and y, level z, and lengths along x and y of each beam.
    """
    x, y, z, length = _runs(*cells.astype(np.int64).T).T
    single = length == 1
    across_y, across_x, across_z, across = _runs(y[single], x[single], z[single]).T
    pieces = [
        *_cut(np.stack([across_x, across_y, across_z, across, np.ones_like(across)], axis=1), along=3),
        *_cut(_paired(np.stack([x, y, z, np.ones_like(x), length], axis=1)[~single]), along=4),
    ]
    return np.array(pieces, dtype=np.int64).reshape(-1, 5)


def _runs(row: Ints, along: Ints, z: Ints) -> Ints:
    """Return the rows of cells without a gap: number of the row, start, level and length, (n, 4)."""
    order = np.lexsort((along, row, z))
    row, along, z = row[order], along[order], z[order]
    begins = np.ones(len(row), dtype=bool)
    begins[1:] = (np.diff(z) != 0) | (np.diff(row) != 0) | (np.diff(along) != 1)
    start = np.flatnonzero(begins)
    length = np.diff(np.append(start, len(row)))
    return np.stack([row[start], along[start], z[start], length], axis=1).astype(np.int64)


def _paired(runs: Ints) -> Ints:
    """Merge runs along y with equal neighbours at x + 1, two and two from the lowest x."""
    runs = runs[np.lexsort((runs[:, 0], runs[:, 4], runs[:, 1], runs[:, 2]))]
    follows = np.zeros(len(runs), dtype=bool)
    follows[1:] = (np.diff(runs[:, [1, 2, 4]], axis=0) == 0).all(axis=1) & (np.diff(runs[:, 0]) == 1)
    place = np.arange(len(runs))
    odd = (place - np.maximum.accumulate(np.where(follows, 0, place))) % 2 == 1
    paired = runs.copy()
    paired[np.flatnonzero(odd) - 1, 3] = 2
    merged: Ints = paired[~odd]
    return merged


def _cut(runs: Ints, along: int) -> Iterator[list[int]]:
    """Yield the beams of runs whose length stands in a column: 3 along x, 4 along y."""
    for run in runs.tolist():
        for length in distribution(run[along]):
            piece = run.copy()
            piece[along] = length
            yield piece
            run[along - 3] += length


def _standing(laid: list[Area], layer: int) -> Iterator[tuple[int, int, int, int, int, int]]:
    """Yield what stands under the beams of a layer: links right under them, and their pillars."""
    if layer == 0:
        return
    pillars = [pillar for beam in laid for pillar in pillars_of(beam)]
    tied = beam_links(laid, pillars)
    top = (layer - 1) * PLATES_PER_BRICK
    taken = {cell for link in tied for cell in cells_of(link)}
    yield from ((x, y, top, a, b, PLATES_PER_BRICK) for x, y, a, b in tied)
    for pillar in pillars:
        if taken.isdisjoint(cells_of(pillar)):
            yield from _stacked(pillar, layer)
            continue
        # the link is part of the pillar; what it leaves of its top layer is filled
        yield from _stacked(pillar, layer - 1)
        for x, y, a, b in _beside(pillar, taken):
            yield x, y, top, a, b, PLATES_PER_BRICK


def pillars_of(beam: Area) -> list[Area]:
    """Return the pillars of a beam.

    Parameters
    ----------
    beam : tuple of int
        Lowest x and y, and lengths along x and y.

    Returns
    -------
    list of tuple of int
        One in the middle, from the second stud to the second-last one of a long
        beam; under a long beam one stud wide, one at either.
    """
    x, y, a, b = beam
    if a > b:
        return [(at_x, at_y, long, wide) for at_y, at_x, wide, long in pillars_of((y, x, b, a))]
    if b < _ENDS_FREE:
        return [(x, y + (b - a) // 2, a, a)]
    if b == LONGEST and a == 1:
        return [(x, y + 1, 1, 1), (x, y + b - 2, 1, 1)]
    return [(x, y + 1, a, b - 2)]


def _stacked(pillar: Area, layers: int) -> Iterator[tuple[int, int, int, int, int, int]]:
    """Yield the bricks of a pillar: tall ones if it is two studs wide, then single ones."""
    x, y, a, b = pillar
    tall = layers // (TALL // PLATES_PER_BRICK) if min(a, b) > 1 else 0
    yield from ((x, y, each * TALL, a, b, TALL) for each in range(tall))
    for each in range(tall * TALL // PLATES_PER_BRICK, layers):
        yield x, y, each * PLATES_PER_BRICK, a, b, PLATES_PER_BRICK


def _beside(pillar: Area, taken: set[tuple[int, int]]) -> list[Area]:
    """Return the areas of a pillar that are not taken."""
    x, y, a, b = pillar
    left = np.array([[(x + i, y + j) not in taken for i in range(a)] for j in range(b)])
    return [(x + i, y + j, *size) for _, i, j, *size in covered(left[None], _PILLAR_SIZES).tolist()]
