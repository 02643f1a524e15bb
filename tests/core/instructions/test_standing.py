"""What is not yet joined: the grid under groups that stand apart, and bricks lifted off what they hide."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Path
from legorize_addon.core.instructions.lattice import FRONT, View
from legorize_addon.core.instructions.picture import PLATE, at, extent
from legorize_addon.core.instructions.sightlines import ENOUGH, Stage
from legorize_addon.core.instructions.standing import LIFTS, Standing, table_grid, ways_down
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.any_bricks import CATALOGUE, table
from tests.core.instructions.built import LONG, PART, SMALL
from tests.core.instructions.test_panels import panels_of

ONE, TWO = PART["3024"], PART["3023"]


def scene_of(bricks, stays, new, view=FRONT):
    """Return how new bricks are seen on those that were there."""
    return Stage(bricks, CATALOGUE).scene(np.array(stays), np.array(new), view)


def corners(item):
    """Yield the points of the paths of an item."""
    for each in item.items if isinstance(item, Group) else [item]:
        assert isinstance(each, Path)
        yield from each.points.tolist()


def test_groups_are_what_touches():
    """Bricks side by side and one on the other are one group, those with a stud between them are two."""
    rows = [(SMALL, 0, 0, 0, 0, 4, 0, 0, 0), (SMALL, 2, 0, 0, 0, 4, 0, 0, 0), (SMALL, 5, 0, 0, 0, 4, 0, 0, 0),
            (SMALL, 5, 0, 3, 0, 4, 0, 0, 0)]  # fmt: skip
    standing = Standing(table(rows), CATALOGUE)
    one, two, three, four = standing.groups(np.arange(4)).tolist()
    assert one == two
    assert three == four
    assert one != three
    assert standing.apart(np.array([0, 2]))
    assert not standing.apart(np.array([0, 1]))
    # what is not there joins nothing
    bridge = Standing(table([*rows[:1], rows[2], (LONG, 0, 0, 3, 0, 4, 0, 0, 0)]), CATALOGUE)
    assert bridge.apart(np.array([0, 1]))
    assert not bridge.apart(np.arange(3))


@pytest.mark.parametrize("turns", range(4))
def test_the_grid_has_a_square_for_each_stud(turns):
    """Two bricks five studs apart stand on a grid of nine by two squares, from corner to corner of them."""
    bricks = table([(SMALL, 0, 0, 0, 0, 4, 0, 0, 0), (SMALL, 7, 0, 0, 0, 4, 0, 0, 0)])
    sight = Stage(bricks, CATALOGUE).sight(np.arange(2), View(turns))
    grid = table_grid(sight, *extent(sight))
    assert len(list(corners(grid))) == 2 * ((9 + 1) + (2 + 1))
    # the bricks' feet are corners of it
    place = sight.cells.place
    foot = place[place[:, 2] == 0]
    ends = at(-3 * np.array([foot[:, :2].min(axis=0), foot[:, :2].max(axis=0) + 1])[:, ::-1])
    points = np.array(list(corners(grid)))
    assert all((points == end).all(axis=1).any() for end in ends)
    # it ends with the picture
    assert np.array_equal(grid.clip.points.min(axis=0), extent(sight)[0])


def test_a_long_brick_is_lifted_off_the_plate_that_it_hides():
    """Of a plate under the middle of a long brick nothing is seen; it is as soon as the brick is high enough."""
    bricks = table([(TWO, 3, 1, 0, 0, 4, 0, 0, 0), (LONG, 0, 0, 1, 0, 4, 0, 0, 0)])
    stage = Stage(bricks, CATALOGUE)
    before = scene_of(bricks, [0], [1])
    assert before.sight.shares[0] < ENOUGH
    after, plates = Standing(bricks, CATALOGUE).lifted(stage, before, np.array([0]))
    assert after.sight.shares[0] >= ENOUGH
    assert plates in LIFTS
    lower = [lift for lift in LIFTS if lift < plates]
    assert all(stage.sight(np.arange(2), FRONT, (np.array([1]), lift)).shares[0] < ENOUGH for lift in lower)
    assert after.shares.tolist() == [1.0]


@pytest.mark.parametrize("view", [FRONT, View(0, below=True)])
def test_what_shows_its_place_is_not_lifted(view):
    """A small brick on the middle of a long one stays where it is, and so does all that is seen from below."""
    bricks = table([(LONG, 0, 0, 0, 0, 4, 0, 0, 0), (ONE, 3, 0, 3, 0, 4, 0, 0, 0)])
    scene = scene_of(bricks, [0], [1], view)
    assert Standing(bricks, CATALOGUE).lifted(Stage(bricks, CATALOGUE), scene, np.array([0])) == (scene, 0)


@pytest.mark.parametrize("turns", range(4))
def test_ways_lead_from_corners_to_where_they_come_down(turns):
    """Three lines as long as the brick is high above its place, from its corners left, right and in front."""
    bricks = table([(TWO, 3, 1, 0, 0, 4, 0, 0, 0), (LONG, 0, 0, 1, 0, 4, 0, 0, 0)])
    stage, view = Stage(bricks, CATALOGUE), View(turns)
    lifted = stage.sight(np.arange(2), view, (np.array([1]), 6))
    [ways] = ways_down(lifted, np.array([1]), 6)
    ends = ways.points.reshape(-1, 2, 2)
    assert (ends[:, 1] - ends[:, 0]).tolist() == [[0, 6 * PLATE]] * 3
    low, high = extent(stage.sight(np.array([1]), view))
    assert ends[:, 1, 0].min() == low[0]
    assert ends[:, 1, 0].max() == high[0]
    assert ends[:, 1, 1].max() == high[1]


def test_sub_assemblies_are_drawn_apart_and_as_large_as_is_said():
    """A long brick with a plate that hangs from its middle: the picture has the lines down, and room for them."""
    rows = [(PART["3001"], 8 * x, 0, 3 * z, 0, 4, 0, 0, 0) for x in range(3) for z in range(2)]
    hanging = [(ONE, 6, 1, 5, 0, 4, 0, 0, 0), (LONG, 4, 0, 6, 0, 4, 0, 0, 0), (LONG, 12, 0, 6, 0, 4, 0, 0, 0)]
    panels = panels_of(plan_assembly(Assembly(table([*rows, *hanging]), CATALOGUE), deepest=3))
    found = [panel for shot in panels.shots for panel in panels.of(shot)]
    lifted = [panel for panel in found if panel.lift]
    assert lifted
    for panel in found:
        picture = panels.picture(panel)
        assert picture.size.tolist() == panel.size.tolist()
        blue = [each for each in picture.items if isinstance(each, Path) and each.paints[0].dash]
        assert bool(blue) == bool(panel.lift)
        for each in blue:
            assert (each.points >= picture.low).all()
            assert (each.points <= picture.high).all()
