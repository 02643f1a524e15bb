"""Links between beams: which bricks, where, and on how many studs."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given

from legorize_addon.core.supports.beam_links import LONG, OFF, beam_links
from legorize_addon.core.supports.beams import areas, pillars_of
from tests.core.supports.places import ceilings


def linked(*laid):
    """Return the links of beams."""
    return beam_links(laid, [pillar for beam in laid for pillar in pillars_of(beam)])


@pytest.mark.parametrize(
    ("one", "other", "sizes"),
    [
        ((0, 0, 1, 3), (1, 0, 1, 3), {(2, 1)}),
        ((0, 0, 2, 3), (2, 0, 2, 3), {(4, 1)}),
        ((0, 0, 2, 4), (2, 0, 2, 4), {(4, 1)}),
        ((0, 0, 1, 6), (1, 0, 1, 6), {(2, 2)}),
        ((0, 0, 2, 6), (2, 0, 2, 6), {(4, 2)}),
        ((0, 0, 1, 4), (0, 4, 1, 3), {(1, 4)}),
    ],
)
def test_links_are_the_recommended_bricks(one, other, sizes):
    """1 x 2 and 1 x 4 link beams up to a length of four, 2 x 2 and 4 x 2 those of six."""
    (link,) = linked(one, other)
    assert link[2:] in sizes


@given(ceilings(most=3, density=(0.6, 1.0)))
def test_links_hold_long_beams_by_two_studs(case):
    """Each link joins two beams, a long one by two studs or more, within a stud of their barycentre."""
    _, cells = case
    laid = [(x, y, a, b) for x, y, _, a, b in areas(cells * [1, 1, 0]).tolist()]
    found = linked(*laid)
    for x, y, a, b in found:
        held = {beam: _shared((x, y, a, b), beam) for beam in laid if _shared((x, y, a, b), beam)}
        assert len(held) == 2
        assert sum(held.values()) == a * b
        assert all(n >= 2 for beam, n in held.items() if max(beam[2:]) >= LONG)
        weight = [beam[2] * beam[3] for beam in held]
        centre = np.average([(beam[0] + beam[2] / 2, beam[1] + beam[3] / 2) for beam in held], axis=0, weights=weight)
        assert np.abs(centre - (x + a / 2, y + b / 2)).max() <= OFF
    studs = [(x + i, y + j) for x, y, a, b in found for i in range(a) for j in range(b)]
    assert len(studs) == len(set(studs))


@pytest.mark.parametrize(("length", "wide"), [(6, 1), (2, 2), (3, 2), (6, 2)])
def test_rows_of_beams_are_tied_together(length, wide):
    """Five beams side by side get four links."""
    assert len(linked(*((wide * k, 0, wide, length) for k in range(5)))) == 4


def _shared(one, other):
    """Count the studs that two areas share."""
    return int(
        np.prod([max(min(one[k] + one[k + 2], other[k] + other[k + 2]) - max(one[k], other[k]), 0) for k in (0, 1)])
    )
