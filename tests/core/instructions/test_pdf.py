"""Pages as PDF."""

from __future__ import annotations

import re
import zlib

import numpy as np

from legorize_addon.core.instructions.canvas import Group, Page, Paint, Path, Text, rectangle
from legorize_addon.core.instructions.pdf import POINTS_PER_MM, Document, data

INK = Paint(fill=(255, 0, 0), stroke=(0, 0, 0), width=0.25)


def streams(file):
    """Return the contents of all streams of a file."""
    return [zlib.decompress(each) for each in re.findall(rb"stream\n(.*?)\nendstream", file, re.DOTALL)]


def test_a_page_has_its_size_and_operators():
    """Paths, clips, groups and texts are there, in millimetres from above."""
    clipped = Group((rectangle(0, 0, 9, 9, INK),), (2, 0, 0, 2, 1, 1), clip=rectangle(0, 0, 1, 1))
    document = Document("Test")
    document.add(Page(100, 50, [clipped, Text("Größe", 30, 20, 5, anchor="end")]))
    file = document.data()
    assert file.startswith(b"%PDF-")
    assert file.rstrip().endswith(b"%%EOF")
    content = next(each for each in streams(file) if b" cm" in each).decode("latin-1")
    assert content.startswith(f"{POINTS_PER_MM:.6f} 0 0 {-POINTS_PER_MM:.6f} 0 {50 * POINTS_PER_MM:.3f} cm")
    for operator in ("q\n2 0 0 2 1 1 cm\n0 0 m", "W n", "1 0 0 rg 0 0 0 RG 0.25 w [] 0 d", "\nB\n", "Q"):
        assert operator in content
    assert "Größe".encode("cp1252").hex() in content
    # the width of the word ends at 30 mm
    [start] = re.findall(r"1 0 0 -1 ([\d.]+) 20 Tm", content)
    assert 30 - 5 * len("Größe") < float(start) < 30 - 5


def test_a4_in_points():
    """A page of A4 is 595 by 842 of the points of which an inch has 72."""
    document = Document("Test")
    document.add(Page(210, 297, []))
    file = document.data()
    assert b"/MediaBox [0 0 595.276 841.89]" in file + b"".join(streams(file))


def test_pages_and_bookmarks_are_counted():
    """Pages with a title have a bookmark, others none."""
    document = Document("Test")
    for title in ("Step 1", "", "Step 2"):
        document.add(Page(10, 10, [], title))
    file = document.data()
    whole = file + b"".join(streams(file))
    assert whole.count(b"/MediaBox") == 3
    assert b"(Step 1)" in whole
    assert b"(Step 2)" in whole
    assert whole.count(b"/Dest ") == 2


def test_the_same_pages_give_the_same_file():
    """There is no time and no chance in it."""
    files = []
    for _ in range(2):
        document = Document("Test")
        document.add(Page(10, 10, [rectangle(0, 0, 1, 1, INK)]))
        files.append(document.data())
    assert files[0] == files[1]


def test_corners_of_paths():
    """Whole numbers stay whole, closed lines are closed."""
    points = np.array([[0, 0], [5, -3], [7, 7], [9, 9]])
    assert data(Path(points, np.array([2, 2]), True, (INK,))).split(b"\n") == [
        b"0 0 m", b"5 -3 l", b"h", b"7 7 m", b"9 9 l", b"h",
    ]  # fmt: skip
    assert data(Path(points[:2] / 3, np.array([2]), False, (INK,))) == b"0 0 m\n1.667 -1 l"
