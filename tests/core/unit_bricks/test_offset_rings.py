"""Offset bricks between trajectories of adjacent levels, and the kinds of overhangs."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays
from scipy import ndimage

from legorize_addon.core.unit_bricks.offset_rings import OverhangKind, offset_rings, overhang_kinds, recolour_rings
from legorize_addon.core.units import BRICK, PLATE, STUD

BLOBS = arrays(bool, array_shapes(min_dims=3, max_dims=3, max_side=9))
BOTH = pytest.mark.parametrize("upside_down", [False, True], ids=["stands", "hangs"])


def offsets(solid, *, height=BRICK, angle=45.0):
    """Find the offset bricks at the default angle."""
    return offset_rings(solid, height=height, critical_angle=angle)


def pyramid(slope, n_levels=5, top=2):
    """Return a square pyramid whose outline moves by `slope` studs a level, up to a square `top` wide."""
    side = top + 2 * slope * (n_levels - 1)
    solid = np.zeros((n_levels, side, side), bool)
    for level in range(n_levels):
        inner = slice(level * slope, side - level * slope)
        solid[level, inner, inner] = True
    return solid


def cone(slope, top, n_levels=5):
    """Return a round cone whose radius shrinks by `slope` studs a level, to `top`."""
    radius = top + slope * np.arange(n_levels)[::-1, None, None]
    middle = np.arange(-radius.max() - 1, radius.max() + 2)
    return middle[:, None] ** 2 + middle**2 <= radius**2


def shown(solid):
    """Return the bricks seen from straight above or from straight below, and those on the outline."""
    around = np.pad(solid, 1)
    around[0] = around[1]  # the ground
    up, down = solid & ~around[2:, 1:-1, 1:-1], solid & ~around[:-2, 1:-1, 1:-1]
    beside = around[1:-1, 2:, 1:-1] & around[1:-1, :-2, 1:-1] & around[1:-1, 1:-1, 2:] & around[1:-1, 1:-1, :-2]
    return up | down, solid & ~beside


def placed(solid, upside_down):
    """Return the model, standing or hanging from a level of its widest outline, and which levels have a step."""
    if upside_down:
        return np.concatenate([solid[::-1], solid[:1]]), np.arange(1, len(solid))
    return solid, np.arange(len(solid) - 1)


def depths(level):
    """Return how many studs bricks lie behind the outline, -1 outside."""
    return ndimage.distance_transform_cdt(np.pad(level, 1), "chessboard")[1:-1, 1:-1] - 1


@BOTH
@pytest.mark.parametrize("slope", [1, 2, 3, 5])
def test_pyramid_has_a_ring_less_than_its_slope(slope, upside_down):
    """With a slope of n studs a level, each step gets n - 1 square rings, numbered from the outline inwards."""
    solid, steps = placed(pyramid(slope), upside_down)
    found = offsets(solid)
    np.testing.assert_array_equal(found.trajectories[steps], slope - 1)
    assert not found.left_alone.any()
    for level in steps:
        depth = depths(solid[level])
        np.testing.assert_array_equal(found.ring[level], np.where((depth > 0) & (depth < slope), depth, 0))
        assert found.cells[level] == np.count_nonzero(found.ring[level])


@BOTH
@pytest.mark.parametrize("top", [1.0, 4.5, 11.0, 23.7])
@pytest.mark.parametrize("slope", [1, 3])
def test_cone_has_a_ring_less_than_its_slope(slope, top, upside_down):
    """Around a cone it is the same number of rings in all directions, none for a slope of a stud a level."""
    solid, steps = placed(cone(slope, top), upside_down)
    found = offsets(solid)
    np.testing.assert_array_equal(found.trajectories[steps], slope - 1)
    if slope == 1:
        assert not found.ring[steps].any()


@pytest.mark.parametrize("side", [1, 2, 3, 8, 13])
@pytest.mark.parametrize("angle", [0, 45, 89])
def test_top_of_a_cube_is_filled(side, angle):
    """All of a flat roof but its rim is offset bricks whatever the angle, and nothing facing the ground is."""
    found = offsets(np.ones((4, side, side), bool), angle=angle)
    assert not found.left_alone.any()
    np.testing.assert_array_equal(found.cells, [0, 0, 0, max(side - 2, 0) ** 2])
    np.testing.assert_array_equal(found.trajectories, [0, 0, 0, (side - 1) // 2])


@pytest.mark.parametrize("height", [PLATE, BRICK])
@pytest.mark.parametrize("angle", [0, 30, 45, 60, 70, 80, 85])
@pytest.mark.parametrize("slope", [1, 2, 3, 4, 7])
def test_criterion_of_the_span(slope, angle, height):
    """A brick is offset just if n W > h tan(beta), n counted from the brick before it and more than 1."""
    solid = pyramid(slope, n_levels=3, top=8)
    found = offsets(solid, height=height, angle=angle)
    rings = np.arange(1, slope)
    left = slope - rings + 1
    needed = rings[left * STUD > height * np.tan(np.radians(angle))]
    spared = np.setdiff1d(rings, needed)
    for level in (0, 1):
        np.testing.assert_array_equal(np.setdiff1d(found.ring[level], 0), needed)
        np.testing.assert_array_equal(found.left_alone[level], np.isin(depths(solid[level]), spared))
    assert found.trajectories[0] == len(needed)


def test_default_angle_is_the_remark_of_the_paper():
    """At 45 degrees a span of one brick gets nothing and one of two bricks an offset."""
    assert offsets(pyramid(1)).cells.sum() == 0
    assert (offsets(pyramid(2)).cells[:-1] > 0).all()


def test_larger_angle_moves_the_limit():
    """At 70 degrees (h tan beta = 3.3 studs) a span of three bricks gets nothing and one of four its first ring."""
    assert offsets(pyramid(3), angle=70).cells.sum() == 0
    np.testing.assert_array_equal(offsets(pyramid(4), angle=70).trajectories, [1, 1, 1, 1, 0])


@given(BLOBS, st.sampled_from([PLATE, BRICK]), st.floats(0, 89))
def test_visible_bricks_are_sorted_without_gap_or_overlap(solid, height, angle):
    """Every brick seen from above or below is on the outline, offset or left alone; inner hidden ones are neither."""
    found = offsets(solid, height=height, angle=angle)
    visible, outline = shown(solid)
    assert not (found.left_alone & (found.ring > 0)).any()
    np.testing.assert_array_equal(found.left_alone | (found.ring > 0), visible & ~outline)


@given(BLOBS)
def test_no_offset_brick_is_hidden(solid):
    """No offset brick has one above and one below (or the ground)."""
    ring = offsets(solid).ring
    above = np.concatenate([solid[1:], np.zeros_like(solid[:1])])
    below = np.concatenate([np.ones_like(solid[:1]), solid[:-1]])
    assert not ((ring > 0) & above & below).any()


@given(BLOBS)
def test_larger_angles_never_offset_more(solid):
    """What is offset at some angle is offset at every smaller one."""
    found = [offsets(solid, angle=angle).ring > 0 for angle in (30, 60, 75, 85)]
    for smaller, larger in pairwise(found):
        assert not (larger & ~smaller).any()


@given(BLOBS, st.integers(1, 4))
def test_ground_is_where_the_model_begins(solid, n_empty):
    """Empty levels below a model change nothing: what faces the ground does not show."""
    solid[0, 0, 0] = True
    lifted = offsets(np.concatenate([np.zeros((n_empty, *solid.shape[1:]), bool), solid]))
    np.testing.assert_array_equal(lifted.ring[n_empty:], offsets(solid).ring)
    assert not lifted.cells[:n_empty].any()


@given(BLOBS)
def test_quarter_turn_turns_the_offsets(solid):
    """Rings do not depend on the direction of the axes."""
    found, other = offsets(solid, angle=60), offsets(np.rot90(solid, axes=(1, 2)), angle=60)
    np.testing.assert_array_equal(np.rot90(found.ring, axes=(1, 2)), other.ring)
    np.testing.assert_array_equal(np.rot90(found.left_alone, axes=(1, 2)), other.left_alone)


@pytest.mark.parametrize("wall", [1, 2, 4])
@pytest.mark.parametrize("angle", [45, 85])
def test_floor_of_a_pit_is_offset_from_its_walls(wall, angle):
    """A floor that no outline of its own level bounds is filled from the walls, however thin they are."""
    solid = np.ones((2, 5 + 2 * wall, 7 + 2 * wall), bool)
    floor = np.s_[wall:-wall, wall:-wall]
    solid[1][floor] = False
    found = offsets(solid, angle=angle)
    depth = np.minimum.outer([1, 2, 3, 2, 1], [1, 2, 3, 4, 3, 2, 1])
    np.testing.assert_array_equal(found.ring[0], np.pad(depth, wall))
    assert not found.left_alone.any()


def test_foot_of_a_tower_ends_the_span():
    """On a roof with a tower, rings run from the rim inwards; the bricks nearest the tower are the last."""
    solid = np.zeros((2, 13, 13), bool)
    solid[0] = True
    solid[1, 5:8, 5:8] = True
    found = offsets(solid, angle=70)
    depth = np.abs(np.mgrid[-6:7, -6:7]).max(axis=0)
    np.testing.assert_array_equal(found.ring[0], np.where((depth > 3) & (depth < 6), 6 - depth, 0))
    np.testing.assert_array_equal(found.left_alone[0], (depth > 1) & (depth < 4))


def test_leaning_slab_is_offset_both_ways():
    """A slab that leans by four studs a level shows up on one side and down on the other, each with its own rings."""
    solid = np.zeros((4, 9, 24), bool)
    for level in range(4):
        solid[level, :, 4 * level : 4 * level + 8] = True
    ring = offsets(solid).ring
    np.testing.assert_array_equal(ring[1:3, 4, :][0, 4:12], [0, 1, 2, 3, 3, 2, 1, 0])
    np.testing.assert_array_equal(offsets(solid).trajectories, [3, 6, 6, 6])


def test_bricks_left_alone_take_the_colour_of_the_nearest():
    """A brick left alone takes the nearest colour of its own level, the first of two equally near; others stay."""
    colour = np.array([[[1, 2, 3, 4, 5, 6]], [[7, 7, 7, 7, 7, 7]]], np.int16)
    left_alone, source = np.zeros(colour.shape, bool), np.zeros(colour.shape, bool)
    left_alone[0, 0, 1:5] = True
    source[:, 0, [0, 4, 5]] = True
    source[0, 0, 4] = False
    left_alone[0, 0, 4] = False
    changed = recolour_rings(colour, left_alone, source)
    np.testing.assert_array_equal(changed, [[[1, 1, 1, 6, 5, 6]], [[7] * 6]])
    np.testing.assert_array_equal(colour[0, 0], np.arange(1, 7))


def test_equally_near_colours_are_settled_by_the_grid():
    """Of four equally near bricks, the first one in the grid gives its colour."""
    colour = np.arange(9, dtype=np.int16).reshape(1, 3, 3)
    left_alone = colour == 4
    assert recolour_rings(colour, left_alone, colour % 2 == 1)[0, 1, 1] == 1
    assert recolour_rings(colour, left_alone, colour == 7)[0, 1, 1] == 7


def test_the_first_of_twelve_equally_near_colours():
    """Twelve squares lie five studs from another one: the first of them in the grid gives its colour."""
    y, x = np.indices((11, 11))
    source = ((x - 5) ** 2 + (y - 5) ** 2 == 25)[None]
    assert source.sum() == 12
    left_alone = np.zeros_like(source)
    left_alone[0, 5, 5] = True
    colour = np.arange(121, dtype=np.int16).reshape(source.shape)
    assert recolour_rings(colour, left_alone, source)[0, 5, 5] == colour[source][0]


def test_recolouring_without_colours_changes_nothing():
    """Without a source, or without a brick to recolour, colours stay as they are."""
    colour = np.arange(6, dtype=np.int16).reshape(1, 2, 3)
    for left_alone, source in ((True, False), (False, True)):
        masks = np.full(colour.shape, left_alone), np.full(colour.shape, source)
        np.testing.assert_array_equal(recolour_rings(colour, *masks), colour)


def post(*tops):
    """Return a post of 2 x 2 with masks of levels on top, all 12 x 12 with the post at rows and columns 5, 6."""
    foot = np.zeros((12, 12), bool)
    foot[5:7, 5:7] = True
    return np.stack([foot, foot, *(top | foot for top in tops)])


def level(rows, columns):
    """Return a level with one rectangle."""
    mask = np.zeros((12, 12), bool)
    mask[rows, columns] = True
    return mask


def kinds(solid):
    """Return the number of point, edge and face overhangs."""
    found = overhang_kinds(solid)
    return [found.count(kind) for kind in OverhangKind]


ALL = slice(None)
FIXTURES = {
    "a post": (post(), [0, 0, 0]),
    "a table": (post(level(ALL, ALL)), [0, 0, 1]),
    "an arm": (post(level(slice(5, 6), slice(5, 12))), [0, 1, 0]),
    "two arms": (post(level(slice(5, 6), ALL)), [0, 2, 0]),
    "an arm two wide": (post(level(slice(5, 7), slice(5, 12))), [0, 0, 1]),
    "a bent arm": (post(level(5, slice(5, 12)) | level(slice(0, 6), 11)), [0, 1, 0]),
    "a collar": (post(level(slice(4, 8), slice(4, 8))), [0, 0, 0]),
    "a nose": (post(level(5, 7)), [0, 0, 0]),
    "a drop under a table": (np.insert(post(level(ALL, ALL)), 2, post(level(1, 2))[2], axis=0), [1, 0, 1]),
    "a slab in the air": (post(level(slice(0, 3), slice(0, 3))), [1, 0, 0]),
    "a brick beside a corner": (post(level(4, 4)), [1, 0, 0]),
}


@pytest.mark.parametrize("name", FIXTURES)
def test_kinds_of_overhangs(name):
    """Tips that begin in the air are points, arms edges, tables faces; a span of one brick is no overhang."""
    solid, expected = FIXTURES[name]
    assert kinds(solid) == expected


def test_overhangs_are_labelled_by_number():
    """Labels are those of the kinds, and cover what hangs but no post and no collar."""
    solid = post(level(slice(4, 8), slice(4, 8)), level(slice(4, 8), slice(0, 12)), level(0, 0))
    found = overhang_kinds(solid)
    assert [OverhangKind(kind) for kind in found.kind] == [OverhangKind.FACE, OverhangKind.FACE, OverhangKind.POINT]
    np.testing.assert_array_equal(np.bincount(found.label.ravel())[1:], [16, 16, 1])
    assert not found.label[:3].any()


@given(BLOBS)
def test_overhangs_have_nothing_below(solid):
    """Labels number bricks with nothing below; just those with no brick beside them that rests are points."""
    found = overhang_kinds(solid)
    assert not (found.label[1:] > 0)[solid[:-1] | ~solid[1:]].any()
    assert not found.label[:1].any()
    np.testing.assert_array_equal(np.unique(found.label[found.label > 0]), np.arange(1, len(found.kind) + 1))
    resting = solid.copy()
    resting[1:] &= solid[:-1]
    flat = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]], bool)[None]
    for number, kind in enumerate(found.kind, 1):
        touched = ndimage.binary_dilation(found.label == number, flat) & resting
        assert touched.any() == (kind != OverhangKind.POINT)


@pytest.mark.parametrize("shape", [(0, 3, 3), (3, 0, 4), (2, 3, 3)])
def test_empty_models(shape):
    """Nothing is offset and nothing hangs over where there is nothing."""
    solid = np.zeros(shape, bool)
    found = offsets(solid)
    assert found.cells.sum() == found.trajectories.sum() == found.left_alone.sum() == 0
    assert kinds(solid) == [0, 0, 0]
