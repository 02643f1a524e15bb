"""Edits as text: nothing is lost on the way, and what is wrong with a file is said in a sentence."""

from __future__ import annotations

import json

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.edits import Edits, edits_text, read_edits
from legorize_addon.core.errors import EditError
from tests.core.any_bricks import CATALOGUE
from tests.core.edits.models import BRICK_2X4, edit, random_edits, shell


@given(st.integers(0, 99), st.none() | st.floats(1e-3, 1e3), st.tuples(*[st.floats(-1e4, 1e4)] * 3))
@settings(max_examples=15, deadline=None)
def test_there_and_back(seed, scale, corner):
    """What is written is read again, to the last bit."""
    edits = Edits(tuple(random_edits(shell(), 5, seed)), scale, corner)
    assert read_edits(edits_text(edits), CATALOGUE) == edits


def test_no_edits():
    """An empty list is a valid file."""
    assert read_edits(edits_text(Edits()), CATALOGUE) == Edits()
    assert len(Edits()) == 0


GOOD = {"kind": "lock", "part": BRICK_2X4, "turn": 0, "cell": [0, 0, 0], "colour": 4}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "not valid JSON"),
        ("[" * 100_000, "not valid JSON"),
        ("[]", "not an object with a list"),
        ('{"edits": 1}', "not an object with a list"),
        ('{"version": 2, "edits": []}', "version 2"),
        ('{"scale": 0, "edits": []}', "scale of the edits is 0"),
        ('{"scale": NaN, "edits": []}', "scale of the edits is nan"),
        ('{"corner": [1, 2], "edits": []}', "corner of the edits"),
        ('{"corner": [1, 2, NaN], "edits": []}', "corner of the edits"),
        ('{"edits": [1]}', "Edit 1 is 1"),
        *(
            (json.dumps({"edits": [GOOD, {**GOOD, **wrong}]}), f"Edit 2 .*{words}")
            for wrong, words in (
                ({"kind": "paint"}, "kind 'paint'"),
                ({"part": 3001}, "part 3001"),
                ({"part": "99999x"}, "99999x"),
                ({"turn": 4}, "turn 4"),
                ({"turn": True}, "turn True"),
                ({"cell": [0, 0]}, "cell"),
                ({"cell": [0, 0, 0.5]}, "cell"),
                ({"cell": [0, 0, 10**9]}, "cell"),
                ({"colour": "red"}, "colour 'red'"),
                ({"colour": 31234}, "31234"),
            )
        ),
    ],
)
def test_wrong_files(text, words):
    """Each mistake has its own sentence with what to do."""
    with pytest.raises(EditError, match=words) as refused:
        read_edits(text, CATALOGUE)
    assert str(refused.value).endswith(".")


def test_a_grid_that_begins_elsewhere():
    """Whole cells between the corners of two grids are taken into account; anything else is another grid."""
    edits = Edits((edit("delete", BRICK_2X4, (5, 6, 7)),), 0.5, (10.0, 20.0, 30.0))
    moved = edits.moved_to(0.5, (10.0 - 16.0, 20.0 + 8.0, 30.0 - 3.2))
    assert moved.edits[0].cell == (7, 5, 8)
    assert moved.corner == (-6.0, 28.0, 26.8)
    assert edits.moved_to(0.51, edits.corner) is None
    assert edits.moved_to(0.5, (14.0, 20.0, 30.0)) is None


def test_a_file_without_a_grid():
    """What somebody wrote by hand is about the model that it is given with."""
    edits = read_edits(json.dumps({"edits": [GOOD]}), CATALOGUE)
    assert edits.moved_to(3.0, (1.0, 2.0, 3.0)) == Edits(edits.edits, 3.0, (1.0, 2.0, 3.0))
