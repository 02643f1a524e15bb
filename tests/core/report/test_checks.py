"""The checks of a finished model: none fails on a good one, and each says what fails."""

from __future__ import annotations

import copy

import pytest

from legorize_addon.core.report.checks import failed_checks

GOOD = {
    "connection": {"components": 1, "floating": 0, "collisions": 0},
    "unavailable_part_colours": {"bricks": 0},
    "buildable_steps": 3,
    "building": {"steps": 3, "ends_as_model": True, "proof": None},
    "stability": {"stable": True, "verdict": "stable", "failing": 0},
}


def test_good_model_fails_nothing() -> None:
    """One component that stands, in colours that exist, with an order that can be built."""
    assert failed_checks(GOOD) == []


def test_strength_that_was_not_asked_for_is_no_fault() -> None:
    """Without strengthening the verdict says how the model stands."""
    weak = GOOD | {"stability": GOOD["stability"] | {"stable": False}}
    assert len(failed_checks(weak | {"settings": {"strengthen": True}})) == 1
    assert failed_checks(weak | {"settings": {"strengthen": False}}) == []


@pytest.mark.parametrize(
    ("place", "value", "words"),
    [
        (("connection", "components"), 2, "Components .*: 2"),
        (("connection", "floating"), 1, "Floating.*: 1"),
        (("connection", "collisions"), 4, "more than one brick fills: 4"),
        (("unavailable_part_colours", "bricks"), 5, "not made: 5"),
        (("building", "steps"), 5, "cannot be built: 2"),
        (("building", "ends_as_model"), False, "does not end"),
        (("building", "proof"), {"collapsing": [1], "undecided": [2, 3]}, "not proven to stand: 3"),
        (("stability", "stable"), False, "not proven: stable, 0 bricks"),
    ],
)
def test_each_fault_has_its_line(place: tuple[str, str], value: object, words: str) -> None:
    """A single fault gives a single line."""
    facts = copy.deepcopy(GOOD)
    facts[place[0]][place[1]] = value
    with pytest.raises(AssertionError, match=words):
        assert failed_checks(facts) == []
    assert len(failed_checks(facts)) == 1
