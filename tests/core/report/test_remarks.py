"""Sentences on what does not hold: the reason is named in words that users know."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.verdict import Verdict
from legorize_addon.core.report.remarks import brick_name, layer_of, remarks
from legorize_addon.core.statics.forces import Ground
from scripts.benchmarks.stablelego import CASES, arm
from tests.core.standing import CATALOGUE, downward, judged, table


def told(bricks, **options):
    """Return the remarks on bricks."""
    return remarks(Assembly(bricks, CATALOGUE), judged(bricks, **options))


def test_what_stands_needs_no_words() -> None:
    """A tower that stands in one piece gives no remark."""
    assert told(table(("3001", 0, 0, 0), ("3001", 0, 0, 3))) == ()


def test_brick_has_a_name() -> None:
    """Colour and part by name; layers count from 1, three plates each."""
    bricks = table(("3001", 0, 0, 0), ("3024", 0, 0, 5))
    bricks = replace(bricks, colour=np.array([4, 15], dtype=np.int16))
    assert [brick_name(Assembly(bricks, CATALOGUE), row) for row in range(2)] == [
        "Red Brick 2 x 4",
        "White Plate 1 x 1",
    ]
    assert [layer_of(bricks, row) for row in range(2)] == [1, 2]


@pytest.mark.parametrize(
    ("rows", "start"),
    [
        ([("3003", 9, 0, 3)], "1 brick hangs in the air in 1 body (layer 2): "),
        (
            [("3003", 9, 0, 9), ("3003", 9, 0, 3), ("3003", 9, 0, 6)],
            "3 bricks hang in the air in 1 body (layers 2 to 4)",
        ),
        ([("3003", 9, 0, 3), ("3003", 15, 0, 6)], "2 bricks hang in the air in 2 bodies (layers 2 to 3)"),
    ],
)
def test_what_hangs_is_counted(rows: list[tuple[str, int, int, int]], start: str) -> None:
    """Bricks and bodies in the air are counted, with the layers between which they hang."""
    [sentence] = told(table(("3001", 0, 0, 0), *rows))
    assert sentence.startswith(start)
    assert sentence.endswith(".")


def test_pieces_that_stand_apart_are_counted() -> None:
    """Two bodies on the ground are told, with the smaller one's size."""
    [sentence] = told(table(("3001", 0, 0, 0), ("3001", 0, 0, 3), ("3003", 9, 0, 0)))
    assert sentence.startswith("The model stands in 2 pieces that are not joined, the smallest of 1 brick:")


def test_tipping_is_told_in_mm() -> None:
    """A 2 x 8 brick on a 2 x 2 one has its centre of mass 2 - 18.75 / 5.55 studs outside of the edge."""
    bricks = replace(table(("3003", 0, 0, 0), ("3007", 0, 0, 3)), colour=np.full(2, 1, dtype=np.int16))
    [sentence] = told(bricks)
    outside = 8 * (18.75 / 5.55 - 2)
    assert sentence.startswith(
        f"The model tips over: it stands on one Blue Brick 2 x 2, and its centre of mass lies {outside:.1f} mm outside"
    )


def test_the_body_that_tips_is_named() -> None:
    """Of two bodies only the one that tips over is told of, by its bricks."""
    _, sentence = told(
        table(("3003", 0, 0, 0), ("3007", 0, 0, 3), ("3001", 0, 9, 0), ("3001", 0, 9, 3), ("3001", 0, 9, 6))
    )
    assert sentence.startswith("The piece of 2 bricks tips over: ")


def test_torn_joint_is_told_by_layer_and_part() -> None:
    """The joint that opens widest is told by its layer and both bricks, the others by their number."""
    bricks = table(("3001", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 2, 0, 3))
    bricks = replace(bricks, colour=np.array([4, 14, 1], dtype=np.int16))
    found = replace(judged(bricks), standing=Verdict.COLLAPSES)
    [sentence] = remarks(Assembly(bricks, CATALOGUE), replace(found, torn=np.array([[0, 1]])))
    assert "in layer 2 the Yellow Brick 2 x 2 tears off the Red Brick 2 x 4 below it; " in sentence
    [sentence] = remarks(Assembly(bricks, CATALOGUE), replace(found, torn=np.array([[-1, 0], [0, 1], [1, 2]])))
    assert "in layer 1 the Red Brick 2 x 4 tears off the ground, the first of 3 joints; " in sentence


def test_a_real_tear_is_told() -> None:
    """A load that hangs on a beam tears its own studs off the beam, not the columns."""
    bricks = table(*arm((8, 0, 2), (1, 3, 1), *((1, x, layer) for x in (0, 7) for layer in (0, 1))))
    found = judged(bricks, loads=downward(bricks, 1, 5.0))
    assert found.standing is Verdict.COLLAPSES
    [sentence] = remarks(Assembly(bricks, CATALOGUE), found)
    assert "in layer 3 the Red Brick 1 x 8 tears off the Red Brick 1 x 1 below it; " in sentence


def test_what_neighbours_hold_is_told_with_the_joint_that_studs_do_not() -> None:
    """A model that is wedged says so, and which joint its studs alone would lose; without one, what is in doubt."""
    bricks = CASES[6].bricks(CATALOGUE)
    found = judged(bricks, ground=Ground.BASEPLATE)
    [sentence] = remarks(Assembly(bricks, CATALOGUE), found)
    assert sentence.startswith("The model stands only while bricks side by side press on each other: its studs alone ")
    lower, upper = found.torn[0].tolist()
    assert f"in layer {bricks.corner[upper, 2] // 3 + 1} the " in sentence
    assert brick_name(Assembly(bricks, CATALOGUE), lower) in sentence
    assert brick_name(Assembly(bricks, CATALOGUE), upper) in sentence
    [doubt] = remarks(Assembly(bricks, CATALOGUE), replace(found, torn=found.torn[:0]))
    first = int(np.abs(found.yielding).max(axis=1).argmax())
    assert f"in doubt is first the {brick_name(Assembly(bricks, CATALOGUE), first)} in layer " in doubt


def test_too_little_to_spare_is_told_of_the_weakest_brick() -> None:
    """What stands with less to spare than is wished names the brick and what it has; with more it needs no words."""
    model = Assembly(table(("3001", 0, 0, 0), ("3003", 0, 0, 3)), CATALOGUE)
    found = replace(judged(model.bricks), margin=np.array([0.9, 0.15]))
    assert remarks(model, found) == remarks(model, found, spare=0.15) == ()
    [sentence] = remarks(model, found, spare=0.2)
    assert sentence.startswith(
        "The model stands, but with less than 20 % of its friction to spare: the Red Brick 2 x 2 in "
    )
    assert "layer 2 is known to have 15 % left" in sentence


def test_collapse_without_a_place_is_told() -> None:
    """What neither tips nor tears, as a brick that slides, is told to collapse."""
    found = judged(table(("3001", 0, 0, 0)), loads=np.array([[0.0152, 0, 0]]))
    assert (found.standing, found.tipping[0] > 0, len(found.torn)) == (Verdict.COLLAPSES, True, 0)
    [sentence] = remarks(Assembly(table(("3001", 0, 0, 0)), CATALOGUE), found)
    assert sentence.startswith("The model collapses under its own weight:")


def test_doubt_is_told_with_its_place() -> None:
    """Where nothing is proven, the brick with the least margin is named; those in the air are not asked."""
    bricks = table(("3001", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 9, 0, 3))
    bricks = replace(bricks, colour=np.array([4, 14, 1], dtype=np.int16))
    found = replace(judged(bricks), standing=Verdict.UNDECIDED, margin=np.array([0.5, -0.1, -1.0]))
    hanging, doubt = remarks(Assembly(bricks, CATALOGUE), found)
    assert "hangs in the air" in hanging
    assert "the weakest is the Yellow Brick 2 x 2 in layer 2;" in doubt
