"""Equal pieces are built together."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.building.alike import alike_pieces, still_alike
from legorize_addon.core.building.check import walk
from legorize_addon.core.building.contacts import building_contacts
from legorize_addon.core.building.items import MOST, REACH
from legorize_addon.core.building.mirror import boxes
from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import plan_steps
from legorize_addon.core.building.steps import Kind
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role, concatenate
from tests.core.files.flattened import afloat, bricks_of, read
from tests.core.standing import CATALOGUE, table

FEET = 8
"""Where the second of two equal pieces stands, in x."""


def tower(x, *, hanging=0):
    """Return a tower of two columns of bricks, and an arm on top from which plates hang."""
    rows = [("3003", x + 2 * k, 0, 3 * level) for level in range(1, 5) for k in range(2)]
    return [*rows, ("3008", x, 0, 15), *(("3024", x + 4 + k, 0, 14) for k in range(hanging))]


def model(*towers, colour=None):
    """Return a floor on which towers are pieces of their own; the last brick may have another colour."""
    floor = [("3008", 8 * x, y, 0) for x in range(6) for y in range(2)]
    bricks = table(*floor, *(row for each in towers for row in each))
    piece = np.repeat(np.arange(1 + len(towers)), [len(floor), *map(len, towers)]).astype(np.int16)
    if colour is not None:
        bricks.colour[-1] = colour
    return replace(bricks, piece=piece)


def planned(bricks):
    """Return how a model is built, and what the walk through its steps finds."""
    gone = np.zeros(len(bricks), bool)
    assembly = Assembly(bricks, CATALOGUE)
    contacts = building_contacts(assembly, temporary=gone)
    steps = plan_steps(bricks, CATALOGUE, contacts.pairs, temporary=gone)
    return steps, walk(steps, assembly, contacts, temporary=gone)


def alike(bricks):
    """Return the pieces that are like one before them."""
    return alike_pieces(bricks, boxes(bricks, CATALOGUE), range(1, int(bricks.piece.max()) + 1))


def test_equal_pieces_near_each_other_are_alike():
    """Each brick of the second piece has its equal; another colour, or more studs than a step spans, part them."""
    bricks = model(tower(0), tower(FEET))
    [(piece, row_of)] = alike(bricks).items()
    assert piece == 2
    firsts, seconds = np.array(list(row_of.items())).T
    assert (bricks.piece[firsts] == 1).all()
    assert sorted(seconds.tolist()) == np.flatnonzero(bricks.piece == 2).tolist()
    np.testing.assert_array_equal(bricks.corner[seconds] - bricks.corner[firsts], [[FEET, 0, 0]] * len(firsts))
    assert alike(model(tower(0), tower(FEET), colour=15)) == {}
    assert alike(model(tower(0), tower(REACH - 7))) == {}


def test_three_equal_pieces_are_a_pair_and_one():
    """A step has room for two."""
    assert list(alike(model(tower(0), tower(FEET), tower(2 * FEET)))) == [2]
    assert list(alike(model(*(tower(x) for x in (0, 8, 16, 24))))) == [2, 4]


@pytest.mark.parametrize("hanging", [0, 3, 4])
def test_two_pieces_are_built_at_once(hanging):
    """Their steps are shared, each brick comes once, and the document has one of them and calls it twice."""
    bricks = model(tower(0, hanging=hanging), tower(FEET, hanging=hanging))
    steps, found = planned(bricks)
    assert found.buildable
    pieces = [each for each in steps.submodels if each.kind == Kind.PIECE]
    assert [each.like for each in pieces] == [pieces[0].number] * 2
    both = [step for step in steps if step.submodel == pieces[0].number]
    assert {step.times for step in both} == {2}
    assert max(len(step.bricks) for step in both) <= MOST
    placed = steps.moves.brick[steps.moves.action == Action.PLACE]
    assert sorted(placed.tolist()) == list(range(len(bricks)))
    document = write_mpd(Assembly(bricks, CATALOGUE), steps, name="model.ldr", title="towers")
    assert document.count("0 FILE piece-") == 1
    assert sum(line.startswith("1 ") and line.endswith("piece-1.ldr") for line in document.splitlines()) == 2
    assert sum(afloat(document).values()) == 0
    models, name = read(document)
    cells = Counter(cell for brick in bricks_of(models, name) for cell in brick)
    assert set(cells.values()) == {1}
    assert len(bricks_of(models, name)) == len(bricks)


@pytest.mark.parametrize(("hanging", "times"), [(5, 2), (6, 1)])
def test_a_piece_with_a_large_sub_assembly_is_built_by_itself(hanging, times):
    """Two of what hangs together in six bricks fit into a step, two of seven do not: neither do their pieces."""
    under = [(x, y) for x in (4, 5, 6) for y in (0, 1)][:hanging]
    towers = [[*tower(x)[:-1], ("3007", x, 0, 15), *(("3024", x + dx, y, 14) for dx, y in under)] for x in (0, FEET)]
    steps, found = planned(model(*towers))
    assert found.buildable
    pieces = [each.number for each in steps.submodels if each.kind == Kind.PIECE]
    assert {step.times for step in steps if step.submodel in pieces} == {times}
    assert all((steps.submodels[number].like == pieces[0]) == (times == 2) for number in pieces[1:])


@pytest.mark.parametrize("hanging", [0, 4])
def test_pieces_that_are_written_once_are_read_as_several(hanging):
    """Each brick of a document comes back with its own piece, also where a sub-assembly of equal pieces is in them."""
    bricks = model(*(tower(x, hanging=hanging) for x in (0, FEET, 2 * FEET)))
    steps, _ = planned(bricks)
    assert any(each.like != each.number for each in steps.submodels if each.kind == Kind.PIECE)
    document = write_mpd(Assembly(bricks, CATALOGUE), steps, name="model.ldr", title="towers")
    found = read_ldraw(document, CATALOGUE).bricks
    told = [sorted(zip(map(tuple, each.corner.tolist()), each.piece.tolist(), strict=True)) for each in (found, bricks)]
    assert told[0] == told[1]


def test_supports_of_equal_pieces_count():
    """A piece with a support is like another one with the same support alone."""
    bricks = model(tower(0), tower(FEET))
    both = [table(("3005", x + 7, 0, 12)) for x in (0, FEET)]
    supports = [
        replace(each, role=np.full(1, Role.SUPPORT_OUTSIDE, np.uint8), piece=np.full(1, 1 + k, np.int16))
        for k, each in enumerate(both)
    ]
    assert list(alike(concatenate([bricks, *supports]))) == [2]
    assert alike(concatenate([bricks, *supports[:1]])) == {}


def test_half_studs_part_what_was_equal():
    """Equal pieces that are moved together stay equal; not where a part of one of them is moved alone."""
    bricks = model(tower(0), tower(FEET))
    steps, _ = planned(bricks)
    assert any(each.like != each.number for each in steps.submodels)
    half = np.zeros((len(bricks), 2), np.uint8)
    half[bricks.piece > 0] = 1
    assert still_alike(steps, replace(bricks, half=half))
    half[(bricks.piece == 2) & (bricks.corner[:, 2] < 8)] = 0
    assert not still_alike(steps, replace(bricks, half=half))
