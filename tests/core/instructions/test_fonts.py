"""Widths of texts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.instructions.fonts import in_fonts, shortened, western, width, wrapped


def test_widths_are_those_of_helvetica():
    """Known advance widths: digits 556, W 944, i 222; bold is wider."""
    assert width("0123456789", 10) == pytest.approx(55.6)
    assert width("Wi", 1000) == 944 + 222
    assert width("Wi", 1000, bold=True) == 944 + 278
    assert width("é", 10) == width("e", 10)


@given(st.text(max_size=40), st.floats(20, 200))
def test_shortened_texts_fit(text, room):
    """Whatever a model is called, its name fits, and a name that fits stays as it is."""
    found = shortened(text, 5, room)
    assert width(found, 5) <= room
    if width(text, 5) <= room:
        assert found == text


@given(st.lists(st.text("abc", min_size=1, max_size=8), max_size=12), st.floats(10, 60))
def test_wrapped_lines_keep_all_words(words, room):
    """No word is lost, and a line is too long only if it is a single word."""
    lines = wrapped(" ".join(words), 5, room)
    assert " ".join(lines).split() == words
    assert all(width(line, 5) <= room or " " not in line for line in lines)


@given(st.text(max_size=40))
def test_western_texts_can_be_written(text):
    """Any text becomes one that the fonts have, and no letter is lost."""
    found = western(text)
    assert len(found) >= len(text)
    found.encode("cp1252")
    assert found == text or not in_fonts(text)


def test_western_letters_stay():
    """Letters that the fonts have stay; others lose what they cannot have."""
    assert western("Über § 4, Čapek 狐") == "Über § 4, Capek [U+72D0]"
