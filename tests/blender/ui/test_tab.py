"""Texts are wrapped at words, and Chinese and Japanese ones, which have none, at their wide letters."""

from __future__ import annotations

from legorize_addon.ui.tab import wrapped


def test_words_stay_whole() -> None:
    """A line has as many words as fit."""
    assert wrapped("one two three four", 9) == ["one two", "three", "four"]


def test_wide_letters_take_two_places() -> None:
    """Half as many of them fit in a line."""
    assert wrapped("積木模型已經完成", 8) == ["積木模型", "已經完成"]


def test_no_line_begins_with_a_full_stop() -> None:
    """It stays with the letter that it follows, also where nothing follows it."""
    assert wrapped("立つか調、作り直す。", 8) == ["立つか調、", "作り直", "す。"]
