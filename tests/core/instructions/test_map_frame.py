"""Layer maps lie on their pages."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.map_frame import Frame
from legorize_addon.core.instructions.paper import PAPERS
from legorize_addon.core.instructions.plans import plan_outlines
from tests.core.any_bricks import CATALOGUE, table

BRICK = next(row for row, part in enumerate(CATALOGUE.parts) if part.number == "3001")


@pytest.mark.parametrize("paper", PAPERS.values())
@pytest.mark.parametrize("turn", [0, 1])
def test_maps_lie_on_the_paper(paper, turn):
    """The corners of a map are within the page, whichever side is longer."""
    row = table([(BRICK, *((0, 4 * n) if turn else (4 * n, 0)), 0, turn, 4, 0, 0, 0) for n in range(12)])
    frame = Frame.of(row, CATALOGUE, 66.0, paper, actual_size=False)
    for x in (frame.low[0], frame.high[0]):
        for y in (frame.low[1], frame.high[1]):
            across, down = frame.at(x, y)
            assert 0 < across < paper.width - 66
            assert 0 < down < paper.height


def test_tiles_have_frames_of_their_own():
    """The frame holds the tile and what lies across its border; columns are counted from those of the whole."""
    bricks = table([(BRICK, x, 0, 0, 0, 4, 0, 0, 0) for x in (2, 14, 30)])
    whole = Frame.of(bricks, CATALOGUE, 66.0, PAPERS["A4"], actual_size=False)
    points, _ = plan_outlines(bricks.take(np.array([1])), CATALOGUE)
    frame = Frame.of_tile(points, (0, 0), whole, 66.0, PAPERS["A4"])
    assert (frame.low.tolist(), frame.high.tolist()) == ([2, 0], [18, 2])
    assert frame.first.tolist() == whole.low.tolist() == [2, 0]
    across = Frame.of_tile(points, (0, 1), whole, 66.0, PAPERS["A4"])
    assert (across.low.tolist(), across.high.tolist()) == ([14, 0], [34, 2])
    assert frame.stud > whole.stud
