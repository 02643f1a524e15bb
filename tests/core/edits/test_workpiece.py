"""Windows that are laid anew: as small as holds together, around what has to stay."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.edits.workpiece import APART, Workpiece
from legorize_addon.core.model import contact_graph
from tests.core.any_bricks import CATALOGUE, multiset, table
from tests.core.edits.models import BRICK_1X1, BRICK_2X2, BRICK_2X4, RED, ROW, WHITE, edit, shell, wall


def test_far_bricks_do_not_change():
    """What lies more than a window away is the same afterwards."""
    work = Workpiece(shell(), CATALOGUE)
    before = shell()
    row = int(work.owner[7, 0, 0])
    assert work.relay(np.array([row]), put=edit("force", BRICK_1X1, (0, 0, 6))) == ""
    far = before.take((before.corner[:, 0] > 10) | (np.abs(before.corner[:, 2] - 6) > 3))
    assert set(multiset(far)) <= set(multiset(work.bricks))


def test_the_window_grows_until_it_holds():
    """A tie is needed somewhere else when a brick that joined two halves must go: bricks beside it are laid anew."""
    work = Workpiece(wall(4), CATALOGUE)
    assert work.relay(np.array([2]), put=edit("force", BRICK_2X2, (2, 0, 3))) == ""
    graph = contact_graph(work.bricks, CATALOGUE)
    assert graph.n_components == 1
    assert (graph.owner >= 0).sum() == (contact_graph(wall(4), CATALOGUE).owner >= 0).sum()


def test_nothing_changes_if_it_cannot_be():
    """A refusal leaves bricks, colours and what stays as they were."""
    tower = table([(ROW(BRICK_1X1), 0, 0, z, 0, RED, 0, 0, 0) for z in (0, 3, 6)])
    work = Workpiece(tower, CATALOGUE)
    assert work.relay(np.array([1]), emptied=[(0, 0, z) for z in (3, 4, 5)]) == APART
    assert work.bricks is tower
    assert not work.fixed.any()


def test_what_stays_keeps_its_mark():
    """Rows are sorted anew, and a fixed brick is found in its new row."""
    work = Workpiece(wall(), CATALOGUE)
    work.fix(5)
    place = work.bricks.corner[5].tolist()
    assert work.relay(np.array([0]), put=edit("force", BRICK_1X1, (3, 1, 0))) == ""
    assert sorted(work.bricks.corner[work.fixed].tolist()) == sorted([place, [3, 1, 0]])
    assert not work.may_change(np.flatnonzero(work.fixed))


def test_settled_colours_are_laid():
    """A cell keeps the colour that an edit gave it whatever is laid over it later, even where nobody sees it."""
    bricks = table(
        [(ROW(BRICK_2X4), 4 * x, 2 * y, 3 * z, 0, RED, 0, 0, 0) for x in (0, 1) for y in (0, 1) for z in range(3)]
    )
    work = Workpiece(bricks, CATALOGUE)
    hidden = [(3, 1, z) for z in (3, 4, 5)]
    before = work.settle(hidden, WHITE)
    assert (before == -1).all()
    assert work.relay(work.rows_in(hidden)) == ""
    assert (work.bricks.colour[work.rows_in(hidden)] == WHITE).all()


def test_grid():
    """The grid has whole layers, all bricks, and what it was said to have."""
    work = Workpiece(wall(1), CATALOGUE, (4, 3, 2))
    assert work.shape == (6, 3, 8)
    assert work.inside({(7, 2, 5), (8, 0, 0), (-1, 0, 0), (0, 0, 6)}) == [(7, 2, 5)]
    assert work.filled([(0, 0, 0), (0, 0, 3)]) == [(0, 0, 0)]
    assert work.rows_in([(0, 0, 0), (7, 1, 2), (0, 2, 0)]).tolist() == [0, 1]
    cells = [(x, y, z) for x in range(5) for y in range(2) for z in range(3)]
    assert work.lie_in(np.array([0, 1]), cells).tolist() == [True, False]
