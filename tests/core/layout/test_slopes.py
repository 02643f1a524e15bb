"""Slopes that keep a model from hanging together make room for bricks."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.layout.fixed import with_fixed
from legorize_addon.core.layout.lay import Manner, lay_fixed
from legorize_addon.core.layout.slopes import lay_around_slopes, lie_among, slopes_beside, slopes_between
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_EMPTY, Fill
from tests.core.any_bricks import table
from tests.core.layout.cells import CATALOGUE, RED, brick_grid

ROW = CATALOGUE.part_row


def around(grid):
    """Return what lays the cells of a grid around slopes, without ties."""

    def lay(fixed):
        cells = with_fixed(grid, fixed, CATALOGUE)
        return lay_fixed(cells, CATALOGUE, fixed, Manner("standard"), rng=np.random.default_rng(0)), cells

    return lay


def laid_around(slopes, grid, worth=None, pair=None, *, dear=False):
    """Lay the cells of a grid around slopes that are worth the same unless that is said."""
    n = len(slopes)
    worth, pair = np.ones(n) if worth is None else np.array(worth), np.arange(n) if pair is None else np.array(pair)
    return lay_around_slopes(slopes, worth, pair, np.full(n, dear), CATALOGUE, around(grid))


def tower_with_a_wing():
    """Return a tower of 2 x 2 cells, and beside its second layer a wing that only bricks across can hold."""
    colour = np.full((3, 2, 6), COLOUR_EMPTY)
    colour[:, :, :2] = RED
    colour[1] = RED
    return brick_grid(colour)


def test_slopes_in_the_way_of_bricks_go():
    """Slopes between the tower and its wing leave, and the wing is held by a brick across again."""
    grid = tower_with_a_wing()
    slopes = table([(ROW("3039"), 0, 0, 3, 0, RED, Role.SHELL, 0, 1)])
    # a slope below the third layer of the tower has its fall under no stud
    grid.cover[2, :, :, 1] = Fill.EMPTY
    grid.colour[2, :, :, 1] = COLOUR_EMPTY
    bricks, laid = laid_around(slopes, grid)
    assert contact_graph(bricks, CATALOGUE).n_components == 1
    assert not (bricks.part == ROW("3039")).any()
    assert not (laid.cover == Fill.FIXED).any()


def test_dear_slopes_far_from_the_joint_stay():
    """What lies on a loose wing is in no brick's way but at its joint: a painted fox lost all slopes of its head."""
    colour = np.full((4, 2, 10), COLOUR_EMPTY)
    colour[:, :, :2] = RED
    colour[1] = RED
    colour[2, :, 4:9] = RED
    colour[3] = COLOUR_EMPTY
    grid = brick_grid(colour)
    grid.cover[2, :, :, 1] = Fill.EMPTY
    grid.colour[2, :, :, 1] = COLOUR_EMPTY
    slopes = table([(ROW("3039"), x, 0, z, 0, RED, Role.SHELL, 0, z // 3) for x, z in ((0, 3), (7, 6))])
    for dear, kept in ((False, []), (True, [7])):
        bricks, _ = laid_around(slopes, grid, dear=dear)
        assert contact_graph(bricks, CATALOGUE).n_components == 1
        assert bricks.corner[bricks.part == ROW("3039"), 0].tolist() == kept


def test_the_least_worthy_dear_slope_leaves_first():
    """Of two slopes in the way of one brick that would do, the worthier stays, with what goes together with it."""
    colour = np.full((3, 4, 6), COLOUR_EMPTY)
    colour[:, :, :2] = RED
    colour[1] = RED
    colour[2, :, 3:] = RED
    for worth, pair, kept in (([1.0, 2.0], [0, 1], [2]), ([2.0, 1.0], [0, 1], [0]), ([2.0, 1.0], [0, 0], [])):
        grid = brick_grid(colour)
        grid.cover[2, :, :, 1] = Fill.EMPTY
        grid.colour[2, :, :, 1] = COLOUR_EMPTY
        slopes = table([(ROW("3039"), 0, y, 3, 0, RED, Role.SHELL, 0, 1) for y in (0, 2)])
        bricks, _ = laid_around(slopes, grid, worth, pair, dear=True)
        assert contact_graph(bricks, CATALOGUE).n_components == 1
        assert bricks.corner[bricks.part == ROW("3039"), 1].tolist() == kept


def test_slopes_between_components():
    """Slopes that touch bricks of another component are found, one inside of its own and a brick are not."""
    bricks = table(
        [
            (ROW("3003"), 0, 0, 0, 0, RED, Role.SHELL, 0, 0),
            (ROW("3039"), 2, 0, 0, 0, RED, Role.SHELL, 0, 0),
            (ROW("3039"), 4, 0, 0, 0, RED, Role.SHELL, 0, 0),
        ]
    )
    assert slopes_between(bricks, np.array([0, 1, 1]), CATALOGUE).tolist() == [[False, True, False]] * 2
    assert not slopes_between(bricks, np.array([0, 0, 0]), CATALOGUE).any()


def test_slopes_that_hold_stay():
    """A slope on the edge of a block is in no brick's way."""
    colour = np.full((2, 2, 6), RED)
    colour[1, :, 5] = COLOUR_EMPTY
    slopes = table([(ROW("3039"), 4, 0, 3, 0, RED, Role.SHELL, 0, 1)])
    bricks, laid = laid_around(slopes, brick_grid(colour))
    assert np.count_nonzero(bricks.part == ROW("3039")) == 1
    assert np.count_nonzero(laid.cover == Fill.FIXED) == 12


def test_what_is_loose_without_slopes_too():
    """Where no slope is near what is loose, the others stay."""
    colour = np.full((2, 2, 12), COLOUR_EMPTY)
    colour[:, :, :6] = RED
    colour[1, :, 5] = COLOUR_EMPTY
    colour[:, :, 9:] = RED
    slopes = table([(ROW("3039"), 4, 0, 3, 0, RED, Role.SHELL, 0, 1)])
    bricks, _ = laid_around(slopes, brick_grid(colour))
    assert contact_graph(bricks, CATALOGUE).n_components == 2
    assert np.count_nonzero(bricks.part == ROW("3039")) == 1


def test_a_model_on_a_loose_foot():
    """Where the part that stands is small and loose, slopes on the large one stay."""
    colour = np.full((3, 2, 12), COLOUR_EMPTY)
    colour[1:, :, :6] = RED
    colour[2, :, 5] = COLOUR_EMPTY
    colour[0, :, 9:] = RED
    slopes = table([(ROW("3039"), 4, 0, 6, 0, RED, Role.SHELL, 0, 1)])
    bricks, _ = laid_around(slopes, brick_grid(colour))
    assert contact_graph(bricks, CATALOGUE).n_components == 2
    assert np.count_nonzero(bricks.part == ROW("3039")) == 1


def test_slopes_beside_bricks():
    """A slope that touches what is meant, or is meant, is found; one further on and a brick are not."""
    bricks = table(
        [
            (ROW("3003"), 0, 0, 0, 0, RED, Role.SHELL, 0, 0),
            (ROW("3039"), 2, 0, 0, 0, RED, Role.SHELL, 0, 0),
            (ROW("3039"), 6, 0, 0, 0, RED, Role.SHELL, 0, 0),
        ]
    )
    assert slopes_beside(bricks, np.array([True, False, False]), CATALOGUE).tolist() == [False, True, False]
    assert slopes_beside(bricks, np.array([False, False, True]), CATALOGUE).tolist() == [False, False, True]


def test_what_lies_among_others():
    """Only the same part at the same corner is the same brick."""
    one = [(ROW("3039"), 2, 0, 0, 0, RED, Role.SHELL, 0, 0), (ROW("3039"), 6, 0, 0, 0, RED, Role.SHELL, 0, 0)]
    others = [(ROW("3003"), 2, 0, 0, 0, RED, Role.SHELL, 0, 0), one[1]]
    assert lie_among(table(one), table(others)).tolist() == [False, True]
