"""Linking bricks: one layer under two beams side by side, they keep the beams' pillars from falling apart.

References
----------
Paper, section on segmentation and Figure 21: which bricks link short and long
beams, at their barycentre, and never by one stud of a beam of four or more.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final

from scipy.cluster.hierarchy import DisjointSet

from .boxes import Area, cells_of

LONG: Final = 4
"""Studs from which on a beam is never linked by a single one of its studs."""

OFF: Final = 1.0
"""Studs, along x and along y, that a link may lie off the barycentre of its two beams."""

_NARROW: Final = ((2, 1), (4, 1))
_WIDE: Final = ((2, 2), (4, 2))


def beam_links(beams: Sequence[Area], pillars: Sequence[Area]) -> list[Area]:
    """Link the beams of one layer, each to what it is not linked to already.

    Parameters
    ----------
    beams : sequence of tuple of int
        Beams that do not overlap.
    pillars : sequence of tuple of int
        What stands under them in the layer of the links: each link lies over one.

    Returns
    -------
    list of tuple of int
        Links that do not overlap, each within two beams.
    """
    steady = {cell for pillar in pillars for cell in cells_of(pillar)}
    owner = {cell: row for row, beam in enumerate(beams) for cell in cells_of(beam)}
    pairs = _neighbours(beams, owner)
    n_pairs = Counter(row for pair in pairs for row in pair)
    linked, taken, found = DisjointSet(range(len(beams))), set[tuple[int, int]](), []
    for one, other in pairs:
        if linked.connected(one, other):
            continue
        # in a row of beams each one leaves room for the next link
        aside = max(n_pairs[one], n_pairs[other]) > 1
        for link in _places(beams[one], beams[other], aside=aside):
            cells = set(cells_of(link))
            if taken.isdisjoint(cells) and not steady.isdisjoint(cells):
                linked.merge(one, other)
                taken |= cells
                found.append(link)
                break
    return found


def _neighbours(beams: Sequence[Area], owner: dict[tuple[int, int], int]) -> list[tuple[int, int]]:
    """Return the pairs of beams that touch along a side."""
    pairs = set()
    for (x, y), row in owner.items():
        for beside in ((x + 1, y), (x, y + 1)):
            other = owner.get(beside, row)
            if other != row:
                pairs.add((min(row, other), max(row, other)))
    return sorted(pairs, key=lambda pair: (beams[pair[0]], beams[pair[1]]))


def _places(one: Area, other: Area, *, aside: bool) -> Iterator[Area]:
    """Yield places of a link of two beams: recommended bricks first, then the nearest the centre, or the farthest."""
    cells = [set(cells_of(one)), set(cells_of(other))]
    least = [2 if max(beam[2:]) >= LONG else 1 for beam in (one, other)]
    centre = _barycentre(one, other)
    along_y = one[0] < other[0] + other[2] and other[0] < one[0] + one[2]
    # the paper takes 1 x 2 and 1 x 4 up to a length of four, 2 x 2 and 4 x 2 for six
    kinds = (_NARROW, _WIDE) if max(*one[2:], *other[2:]) <= LONG else (_WIDE, _NARROW)
    for sizes in kinds:
        near = []
        for long, wide in sizes:
            a, b = (wide, long) if along_y else (long, wide)
            for x, y in cells[0] | cells[1]:
                off = max(abs(x + a / 2 - centre[0]), abs(y + b / 2 - centre[1]))
                held = [len(each.intersection(cells_of((x, y, a, b)))) for each in cells]
                if off <= OFF and sum(held) == a * b and held[0] >= least[0] and held[1] >= least[1]:
                    near.append((-off if aside else off, -long, (x, y, a, b)))
        yield from (link for *_, link in sorted(near))


def _barycentre(one: Area, other: Area) -> tuple[float, float]:
    """Return the common barycentre of two beams."""
    weights = [beam[2] * beam[3] for beam in (one, other)]
    x, y = (
        sum(w * (beam[axis] + beam[axis + 2] / 2) for w, beam in zip(weights, (one, other), strict=True)) / sum(weights)
        for axis in (0, 1)
    )
    return x, y
