"""Edits made in a layout: each holds or is refused, and the model stays as whole as it was."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.edits import apply_edits, edit_of, outcomes_of
from legorize_addon.core.edits.apply import NARROW
from legorize_addon.core.model import Role, concatenate, contact_graph
from tests.core.any_bricks import CATALOGUE, multiset, table
from tests.core.edits.models import (
    BRICK_1X1,
    BRICK_2X2,
    BRICK_2X4,
    PLATE_2X4,
    RED,
    ROW,
    WHITE,
    edit,
    random_edits,
    shell,
    wall,
)


def made(bricks, *edits, **options):
    """Make edits, each of which must hold, and return the bricks."""
    found, refused = apply_edits(bricks, CATALOGUE, edits, **options)
    assert not refused
    assert not [each.reason for each in outcomes_of(found, CATALOGUE, edits, refused) if each.reason]
    return found


def refusal(bricks, *edits, **options):
    """Make edits of which the last one is refused; return why."""
    found, refused = apply_edits(bricks, CATALOGUE, edits, **options)
    assert list(refused) == [len(edits) - 1]
    assert outcomes_of(found, CATALOGUE, edits, refused)[-1].reason == refused[len(edits) - 1]
    return refused[len(edits) - 1]


def colours(bricks):
    """Return the colour of each cell, -1 where it is empty."""
    graph = contact_graph(bricks, CATALOGUE)
    return np.append(bricks.colour, -1)[graph.owner]


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=12, deadline=None)
def test_each_holds_or_is_told(seed):
    """Of many edits at random, whatever is not in the bricks has a reason, and the model is as whole as before."""
    bricks = shell()
    edits = random_edits(bricks, 25, seed)
    found, refused = apply_edits(bricks, CATALOGUE, edits)
    graph = contact_graph(found, CATALOGUE)
    assert graph.collisions == 0
    assert graph.n_components == 1
    assert graph.n_floating == 0
    assert CATALOGUE.exists_in(found.part, found.colour).all()
    outcomes = outcomes_of(found, CATALOGUE, edits, refused)
    # nothing was lost on the way: those without a reason of their own are in the bricks, and most are
    assert {number for number, each in enumerate(outcomes) if each.reason} == refused.keys() | {
        number for number, each in enumerate(outcomes) if "made later" in each.reason
    }
    assert sum(not each.reason for each in outcomes) > 12


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=6, deadline=None)
def test_made_again_they_change_nothing(seed):
    """In a model that has them already, edits are found and not made a second time."""
    edits = random_edits(shell(), 12, seed)
    once, refused = apply_edits(shell(), CATALOGUE, edits)
    kept = [each for number, each in enumerate(edits) if number not in refused]
    twice, _ = apply_edits(once, CATALOGUE, kept)
    assert multiset(twice, steps=False) == multiset(once, steps=False)


def test_no_edits():
    """Without edits a model stays as it is."""
    assert apply_edits(wall(), CATALOGUE, [])[1] == {}
    assert multiset(apply_edits(wall(), CATALOGUE, [])[0]) == multiset(wall())


def test_a_brick_is_recoloured():
    """A part that is made in the colour stays, and no other brick changes."""
    bricks = made(wall(), edit_of("recolour", wall(), 1, CATALOGUE, WHITE))
    assert bricks.colour.tolist() == [RED, WHITE, RED, RED, RED, RED]
    assert multiset(bricks)[1][0] == ROW(BRICK_2X4)


def test_a_brick_is_recoloured_in_part():
    """Under another layout the cells have the colour, and all others keep theirs."""
    bricks = made(wall(), edit("recolour", BRICK_2X2, (3, 0, 3), WHITE))
    expected = colours(wall())
    expected[3:6, :, 3:5] = WHITE
    np.testing.assert_array_equal(colours(bricks), expected)


def test_a_part_that_is_not_made_in_the_colour():
    """Smaller ones take its place."""
    part, code = next(
        (row, int(code))
        for row, part in enumerate(CATALOGUE.parts)
        for code in CATALOGUE.codes
        if part.height == 3 and part.length <= 8 and not CATALOGUE.exists_in(row, code)
    )
    bricks = table([*((ROW(BRICK_2X4), x, 0, 0, 0, RED, 0, 0, 0) for x in (0, 4)), (part, 0, 0, 3, 0, RED, 0, 0, 1)])
    edited = made(bricks, edit_of("recolour", bricks, 2, CATALOGUE, code))
    assert len(edited) > 3
    assert set(colours(edited)[3:].ravel()) <= {code, -1}


def test_cells_are_deleted():
    """They are empty, and what was cut is laid anew."""
    bricks = made(wall(), edit("delete", BRICK_1X1, (5, 0, 6)))
    expected = colours(wall())
    expected[6:9, 0, 5] = -1
    np.testing.assert_array_equal(colours(bricks), expected)


def test_what_would_come_apart_is_not_deleted():
    """The only brick between two others has to stay, and so has the last one of all."""
    tower = table([(ROW(BRICK_1X1), 0, 0, z, 0, RED, 0, 0, 0) for z in (0, 3, 6)])
    assert "come apart" in refusal(tower, edit("delete", BRICK_1X1, (0, 0, 3)))
    assert refusal(tower.take(np.array([0])), edit("delete", BRICK_1X1, (0, 0, 0)))
    # what was empty before is as it should be
    assert len(made(tower, edit("delete", BRICK_1X1, (5, 5, 0)), shape=(9, 9, 9))) == 3


@pytest.mark.parametrize(("part", "cell"), [(BRICK_2X4, (3, 0, 0)), (PLATE_2X4, (3, 0, 4)), (BRICK_1X1, (5, 1, 6))])
def test_a_part_is_laid_by_force(part, cell):
    """Bricks and plates lie where they are wanted, across the seams of others; the cells stay the same."""
    bricks = made(wall(), edit("force", part, cell))
    np.testing.assert_array_equal(colours(bricks), colours(wall()))
    assert len(edit("force", part, cell).rows_of(bricks, CATALOGUE)) == 1


def test_a_part_that_sticks_out():
    """By force it may fill cells that were empty, where something holds it and the grid has room."""
    bricks = made(wall(), edit("force", BRICK_2X4, (8, 0, 0)), shape=(9, 2, 12))
    assert (colours(bricks)[:3, :, 8:12] == RED).all()
    assert "out of the grid" in refusal(wall(), edit("force", BRICK_2X4, (8, 0, 0)))
    assert "nothing would hold" in refusal(wall(), edit("force", BRICK_1X1, (11, 0, 6)), shape=(9, 2, 12))


def test_a_lock_needs_its_cells():
    """Where the model is not filled any more, a locked brick is not built again."""
    assert "no brick there" in refusal(wall(), edit("lock", BRICK_2X4, (6, 0, 0)), shape=(9, 2, 12))


def test_what_is_locked_survives_other_edits():
    """Edits around a brick do not touch it."""
    bricks = shell()
    row = int(np.flatnonzero(bricks.corner[:, 2] == 6)[3])
    lock = edit_of("lock", bricks, row, CATALOGUE)
    others = [
        each
        for each in random_edits(bricks, 20, 1)
        if each.kind != "delete" and lock.cells(CATALOGUE).isdisjoint(each.cells(CATALOGUE))
    ]
    found, _ = apply_edits(bricks, CATALOGUE, [lock, *others])
    assert len(lock.rows_of(found, CATALOGUE)) == 1


def on_a_brick(*above):
    """Return a 2 x 4 brick with parts on it: rows of number, x, y, turn, colour, two of them never in one cell."""
    rows = [(ROW(BRICK_2X4), 0, 0, 0, 0, RED, 0, 0, 0)]
    return table([*rows, *((ROW(part), x, y, 3, turn, colour, 0, 0, 1) for part, x, y, turn, colour in above)])


def test_a_lone_plate_beside_a_brick_is_forbidden():
    """Windows are laid in bricks where these fit: the brick makes room for a plate of two studs all the same."""
    bricks = on_a_brick(("3024", 0, 0, 0, RED), (BRICK_1X1, 1, 0, 0, RED))
    found, refused = apply_edits(bricks, CATALOGUE, [edit_of("forbid", bricks, 1, CATALOGUE)])
    assert refused == {}
    there = (found.corner == (0, 0, 3)).all(axis=1)
    assert [CATALOGUE.parts[row].title for row in found.part[there]] == ["Plate 1 x 2"]
    assert contact_graph(found, CATALOGUE).n_components == 1
    assert not contact_graph(found, CATALOGUE).collisions
    # what was laid instead is no edit itself
    later = edit_of("forbid", found, int(np.flatnonzero(there)[0]), CATALOGUE)
    assert "edit" not in apply_edits(found, CATALOGUE, [later])[1].get(0, "")


@pytest.mark.parametrize("beside", [[], [(BRICK_1X1, 1, 0, 0, WHITE)]])
def test_where_only_one_stud_fits_the_refusal_says_so(beside):
    """Beside it there is nothing, or another colour."""
    bricks = on_a_brick((BRICK_1X1, 0, 0, 0, RED), *beside)
    found, refused = apply_edits(bricks, CATALOGUE, [edit_of("forbid", bricks, 1, CATALOGUE)])
    assert refused == {0: NARROW}
    assert found is bricks


def test_a_slope_is_forbidden():
    """Bricks and plates lie in its place, and no other edit is said to be in the way."""
    slope = next(part.number for part in CATALOGUE.parts if part.title == "Slope 45 2 x 1")
    bricks = on_a_brick((slope, 0, 0, 0, RED))
    found, refused = apply_edits(bricks, CATALOGUE, [edit_of("forbid", bricks, 1, CATALOGUE)])
    assert refused == {}
    assert not (found.part == ROW(slope)).any()
    assert len(found) > 1


def test_a_part_is_forbidden():
    """Another one lies there, in the same colour, now and after later edits around it."""
    forbid = edit("forbid", BRICK_2X4, (2, 0, 3))
    bricks = made(wall(), forbid, edit("recolour", BRICK_1X1, (6, 0, 3), WHITE))
    graph = contact_graph(bricks, CATALOGUE)
    assert not (bricks.part[graph.owner[3:6, :, 2:6]] == ROW(BRICK_2X4)).any()


def test_supports_stay():
    """What stands under the model is planned anew with it: nobody edits it, and no window takes it out."""
    pillar = table([(ROW(BRICK_2X2), 8, 0, 0, 0, RED, int(Role.SUPPORT_KEPT), 0, 0)])
    bricks = concatenate([wall(), pillar])
    for kind in ("recolour", "delete", "force", "forbid"):
        assert "support" in refusal(bricks, edit(kind, BRICK_2X2, (8, 0, 0), WHITE))
    found = made(bricks, edit("force", BRICK_2X4, (3, 0, 0)))
    assert (found.role == Role.SUPPORT_KEPT).sum() == 1


def roof():
    """Return a wall with a tile of 2 x 4, one of 2 x 2 and a plate on top."""
    tops = [("87079", 0, 0), ("3068b", 4, 0), ("3022", 6, 0)]
    bricks = wall()
    more = table([(ROW(part), x, y, 9, 0, RED, 0, 0, 3) for part, x, y in tops])
    return concatenate([bricks, more])


def tops_of(bricks):
    """Return whether there is a tile on each stud square of the top plate."""
    graph = contact_graph(bricks, CATALOGUE)
    tile = np.array([part.profile == "tile" for part in CATALOGUE.parts])
    return np.where(graph.owner[9] >= 0, np.append(tile[bricks.part], False)[graph.owner[9]], False)


def test_tiles_change_as_plates_do_and_are_tiles_again():
    """Half of a tile is recoloured: bricks are laid anew there, and the top is as smooth as before."""
    bricks = roof()
    found = made(bricks, edit("recolour", "3022", (0, 0, 9), WHITE))
    assert (tops_of(found) == tops_of(bricks)).all()
    assert (colours(found)[9, :, :2] == WHITE).all()


def test_a_brick_on_a_tile():
    """What is laid on a tile by force has studs below it, and the rest is smooth again."""
    bricks = roof()
    found = made(bricks, edit("force", "3022", (0, 0, 9), RED), edit("force", "3022", (0, 0, 10), RED))
    assert not tops_of(found)[:, :2].any()
    assert tops_of(found)[:, 2:6].all()
    assert contact_graph(found, CATALOGUE).n_components == 1


def test_a_tile_by_force():
    """A plate becomes a tile where that is wanted."""
    found = made(roof(), edit("force", "3068b", (6, 0, 9)))
    assert tops_of(found)[:, :8].all()
