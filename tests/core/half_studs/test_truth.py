"""Set apart: bricks get the half studs of their levels; what held by the one grid alone is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.half_studs.halves import Halves
from legorize_addon.core.half_studs.regions import Region
from legorize_addon.core.half_studs.truth import HalfStudsError, check_apart, lies_in_several, set_apart
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks, Role
from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()
REGION = Region(1, 2, True, 7, (1, 0))


def halves(*layers, region=(REGION,)):
    """Return half studs along x, the same all over each layer."""
    half = np.array(layers, np.uint8)
    return Halves(np.broadcast_to(half[:, None, None], (len(half), 4, 9)).copy(), 0, np.zeros(3), 0, region)


HALVES = halves(0, 1, 1)


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


GOOD = (("3020", 0, 0, 0), ("3020", 0, 0, 1), ("15573", 0, 0, 2), ("15573", 0, 1, 2), ("3003", 0, 0, 3))


def test_what_stands_on_jumpers_holds():
    """The brick on two jumpers lies half a stud on, holds to both, and its middle with it."""
    together = model(*GOOD)
    apart = set_apart(together, HALVES)
    assert apart.bricks.half.tolist() == [[0, 0]] * 4 + [[1, 0]]
    assert apart.graph.pairs.tolist() == together.graph.pairs.tolist()
    assert apart.graph.collisions == 0
    assert (apart.middles - together.middles).tolist() == [[0, 0]] * 4 + [[0.5, 0]]


@pytest.mark.parametrize(
    "more",
    [
        [("3024", 2, 0, 2), ("3024", 2, 0, 3)],  # held across by a stud of a plate
        [("3005", 6, 0, 2)],  # reaches across
        [("3024", 2, 0, 2)],  # its stud stands in the brick on the jumpers
    ],
)
def test_what_does_not_hold_is_refused(more):
    """The region is named."""
    with pytest.raises(HalfStudsError) as raised:
        set_apart(model(*GOOD, *more), HALVES)
    assert raised.value.regions == (REGION,)


def test_only_regions_near_what_is_wrong_are_named():
    """One that lies far above is not given up."""
    far = Region(6, 9, True, 9, (1, 0))
    with pytest.raises(HalfStudsError) as raised:
        set_apart(model(*GOOD, ("3005", 6, 0, 2)), halves(0, 1, 1, region=(REGION, far)))
    assert raised.value.regions == (REGION,)


def test_lost_contacts_are_seen_beside_collisions_that_were_there(monkeypatch):
    """In split models supports lie where other pieces will be: what holds no longer is found all the same."""
    monkeypatch.setattr("legorize_addon.core.half_studs.truth.collisions_between_grids", lambda *_: 99)
    set_apart(model(*GOOD), HALVES)
    with pytest.raises(HalfStudsError):
        set_apart(model(*GOOD, ("3024", 2, 0, 2), ("3024", 2, 0, 3)), HALVES)


def supported(*rows):
    """Return the good model with others, of which those below the second layer are supports."""
    made = model(*GOOD, *rows)
    role = np.where(np.arange(len(made)) >= len(GOOD), np.uint8(Role.SUPPORT_OUTSIDE), made.bricks.role)
    return Assembly(replace(made.bricks, role=role), CATALOGUE)


def test_supports_lie_where_what_they_carry_does():
    """A column under the end of a long plate stands half a stud off from the ground on."""
    rows = (("3001", 1, 0, 6), ("3005", 4, 0, 0), ("3005", 4, 0, 3))
    made = supported(*rows)
    role = made.bricks.role.copy()
    role[len(GOOD)] = 0
    apart = set_apart(Assembly(replace(made.bricks, role=role), CATALOGUE), HALVES)
    assert apart.bricks.half[len(GOOD) :].tolist() == [[1, 0]] * 3
    assert apart.graph.collisions == 0


def test_supports_cannot_carry_both():
    """One that carries what lies off and what does not is refused."""
    both = (("3024", 6, 0, 3), ("3024", 7, 0, 3), ("3004", 6, 0, 0))
    made = supported(*both)
    role = made.bricks.role.copy()
    role[len(GOOD) : len(GOOD) + 2] = 0
    half = halves(0, 1, 1)
    half.half[1, :, 7] = 0
    with pytest.raises(HalfStudsError):
        set_apart(Assembly(replace(made.bricks, role=role), CATALOGUE), half)


def test_cells_of_different_half_studs_lie_apart():
    """Side by side one brick could cover both; a column apart it cannot."""
    solid = np.zeros((2, 3, 4, 9), bool)
    solid[1, :, 1, 2] = solid[1, :, 1, 4] = True
    half = halves(0, 1, 1)
    half.half[1, :, 3:] = 0
    check_apart(solid, half)
    solid[1, 2, 1, 3] = True
    with pytest.raises(HalfStudsError) as raised:
        check_apart(solid, half)
    assert raised.value.regions == (REGION,)


def test_bricks_across_regions_are_known():
    """A brick over both kinds of cells, or as high as both layers, lies in several."""
    half = halves(0, 1, 1)
    half.half[0, :, 5:] = 1
    found = lies_in_several(model(("3004", 0, 0, 0), ("3004", 4, 0, 0), ("3005", 0, 2, 2), ("3005", 6, 2, 2)), half)
    assert found.tolist() == [False, True, True, False]


def test_bricks_keep_their_half_studs():
    """Taken, joined and changed, tables keep what they know; joined with others they know of none there."""
    bricks = set_apart(model(*GOOD), HALVES).bricks
    assert bricks.take(np.array([4, 0])).half.tolist() == [[1, 0], [0, 0]]
    assert replace(bricks, colour=bricks.colour + 1).half is bricks.half
