"""What a declaration says of a setting."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Literal

import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.setting import check_value, help_text, renamed, setting


@dataclass(frozen=True)
class Some:
    """Two settings."""

    size: int = setting(3, "Size (studs)", "How large it is.", group="Size", limits=(1, 9), was="length")
    kind: Literal["a", "b"] = setting(
        "a", "Kind", "Which one.", group="Size", words={"a": "the first", "b": "the last"}
    )


SIZE, KIND = fields(Some)


def test_help_says_what_each_word_means() -> None:
    """The sentence, and for a choice the meaning of its words in one more."""
    assert help_text(SIZE) == "How large it is."
    assert help_text(KIND) == "Which one. a: the first; b: the last."


def test_an_earlier_name_is_told() -> None:
    """The remark has both names."""
    assert renamed(SIZE) == "The setting length is now called size: its value was used."


@pytest.mark.parametrize("value", [0, 10, 2.0, True, "3"])
def test_a_value_that_it_cannot_have_is_refused(value: object) -> None:
    """Beyond the limits, or of another type."""
    check_value(SIZE, int, 1)
    check_value(SIZE, int, 9)
    with pytest.raises(SettingsError, match=r"^size is .*\.$"):
        check_value(SIZE, int, value)


def test_a_word_that_is_not_offered_is_refused() -> None:
    """The sentence lists those that are."""
    check_value(KIND, Literal["a", "b"], "b")
    with pytest.raises(SettingsError, match=r"^kind is 'c': choose one of a, b\.$"):
        check_value(KIND, Literal["a", "b"], "c")
