"""What is said of edits that do not fit."""

from __future__ import annotations

from legorize_addon.core.edits import Outcome
from legorize_addon.core.report.edit_remarks import SHOWN, edit_facts, remarks_on_edits
from tests.core.any_bricks import CATALOGUE
from tests.core.edits.models import BRICK_2X4, edit

LOST = Outcome(edit("delete", BRICK_2X4, (0, 0, 0)), "it rains")
HELD = Outcome(edit("delete", BRICK_2X4, (4, 0, 0)))


def test_only_what_does_not_fit_is_told():
    """A sentence each, and for many of them one that counts the others."""
    assert remarks_on_edits([HELD, HELD], CATALOGUE) == ()
    [sentence] = remarks_on_edits([HELD, LOST], CATALOGUE)
    assert "because it rains." in sentence
    many = remarks_on_edits([LOST] * (SHOWN + 3), CATALOGUE)
    assert len(many) == SHOWN + 1
    assert many[-1].startswith("3 more edits")


def test_facts_have_all():
    """The report counts those that were made, and lists the others by their number."""
    facts = edit_facts([HELD, LOST, HELD], CATALOGUE)
    assert facts["made"] == 2
    assert [(each["edit"], each["reason"]) for each in facts["unfitting"]] == [(2, "it rains")]
