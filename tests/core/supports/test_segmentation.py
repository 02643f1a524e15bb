"""Split assembly: cuts that save supports, joints that hold."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from legorize_addon.core.supports.assembly_plan import plan_assembly
from legorize_addon.core.supports.segmentation import INTERFACE, LEAST, SAVING, pays, segment
from tests.core.overhanging import overhanging
from tests.core.standing import CATALOGUE, table


def bricks_of(name, width):
    """Return a mesh with overhangs as bricks."""
    return legorize(overhanging(100.0)[name], Settings(width=width, supports="none")).bricks


def cut(bricks, most=5, deepest=0):
    """Return bricks in pieces, and the joints."""
    assembly, joints = segment(Assembly(bricks, CATALOGUE), most=most, deepest=deepest)
    return assembly.bricks, joints


@pytest.fixture(scope="module")
def cars():
    """Return the car, whole and in two pieces."""
    return bricks_of("box_car", 32)


def test_split_saves_a_fifth_of_the_supports(cars):
    """A car whose body hangs over its wheels takes at least a fifth fewer support bricks with each wheel by itself."""
    pieces, joints = cut(cars)
    assert len(joints) == 4
    whole, split = (
        len(plan_assembly(Assembly(each, CATALOGUE), wish="tree", deepest=0).removed) for each in (cars, pieces)
    )
    assert whole > 0
    assert split <= (1 - SAVING) * whole


def test_parts_join_to_the_same_model(cars):
    """No brick is lost or moved, pieces hang together, and the joint has as many studs as it says."""
    pieces, [*wheels, joint] = cut(cars)
    assert [(wheel.studs, wheel.level) for wheel in wheels] == [(0, 0)] * 3
    for piece in range(5):
        assert contact_graph(pieces.take(pieces.piece == piece), CATALOGUE).n_components == 1
    assert np.array_equal(pieces.corner, cars.corner)
    upper = pieces.piece == joint.piece
    assert contact_graph(pieces.take(upper), CATALOGUE).n_components == 1
    assert min(upper.mean(), 1 - upper.mean()) >= LEAST
    found = contact_graph(pieces, CATALOGUE)
    between = upper[found.pairs[:, 0]] != upper[found.pairs[:, 1]]
    assert found.studs[between].sum() == joint.studs >= INTERFACE
    assert (pieces.corner[upper, 2] >= joint.level).all()


@pytest.mark.parametrize("most", [2, 3, 4])
def test_a_cut_that_leaves_loose_parts_is_refused(cars, most):
    """Four wheels are no piece: with fewer than five pieces the car stays as it is."""
    pieces, joints = cut(cars, most=most)
    assert joints == ()
    assert not pieces.piece.any()


def test_pieces_that_hook_into_each_other_are_not_cut():
    """An arm that rises beside and reaches over what would be put on from above is in its way."""
    foot = [("3001", 0, 0, 0), ("3001", 0, 0, 3)]
    upper = [("3003", 0, 0, 6), *(("3008", 0, y, 9) for y in range(2))]
    hook = [("3003", 2, 0, 6), *(("3003", 2, 2, z) for z in (3, 6, 9, 12)), ("3001", 2, 0, 15, 1)]
    bricks, joints = cut(table(*foot, ("3001", 2, 2, 0), *upper, *hook), deepest=0)
    assert plan_assembly(Assembly(bricks, CATALOGUE), deepest=0).walk.loose_pieces.tolist() == []
    assert all(joint.studs >= INTERFACE for joint in joints)


def test_split_model_can_be_built(cars):
    """Each piece on the table, its supports out, then joined: every step can be done."""
    found = plan_assembly(Assembly(cut(cars)[0], CATALOGUE), deepest=0)
    assert found.walk.buildable
    assert found.contacts.collisions == 0


def test_a_piece_cut_again_keeps_its_own_joint():
    """A plate that hangs under an arm holds on to the arm alone: it is no piece of its own, though that saves more."""
    foot, pillar, arm = ("3001", 0, 0, 0), ("3001", 0, 0, 3), ("3007", 0, 0, 6)
    bricks, joints = cut(table(foot, pillar, arm, ("3003", 6, 0, 3), ("3022", 6, 0, 2)), most=3)
    assert [joint.studs for joint in joints] == [8]
    assert bricks.piece.tolist() == [0, 1, 1, 1, 1]
    assert plan_assembly(Assembly(bricks, CATALOGUE), deepest=0).walk.buildable


def test_no_piece_sits_on_what_is_not_there_yet():
    """A tower on a brick that hangs from above the cut is joined after the piece that this one hangs on, or not cut."""
    pillar, arm, hanger = [("3003", 0, 0, z) for z in (0, 3, 6)], ("3007", 0, 0, 9), ("3001", 6, 0, 6, 1)
    tower = [("3003", 6, 2, 9), ("3003", 6, 2, 12), ("3007", 6, 2, 15, 1), ("3003", 6, 8, 12), ("3003", 6, 8, 9)]
    bricks, joints = cut(table(*pillar, arm, hanger, *tower), deepest=3)
    assert all(joint.studs >= INTERFACE for joint in joints)
    assert plan_assembly(Assembly(bricks, CATALOGUE), deepest=3).walk.buildable


@pytest.mark.parametrize(("before", "after", "enough"), [(10, 8, True), (20, 17, False), (1, 0, True), (0, 0, False)])
def test_a_fifth_has_to_be_saved(before, after, enough):
    """A cut that saves less than a fifth of the supports is not worth the joint."""
    assert pays(before, after) == enough


def test_no_cut_where_nothing_is_saved():
    """A tower needs no supports: it stays in one piece, whatever is allowed."""
    bricks, joints = cut(table(*(("3001", 0, 0, 3 * k) for k in range(9))), most=4)
    assert joints == ()
    assert not bricks.piece.any()


def test_one_piece_is_never_cut(cars):
    """With one piece at most the model stays whole."""
    assert cut(cars, most=1)[1] == ()


@pytest.mark.parametrize("most", [2, 3, 4])
def test_never_more_pieces_than_allowed(most):
    """Numbers of pieces run from 0 without a gap, no more of them than allowed."""
    bricks, joints = cut(bricks_of("table", 20), most=most)
    assert len(joints) < most
    assert np.unique(bricks.piece).tolist() == list(range(len(joints) + 1))
