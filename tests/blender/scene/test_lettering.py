"""Names in letters of all scripts."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.scene.lettering import outlines_of, title_for


def enclosed(shape):
    """Return the area that is filled, in squares of the size of the letters: holes run the other way round."""
    total, row = 0.0, 0
    for count in shape.count.tolist():
        x, y = shape.points[row : row + count].T
        total += (x * (y.take(range(1, count + 1), mode="wrap")) - x.take(range(1, count + 1), mode="wrap") * y).sum()
        row += count
    return abs(total) / 2


@pytest.mark.parametrize("text", ["Лиса", "Αλεπού", "狐狸", "キツネ", "여우", "לוח"])
def test_letters_of_other_scripts_have_outlines(text):
    """None of them is a box, and what Blender needed for them is gone."""
    title = title_for(text)
    assert title.outlines.missing == title.lost == ""
    assert title.outlines.count.sum() == len(title.outlines.points)
    assert (title.outlines.count >= 3).all()
    assert 0.3 * len(text) < title.outlines.width < 1.2 * len(text)
    assert 0.02 * len(text) < enclosed(title.outlines) < 0.6 * len(text)
    assert not [thing for thing in (*bpy.data.curves, *bpy.data.objects) if "Lettering" in thing.name]


def test_letters_that_every_reader_has_stay_a_text():
    """Nothing is drawn for them."""
    assert title_for("Größe é §").outlines is None


def test_letters_that_no_font_has_are_named():
    """They are boxes: the sentence says which."""
    title = title_for("x \U00010380")
    assert title.outlines.missing == "\U00010380"
    assert "No font has the letters \U00010380 " in title.lost


def test_a_letter_lies_on_its_line():
    """Letters rise above the base line: y goes downwards. The hole of an O is as deep as the O but for its strokes."""
    shape = outlines_of("O")
    assert shape.points[:, 1].min() == pytest.approx(-0.73, abs=0.06)
    assert len(shape.count) == 2
    assert enclosed(shape) < 0.6 * 0.73 * shape.width
