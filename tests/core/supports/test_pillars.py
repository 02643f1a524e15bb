"""Pillars that stay: under what floats, and in closed hollows."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.statics.stability import stability
from legorize_addon.core.supports.boxes import INSIDE_COLOUR
from legorize_addon.core.supports.pillars import LooseError, add_inner_pillars, add_pillars, places_below
from tests.core.standing import CATALOGUE, table


def carried(*rows, colour=4):
    """Return bricks with pillars under all that floats, the graph of their contacts, and how many came in."""
    bricks = table(*rows)
    bricks = replace(bricks, colour=np.full(len(bricks), colour, np.int16))
    after = add_pillars(Assembly(bricks, CATALOGUE))
    return after.bricks, after.graph, len(bricks)


def test_nothing_holds_what_lies_on_a_tile():
    """It is said where, and what to do: no pillar stands on a tile."""
    with pytest.raises(LooseError, match=r"layer 2 .* choose another size") as caught:
        carried(("3005", 0, 0, 0), ("3070b", 0, 0, 3), ("3024", 0, 0, 4))
    assert caught.value.levels.tolist() == [4]


@pytest.mark.parametrize("gap", range(1, 12))
def test_pillar_fills_any_gap(gap):
    """Whatever the height in plates, the brick stands afterwards, and nothing overlaps."""
    bricks, graph, n = carried(("3003", 0, 0, 0), ("3003", 0, 0, 3 + gap))
    assert graph.n_floating == graph.collisions == 0
    heights = np.array([part.height for part in CATALOGUE.parts])[bricks.part[n:]]
    assert heights.sum() == gap
    assert (bricks.role[n:] == Role.SUPPORT_KEPT).all()
    assert (bricks.colour[n:] == 4).all()


def test_shortest_way_down_is_taken():
    """A beam over the ground and over a tower gets its pillar on the tower."""
    bricks, _, n = carried(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3009", 1, 0, 7))
    assert bricks.corner[n:].tolist() == [[1, 0, 6]]


def test_part_on_the_ground_stands_by_itself():
    """A beam of eight studs beside the model gets pillars with the middle of its weight between them."""
    bricks, graph, _ = carried(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3008", 5, 5, 3), ("3005", 12, 5, 6))
    own = graph.component == graph.component[2]
    feet = bricks.corner[own & (bricks.corner[:, 2] == 0), 0]
    assert feet.min() < 9 < feet.max() + 1
    assert stability(Assembly(bricks, CATALOGUE)).stable


def test_floating_parts_on_each_other_all_stand():
    """One pillar between the two that float, and upright ones down to the ground."""
    bricks, graph, n = carried(("3003", 9, 9, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 9))
    assert graph.n_floating == 0
    assert sorted(bricks.corner[n:, 2].tolist())[-1] == 6
    assert stability(Assembly(bricks, CATALOGUE)).stable


def test_nothing_floats_nothing_changes():
    """A model in one piece comes back as it was."""
    bricks, _, n = carried(("3003", 0, 0, 0), ("3003", 0, 0, 3))
    assert len(bricks) == n


def test_pillar_inside_is_red():
    """It stands on the floor below the brick that is named, and joins the two."""
    bricks = table(("3001", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6), ("3001", 0, 0, 9), ("3005", 3, 0, 6))
    after = add_inner_pillars(Assembly(bricks, CATALOGUE), np.array([4]))
    assert after.bricks.corner[5:].tolist() == [[3, 0, 3]]
    assert after.bricks.role[5:].tolist() == [Role.SUPPORT_INSIDE]
    assert after.bricks.colour[5:].tolist() == [INSIDE_COLOUR]
    assert {(0, 5), (5, 4)} <= set(map(tuple, after.graph.pairs.tolist()))


def test_pillars_stand_on_no_slope_and_hold_no_fall():
    """The way down onto the fall of a slope is shorter, but ends at no stud; an inverted slope is held at its foot."""
    bricks, graph, n = carried(("3039", 0, 0, 0), ("3003", 1, 0, 6))
    assert graph.n_floating == graph.collisions == 0
    assert set(bricks.corner[n:, 0].tolist()) == {2}
    bricks, graph, n = carried(("3665", 0, 0, 6), ("3003", 5, 0, 0))
    assert graph.n_floating == graph.collisions == 0
    assert set(map(tuple, bricks.corner[n:, :2].tolist())) == {(0, 0)}


@pytest.mark.parametrize("between", [False, True])
def test_pillars_between_the_bricks_that_are_asked_about(between):
    """Under the free end of an arm there is room down to a brick below it, if that may be stood on."""
    assembly = Assembly(table(("3008", 0, 0, 0), ("3005", 0, 0, 3), ("3010", 0, 0, 6)), CATALOGUE)
    found = places_below(assembly, np.ones(3, dtype=bool), between=between)
    assert found.on_brick.all()
    assert list(zip(found.x.tolist(), found.length.tolist(), strict=True)) == [(1, 3), (2, 3), (3, 3)] * between
