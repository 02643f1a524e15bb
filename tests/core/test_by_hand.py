"""Edits in a whole run: every one is in the bricks of the result, or told with place and reason."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.by_hand import OTHER_GRID
from legorize_addon.core.edits import Edits, edit_of, edits_text, outcomes_of, read_edits
from legorize_addon.core.ldraw import read_ldraw
from legorize_addon.core.model import NOBODY, Fill, contact_graph, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.report.outputs import output_texts
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from tests.core.edits.models import random_edits
from tests.core.test_pipeline import check
from tests.core.textured import painted, table

CATALOGUE = load_catalogue()
SETTINGS = Settings(width=20, supports="columns")


@pytest.fixture(scope="module")
def mesh():
    """Return a table in a few colours, which has an overhang and legs."""
    return painted(table(), 3)


@pytest.fixture(scope="module")
def plain(mesh):
    """Return its model without edits."""
    return legorize(mesh, SETTINGS)


def edits_for(build, edits):
    """Return edits in the grid of a build."""
    return Edits(tuple(edits), build.scale, tuple(build.grid.origin.tolist()))


def test_none_of_a_hundred_is_lost(mesh, plain):
    """Each of 100 edits is in the bricks, or is told with its place and a reason; bricks, cells and files agree."""
    edits = edits_for(plain, random_edits(plain.bricks, 100, 3))
    build = legorize(mesh, SETTINGS, edits=edits)
    held = [each for each in build.outcomes if not each.reason]
    assert [each.edit for each in build.outcomes] == list(edits.edits)
    assert len(held) > 60
    # whatever counts as made is read off the bricks themselves
    again = outcomes_of(build.bricks, CATALOGUE, edits.edits, {})
    assert [each.edit for each in again if not each.reason] == [each.edit for each in held]
    facts = report(build, CATALOGUE, version="0", mm_per_unit=1.0, with_bound=False)
    assert facts["edits"]["made"] == len(held)
    assert len(facts["edits"]["unfitting"]) == 100 - len(held)
    assert sum("no longer fit" in note for note in build.notes) == min(100 - len(held), 13)
    files = output_texts(build, CATALOGUE, facts, "table")
    written = outcomes_of(read_ldraw(files["model.ldr"], CATALOGUE).bricks, CATALOGUE, edits.edits, {})
    assert {each.edit for each in held} <= {each.edit for each in written if not each.reason}
    assert read_edits(files["edits.json"], CATALOGUE) == edits
    assert json.loads(files["report.json"])["edits"] == facts["edits"]


def test_the_cells_are_those_that_bricks_fill(mesh, plain):
    """What was deleted or added by hand changes the cells that have to be covered, and nothing else in the result."""
    lowest = int(plain.bricks.corner[:, 2].argmax())
    edits = edits_for(plain, [edit_of("delete", plain.bricks, lowest, CATALOGUE)])
    build = legorize(mesh, SETTINGS, edits=edits)
    assert not build.outcomes[0].reason
    check(replace(build, timings={name: spent for name, spent in build.timings.items() if name != "edits"}))
    gone = (plain.hollow.cover == Fill.REQUIRED) & (build.hollow.cover == Fill.EMPTY)
    assert gone.any()
    owner = contact_graph(build.bricks, CATALOGUE).owner
    z, y, x = np.nonzero(gone.reshape(-1, *gone.shape[2:]))
    inside = z < len(owner)
    assert (owner[z[inside], y[inside], x[inside]] == NOBODY).all()


def test_without_edits_nothing_is_new(plain, mesh):
    """No stage, no file and the same bricks, with an empty list of edits."""
    build = legorize(mesh, SETTINGS, edits=edits_for(plain, []))
    assert "edits" not in build.timings
    np.testing.assert_array_equal(build.bricks.corner, plain.bricks.corner)
    assert "edits.json" not in output_texts(build, CATALOGUE, {}, "table")


def test_what_is_locked_survives_another_layout(mesh, plain):
    """A brick that another seed would not have laid lies there again."""
    other = legorize(mesh, replace(SETTINGS, seed=5, layout="fast"))
    locks = [edit_of("lock", plain.bricks, row, CATALOGUE) for row in range(len(plain.bricks))]
    lost = [
        each
        for each, now in zip(locks, outcomes_of(other.bricks, CATALOGUE, locks, {}), strict=True)
        if now.reason and each.colour in CATALOGUE.codes
    ][:5]
    assert lost
    build = legorize(mesh, replace(SETTINGS, seed=5, layout="fast"), edits=edits_for(plain, lost))
    assert sum(not each.reason for each in build.outcomes) >= len(lost) - 1


def test_in_another_size_all_are_told(mesh, plain):
    """Cells of another grid are others: nothing is edited there, every edit is kept and told."""
    edits = edits_for(plain, random_edits(plain.bricks, 3, 0))
    build = legorize(mesh, replace(SETTINGS, width=18), edits=edits)
    assert [each.reason for each in build.outcomes] == [OTHER_GRID] * 3
    assert build.edits == edits
    assert edits_text(build.edits) == edits_text(edits)
    assert sum("another size" in note for note in build.notes) == 3
