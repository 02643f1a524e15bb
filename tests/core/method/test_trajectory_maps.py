"""Maps of the trajectories."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Path
from legorize_addon.core.method.sheet import Sheet
from legorize_addon.core.method.trajectory_maps import EXTERIOR, INTERIOR, colour_rgb, trajectory_maps
from tests.core.any_bricks import CATALOGUE
from tests.core.method.drafts import SIDES, draft


def maps(shown):
    """Return the pages of the tubes."""
    made, grid = draft(), draft().grid
    sheet = Sheet.of(*grid.colour.shape[:1:-1])
    options = {"origin": grid.origin[:2], "sheet": sheet, "catalogue": CATALOGUE, "shown": shown}
    return list(trajectory_maps(made.trajectories, made.cut.layer, made.cut.plate, **options))


def drawn(page):
    """Yield the colour and the points in mm of each line of the map, without the grid's."""
    [group] = [item for item in page.items if isinstance(item, Group) and len(item.items) > 1]
    for item in group.items[2:]:
        assert isinstance(item, Path)
        for line in np.split(item.points * 8, np.cumsum(item.count)[:-1]):
            if len(line):
                yield item.paints[0].stroke, line


def test_exterior_is_blue_and_interior_green():
    """Every layer has its loops, outer ones blue, inner ones green, in the cells of the grid."""
    pages = maps("sides")
    assert [page.title for page in pages] == [f"Layer {number}" for number in range(1, 6)]
    for page in pages:
        sizes = [(stroke, np.ptp(line, axis=0).round(6).tolist()) for stroke, line in drawn(page)]
        wanted = [(EXTERIOR, SIDES[0]), (EXTERIOR, SIDES[2]), (INTERIOR, SIDES[1]), (INTERIOR, SIDES[3])]
        assert sorted(sizes, key=str) == sorted(3 * [(stroke, [side, side]) for stroke, side in wanted], key=str)


@pytest.mark.parametrize("code", [1, 4])
def test_colours_lie_where_they_are(code):
    """In colours, the wall on the left is red, the one on the right blue."""
    middle = draft().grid.colour.shape[3] * 4
    lines = [line for page in maps("colours") for stroke, line in drawn(page) if stroke == colour_rgb(code, CATALOGUE)]
    assert lines
    away = (np.concatenate(lines)[:, 0] - middle) * (1 if code == 1 else -1)
    # each colour has one of the outermost walls, and not the other one
    assert away.max() == pytest.approx(SIDES[0] / 2)
    assert away.min() > -SIDES[0] / 2 + 1
