"""The shapes of parts that fall along their length: columns, solids and centres agree with each other."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import columns, filled, footprint, lines, load_catalogue, outline, solid, turned
from legorize_addon.core.model.profiles import centre

PARTS = load_catalogue().parts
NUMBER = {part.number: part for part in PARTS}
SMALL = [part for part in PARTS if part.length <= 8]
FINE = 8


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("part", SMALL, ids=lambda part: part.number)
def test_columns_claim_the_plates_that_the_solid_reaches(part, turn):
    """A column claims each plate with something of the part in it, and no other."""
    found = columns(part, turn)
    assert (found.xy == footprint(part, turn)).all()
    plates = solid(part, turn, FINE, FINE).reshape(len(found.xy), part.height, -1).any(axis=2)
    level = np.arange(part.height)
    assert (plates == ((level >= found.low[:, None]) & (level < found.high[:, None]))).all()


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("part", SMALL, ids=lambda part: part.number)
def test_centre_is_that_of_the_samples(part, turn):
    """The centre of mass is the mean of fine samples of the solid, but for the height of the samples."""
    cell, z, y, x = np.nonzero(solid(part, turn, 2 * FINE, 2 * FINE))
    xy = footprint(part, turn)[cell] + (np.stack([x, y], axis=1) + 0.5) / (2 * FINE)
    sampled = [*xy.mean(axis=0), (z.mean() + 0.5) / (2 * FINE)]
    assert centre(part, turn) == pytest.approx(sampled, abs=0.03)


def test_studs_sockets_and_feet_are_where_the_parts_have_them():
    """A slope has one row of studs, an inverted one a row of sockets; a cheese slope has no stud."""
    for number, studs, sockets, feet in (
        ("3039", 2, 4, 4), ("4286", 1, 3, 3), ("54200", 0, 1, 1), ("3665", 2, 1, 1), ("3660", 4, 2, 2),
        ("3037", 4, 8, 8), ("4287", 3, 1, 1), ("11477", 0, 2, 2), ("93606", 0, 8, 8),
    ):  # fmt: skip
        for turn in range(4):
            found = columns(NUMBER[number], turn)
            assert (found.stud.sum(), found.socket.sum(), found.foot.sum()) == (studs, sockets, feet)
    high = columns(NUMBER["3040b"], 0)
    assert high.xy[high.stud].tolist() == [[0, 0]]
    assert [columns(NUMBER["3040b"], turn).xy[columns(NUMBER["3040b"], turn).stud].tolist() for turn in (1, 2, 3)] == [
        [[0, 0]], [[1, 0]], [[0, 1]],
    ]  # fmt: skip


def test_curves_stand_on_two_studs_and_step_up_to_their_high_end():
    """The underside of a curve is a plate higher with each stud from the second on; its top falls ever more."""
    for number, low, high in (
        ("11477", [1, 0], [2, 2]),
        ("50950", [1, 0, 0], [3, 3, 2]),
        ("61678", [2, 1, 0, 0], [3, 3, 3, 2]),
    ):
        found = columns(NUMBER[number], 0)
        assert (found.low.tolist(), found.high.tolist()) == (low, high)
        slope = np.diff([z for _, z in lines(NUMBER[number])[0]]) / np.diff([x for x, _ in lines(NUMBER[number])[0]])
        assert (np.diff(slope) < 0).all()
        assert slope[0] > -0.3


@pytest.mark.parametrize("part", [part for part in PARTS if part.wedge], ids=lambda part: part.number)
def test_shares_within_outlines_are_exact(part):
    """The shares of small parts are those of fine samples, at every turn, and add up to the area of the outline."""
    x, y = outline(part).T
    area = (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2
    for turn in range(4):
        shares = filled(part, turn, 4)
        sampled = solid(part, turn, 64, 1)[:, 0].reshape(len(shares), 4, 16, 4, 16).mean(axis=(2, 4))
        assert shares == pytest.approx(sampled, abs=0.05)
        assert shares.sum() / 16 == pytest.approx(area)


STUDS = {
    "26601": "-10 -10, -10 10, 10 10", "2450": "-20 -20, -20 0, -20 20, 0 0, 0 20, 20 20", "24299": "-10 -10, -10 10",
    "43723": "-10 -20, -10 0, -10 20", "41770": "-10 -30, -10 -10, -10 10, -10 30", "65429": "-10 10, -10 30",
    "51739": "-10 -10, -10 10, 10 -10, 10 10",
}  # fmt: skip
"""Where LDraw's files of wedge plates have studs, in LDU along x and z from the middle of the part."""

CLUTCHED = {"26601": 0, "2450": 0, "24299": 0, "43723": 1, "41770": 1, "65429": 0, "51739": 0}
"""Squares of each that have no stud, but hold one below."""

RIGHT = {"24307": "24299", "43722": "43723", "41769": "41770", "65426": "65429"}
"""The mirror images of those on the left."""


@pytest.mark.parametrize("part", [part for part in PARTS if part.wedge], ids=lambda part: part.number)
def test_wedge_plates_have_the_studs_of_the_library(part):
    """Studs stand where a whole one has room, sockets there and where one is held; else is a notch. Feet are whole."""
    left = RIGHT.get(part.number, part.number)
    places = np.array([place.split() for place in STUDS[left].split(", ")], np.float64)
    if left != part.number:
        places[:, 0] *= -1
    # LDraw's wedge plates get narrower along -z, ours along x
    own = np.stack([-places[:, 1], places[:, 0]], axis=1) / 20 + np.array([part.length, part.width]) / 2
    for turn in range(4):
        found = columns(part, turn)
        expected = {tuple(np.floor(place).astype(int)) for place in turned(part, turn, own)}
        assert set(map(tuple, found.xy[found.stud].tolist())) == expected
        assert found.socket[found.stud].all()
        assert np.count_nonzero(found.socket & ~found.stud) == CLUTCHED[left]
        np.testing.assert_array_equal(found.foot, found.stud)
