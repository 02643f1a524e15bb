"""Brick colours replaced by others: how they are written, and what becomes of a table of colours."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.colours.replacing import replaced, replacements, replacements_text
from legorize_addon.core.errors import SettingsError
from legorize_addon.core.model.catalogue import load_catalogue

CATALOGUE = load_catalogue()
CODES = CATALOGUE.codes.tolist()


def test_names_and_codes():
    """Both are understood, in any case and with any blanks; the later pair counts; nothing is an empty text."""
    assert replacements(" Tan=Dark Tan; 4 =15,red =  BLACK ,", CATALOGUE) == {19: 28, 4: 0}
    assert replacements("  ", CATALOGUE) == {}


@pytest.mark.parametrize(
    ("text", "words"), [("Tan", "'Tan'"), ("a=b=c", "'a=b=c'"), ("Tan=Gold dust", "'gold dust'"), ("=4", "''")]
)
def test_what_cannot_be_understood(text, words):
    """The sentence names the word that is wrong."""
    with pytest.raises(SettingsError, match=words):
        replacements(text, CATALOGUE)


@given(st.dictionaries(st.sampled_from(CODES), st.sampled_from(CODES), max_size=5))
def test_there_and_back(pairs):
    """What is written is read again; a colour that stands for itself is not written."""
    assert replacements(replacements_text(pairs, CATALOGUE), CATALOGUE) == {
        one: other for one, other in pairs.items() if one != other
    }


def test_colours_change_places():
    """All are replaced at once, and nothing else is."""
    codes = np.array([[4, 15], [1, -1]], dtype=np.int16)
    assert replaced(codes, {4: 15, 15: 4}).tolist() == [[15, 4], [1, -1]]
    assert codes.tolist() == [[4, 15], [1, -1]]
