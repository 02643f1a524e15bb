"""Pages that are cut into sheets."""

from __future__ import annotations

import re

import pytest

from legorize_addon.core.instructions.canvas import Page, Paint, rectangle
from legorize_addon.core.instructions.layer_maps import layer_files
from legorize_addon.core.instructions.paper import MARGIN, PAPERS
from legorize_addon.core.instructions.sheets import sheets, sheets_for

A4 = PAPERS["A4"]
RED = Paint(fill=(255, 0, 0))


def test_what_fits_stays_as_it_is():
    """A page of the size of the paper is one sheet, without a name."""
    page = Page(A4.width, A4.height, (), "Layer 1")
    assert list(sheets(page, A4)) == [("", page)]


@pytest.mark.parametrize(
    ("size", "cut"),
    [((800, 200), (5, 1)), ((800, 190), (3, 1)), ((500, 300), (2, 2)), ((150, 500), (1, 2)), ((298, 100), (2, 1))],
)
def test_the_fewest_sheets_cover_the_page(size, cut):
    """Lying or upright; together they are as large as the page, but for the rims that no printer reaches."""
    found = sheets_for(Page(*size), A4)
    assert (found.columns, found.rows) == cut
    wide, high = found.room
    assert found.columns * wide >= size[0]
    assert found.rows * high >= size[1]
    assert sorted(found.paper) == sorted(A4)
    assert found.room == (found.paper.width - 2 * MARGIN, found.paper.height - 2 * MARGIN)


def test_sheets_go_on_where_the_last_one_ends():
    """What is at the left edge of the second column lies there at the end of the first."""
    page = Page(500, 300, (rectangle(0, 0, 500, 300, RED),), "Layer 7")
    found = dict(sheets(page, A4))
    assert list(found) == ["A1", "A2", "B1", "B2"]
    wide, high = sheets_for(page, A4).room
    for row, column in ((0, 0), (0, 1), (1, 0), (1, 1)):
        sheet = found["AB"[row] + str(column + 1)]
        [shown] = sheet.items[0].items
        assert shown.matrix == (1, 0, 0, 1, MARGIN - column * wide, MARGIN - row * high)
        assert sheet.items[0].clip.points.min(axis=0).tolist() == [MARGIN, MARGIN]
        assert (sheet.items[0].clip.points.max(axis=0) - MARGIN).tolist() == pytest.approx([wide, high])
        assert (sheet.width, sheet.height, sheet.title) in {(*A4, "Layer 7"), (*A4[::-1], "Layer 7")}


def test_files_of_sheets_are_named_like_their_map():
    """The layer's number, then row and column; each is a picture of the size of the paper that shows its part alone."""
    pages = [Page(500, 150, (rectangle(0, 0, 500, 150, RED),), "Layer 1"), Page(200, 100, (), "Layer 2")]
    files = dict(layer_files(pages, A4))
    assert list(files) == ["001-A1.svg", "001-A2.svg", "002.svg"]
    sizes = [re.search(r'viewBox="([^"]+)"', text)[1].split()[2:] for text in files.values()]
    assert sizes == [["297", "210"]] * 2 + [["200", "100"]]
    assert "clip" in files["001-A1.svg"]
    assert list(dict(layer_files(pages))) == ["001.svg", "002.svg"]
