"""Multi-part documents: model, pieces and sub-assemblies in building order, supports among them."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings

from legorize_addon.core.building.moves import Action
from legorize_addon.core.building.order import steps_of
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.ldraw.lines import parse
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.supports.assembly_plan import plan_assembly
from tests.core.any_bricks import CATALOGUE, any_bricks, multiset
from tests.core.building.test_views import WALL, in_steps
from tests.core.files.flattened import afloat, bricks_of, read
from tests.core.standing import table

unhurried = settings(deadline=None, max_examples=50)

GATE = (("3004", 0, 0, 0), ("3004", 0, 0, 3), ("3004", 0, 0, 6), ("3008", 4, 0, 6), ("3008", 0, 0, 9))
"""An arm and what hangs from it, which needs a support."""

COMB = (
    *(("3008", 0, y, 0) for y in range(8)),
    ("3010", 7, 0, 3),
    ("3024", 10, 0, 2),
    ("3010", 7, 4, 3),
    ("3024", 10, 4, 2),
)
"""A bench with two equal arms, and a plate below the end of each."""


def document(bricks, **options):
    """Return the document of bricks."""
    assembly = Assembly(bricks, CATALOGUE)
    return write_mpd(assembly, steps_of(assembly), **{"name": "m.ldr", "title": "m", **options})


def built(*rows, pieces=None):
    """Return bricks with their supports."""
    bricks = table(*rows)
    if pieces is not None:
        bricks = replace(bricks, piece=np.array(pieces, np.int16))
    return plan_assembly(Assembly(bricks, CATALOGUE), wish="tree", deepest=3).bricks


def files_in(text):
    """Return the names of the models."""
    return [line.removeprefix("0 FILE ") for line in text.splitlines() if line.startswith("0 FILE")]


def calls_in(text):
    """Return the sub-models that are called, with their places."""
    return [(*line.split()[2:5], line.split()[-1]) for line in text.splitlines() if line.startswith("1 16 ")]


@unhurried
@given(any_bricks())
def test_multi_part_document_holds_the_same_bricks(bricks):
    """All models together are model and supports, whatever the bricks."""
    assert multiset(read_ldraw(document(bricks), CATALOGUE).bricks, steps=False) == multiset(bricks, steps=False)


def test_model_without_anything_that_hangs_is_one_model():
    """A tower needs no sub-models."""
    text = document(table(("3003", 0, 0, 0), ("3003", 0, 0, 3)))
    assert files_in(text) == ["m.ldr"]
    assert calls_in(text) == []


def test_equal_sub_assemblies_are_written_once_and_called_twice():
    """Two arms of one shape are one model, called where each of them stands."""
    text = document(table(*COMB))
    assert len(files_in(text)) == 2
    (*first, name), (*second, same) = calls_in(text)
    assert name == same == files_in(text)[1]
    assert first == ["0", "0", "0"]
    assert second == ["0", "0", "80"]
    assert "0 // Step 1, 2 times" in text or ", 2 times" in text
    assert multiset(read_ldraw(text, CATALOGUE).bricks, steps=False) == multiset(table(*COMB), steps=False)


def test_supports_stand_among_the_bricks_and_are_taken_out():
    """Each support is hidden from the step on in which it is taken out, for both programs; the last step has none."""
    bricks = built(*GATE)
    temporary = bricks.role == Role.SUPPORT_OUTSIDE
    assert temporary.any()
    text = document(bricks)
    models, first = read(text)
    assert len(bricks_of(models, first)) == (~temporary).sum()
    most = max(len(bricks_of(models, first, step=step)) for step in range(len(models[first].steps) + 1))
    assert most == len(bricks)
    assert text.count("0 !LEOCAD PIECE STEP_HIDE") == text.count("0 MLCAD BTG") == temporary.sum()
    assert text.count("0 !LPUB REMOVE GROUP") == text.count("0 GROUP ")


def test_steps_have_one_numbering():
    """There is one STEP for each step, whose number is told, in one of the models."""
    bricks = built(*GATE, pieces=[0, 0, 1, 1, 1])
    steps = steps_of(Assembly(bricks, CATALOGUE))
    text = document(bricks)
    lines = text.splitlines()
    assert sum(line.split()[1] == "STEP" for line in lines) == len(steps)
    told = [int(line.split()[3].rstrip(":,")) for line in lines if line.startswith("0 // Step")]
    assert sorted(told) == list(range(1, len(steps) + 1))
    # in the main model they ascend
    main = text.split("0 NOFILE")[0].splitlines()
    numbers = [int(line.split()[3].rstrip(":,")) for line in main if line.startswith("0 // Step")]
    assert numbers == sorted(numbers)


def test_view_is_turned_where_a_step_is_hidden():
    """What comes behind a wall is seen from the back, in two steps, and then the front is seen again.

    LeoCAD 26.09 knows STEP alone, and LPub3D counts no step in which nothing is: each end has one, and is read as one.
    """
    bricks = table(*WALL, ("3005", 2, 2, 0), ("3005", 3, 2, 0), ("3005", 2, -2, 0))
    text = write_mpd(Assembly(bricks, CATALOGUE), in_steps(bricks, [0] * 8 + [1, 2, 3]), name="m.ldr", title="m")
    ends = [line for line in text.splitlines() if "STEP" in line.split()[1]]
    turn = ends[1]
    assert ends == ["0 STEP", turn, "0 STEP", turn, "0 STEP", "0 ROTSTEP END", "0 STEP"]
    assert turn in ("0 ROTSTEP 0 90 0 REL", "0 ROTSTEP 0 180 0 REL")
    [section] = parse(text).sections.values()
    assert sum(item is None for item in section.items) == 4


@pytest.mark.parametrize("pieces", [None, [0, 0, 1, 1, 1]])
def test_nothing_floats_at_any_step(pieces):
    """Followed by rules of its own, every step of every model hangs together with its ground."""
    assert afloat(document(built(*GATE, pieces=pieces))) == {}
    assert afloat(document(table(*COMB))) == {}


def test_the_walk_finds_what_floats():
    """A document that leaves out a foot is found out."""
    text = document(table(("3003", 0, 0, 0), ("3003", 0, 0, 3), ("3003", 9, 0, 0)))
    lines = text.splitlines()
    without = [line for line in lines if line != next(each for each in lines if each.endswith("3003.dat"))]
    assert sum(afloat("\n".join(without)).values()) == 1


def test_pieces_are_called_once_their_supports_are_out():
    """A piece is a model with supports of its own, which are hidden in its last step."""
    high = [("3004", 0, 0, 3 * level) for level in range(4)]
    bricks = built(*high, ("3008", 4, 0, 9), ("3008", 0, 0, 12), pieces=[0, 0, 1, 1, 1, 1])
    steps = steps_of(Assembly(bricks, CATALOGUE))
    assert ((steps.moves.action == Action.REMOVE) & (steps.moves.piece == 1)).any()
    text = document(bricks)
    assert Counter(name for *_, name in calls_in(text))["piece-1.ldr"] == 1
    models, _ = read(text)
    mine = (bricks.piece == 1) & (bricks.role != Role.SUPPORT_OUTSIDE)
    assert len(bricks_of(models, "piece-1.ldr")) == mine.sum()


@pytest.mark.parametrize("name", ["piece-1.ldr", "PIECE-1.LDR", "a\r\n0 STEP\u2028b.ldr"])
def test_main_model_never_has_the_name_of_a_sub_model(name):
    """A document called like one of its own sub-models, or over several lines, reads as the same bricks."""
    bricks = built(*GATE, pieces=[0, 0, 1, 1, 1])
    text = document(bricks, name=name, title="STEP")
    names = [each.lower() for each in files_in(text)]
    assert len(set(names)) == len(names)
    assert multiset(read_ldraw(text, CATALOGUE).bricks) == multiset(read_ldraw(document(bricks), CATALOGUE).bricks)
