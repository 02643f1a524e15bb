"""Multi-part documents: pieces and supports as sub-models in assembly order."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings

from legorize_addon.core.files.ldraw import read_ldr, write_ldr
from legorize_addon.core.files.ldraw_mpd import write_mpd
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Role
from tests.core.any_bricks import CATALOGUE, any_bricks, everything, multiset, table

unhurried = settings(deadline=None, max_examples=50)


@unhurried
@given(any_bricks())
def test_multi_part_document_holds_the_same_bricks(bricks):
    """The sub-models together are the model, and what is built first has the lower steps."""
    read = read_ldr(write_mpd(Assembly(bricks, CATALOGUE), name="m.ldr", title="m"), CATALOGUE)
    aside = (bricks.role == Role.SUPPORT_OUTSIDE) & (bricks.piece > 0)
    called = bricks if aside.all() and len(np.unique(bricks.piece)) == 1 else bricks.take(~aside)
    assert multiset(read, steps=False) == multiset(called, steps=False)
    support = np.isin(read.role, [Role.SUPPORT_OUTSIDE, Role.SUPPORT_INSIDE])
    stage = read.piece * 2 + ~support
    order = np.argsort(read.step, kind="stable")
    assert (np.diff(stage[order]) >= 0).all()


def test_model_in_one_piece_is_not_divided():
    """Without supports and pieces the document holds the model itself, line for line."""
    single = write_ldr(Assembly(everything(), CATALOGUE), name="m.ldr", title="m")
    document = write_mpd(Assembly(everything(), CATALOGUE), name="m.ldr", title="m")
    assert document == f"0 FILE m.ldr\r\n{single}0 NOFILE\r\n"


def test_supports_and_pieces_become_sub_models_in_assembly_order():
    """Supports of a piece come before it, pieces by number, each as a sub-model called once by the main model."""
    rows = [(0, 0, 0, 0, 0, 4, 0, 1, 0), (0, 1, 0, 0, 0, 15, 4, 0, 0), (0, 2, 0, 0, 0, 4, 0, 0, 1)]
    document = write_mpd(Assembly(table([*rows, (0, 3, 0, 0, 0, 4, 5, 1, 0)]), CATALOGUE), name="m.ldr", title="m")
    names = [line.removeprefix("0 FILE ") for line in document.splitlines() if line.startswith("0 FILE")]
    assert names == ["m.ldr", "support-outside-0.ldr", "piece-0.ldr", "support-inside-1.ldr", "piece-1.ldr"]
    calls = [line.split()[-1] for line in document.splitlines() if line.startswith("1 16 ")]
    assert calls == names[1:]


def calls_in(text):
    """Return the sub-models that a model calls."""
    return [line.split()[-1] for line in text.splitlines() if line.startswith("1 16 ")]


def test_supports_of_later_pieces_are_beside_the_model():
    """What is taken out before its piece is joined is called with that piece by a model beside the main one."""
    rows = [(0, 0, 0, 0, 0, 4, 0, 0, 0), (0, 1, 0, 0, 0, 15, 4, 1, 0), (0, 2, 0, 0, 0, 4, 0, 1, 1)]
    document = write_mpd(Assembly(table(rows), CATALOGUE), name="m.ldr", title="m")
    main, *others = document.split("0 FILE ")[1:]
    calls = {
        part.split(".ldr")[0]: [line.split()[-1] for line in part.splitlines() if line.startswith("1 16 ")]
        for part in others
    }
    assert [line.split()[-1] for line in main.splitlines() if line.startswith("1 16 ")] == [
        "piece-0.ldr",
        "piece-1.ldr",
    ]
    assert calls["on-table-1"] == ["support-outside-1.ldr", "piece-1.ldr"]


def test_main_model_never_has_the_name_of_a_sub_model():
    """A document called like one of its own sub-models, or over several lines, reads as the same bricks."""
    rows = [(0, 0, 0, 0, 0, 4, 0, 0, 0), (0, 1, 0, 0, 0, 15, 4, 1, 0), (0, 2, 0, 0, 0, 4, 0, 1, 1)]
    plain = read_ldr(write_mpd(Assembly(table(rows), CATALOGUE), name="m.ldr", title="m"), CATALOGUE)
    for name in ("piece-0.ldr", "Support-Outside-1.ldr", "on-table-1.ldr", "a\r\n0 STEP\u2028b.ldr"):
        document = write_mpd(Assembly(table(rows), CATALOGUE), name=name, title="STEP")
        names = [line.lower() for line in document.splitlines() if line.startswith("0 FILE")]
        assert len(set(names)) == len(names) == 5
        assert multiset(read_ldr(document, CATALOGUE)) == multiset(plain)
