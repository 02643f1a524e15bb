"""Repairs that the paper does not have are counted, and told of models that are made as in the paper."""

from __future__ import annotations

from dataclasses import asdict, replace

import pytest

from legorize_addon.core.beyond import Beyond, beyond_paper
from legorize_addon.core.drafting import draft_model
from legorize_addon.core.model import Role, load_catalogue
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.presets import preset_values
from legorize_addon.core.report.report import report
from legorize_addon.core.settings import Settings
from legorize_addon.core.stages import hollow_by
from tests.core.any_bricks import table as bricks_of
from tests.core.solids import box, joined

PAPER = Settings(**preset_values("paper") | {"width": 10})
NOTHING = Beyond(0, 0, 0, 0, 0, 0)


def counted(settings, made, final=None, ties=0):
    """Count the repairs of a draft."""
    final = bricks_of([]) if final is None else final
    return beyond_paper(made, hollow_by(settings, made.grid), final, plates=True, ties=ties)


@pytest.fixture(scope="module")
def thin():
    """Return a wall of 3 mm on a block: 80 x 3 mm on 80 x 80, ten layers above three."""
    return joined(box((0, 0, 0), (80, 80, 28.8)), box((0, 38.5, 28.8), (80, 41.5, 124.8)))


def test_thin_parts_are_counted(thin):
    """A wall that fills less than half of its cells is there because it is kept; without it there are none."""
    made = draft_model(thin, PAPER)
    assert counted(PAPER, made).thin >= 80
    bare = replace(PAPER, keep_thin=False)
    assert counted(bare, draft_model(thin, bare)) == NOTHING


def test_whole_bodies_need_nothing():
    """A block has no repairs, and says so."""
    build = legorize(box((0, 0, 0), (80, 80, 48)), PAPER)
    assert build.beyond == asdict(NOTHING)
    assert "Beyond the paper, so that the model holds: nothing." in build.notes


def test_what_is_told(thin):
    """The remark has the counts of the report; a default build says nothing."""
    build = legorize(thin, PAPER)
    told = report(build, load_catalogue(), version="0", mm_per_unit=1.0)
    assert told["beyond_paper"] == build.beyond
    [note] = [note for note in told["notes"] if note.startswith("Beyond the paper")]
    assert f"{build.beyond['thin']} unit bricks of thin parts" in note
    default = legorize(thin, Settings(width=10, layout="fast"))
    assert default.beyond == {}
    assert not any("Beyond" in note for note in default.notes)


def test_pillars_and_ties():
    """Pillars are bricks of their role; ties are what the layout grew by."""
    made = draft_model(box((0, 0, 0), (80, 80, 48)), PAPER)
    final = bricks_of([(0, 0, 0, 0, 0, 4, Role.SUPPORT_KEPT, 0, 0)])
    assert counted(PAPER, made, final, 3) == replace(NOTHING, ties=3, pillars=1)
    assert (
        Beyond(0, 2, 0, 0, 3, 1)
        .sentence()
        .endswith("2 between bodies that nearly touch, 3 more parts by ties, 1 bricks of pillars that stay.")
    )
