"""Models for which too few parts are owned."""

from __future__ import annotations

from dataclasses import dataclass

import pytest

from legorize_addon.core.errors import PartsError
from legorize_addon.core.progress import silent
from legorize_addon.core.settings import Settings
from legorize_addon.core.shortage import GAINS, with_enough_parts
from tests.core.solids import box


@dataclass(frozen=True)
class Made:
    """What is read of a build."""

    settings: Settings
    notes: tuple[str, ...] = ()


def tried(good, settings):
    """Return what is built if a function says which settings have enough parts, and all settings that were tried."""
    seen, shares = [], []

    def make(mesh, asked, progress):
        progress("layout", 0.5)
        seen.append((asked.plates, asked.plate_gain))
        if not good(asked):
            raise PartsError(f"Too few at {asked.plate_gain}.")
        return Made(asked)

    try:
        return with_enough_parts(make, box(), settings, lambda _, share: shares.append(share)), seen
    finally:
        assert shares == sorted(shares)


def test_enough_is_built_as_it_was_set():
    """Nothing else is tried, and nothing is said."""
    made, seen = tried(lambda asked: True, Settings())
    assert (made.notes, seen) == ((), [("pays", 0.2)])


def test_fewer_plates_step_by_step():
    """The first settings with enough parts are taken; the build keeps the user's, and says what was changed."""
    made, seen = tried(lambda asked: asked.plate_gain > 0.5, Settings())
    assert seen == [("pays", 0.2), ("pays", GAINS[0]), ("pays", GAINS[1])]
    assert made.settings == Settings()
    assert "save an error of 0.6" in made.notes[0]


def test_bricks_alone_are_the_last():
    """Without plates it may be possible; from all plates the way is longer by none."""
    made, seen = tried(lambda asked: asked.plates == "none", Settings(plates="all"))
    assert [plates for plates, _ in seen] == ["all", "pays", "pays", "pays", "none"]
    assert "bricks alone" in made.notes[0]


@pytest.mark.parametrize(("plates", "many"), [("none", 1), ("pays", 5)])
def test_the_first_sentence_counts(plates, many):
    """If nothing suffices, the error is that of the model that was asked for."""
    seen = []

    def make(mesh, asked, progress):
        seen.append(asked)
        raise PartsError(f"Number {len(seen)}.")

    with pytest.raises(PartsError, match="Number 1"):
        with_enough_parts(make, box(), Settings(plates=plates), silent)
    assert len(seen) == many


@pytest.mark.parametrize("other", [{"surface": "tiles"}, {"half_studs": True}, {"surface": "slopes"}])
def test_bricks_alone_are_tried_whatever_lies_among_plates(other):
    """Settings that need plates are off for the last attempt; the build keeps the user's."""
    made, seen = tried(lambda asked: asked.plates == "none", Settings(**other))
    assert seen[-1][0] == "none"
    assert made.settings == Settings(**other)
