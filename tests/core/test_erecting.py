"""Replaced colours in a whole run: painted where the layout stays as good, laid anew where it does not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core import erecting
from legorize_addon.core.edits import Edits, edit_of
from legorize_addon.core.memo import Memo
from legorize_addon.core.model import load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings
from tests.core.test_pipeline import check
from tests.core.test_run import files_of
from tests.core.textured import split_at_x, table

CATALOGUE = load_catalogue()
MESH = split_at_x(table(leg=16.0))
START = Settings(width=12, layout="fast")
RED, BLUE, GREEN = 4, 1, 2


@pytest.fixture(scope="module")
def known():
    """Return the model of a table that is half red, half blue, and what the run leaves."""
    memo = Memo()
    trial = memo.trial()
    build = legorize(MESH, START, trial=trial)
    memo.keep(trial)
    return build, memo


def computed(memo, settings, **more):
    """Return an update, and the names of what it computed."""
    trial = memo.trial()
    build = legorize(MESH, settings, trial=trial, **more)
    return build, {entry.name.rpartition(".")[2] for entry in trial.entries if entry not in memo.entries}


def test_another_colour_lays_nothing(known):
    """The same bricks, supports and steps, in the other colour; the files are those of a full run."""
    plain, memo = known
    settings = replace(START, replace_colours="4=2")
    build, names = computed(memo, settings)
    assert names == {"cells_to_lay", "paint_draft", "paint_bricks", "paint_plan", "paint_cells"}
    assert files_of(build) == files_of(legorize(MESH, settings))
    was, now = plain.supports.bricks, build.supports.bricks
    np.testing.assert_array_equal(was.corner, now.corner)
    np.testing.assert_array_equal(was.step, now.step)
    stays = ~build.supports.temporary
    np.testing.assert_array_equal(np.where(was.colour == RED, GREEN, was.colour)[stays], now.colour[stays])
    assert (was.colour[~stays] == now.colour[~stays]).all()
    for code in (build.hollow.colour, build.unedited.colour, build.surface.codes):
        assert GREEN in code
        assert RED not in code
    check(build)


def test_two_colours_become_one(known):
    """What is one colour then is laid anew, in no more parts, and covers what both covered."""
    plain, memo = known
    build, names = computed(memo, replace(START, replace_colours="4=1"))
    assert "lay_with_slopes" in names
    assert RED not in build.bricks.colour
    assert len(build.bricks) <= len(plain.bricks)
    check(build)


def test_parts_that_are_not_made_are_laid_otherwise(known, monkeypatch):
    """A colour in which a part of the layout does not exist gets other parts, each of which exists."""
    plain, memo = known
    parts = np.unique(plain.bricks.part[plain.bricks.colour == RED])
    lacking = next(code for code in CATALOGUE.codes if not CATALOGUE.exists_in(parts, code).all())
    settings = replace(START, replace_colours=f"4={lacking}")
    build, names = computed(memo, settings)
    assert "lay_with_slopes" in names
    assert lacking in build.bricks.colour
    assert RED not in build.bricks.colour
    assert CATALOGUE.exists_in(build.bricks.part, build.bricks.colour).all()
    assert files_of(build) == files_of(legorize(MESH, settings))
    check(build)


def test_what_is_tried_in_vain_stops_at_the_layout(known, monkeypatch):
    """A layout that cannot be painted does not have to hold first, and leaves the random numbers as they were."""
    plain, _ = known
    parts = np.unique(plain.bricks.part[plain.bricks.colour == RED])
    lacking = next(code for code in CATALOGUE.codes if not CATALOGUE.exists_in(parts, code).all())
    tied = []
    tie = erecting.tie_parts
    monkeypatch.setattr(erecting, "tie_parts", lambda *given: tied.append(None) or tie(*given))
    settings = replace(START, replace_colours=f"4={lacking}")
    build = legorize(MESH, settings)
    assert len(tied) == 1
    monkeypatch.setattr(erecting, "cells_to_lay", lambda run, cells: (cells, False))
    assert files_of(legorize(MESH, settings)) == files_of(build)


def test_edits_are_made_in_painted_bricks(known):
    """One that gives a brick the colour that is replaced elsewhere keeps it."""
    plain, memo = known
    row = int(np.flatnonzero(plain.bricks.colour == BLUE)[0])
    edit = edit_of("recolour", plain.bricks, row, CATALOGUE, RED)
    edits = Edits((edit,), plain.scale, tuple(plain.grid.origin.tolist()))
    settings = replace(START, replace_colours="4=2")
    build, _ = computed(memo, settings, edits=edits)
    assert not build.outcomes[0].reason
    assert (build.bricks.colour == RED).sum() == 1
    assert GREEN in build.bricks.colour
    assert RED not in build.unedited.colour
