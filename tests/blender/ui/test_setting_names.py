"""What the window says names settings as its panels do."""

from __future__ import annotations

from dataclasses import fields

import pytest

from legorize_addon.core.settings import Settings
from legorize_addon.ui.setting_names import as_in_panel


def test_settings_have_the_names_of_the_panel() -> None:
    """With the group where they are found; also at the end of a sentence."""
    told = as_in_panel("open_bottom is on but hollow is off: turn open_bottom off, or raise limit_size.")
    assert told == (
        "Inside > Open bottom is on but hollow is off: turn Inside > Open bottom off, or raise Limits > Size (cm)."
    )
    left = [entry.name for entry in fields(Settings) if "_" in as_in_panel(f"choose another {entry.name}, please")]
    assert not left


@pytest.mark.parametrize(
    "sentence",
    [
        "Wrote models/learned_from.csv.",
        "learned 'keep_thin' and limit_size.csv",
        "Use --limit-size or my_keep_thin.",
    ],
)
def test_files_and_other_words_stay(sentence: str) -> None:
    """A path that has the name of a setting in it is still the path."""
    assert as_in_panel(sentence) == sentence
