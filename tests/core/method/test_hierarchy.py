"""The tree of the trajectories as text."""

from __future__ import annotations

import re

import numpy as np

from legorize_addon.core.method.files import slice_titles
from legorize_addon.core.method.hierarchy import hierarchy_text
from tests.core.any_bricks import CATALOGUE
from tests.core.method.drafts import LEVELS, SIDES, draft


def paragraphs():
    """Return the lines of each slice."""
    text = hierarchy_text(draft().trajectories, slice_titles(draft()), CATALOGUE)
    return [part.splitlines() for part in text.strip().split("\n\n")]


def test_nested_tubes_have_four_levels():
    """Each loop stands one step further in than the one around it; sides take turns, areas are those of the squares."""
    found = paragraphs()
    assert len(found) == len(draft().cut.slices.heights)
    for title, *loops in found:
        assert title.endswith(f": {LEVELS} loops")
        assert [(len(line) - len(line.lstrip())) // 3 for line in loops] == list(range(LEVELS))
        sides = ["exterior, counter-clockwise", "interior, clockwise"] * 2
        for line, words, side in zip(loops, sides, SIDES, strict=True):
            assert f"{words}, {side * side:.1f} mm², {4 * side:.1f} mm:" in line


def test_every_loop_is_named_once():
    """Numbers run from 1, and the colours of a loop add up to all of it."""
    loops = [line for _, *lines in paragraphs() for line in lines]
    numbers = [int(re.search(r"\+- (\d+) ", line).group(1)) for line in loops]
    assert sorted(numbers) == list(range(1, len(draft().trajectories.loop_slice) + 1))
    for line in loops:
        shares = [int(each) for each in re.findall(r"(\d+)%", line)]
        assert abs(sum(shares) - 100) <= 1
        assert {"Red", "Blue"} == set(re.findall(r"(Red|Blue) \d+%", line))


def test_titles_tell_the_height():
    """A slice is in the middle of a plate of its layer."""
    heights = [float(re.search(r"at ([\d.]+) mm", title).group(1)) for title in slice_titles(draft())]
    np.testing.assert_allclose(heights, 9.6 * draft().cut.layer + 3.2 * draft().cut.plate + 1.6, atol=0.051)
