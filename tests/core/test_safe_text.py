"""Names given by users stay words: no LDraw reader takes them for a command, no spreadsheet for a formula."""

from __future__ import annotations

import csv
import io

import pytest

from legorize_addon.core.safe_text import META, csv_text, one_line, title_line

CONTROLS = "".join(map(chr, [*range(32), *range(127, 160), 0x2028, 0x2029, 0x202E, 0xFEFF, 0xDC80]))


@pytest.mark.parametrize(
    "word", [*sorted(META), "!LDRAW_ORG", "!LEGORIZE ROLE SHELL PIECE 7", "~Moved", "//", "_", "="]
)
@pytest.mark.parametrize("case", [str.upper, str.lower, str.title])
def test_no_title_is_a_command(word: str, case) -> None:
    """A keyword, alone or with more behind it, is no longer the first word."""
    for text in (case(word), f"{case(word)} model.ldr", f"  {case(word)}:", f"\n{case(word)}"):
        first = title_line(text).split()[0]
        assert first == "Model"
        assert case(word).strip() in title_line(text)


@pytest.mark.parametrize("text", ["box", "Steps of a house", "Stepladder", "3001", "Ä file", "日本"])
def test_plain_titles_stay(text: str) -> None:
    """What no reader takes for a command is left alone."""
    assert title_line(text) == text


def test_one_line_has_nothing_that_cannot_be_printed() -> None:
    """Line ends, other controls, marks that turn the writing around and halves of characters are gone."""
    assert one_line(f"a{CONTROLS}b{CONTROLS}") == "a b"
    assert one_line("grün  ❤\tx") == "grün ❤ x"
    for nothing in ("", " \n", CONTROLS):
        assert one_line(nothing) == title_line(nothing) == "Untitled"


@pytest.mark.parametrize("cell", ["=cmd|' /C calc'!A0", "+1", "-1+2", "@SUM(A1)", "\tx", "\rx", "\n=x", "\uff1dx"])
def test_no_cell_is_a_formula(cell: str) -> None:
    """An apostrophe makes it text; numbers and the rest of the table are as they were."""
    text = csv_text(("name", "count"), [(cell, -3), ("box", 2.5)], line_end="\r\n")
    rows = list(csv.reader(io.StringIO(text, newline="")))
    assert rows == [["name", "count"], [f"'{cell}", "-3"], ["box", "2.5"]]
