"""Set apart: bricks get the half studs of their levels; what held by the one grid alone is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.planes import Plane
from legorize_addon.core.half_studs.truth import HalfStudsError, set_apart
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()
PLANES = (Plane(4, (1, 0)),)


def model(*rows):
    """Return bricks, given number, x, y and z each."""
    number, *corner = zip(*rows, strict=True)
    n = len(rows)
    return Assembly(
        Bricks(
            part=np.array([CATALOGUE.part_row(each) for each in number], np.int16),
            corner=np.array(corner, np.int32).T,
            turn=np.zeros(n, np.uint8),
            colour=np.zeros(n, np.int16),
            role=np.zeros(n, np.uint8),
            piece=np.zeros(n, np.int16),
            step=np.zeros(n, np.int32),
        ),
        CATALOGUE,
    )


GOOD = (("3001", 0, 0, 0), ("15573", 0, 0, 3), ("15573", 0, 1, 3), ("3003", 0, 0, 4))


def test_what_stands_on_jumpers_holds():
    """The brick on two jumpers lies half a stud on, holds to both, and its middle with it."""
    together = model(*GOOD)
    apart = set_apart(together, PLANES)
    assert apart.bricks.half.tolist() == [[0, 0]] * 3 + [[1, 0]]
    assert apart.graph.pairs.tolist() == together.graph.pairs.tolist()
    assert apart.graph.collisions == 0
    assert (apart.middles - together.middles).tolist() == [[0, 0]] * 3 + [[0.5, 0]]


@pytest.mark.parametrize(
    "more",
    [
        [("3024", 2, 0, 3), ("3024", 2, 0, 4)],  # held across the plane by a stud of a plate
        [("3005", 6, 0, 2)],  # reaches through the plane
        [("3024", 2, 0, 3)],  # its stud stands in the brick on the jumpers
    ],
)
def test_what_does_not_hold_is_refused(more):
    """The level of the plane is named."""
    with pytest.raises(HalfStudsError) as raised:
        set_apart(model(*GOOD, *more), PLANES)
    assert raised.value.levels == (4,)


def test_lost_contacts_are_seen_beside_collisions_that_were_there(monkeypatch):
    """In split models supports lie where other pieces will be: what holds no longer is found all the same."""
    monkeypatch.setattr("legorize_addon.core.half_studs.truth.collisions_between_grids", lambda *_: 99)
    set_apart(model(*GOOD), PLANES)
    with pytest.raises(HalfStudsError) as raised:
        set_apart(model(*GOOD, ("3024", 2, 0, 3), ("3024", 2, 0, 4)), (*PLANES, Plane(9, (0, 0))))
    assert raised.value.levels == (4,)


def test_bricks_keep_their_half_studs():
    """Taken, joined and changed, tables keep what they know; joined with others they know of none there."""
    bricks = set_apart(model(*GOOD), PLANES).bricks
    assert bricks.take(np.array([3, 0])).half.tolist() == [[1, 0], [0, 0]]
    assert replace(bricks, colour=bricks.colour + 1).half is bricks.half
