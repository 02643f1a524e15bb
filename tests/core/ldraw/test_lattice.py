"""Matrices as quarter turns, places as cells."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from legorize_addon.core.files.ldraw import part_origin
from legorize_addon.core.ldraw.lattice import cells, quarter_turns
from legorize_addon.core.model.catalogue import footprint
from tests.core.any_bricks import CATALOGUE, ORIENTATIONS

ONE = CATALOGUE.part_row("3005")


def axis_aligned():
    """Yield the 48 signed permutation matrices."""
    for order in itertools.permutations(range(3)):
        for signs in itertools.product((1, -1), repeat=3):
            yield np.eye(3)[list(order)] * np.array(signs)[:, None]


@pytest.mark.parametrize("corner", [False, True])
def test_upright_parts_have_a_turn(corner):
    """Of 48 matrices that keep the axes the 4 turns about the vertical and their 4 mirrors do, each turn twice."""
    matrices = np.array(list(axis_aligned()))
    turn, mirrored = quarter_turns(matrices, np.full(48, corner))
    upright = matrices[:, 1, 1] == 1
    np.testing.assert_array_equal(turn >= 0, upright)
    np.testing.assert_array_equal(mirrored, np.linalg.det(matrices) < 0)
    assert sorted(turn[upright].tolist()) == [0, 0, 1, 1, 2, 2, 3, 3]


@pytest.mark.parametrize("number", ["3001", "2357"])
def test_mirrored_parts_fill_the_same_cells(number):
    """The cells of a part in a mirror are those of the turn that it is read with."""
    row = CATALOGUE.part_row(number)
    part = CATALOGUE.parts[row]
    box = [[20 * i - 30, 20 * j - 10] for i in range(4) for j in range(2)]
    local = np.array([[0, 0], [20, 0], [0, 20]] if part.corner else box)
    upright = 0
    for matrix in axis_aligned():
        [turn], _ = quarter_turns(matrix[None], np.array([part.corner]))
        if turn >= 0:
            upright += 1
            centres = local @ matrix[[0, 2]][:, [0, 2]].T
            wanted = sorted(map(tuple, ((centres - centres.min(axis=0)) / 20).astype(int).tolist()))
            assert sorted(map(tuple, footprint(part, int(turn)).tolist())) == wanted
    assert upright == 8


def test_rounded_and_bent_matrices():
    """What rounding leaves is forgiven; what is turned by a few degrees, stretched, or no rotation at all is not."""
    angle = np.radians(3)
    bent = [[np.cos(angle), 0, -np.sin(angle)], [0, 1, 0], [np.sin(angle), 0, np.cos(angle)]]
    matrices = np.array([np.eye(3) + 0.004, bent, 2 * np.eye(3), np.zeros((3, 3)), np.ones((3, 3))])
    turn, mirrored = quarter_turns(matrices, np.zeros(5, bool))
    assert turn.tolist() == [0, -1, -1, -1, -1]
    assert not mirrored.any()


def places(shift, rows):
    """Return the places in LDU of 1 x 1 bricks in cells (x, y), moved by a vector."""
    return np.array([[20 * x + 10, -24, 20 * y + 10] for x, y in rows], float) + shift


@pytest.mark.parametrize("shift", [(0, 0, 0), (10, 0, 10), (7, -3, 1.5), (1999.96, 0, 0.04), (-0.03, 0.02, 20.01)])
def test_lattice_is_that_of_most_parts(shift):
    """Wherever a model lies, its parts are in neighbouring cells; half a stud off is told, less is no place."""
    found = places(shift, [(0, 0), (1, 0), (2, 0), (0, 5)])
    # a jumper lies two squares long
    found = np.vstack([found, found[:1] + np.array([(5, 0, 0), (10, 0, 0), (20, 16, 10)])])
    part = np.array([ONE] * 6 + [CATALOGUE.part_row("15573")])
    assert not cells(found[:6], part[:6], np.zeros(6, int), CATALOGUE)[2][5]
    corner, half, on = cells(found, part, np.zeros(7, int), CATALOGUE)
    assert on[:6].tolist() == [True] * 4 + [False, True]
    assert half[:4].tolist() == [[0, 0]] * 4
    assert half[5].tolist() == [1, 0]
    assert corner[5].tolist() == corner[0].tolist()
    assert (corner[:4] - corner[0]).tolist() == [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 5, 0]]


def test_parts_on_the_lattice_of_our_own_files_stay_where_they_are():
    """Each part in each orientation, put as we put it, is in the cell that it came from."""
    part, turn = np.array(ORIENTATIONS).T
    origin = np.array([part_origin(CATALOGUE.parts[row], quarter) for row, quarter in ORIENTATIONS])
    corner, _, on = cells(origin + np.array((60.0, -16.0, -40.0)), part, turn, CATALOGUE)
    assert on.all()
    assert (corner == (3, -2, 2)).all()


@pytest.mark.parametrize(("off", "ok"), [(0.09, True), (0.2, False), (10, False)])
def test_how_far_off_is_off(off, ok):
    """A tenth of a unit is rounding; more is not."""
    found = places((0, 0, 0), [(0, 0), (1, 0), (2, 0)])
    found[2, 0] += off
    *_, on = cells(found, np.full(3, ONE), np.zeros(3, int), CATALOGUE)
    assert on.tolist() == [True, True, ok]
