"""Pages as SVG."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.instructions.canvas import Group, Page, Paint, Path, Text, lines, rectangle
from legorize_addon.core.instructions.svg import colour, data, number, svg

INK = Paint(fill=(255, 0, 0), stroke=(1, 2, 3), width=0.25, dash=(1, 0.5))
SPACE = "{http://www.w3.org/2000/svg}"


def corners(text):
    """Read path data of moves, lines and closings back: the lines with whether each is closed."""
    found, at, start = [], (0.0, 0.0), (0.0, 0.0)
    for letter, rest in re.findall(r"([MmLlZz])([^MmLlZz]*)", text):
        if letter in "Zz":
            found[-1] = (found[-1][0], True)
            at = start
            continue
        x, y = map(float, re.findall(r"-?[\d.]+", rest))
        at = (at[0] + x, at[1] + y) if letter.islower() else (x, y)
        if letter in "Mm":
            start = at
            found.append(([], False))
        found[-1][0].append(at)
    return found


@given(
    st.lists(st.lists(st.tuples(st.integers(-999, 999), st.integers(-999, 999)), min_size=1, max_size=5), min_size=1),
    st.booleans(),
)
def test_whole_numbers_come_back(polylines, closed):
    """Relative path data mean the same corners."""
    points = np.array([point for line in polylines for point in line])
    path = Path(points, np.array([len(line) for line in polylines]), closed, (INK,))
    assert corners(data(path)) == [([tuple(map(float, point)) for point in line], closed) for line in polylines]


def test_broken_numbers_are_cut_to_thousandths():
    """Three decimals, and none in vain."""
    path = Path(np.array([[0.12345, 1.0], [2.5, -3.0]]), np.array([2]), False, (INK,))
    assert data(path) == "M0.123 1L2.5 -3"
    assert [number(each) for each in (0.0, -0.0001, 1.0, 12.3456)] == ["0", "0", "1", "12.346"]


def test_pages_are_valid_and_have_their_size():
    """A page is an XML element with its size in mm; names of its parts begin as was asked."""
    twice = Path(np.array([[0, 0], [5, 5]]), np.array([2]), False, (INK, INK))
    clipped = Group((rectangle(0, 0, 9, 9, INK),), (2, 0, 0, 2, 1, 1), clip=rectangle(0, 0, 1, 1))
    page = Page(
        100, 50.5, [twice, clipped, Text('<&"', 1, 2, 3, bold=True, anchor="end"), lines(np.zeros((0, 2, 2)), INK)]
    )
    root = ElementTree.fromstring(svg(page, name="k"))
    assert (root.get("width"), root.get("height"), root.get("viewBox")) == ("100mm", "50.5mm", "0 0 100 50.5")
    assert [each.text for each in root.iter(f"{SPACE}text")] == ['<&"']
    names = [each.get("id") for each in root.iter() if each.get("id")]
    assert len(names) == len(set(names)) == 2
    assert all(name.startswith("k") for name in names)
    [use] = root.iter(f"{SPACE}use")
    assert use.get("href") == f"#{next(root.iter(f'{SPACE}path')).get('id')}"


def test_the_second_paint_is_not_hidden_by_the_first():
    """A path that is repeated has no style of its own, which would win over that of the repetition."""
    twice = Path(np.array([[0, 0], [5, 5]]), np.array([2]), False, (INK, Paint(stroke=(9, 9, 9), width=1)))
    root = ElementTree.fromstring(svg(Page(9, 9, [twice])))
    [path] = root.iter(f"{SPACE}path")
    assert set(path.keys()) == {"id", "d"}


@pytest.mark.parametrize(("rgb", "text"), [((255, 0, 0), "#f00"), ((18, 52, 86), "#123456")])
def test_colours(rgb, text):
    """Colours are as short as can be."""
    assert colour(rgb) == text
