"""What a builder is told of supports and steps."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.report.building_remarks import remarks_on_building, remarks_on_split
from legorize_addon.core.supports.assembly_plan import plan_assembly
from legorize_addon.core.supports.pillars import add_pillars
from tests.core.standing import CATALOGUE, table


def told(*rows, posts=False, deepest=3, **options):
    """Return what is told of bricks."""
    bricks = table(*rows)
    if posts:
        bricks = add_pillars(Assembly(bricks, CATALOGUE)).bricks
    return remarks_on_building(plan_assembly(Assembly(bricks, CATALOGUE), deepest=deepest, **options))


def test_nothing_to_tell():
    """A tower, and a gate whose support comes out again, need no words."""
    assert told(("3003", 0, 0, 0), ("3003", 0, 0, 3)) == ()
    gate = (
        ("3003", 0, 0, 0),
        ("3003", 6, 0, 0),
        ("3003", 0, 0, 3),
        ("3003", 6, 0, 3),
        ("3005", 4, 0, 3),
        ("3007", 0, 0, 6),
    )
    assert told(*gate, deepest=0) == ()


def test_post_that_stays_is_told():
    """A part that touches nothing else has one of one brick."""
    [sentence] = told(("3003", 0, 0, 0), ("3003", 0, 0, 6), posts=True)
    assert sentence == (
        "1 support brick stays in the model, under parts that would fall without them: "
        "on the layer maps at 1 A in layer 2 (step 1)."
    )


def test_high_slim_support_is_told():
    """In a shaft of one stud no support can be wide, in the open it is."""
    shaft = [("3005", x, y, 3 * z) for x in range(3) for y in range(3) for z in range(6) if (x, y) != (1, 1)]
    lid = [("3005", 1, 1, 15), ("3001", 0, 0, 18)]
    [sentence] = told(*shaft, *lid, deepest=0)
    assert sentence.startswith("1 support column is one stud wide and more than 4 bricks high")
    assert "2 B in layer" in sentence
    assert told(("3003", 0, 0, 0), *[("3003", 0, 0, z) for z in range(3, 18, 3)], ("3007", 0, 0, 18), deepest=0) == ()


def test_a_sub_assembly_that_leans_is_told():
    """An arm on a floor from whose end four plates hang: by itself it would stand on these."""
    floor, arm = [("3008", 0, y, 0) for y in range(16)], ("3007", 4, 8, 3)
    hanging = [("3024", x, y, 2) for x, y in ((9, 8), (10, 8), (11, 8), (11, 9))]
    [sentence] = told(*floor, arm, *hanging, wish="none")
    assert sentence.startswith("1 sub-assembly would fall over on the table")
    assert sentence.endswith("hold it in step 2.")


def test_brick_in_the_air_is_named():
    """Without supports, a brick that floats is named by colour, part and layer."""
    [sentence] = told(("3003", 0, 0, 0), ("3001", 0, 0, 6), wish="none")
    assert "1 brick with nothing to hold" in sentence
    assert "Brick 2 x 4 in layer 3" in sentence


def test_piece_without_hold_is_told():
    """A piece that touches nothing when it is joined is counted."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", 6, 0, 3)), piece=np.array([0, 1], np.int16))
    [sentence] = remarks_on_building(plan_assembly(Assembly(bricks, CATALOGUE), wish="none", deepest=3))
    assert "1 piece that has nothing to hold" in sentence


def test_tower_to_hold_is_told_with_its_step():
    """A beam that tips its foot over, with nothing put under it."""
    [sentence] = told(("3005", 0, 0, 0), ("3008", 0, 0, 3), wish="none")
    assert sentence == "1 tower has to be held by hand while building, the first in step 1."


def test_deep_hanging_is_told():
    """Bricks that hang over the model too deep for the limit, where no support can stand."""
    floor = [("3007", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 0, 0, 6), ("3003", 0, 0, 9)]
    sentences = told(*floor, ("3007", 0, 0, 12), ("3003", 6, 0, 9), ("3003", 6, 0, 6), deepest=0)
    assert any("2 bricks hang deeper than the limit" in sentence for sentence in sentences)


def in_one_piece(*rows):
    """Return what is told of a model in one piece that might have three."""
    return remarks_on_split(plan_assembly(Assembly(table(*rows), CATALOGUE), deepest=0), most=3)


def test_model_that_stays_in_one_piece_says_why():
    """Whoever asks for pieces and gets one reads why: no supports, or none worth a cut."""
    [tower] = in_one_piece(("3003", 0, 0, 0), ("3003", 0, 0, 3))
    assert tower == "The model stays in one piece, although 3 are allowed: it needs no supports that a cut could save."
    [gate] = in_one_piece(
        ("3003", 0, 0, 0),
        ("3003", 6, 0, 0),
        ("3003", 0, 0, 3),
        ("3003", 6, 0, 3),
        ("3005", 4, 0, 3),
        ("3007", 0, 0, 6),
    )
    assert gate.startswith("The model stays in one piece, although 3 are allowed: no cut ")
    assert gate.endswith(" that was tried saves 20% of its supports.")


def test_split_that_was_made_or_not_asked_for_needs_no_words():
    """Two pieces are an answer, and one piece is what was asked for by default."""
    bricks = replace(table(("3003", 0, 0, 0), ("3003", 0, 0, 3)), piece=np.array([0, 1], np.int16))
    assert remarks_on_split(plan_assembly(Assembly(bricks, CATALOGUE), deepest=0), most=3) == ()
    assert remarks_on_split(plan_assembly(Assembly(table(("3003", 0, 0, 0)), CATALOGUE), deepest=0), most=1) == ()
