"""Settings come back from their JSON as they were, and a file that says something else is refused in one sentence."""

from __future__ import annotations

import json
from dataclasses import fields

import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.settings import Settings
from legorize_addon.core.settings_file import read_settings, settings_text


@given(
    st.builds(Settings, width=st.integers(1, 1000), palette=st.text(), cusp=st.floats(0.1, 9.6), hollow=st.booleans())
)
def test_settings_come_back(settings):
    """Every setting is written, and reading gives the same settings without a remark."""
    values, remarks = read_settings(settings_text(settings))
    assert list(values) == [entry.name for entry in fields(Settings)]
    assert Settings(**values) == settings
    assert remarks == ()


def test_a_report_can_be_read():
    """Its settings are taken; the rest of it is nobody's business."""
    assert read_settings(json.dumps({"bricks": 7, "settings": {"width": 12}})) == ({"width": 12}, ())


def test_earlier_names_are_read_with_a_remark():
    """A file of an earlier version still works, and says what has changed."""
    values, [remark] = read_settings('{"hold": 0.9}')
    assert values == {"clutch": 0.9}
    assert "clutch" in remark


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("{", r"^The settings are not valid JSON \(.*\): mend the file\.$"),
        ("[" * 100_000, r"^The settings are not valid JSON"),
        ("[1]", r"^The settings are not an object: .*\.$"),
        ('{"widht": 3}', r"^There is no setting 'widht': did you mean 'width'\?$"),
        ('{"": 3}', r"^There is no setting '': leave it out\.$"),
    ],
)
def test_other_texts_are_refused(text, sentence):
    """What is wrong and what to do."""
    with pytest.raises(SettingsError, match=sentence):
        read_settings(text)
