"""Statics: which forces there are, where they act, and what they add up to."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model import columns, outline, turned
from legorize_addon.core.model.bricks import NOBODY
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.statics.forces import GRAVITY, HOLD, TABLE_FRICTION, Ground
from tests.core.standing import CATALOGUE, downward, equations, table, weight


def test_weight_of_every_part() -> None:
    """Each part weighs its grams, in its own middle."""
    bricks = table(*((part.number, 0, 0, 9 * row) for row, part in enumerate(CATALOGUE.parts)))
    found = equations(bricks)
    weights = found.loads.reshape(-1, 6)
    # what is higher than the part above it floats
    np.testing.assert_allclose(weights[:, 2], -GRAVITY * CATALOGUE.mass[bricks.part[found.rows]] / 1000)
    assert (weights[:, [0, 1, 3, 4, 5]] == 0).all()


@pytest.mark.parametrize(("number", "grips"), [("3001", 3), ("3010", 4), ("2357", 3), ("3024", 4), ("30145", 3)])
def test_grips_of_a_stud(number: str, grips: int) -> None:
    """The upper part decides how many points of a stud it grips; a part one stud wide grips four."""
    bricks = table(("3001", 0, 0, 0), (number, 0, 0, 3))
    links, contacts = contact_graph(bricks, CATALOGUE), equations(bricks).contacts
    gripping = contacts.by != NOBODY
    # two edges of a cone at each point
    assert gripping.sum() == 2 * grips * links.studs[0]
    assert (contacts.least[gripping] == -HOLD / 2).all()
    assert (contacts.on[gripping] == 1).all()
    assert (contacts.by[gripping] == 0).all()
    # a plate is 0.4 studs high
    np.testing.assert_allclose(contacts.point[gripping, 2], 1.2)


@pytest.mark.parametrize("number", ["3001", "3010"])
def test_friction_is_shared_by_pull_and_push_along_the_wall(number: str) -> None:
    """A point bears a force exactly if its pull and its push along the wall are no more than the clutch together."""
    contacts = equations(table(("3001", 0, 0, 0), (number, 0, 0, 3))).contacts
    first = np.flatnonzero(contacts.by != NOBODY)[0]
    one, other = contacts.direction[first : first + 2]
    np.testing.assert_array_equal(contacts.point[first], contacts.point[first + 1])
    np.testing.assert_allclose(one + other, [0, 0, 2], atol=1e-15)
    along = (one - other) / 2
    assert np.linalg.norm(along) == pytest.approx(1)
    # across the line from the point to the middle of the stud, which is in the middle of a square
    middle = np.floor(contacts.point[first, :2]) + 0.5
    assert along[:2] @ (contacts.point[first, :2] - middle) == pytest.approx(0)
    for up, push in ((-HOLD, 0.0), (-HOLD / 2, HOLD / 2), (-0.1, 0.1 - HOLD), (0.0, HOLD), (1.0, 1.0 + HOLD)):
        for spare, borne in ((0.001, True), (-0.001, False)):
            shares = np.linalg.lstsq(np.column_stack([one, other]), (up + spare) * np.array([0, 0, 1]) + push * along)
            assert (shares[0] >= contacts.least[first]).all() == borne


def test_middle_of_a_corner_part() -> None:
    """A corner part weighs where its three squares do."""
    np.testing.assert_allclose(equations(table(("2357", 0, 0, 0))).middle, [[5 / 6, 5 / 6, 0.6]])


def test_feet_of_a_corner_part() -> None:
    """The table pushes at the five outward corners of a corner part, leaning four ways at each."""
    contacts = equations(table(("2357", 0, 0, 0))).contacts
    corners = np.unique(contacts.point, axis=0)
    np.testing.assert_array_equal(corners, [[0, 0, 0], [0, 2, 0], [1, 2, 0], [2, 0, 0], [2, 1, 0]])
    assert len(contacts.on) == 20
    np.testing.assert_allclose(np.hypot(*contacts.direction[:, :2].T), TABLE_FRICTION)
    assert (contacts.least == 0).all()


def test_baseplate_grips_as_a_brick_would() -> None:
    """Under a 2 x 4 brick a baseplate has the points that another brick of that size has."""
    plate = equations(table(("3001", 0, 0, 0)), ground=Ground.BASEPLATE).contacts
    pair = equations(table(("3001", 0, 0, 0), ("3001", 0, 0, 3))).contacts
    between = pair.by == 0
    np.testing.assert_array_equal(plate.point[:24, :2], pair.point[between][:24, :2])
    np.testing.assert_array_equal(plate.least, pair.least[between])


def test_bricks_side_by_side_push() -> None:
    """Two pushes for each pair, at the ends of what touches, at its bottom, away from each other; or none."""
    bricks = table(("30145", 0, 0, 0), ("3001", 2, 0, 0), ("3001", 2, 0, 3), ("3001", 0, 2, 0))
    contacts = equations(bricks, neighbours=True).contacts
    sides = (contacts.least == 0) & (contacts.by != NOBODY)
    found = [
        (int(by), int(on), *point)
        for by, on, point in zip(
            contacts.by[sides], contacts.on[sides], contacts.point[sides].round(9).tolist(), strict=True
        )
    ]
    # the last one stands behind the first and, by half, behind the second
    assert [(by, on, z) for by, on, _, _, z in sorted(found)[::2]] == [(0, 1, 0), (0, 2, 1.2), (0, 3, 0), (1, 3, 0)]
    assert [row[3] for row in found[:4]] == [0, 2, 0, 2]
    assert sorted(row[2] for row in found[4:]) == [0, 2, 2, 4]
    np.testing.assert_array_equal(contacts.direction[sides].sum(axis=1), 1)
    without = equations(bricks).contacts
    assert ((without.least < 0) | (without.by == NOBODY)).all()


def test_place_does_not_matter() -> None:
    """Moved to negative coordinates, a model has the same equations."""
    rows = [("3001", 0, 0, 0), ("3003", 4, 0, 0), ("3001", 2, 0, 3), ("3024", 2, 0, 6)]
    here = equations(table(*rows), neighbours=True)
    there = equations(table(*((number, x - 9, y - 5, z - 6) for number, x, y, z in rows)), neighbours=True)
    np.testing.assert_allclose(there.matrix.toarray(), here.matrix.toarray(), atol=1e-12)
    np.testing.assert_array_equal(there.contacts.by, here.contacts.by)


def test_what_floats_is_left_out() -> None:
    """Bricks in the air have no equations, and what they would push does not exist."""
    found = equations(table(("3001", 0, 0, 3), ("3001", 0, 0, 0), ("3001", 4, 0, 3), ("3001", 0, 0, 9)))
    assert found.rows.tolist() == [0, 1]
    assert found.matrix.shape[0] == 12
    assert ((found.contacts.least != 0) | (found.contacts.by == NOBODY)).all()


def test_loads_are_added() -> None:
    """A load of a newton stands beside the weight, without a torque."""
    bricks = table(("3001", 0, 0, 0), ("3003", 0, 0, 3))
    found = equations(bricks, loads=downward(bricks, 1, 1.0)).loads.reshape(-1, 6)
    np.testing.assert_allclose(found[:, 2], [-weight("3001"), -weight("3003") - 1])


def test_inner_forces_cancel() -> None:
    """Action is reaction: about one common point, a force between bricks adds nothing up."""
    found = equations(
        table(("3001", 0, 0, 0), ("3003", 4, 1, 0), ("3010", 2, 1, 3), ("3020", 0, 0, 6), ("3024", 3, 0, 3)),
        neighbours=True,
    )
    columns = found.matrix.toarray().reshape(len(found.rows), 6, -1)
    x, y, z = found.middle.T[:, :, None]
    torque_x = (columns[:, 3] + y * columns[:, 2] - z * columns[:, 1]).sum(axis=0)
    torque_y = (columns[:, 4] + z * columns[:, 0] - x * columns[:, 2]).sum(axis=0)
    torque_z = (columns[:, 5] + x * columns[:, 1] - y * columns[:, 0]).sum(axis=0)
    inner = found.contacts.by != NOBODY
    assert inner.sum() > 30
    for sums in (*columns[:, :3].sum(axis=0), torque_x, torque_y, torque_z):
        np.testing.assert_allclose(sums[inner], 0, atol=1e-12)


@pytest.mark.parametrize(("lower", "upper", "held"), [("3023", "3069b", True), ("3069b", "3023", False)])
def test_tiles_hold_below_and_nothing_above(lower: str, upper: str, held: bool) -> None:
    """Forces go between a plate and a tile on it, none between a tile and a plate on it."""
    bricks = table((lower, 0, 0, 0), (upper, 0, 0, 1))
    found = equations(bricks)
    assert len(found.rows) == 1 + held
    assert bool((found.contacts.by != NOBODY).any()) == held


def test_corners_that_reach_into_each_other_push_wherever_they_stand():
    """Two corner plates in a square of three by three: the ends of their pushes move with them, below zero as well."""
    rows = [("2420", 0, 0, 0, 0), ("2420", 0, 1, 0, 2), ("3023", 3, 0, 0, 1), ("3005", 2, 0, 0)]
    here = equations(table(*rows)).contacts
    for shift in ((-7, -5), (4, 3)):
        there = equations(table(*((number, x + shift[0], y + shift[1], z, *turn) for number, x, y, z, *turn in rows)))
        np.testing.assert_allclose(there.contacts.point, here.point + np.array([*shift, 0]))
        np.testing.assert_array_equal(there.contacts.direction, here.direction)


WEDGES = [part for part in CATALOGUE.parts if part.wedge]


@pytest.mark.parametrize("turn", range(4))
@pytest.mark.parametrize("part", WEDGES, ids=lambda part: part.number)
def test_the_table_bears_wedge_plates_at_the_corners_of_their_outline(part, turn) -> None:
    """Where a wedge plate only reaches into a square, the corner of this bears nothing."""
    contacts = equations(table((part.number, 4, 2, 0, turn))).contacts
    assert (contacts.by == NOBODY).all()
    expected = turned(part, turn, outline(part)) + np.array([4, 2])
    np.testing.assert_allclose(np.unique(contacts.point[:, :2], axis=0), np.unique(expected, axis=0))
    assert (contacts.point[:, 2] == 0).all()


@pytest.mark.parametrize("part", WEDGES, ids=lambda part: part.number)
def test_wedge_plates_hold_on_studs_alone(part) -> None:
    """Grips are where a plate below has a stud and the wedge plate a socket: none in its notches."""
    own = columns(part, 0)
    below = [("3024", x, y, 0) for x, y in own.xy.tolist()]
    contacts = equations(table(*below, (part.number, 0, 0, 1))).contacts
    gripping = contacts.by != NOBODY
    assert set(contacts.on[gripping].tolist()) == {len(below)}
    squares = np.floor(contacts.point[gripping, :2]).astype(int)
    assert set(map(tuple, squares.tolist())) == set(map(tuple, own.xy[own.socket].tolist()))
    # and a baseplate holds it at the same ones
    held = equations(table((part.number, 0, 0, 0)), ground=Ground.BASEPLATE).contacts.point[:, :2]
    assert set(map(tuple, np.floor(held).astype(int).tolist())) == set(map(tuple, own.xy[own.socket].tolist()))


def test_nothing_presses_on_the_slanted_side_of_a_wedge_plate() -> None:
    """Bricks beside a wedge plate push its long straight side and its wide end; beside the other one is a gap."""
    # 43722 is three studs long, straight at high y
    bricks = table(("43722", 0, 1, 0), ("3623", 0, 3, 0), ("3623", 0, 0, 0), ("3022", 3, 1, 0), ("3022", -2, 1, 0))
    contacts = equations(bricks, neighbours=True).contacts
    sides = (contacts.by != NOBODY) & ((contacts.on == 0) | (contacts.by == 0))
    assert set((contacts.on + contacts.by)[sides].tolist()) == {1, 3, 4}
    # only where the plate is as deep as its squares
    ends = contacts.point[sides & ((contacts.on + contacts.by) >= 3), 1]
    assert set(ends.tolist()) == {2.0, 3.0}
