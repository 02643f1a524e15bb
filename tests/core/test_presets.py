"""Presets are settings that can be made, each for something that a user sees."""

from __future__ import annotations

from dataclasses import asdict

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.presets import PRESETS, follows, preset_values
from legorize_addon.core.settings import Settings


@pytest.mark.parametrize("word", PRESETS)
def test_a_preset_is_a_set_of_settings(word):
    """It has a name and a sentence, its settings exist, can be combined, and are not the defaults written again."""
    preset = PRESETS[word]
    assert preset.name.istitle()
    assert preset.text.endswith(".")
    made = Settings(**preset_values(word))
    assert all(getattr(made, name) == value != getattr(Settings(), name) for name, value in preset.values.items())


def test_no_two_presets_are_the_same():
    """A choice that changes nothing is none."""
    assert len({Settings(**preset_values(word)) for word in PRESETS}) == len(PRESETS)


def test_an_unknown_preset_is_refused():
    """One sentence lists those that there are."""
    with pytest.raises(SettingsError, match=r"^There is no preset 'best': choose one of desk, .*\.$"):
        preset_values("best")


def test_what_follows_a_preset():
    """Other settings may differ, its own may not."""
    assert follows(asdict(Settings(**preset_values("paper") | {"width": 20})), "paper")
    assert not follows(asdict(Settings(**preset_values("paper") | {"layout": "fast"})), "paper")
    assert not follows(asdict(Settings()), "paper")
