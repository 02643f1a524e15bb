"""Pictures of bricks: faces, lines, studs."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.instructions.canvas import Group, Path
from legorize_addon.core.instructions.lattice import FRONT, Cells, View, look
from legorize_addon.core.instructions.picture import ACROSS, DOWN, MM, PLATE, STUD, Look, at, draw
from legorize_addon.core.instructions.shades import LINE, lit
from legorize_addon.core.units import PLATE as PLATE_MM
from tests.core.any_bricks import CATALOGUE, everything, table

RED = (180, 0, 0)


def picture(bricks, *, new=True, view=FRONT, colours=None, studs=True):
    """Draw bricks, red if nothing else is said."""
    n = len(bricks)
    rgb = np.array([RED] * n if colours is None else colours)
    return draw(look(Cells.of(bricks, CATALOGUE, view), n), Look(rgb, np.full(n, new), studs))


def paths(items):
    """Yield all paths, those in groups too."""
    for item in items:
        if isinstance(item, Group):
            yield from paths(item.items)
        elif isinstance(item, Path):
            yield item


def area(path):
    """Return the area that a path of closed loops fills."""
    total, row = 0.0, 0
    for count in path.count.tolist():
        x, y = path.points[row : row + count].T.astype(float)
        total += x @ np.roll(y, -1) - y @ np.roll(x, -1)
        row += count
    return abs(total) / 2


def brick(number, x=0, y=0, z=0, turn=0):
    """Return a row of a table."""
    row = next(row for row, part in enumerate(CATALOGUE.parts) if part.number == number)
    return (row, x, y, z, turn, 4, 0, 0, 0)


def test_the_projection_is_that_of_a_camera():
    """Studs and plates have the proportions of a parallel projection along the diagonal, to within a hundredth."""
    back, upwards = np.array([8.0, 8.0, 9.6]), np.array([0.0, 0.0, 1.0])
    back /= np.linalg.norm(back)
    # whoever looks along -back has this to the right: a picture the other way round is that of a mirror
    right = np.cross(upwards, back)
    right /= np.linalg.norm(right)
    up = np.cross(back, right)
    for way, expected in (((1, 0, 0), (-STUD[0], STUD[1])), ((0, 1, 0), STUD), ((0, 0, 1), (0, -PLATE))):
        x, y, z = way
        [start, end] = at(np.array([[0, 0], [z - 3 * y, z - 3 * x]]))
        assert (end - start).tolist() == list(expected)
        mm = np.array(way) * (8.0, 8.0, PLATE_MM)
        assert (end - start) * MM == pytest.approx([mm @ right, -mm @ up], rel=0.012, abs=1e-9)


def test_studs_lie_within_the_tops_below_them():
    """A stud 4.8 mm wide and 1.6 mm high, seen from the corner, with its line, covers nothing beside its square."""
    angle = np.linspace(0, 2 * np.pi, 721)
    radius = 0.3 + 0.17 / 6
    circle = 0.5 + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    for raised in (0.0, 1 / 6):
        # upwards is along the diagonal of the top in the picture
        assert (circle - raised > 0).all()
        assert (circle - raised < 1).all()


def test_a_brick_has_three_faces_in_their_light():
    """A single brick is three fills: top, right, left, each a third of the hexagon, in the light of its side."""
    filled = [path for path in paths(picture(table([brick("3005")])).items) if path.closed]
    assert sorted(path.paints[0].fill for path in filled) == sorted(lit(RED, side) for side in range(3))
    assert len({area(path) for path in filled}) == 1
    assert area(filled[0]) == 2 * STUD[0] * STUD[1]


def test_extent_is_that_of_the_bricks():
    """A picture is as wide and high as the corners of its bricks say."""
    made = picture(table([brick("3001")]))
    assert made.size.tolist() == [6 * STUD[0], 6 * STUD[1] + 3 * PLATE]


def test_hidden_studs_are_not_drawn_and_half_hidden_ones_are_clipped():
    """Under a brick there is no stud; behind a wall studs are cut off along it."""
    stacked = picture(table([brick("3005"), brick("3005", z=3)]))
    # two passes of one stud
    assert [len(path.points) for path in paths(stacked.items) if not path.closed][-2:] == [2, 2]
    assert not [item for item in stacked.items if isinstance(item, Group) and item.clip]
    behind = picture(table([brick("3005"), brick("3005", x=1, z=0), brick("3024", x=1, z=3)]), view=View(0))
    [clipped] = [item for item in behind.items if isinstance(item, Group) and item.clip]
    assert 0 < area(clipped.clip) < area(next(path for path in paths(behind.items) if path.closed))


def test_new_bricks_are_outlined():
    """What is new has a strong line around it, what was there before has none."""

    def strong(new):
        return [
            paint.width
            for path in paths(picture(table([brick("3001")]), new=new).items)
            for paint in path.paints
            if paint.stroke == LINE and paint.width > 5
        ]

    assert strong(new=True)
    assert not strong(new=False)


@pytest.mark.parametrize("below", [False, True])
def test_every_part_can_be_drawn(below):
    """All parts in all turns, from above with studs and from below with sockets, in whole numbers."""
    bricks = everything()
    made = picture(bricks, view=View(2, below), studs=not below)
    assert made.size.min() > 0
    corners = np.concatenate([path.points for path in paths(made.items) if path.closed])
    assert corners.dtype.kind == "i"
    assert (corners >= made.low).all()
    assert (corners <= made.high).all()


def test_points_of_the_lattice():
    """One step along p goes left and up, along q right and up."""
    assert at(np.array([[1, 0], [0, 1]])).tolist() == [[-ACROSS, -DOWN], [ACROSS, -DOWN]]


def test_nothing_is_an_empty_picture():
    """Without bricks there is nothing to draw."""
    made = picture(table([]))
    assert made.items == ()
    assert made.size.tolist() == [0.0, 0.0]


def test_tiles_are_drawn_without_studs():
    """A plate shows its two studs, a tile of the same size everything but these; from below both show sockets."""
    tops = []
    for number in ("3023", "3069b"):
        bricks = table([brick(number)])
        sight, smooth = look(Cells.of(bricks, CATALOGUE, FRONT), 1), ~CATALOGUE.studs[bricks.part]
        colours, new = np.array([RED]), np.ones(1, dtype=bool)
        made = {studs: draw(sight, Look(colours, new, studs=studs, smooth=smooth)) for studs in (True, False)}
        tops.append({studs: sum(isinstance(item, Group) for item in each.items) for studs, each in made.items()})
    assert tops == [{True: 1, False: 1}, {True: 0, False: 1}]
