"""Ties join whatever touches, and a little besides, and cost as little colour as they can."""

from __future__ import annotations

from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import ndimage

from legorize_addon.core.layout.joining import ties
from legorize_addon.core.layout.joining.cutting import Bench, Seam
from legorize_addon.core.layout.joining.ties import add_ties, tie_seam
from legorize_addon.core.layout.lay import lay_unjoined
from legorize_addon.core.layout.problem.problem import owners, with_margins
from legorize_addon.core.model.bricks import NOBODY, Bricks, Role
from legorize_addon.core.model.contacts import contact_graph
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY
from tests.core.layout.cells import CATALOGUE, RED, WHITE, assert_covers, grid_of, planes

BLUE = 1


def laid(grid):
    """Lay a grid and join nothing."""
    return lay_unjoined(grid, CATALOGUE, rng=np.random.default_rng(0))


def both(grid, *, plates=True):
    """Return the connections of a grid's bricks before and after, and the bricks after."""
    bricks = laid(grid)
    found, _ = add_ties(bricks, grid, CATALOGUE, plates=plates)
    return contact_graph(bricks, CATALOGUE), contact_graph(found, CATALOGUE), found


def wrong(grid, bricks, links) -> np.ndarray:
    """Return the cells of a grid in which another colour lies than theirs."""
    colour = planes(grid.colour)
    owner = np.full(colour.shape, NOBODY)
    n_z, n_y, n_x = links.owner.shape
    owner[:n_z, :n_y, :n_x] = links.owner
    return (colour >= 0) & (np.append(bricks.colour, np.int16(NOBODY))[owner] != colour)


def placed(*rows):
    """Return bricks, given number, colour and corner of each."""
    number, colour, *corner = zip(*rows, strict=True)
    n = len(rows)
    return Bricks(
        part=np.array([CATALOGUE.part_row(each) for each in number], np.int16),
        corner=np.array(corner, np.int32).T,
        turn=np.zeros(n, np.uint8),
        colour=np.array(colour, np.int16),
        role=np.full(n, Role.PLATE, np.uint8),
        piece=np.zeros(n, np.int16),
        step=np.zeros(n, np.int32),
    )


def claw(width=1, lowest=2):
    """Make a red block with a claw of another colour beside it that hangs in the air."""
    cells = np.full((4, 3, 5, 8), COLOUR_EMPTY)
    cells[:, :, :, :3] = RED
    cells[lowest:, :, 1 : 1 + width, 3:5] = BLUE
    return grid_of(cells)


def two_plates():
    """Make a red and a blue plate of 2 x 3 studs side by side in the air, and a stud on the ground by itself."""
    cells = np.full((2, 3, 3, 7), COLOUR_EMPTY)
    cells[1, 1, :, :4] = RED, RED, BLUE, BLUE
    cells[0, 0, 0, 6] = RED
    return grid_of(cells)


@pytest.mark.parametrize("width", [1, 3])
def test_what_colours_keep_apart_gets_a_plate_below(width):
    """A claw beside a block becomes part of it, all in its own colour, by a plate that reaches below the claw."""
    grid = claw(width)
    before, after, bricks = both(grid)
    assert (before.n_components, after.n_components) == (2, 1)
    assert not wrong(grid, bricks, after).any()
    n_z, n_y, n_x = after.owner.shape
    added = np.argwhere((after.owner != NOBODY) & ~planes(grid.solid)[:n_z, :n_y, :n_x])
    assert added[:, 0].tolist() == [5]


def test_what_stands_beside_is_joined_by_one_plate():
    """On the ground, with no room below, one cell is in the neighbour's colour, and nothing is added."""
    grid = claw(lowest=0)
    before, after, bricks = both(grid)
    assert before.n_components == 2
    assert after.n_components == 1
    assert wrong(grid, bricks, after).sum() == 1
    np.testing.assert_array_equal(after.owner != NOBODY, before.owner != NOBODY)
    assert CATALOGUE.exists_in(bricks.part, bricks.colour).all()


def test_no_plate_is_added_that_joins_nothing():
    """Where a place is offered at which one side has nothing to hold to, no plate is laid."""
    bricks = laid(two_plates())
    links = contact_graph(bricks, CATALOGUE)
    colour = with_margins(two_plates().colour, COLOUR_EMPTY)
    bench = Bench(bricks, owners(links, colour.shape), CATALOGUE)
    before = len(bench.laid)
    assert not tie_seam(bench, Seam(3, ((4, 0), (5, 0))), colour, 1, 0)
    assert not tie_seam(bench, Seam(3, ((3, 0), (4, 0))), colour, 1, 0)
    assert len(bench.laid) == before
    assert tie_seam(bench, Seam(3, ((1, 0), (2, 0))), colour, 1, 0)


def test_cell_that_is_seen_least_changes():
    """Of a wide claw's contact on the ground a cell with none of its sides open changes its colour."""
    grid = claw(width=3, lowest=0)
    _, after, bricks = both(grid)
    [[z, y, x]] = np.argwhere(wrong(grid, bricks, after))
    solid = np.pad(planes(grid.solid), 1)
    around = ndimage.convolve(solid.astype(int), ndimage.generate_binary_structure(3, 1).astype(int))
    assert around[z + 1, y + 1, x + 1] == 7


def test_colours_that_agree_are_kept():
    """Pillars of one colour, or of free colour, that touch are joined at no cost."""
    for other in (RED, COLOUR_ANY):
        cells = np.full((3, 3, 1, 2), RED)
        cells[..., 1] = other
        # single studs, so that nothing holds yet
        grid = grid_of(cells)
        apart = cells.copy()
        apart[..., 1] = BLUE
        bricks, _ = add_ties(laid(grid_of(apart)), grid, CATALOGUE, plates=True)
        links = contact_graph(bricks, CATALOGUE)
        assert links.n_components == 1
        assert len(bricks) >= 6


def test_wall_of_narrow_colours_is_one_piece():
    """A wall a stud thick in upright stripes, as many pieces as it has stripes, is joined by a plate at each seam."""
    cells = np.full((3, 3, 1, 9), COLOUR_EMPTY)
    cells[:] = np.resize([RED, WHITE, BLUE], 9)
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert before.n_components == 9
    assert after.n_components == 1
    assert wrong(grid, bricks, after).sum() <= 8


def test_plates_on_edge_get_one_below():
    """Plates with nothing above or below that touch sideways in two colours get one plate more, not on top."""
    grid = two_plates()
    before, after, bricks = both(grid)
    assert before.n_components == after.n_components + 1
    assert sorted(bricks.corner[:, 2]) == [0, 3, 4, 4]
    assert not wrong(grid, bricks, after).any()
    added = bricks.corner[:, 2] == 3
    assert bricks.role[added] == Role.PLATE
    assert (bricks.step == bricks.corner[:, 2] // 3).all()


def test_single_plates_beside_a_foot_are_joined_on_top():
    """Plates of another colour along a foot, too many to be recoloured, are joined by one that reaches over them."""
    cells = np.full((2, 3, 3, 6), COLOUR_EMPTY)
    cells[:, :, :2] = RED
    cells[0, 0, 2] = BLUE
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert (before.n_components, after.n_components) == (2, 1)
    assert not wrong(grid, bricks, after).any()
    added = (after.owner != NOBODY) & ~planes(grid.solid)
    assert np.argwhere(added)[:, :2].tolist() == [[1, 2]]


def test_row_after_row_is_joined():
    """A sheet of many stripes beside a foot is joined stripe by stripe, however many there are."""
    cells = np.full((2, 3, 15, 8), COLOUR_EMPTY)
    cells[0, 0] = np.resize([RED, BLUE, WHITE], 15)[:, None]
    cells[:, :, :2] = RED
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert before.n_components > 10
    assert after.n_components == 1
    assert_covers(bricks, add_ties(laid(grid), grid, CATALOGUE, plates=True)[1])


def test_place_on_top_is_tried_where_the_one_below_does_not_hold():
    """A plate above a row on the ground can be cut for a tie on that row, though a tie beside it is cheaper."""
    cells = np.full((1, 3, 2, 3), COLOUR_EMPTY)
    cells[0, 0] = [[COLOUR_EMPTY, RED, BLUE], [RED, RED, RED]]
    cells[0, 1, 0] = COLOUR_ANY, COLOUR_ANY, RED
    cells[0, 2, 0] = RED, BLUE, BLUE
    grid = grid_of(cells)
    bricks = placed(
        ("3024", RED, 1, 0, 0),
        ("3024", BLUE, 2, 0, 0),
        ("3623", RED, 0, 1, 0),
        ("3623", RED, 0, 0, 1),
        ("3024", RED, 0, 0, 2),
        ("3023", BLUE, 1, 0, 2),
    )
    assert contact_graph(bricks, CATALOGUE).n_components == 2
    found, joined = add_ties(bricks, grid, CATALOGUE, plates=True)
    links = contact_graph(found, CATALOGUE)
    assert links.n_components == 1
    assert not wrong(grid, found, links).any()
    assert_covers(found, joined)


def test_sheet_of_one_colour_is_joined_on_top():
    """A sheet a plate thick, larger than any plate, is no picture: plates on it make it one piece."""
    cells = np.full((1, 3, 9, 20), COLOUR_EMPTY)
    cells[0, 0] = RED
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert before.n_components > 5
    assert after.n_components == 1
    assert (bricks.colour == RED).all()


def test_flat_picture_stays_as_it_is():
    """A picture of single plates on the ground is not covered by plates and loses no pixel: it stays in pieces."""
    cells = np.full((1, 3, 2, 6), COLOUR_EMPTY)
    cells[0, 0] = [[RED, BLUE, RED, BLUE, WHITE, WHITE], [BLUE, RED, WHITE, RED, RED, BLUE]]
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert after.n_components == before.n_components
    assert not wrong(grid, bricks, after).any()


def test_picture_of_bricks_is_held_inside():
    """A picture of bricks is one piece, joined in the middle, where nobody sees it, or below."""
    cells = np.resize([RED, BLUE, WHITE, RED, WHITE], (1, 1, 6, 7))
    grid = grid_of(np.repeat(cells, 3, axis=1))
    before, after, bricks = both(grid)
    assert before.n_components > 20
    assert after.n_components == 1
    lost = wrong(grid, bricks, after)
    assert not lost[2].any()
    assert lost[1].sum() > 5 * lost[0].sum()


def test_what_is_apart_stays_apart():
    """Two studs between two bodies are too many, and the very same bricks come back."""
    cells = np.full((2, 3, 3, 8), COLOUR_EMPTY)
    cells[..., :3] = cells[..., 5:] = RED
    grid = grid_of(cells)
    bricks = laid(grid)
    found, same = add_ties(bricks, grid, CATALOGUE, plates=True)
    assert found is bricks
    assert same is grid


def test_heavy_parts_get_more_ties():
    """What many bricks hang on, and agrees in colour, is held in several places."""
    cells = np.full((14, 3, 6, 8), COLOUR_EMPTY)
    cells[..., :4] = RED
    cells[2:, :, :, 4:] = COLOUR_ANY
    apart = np.where(cells == COLOUR_ANY, BLUE, cells)
    bricks = laid(grid_of(apart))
    found, _ = add_ties(bricks, grid_of(cells), CATALOGUE, plates=True)
    links = contact_graph(found, CATALOGUE)
    assert links.n_components == 1
    across = (links.owner[:, :, 3] == links.owner[:, :, 4]) & (links.owner[:, :, 3] != NOBODY)
    assert len(np.unique(links.owner[:, :, 3][across])) > 1


def test_bricks_alone_are_joined_by_bricks():
    """Where only bricks are asked for, a brick lies across the seam, and no plate is laid."""
    grid = claw()
    before, after, bricks = both(grid, plates=False)
    assert before.n_components == 2
    assert after.n_components == 1
    assert {CATALOGUE.parts[part].height for part in bricks.part} == {3}
    assert wrong(grid, bricks, after).sum() == 3


@pytest.mark.parametrize("make", [claw, two_plates])
def test_grid_is_told_what_was_laid(make):
    """The grid that comes back is covered by the bricks in its own colours: recoloured, and with what was added."""
    grid = make()
    bricks, told = add_ties(laid(grid), grid, CATALOGUE, plates=True)
    assert_covers(bricks, told)
    assert (told.colour != grid.colour).sum() in (1, 2)
    assert not (grid.solid & ~told.solid).any()


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.sampled_from([0.3, 0.5, 0.8]))
def test_what_touches_holds(seed, filled):
    """Every body of cells that touch face to face above the ground is one piece; nothing is lost, all fits."""
    rng = np.random.default_rng(seed)
    cells = np.full((4, 3, 6, 7), COLOUR_EMPTY)
    choice = [COLOUR_EMPTY, COLOUR_ANY, RED, BLUE, WHITE]
    cells[1:3] = rng.choice(choice, (2, 3, 6, 7), p=[1 - filled, *[filled / 4] * 4])
    cells[0, 0, 0, 0] = RED
    grid = grid_of(cells)
    before, after, bricks = both(grid)
    assert after.n_components <= min(before.n_components, ndimage.label(planes(grid.solid))[1])
    assert after.collisions == 0
    n_z, n_y, n_x = after.owner.shape
    assert (after.owner != NOBODY)[planes(grid.solid)[:n_z, :n_y, :n_x]].all()
    assert CATALOGUE.exists_in(bricks.part, bricks.colour).all()


@pytest.mark.parametrize("plates", [True, False])
def test_same_input_same_bricks(plates):
    """Nothing is decided by chance."""
    grid = claw(width=3)
    bricks = laid(grid)
    one, other = (add_ties(bricks, grid, CATALOGUE, plates=plates)[0] for _ in range(2))
    np.testing.assert_array_equal(one.corner, other.corner)
    np.testing.assert_array_equal(one.part, other.part)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_what_hangs_on_a_joint_is_the_smaller_side(seed):
    """Of a forest, each joint is taken away, and the bricks on both sides are counted."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 12))
    joints = [sorted((int(rng.integers(node)), node)) for node in range(1, n) if rng.random() < 0.8]
    joints = np.array(rng.permutation(joints), np.int32).reshape(-1, 2)
    size = rng.integers(1, 9, n)

    def side(start, left):
        found = {start}
        while more := {node for joint in left if set(joint) & found for node in joint} - found:
            found |= more
        return int(size[list(found)].sum())

    for row, (one, other) in enumerate(joints.tolist()):
        left = np.delete(joints, row, axis=0).tolist()
        assert ties._hanging(joints, size)[row] == min(side(one, left), side(other, left))


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_more_ties_are_the_next_places_of_a_joint(seed):
    """Of the places after it: one that is free for each 6 bricks, up to 6; one that is dear for 40, less the free."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 40))
    price = np.sort(rng.choice([-0.1, 0.5, 0.6, 5.0, 10.5, 10.6, 11.0], n))
    pairs, joint = rng.integers(0, 2, (n, 2)), int(rng.integers(n))
    bricks = int(rng.choice([0, 5, 6, 11, 12, 35, 36, 39, 40, 45, 79, 80, 300]))
    same = [row for row in range(joint + 1, n) if sorted(pairs[row]) == sorted(pairs[joint])]
    free = [row for row in same if price[row] < 0.6][: min(bricks // 6, 6)]
    dear = [row for row in same if 0.6 <= price[row] < 10.6]
    expected = free + dear[: min(max(bricks // 40 - len(free), 0), 1)]
    assert list(ties._more(SimpleNamespace(price=price), pairs, [joint], [bricks])) == (expected if bricks >= 6 else [])


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_ties_offered_at_a_seam_are_all_that_there_are_in_order(seed):
    """Every form at every place is tried; in the order, fewest wrong squares, least seen, then most to rest on."""
    rng = np.random.default_rng(seed)
    cells = np.full((2, 3, 3, 5), COLOUR_EMPTY)
    cells[:, :, :, :] = rng.choice([COLOUR_EMPTY, 0, RED, RED], (3, 5))
    cells[0, :, 0, 0] = RED
    cells[rng.integers(2), rng.integers(3)] = COLOUR_EMPTY
    grid = grid_of(cells)
    bricks = laid(grid)
    colour = with_margins(grid.colour, COLOUR_EMPTY)
    bench = Bench(bricks, owners(contact_graph(bricks, CATALOGUE), colour.shape), CATALOGUE)
    level, y, x = (int(rng.integers(most)) for most in (6, 3, 4))
    seam, most_wrong = Seam(level, ((x, y), (x + 1, y))), int(rng.integers(3))
    ends = [bench.at(level, end) for end in seam.ends]
    cut = sorted({number for number in ends if number != NOBODY})
    beside = [bench.laid[number] for number in cut or bench.over_and_under(seam)]
    sides = [{end}.union(*(each.squares for each in beside if end in each.squares and cut)) for end in seam.ends]
    found = ties._ties(bench, seam, cut, colour, 1, most_wrong)
    expected = {}
    for code in {each.colour for each in beside}:
        for form in bench.forms.made(1, code):
            for corner in [(a, b) for a in range(-3, 6) for b in range(-3, 4)]:
                squares = {(corner[0] + a, corner[1] + b) for a, b in form.squares}
                inside = [(a, b) for a, b in squares if 0 <= a < 5 and 0 <= b < 3]
                if not (set(seam.ends) <= squares <= sides[0] | sides[1]):
                    continue
                wrong = [each for each in inside if colour[level + 1, each[1], each[0]] not in (code, COLOUR_EMPTY)]
                around = [bench.at(level + step, each) for each in inside for step in (-1, 1)]
                if len(wrong) <= most_wrong and (not wrong or set(around) != {NOBODY}):
                    faces = sum(bench.open_faces(level, each) for each in wrong)
                    rests = min(len(squares & side) for side in sides)
                    expected[form, corner, code] = (len(wrong), faces, -rests, -len(squares), corner)
    assert sorted(expected) == sorted((tie.form, tie.corner, tie.colour) for tie in found)
    ranks = [expected[tie.form, tie.corner, tie.colour] for tie in found]
    assert all(one <= other for one, other in pairwise(ranks))
    assert {tie.level for tie in found} <= {level}
