"""Sub-models where they are called: places, matrices, colours, steps."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.ldraw.flatten import MOST_PARTS, flatten
from legorize_addon.core.ldraw.lines import parse

UPRIGHT = "1 0 0 0 1 0 0 0 1"


def flat(text, parts=("3005.dat",)):
    """Return the parts of a text, and their names."""
    return flatten(parse(text), parts.__contains__)


def test_calls_move_turn_and_colour():
    """A call within a call: both matrices count, colour 16 is that of the nearest call with one, others stay."""
    text = f"""0 FILE main
1 14 100 -24 40 0 0 -1 0 1 0 1 0 0 arm
0 FILE arm
1 16 40 -8 20 0 0 1 0 1 0 -1 0 0 hand
1 4 90 -8 30 {UPRIGHT} 3005.dat
0 FILE hand
1 16 1 2 3 {UPRIGHT} 3005.dat
"""
    parts, names = flat(text)
    assert [names[row] for row in parts.name] == ["3005.dat", "3005.dat"]
    assert parts.colour.tolist() == [14, 4]
    # the hand's brick: (1, 2, 3) is turned to (3, 2, -1), moved to (43, -6, 19), turned to (-19, -6, 43)
    assert parts.place.tolist() == [[81, -30, 83], [70, -32, 130]]
    np.testing.assert_array_equal(parts.matrix[0], np.eye(3))
    assert parts.line.tolist() == [7, 5]


def test_steps_count_through_sub_models():
    """Ends of steps in a model that is called lie between the parts before and after its call."""
    brick, call = f"1 4 0 0 0 {UPRIGHT} 3005.dat", f"1 4 0 0 0 {UPRIGHT} a"
    main = f"0 FILE m\n{brick}\n0 STEP\n{call}\n{brick}\n0 STEP\n{brick}\n"
    parts, _ = flat(f"{main}0 FILE a\n{brick}\n0 STEP\n{brick}\n")
    assert parts.step.tolist() == [0, 1, 2, 2, 3]


def test_parts_that_a_document_brings_along_stay_parts():
    """A .dat is a part, also where its geometry is in the document: it is known by its number, or not at all."""
    calls = f"1 4 0 0 0 {UPRIGHT} 3005.dat\n1 4 0 0 0 {UPRIGHT} mine.dat\n"
    text = f"0 FILE m\n{calls}0 FILE 3005.dat\n4 16\n0 FILE mine.dat\n1 16 0 0 0 {UPRIGHT} stud.dat\n"
    parts, names = flat(text)
    assert [names[row] for row in parts.name] == ["3005.dat", "mine.dat"]


@pytest.mark.parametrize("chain", [["a"], ["a", "b"], ["a", "b", "c"]])
def test_model_in_itself_is_refused(chain):
    """A model that contains itself, at once or by way of others, is named with its line."""
    calls = "".join(
        f"0 FILE {name}\n1 16 0 0 0 {UPRIGHT} {chain[(row + 1) % len(chain)]}\n" for row, name in enumerate(chain)
    )
    with pytest.raises(BuildError, match=f"Line {2 * len(chain)} puts the model a into itself"):
        flat(calls)


def test_deep_nesting_is_no_recursion():
    """Two thousand models in each other are read as well as one."""
    calls = "".join(f"0 FILE m{row}\n1 16 0 0 1 {UPRIGHT} m{row + 1}\n" for row in range(2000))
    parts, _ = flat(f"{calls}0 FILE m2000\n1 4 0 0 0 {UPRIGHT} 3005.dat\n")
    assert parts.place.tolist() == [[0, 0, 2000]]


def test_unfolding_is_bounded():
    """Twenty models that each call the next one ten times are refused before they are unfolded."""
    calls = "".join(f"0 FILE m{row}\n" + f"1 16 0 0 0 {UPRIGHT} m{row + 1}\n" * 10 for row in range(20))
    with pytest.raises(BuildError, match=f"more than {MOST_PARTS:,} parts"):
        flat(f"{calls}0 FILE m20\n1 4 0 0 0 {UPRIGHT} 3005.dat\n")


def chain(deep, inner, wide=1, matrix=UPRIGHT):
    """Return models that each call the next one some times, and the last one's lines."""
    calls = "".join(f"0 FILE m{row}\n" + f"1 16 0 0 0 {matrix} m{row + 1}\n" * wide for row in range(deep))
    return f"{calls}0 FILE m{deep}\n{inner}\n"


def test_steps_are_bounded():
    """Seventy models that double the steps of the next one would have more than a number can say."""
    with pytest.raises(BuildError, match=f"more than {MOST_PARTS:,} steps"):
        flat(chain(70, "0 STEP", wide=2))
    assert len(flat(chain(70, "", wide=2))[0]) == 0


def test_moves_are_bounded():
    """A hundred models around a million parts would be moved a hundred times: refused before."""
    brick = f"1 4 0 0 0 {UPRIGHT} 3005.dat"
    many = "\n".join([brick] * 1000)
    inner = f"0 FILE n\n{many}\n"
    calls = "\n".join([f"1 4 0 0 0 {UPRIGHT} n"] * 900)
    with pytest.raises(BuildError, match=r"lie in each other too deeply .*\.$"):
        flat(chain(100, calls) + inner)


def test_stretching_has_no_end():
    """Models that stretch each other beyond all numbers put their parts nowhere, without a warning."""
    parts, _ = flat(chain(80, f"1 4 1 2 3 {UPRIGHT} 3005.dat", matrix="1e6 0 0 0 1e6 0 0 0 1e6"))
    assert not np.isfinite(parts.matrix).all()


def test_endless_names_are_cut():
    """The sentence about a model in itself stays a sentence."""
    name = "m" * 5000
    with pytest.raises(BuildError, match=r"^Line 2 puts the model m{39}\u2026 into itself: remove that line\.$"):
        flat(f"0 FILE {name}\n1 16 0 0 0 {UPRIGHT} {name}\n")
