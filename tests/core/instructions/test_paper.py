"""Sheets and cells."""

from __future__ import annotations

import pytest

from legorize_addon.core.instructions.canvas import Text
from legorize_addon.core.instructions.paper import FOOT, GAP, LOWEST, MARGIN, NARROWEST, PAPERS, foot, page_cell


@pytest.mark.parametrize("paper", PAPERS.values())
def test_halves_of_halves_cover_the_page(paper):
    """Halves lie side by side with a gap, and end before they are too small."""
    page = page_cell(paper)
    assert page.x + page.width == pytest.approx(paper.width - MARGIN)
    assert page.y + page.height == pytest.approx(paper.height - MARGIN - FOOT)
    cells = [page]
    while cells:
        cell = cells.pop()
        assert cell.width >= NARROWEST
        assert cell.height >= LOWEST
        if cell.halves is None:
            continue
        one, other = cell.halves
        assert (one.x, one.y) == (cell.x, cell.y)
        assert one.width * one.height == other.width * other.height
        across = one.width < cell.width
        assert (2 * one.width + GAP if across else 2 * one.height + GAP) == pytest.approx(
            cell.width if across else cell.height
        )
        assert other.x + other.width == pytest.approx(cell.x + cell.width)
        assert other.y + other.height == pytest.approx(cell.y + cell.height)
        cells += [one, other]


def test_pages_have_numbers():
    """The number stands in the corner, on the sheet."""
    [text] = foot(7, PAPERS["A4"])
    assert isinstance(text, Text)
    assert text.text == "7"
    assert text.y < PAPERS["A4"].height
