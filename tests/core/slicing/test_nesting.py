"""Parents and sons: every loop has at most one parent, the smallest loop around it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.slicing import nesting
from legorize_addon.core.slicing.linking import successors
from legorize_addon.core.slicing.loops import loop_areas
from legorize_addon.core.slicing.nesting import loop_parents
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from tests.core.solids import box, joined, reversed_mesh, tube

RING = np.stack([np.cos(np.arange(16) * np.pi / 8), np.sin(np.arange(16) * np.pi / 8)], axis=1)


def parents(loops, slices=None) -> list[int]:
    """Find the parents of loops given as lists of points."""
    start = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
    points = np.concatenate(loops) if loops else np.zeros((0, 2))
    slices = np.zeros(len(loops), np.int32) if slices is None else np.asarray(slices, np.int32)
    return loop_parents(np.asarray(points, dtype=np.float64), start, slices).tolist()


def circle(x, y, radius) -> np.ndarray:
    """Draw a polygon of 16 sides."""
    return np.array([x, y]) + radius * RING


def depths(parent) -> list[int]:
    """Return how many ancestors every loop has."""
    found = []
    for row in range(len(parent)):
        depth, here = 0, row
        while parent[here] >= 0:
            here, depth = parent[here], depth + 1
            assert depth <= len(parent)
        found.append(depth)
    return found


def test_rings_are_nested_like_dolls():
    """Of rings one in the other each has the next larger one as its parent, in whatever order they come."""
    radii = [10, 40, 20, 30]
    assert parents([circle(0, 0, r) for r in radii]) == [2, -1, 3, 1]


def test_neighbours_are_no_family():
    """Rings beside each other, though the box of one lies in the box of the other, have no parent."""
    crescent = np.concatenate([20 * RING[:9], 15 * RING[8::-1] + [0, -3]])
    assert parents([circle(0, 0, 5), circle(30, 0, 5)]) == [-1, -1]
    assert parents([crescent, circle(0, 2, 3)]) == [-1, -1]


@pytest.mark.parametrize("few", [0, 300])
def test_slices_do_not_mix(monkeypatch, few):
    """A ring in another slice holds nothing, whether loops are sorted by width or not."""
    monkeypatch.setattr(nesting, "_FEW", few)
    loops = [circle(0, 0, 40), circle(0, 0, 10), circle(0, 0, 20)]
    assert parents(loops, [0, 1, 0]) == [-1, -1, 0]
    assert parents(loops[1:] * 3, [5, 5, 0, 0, 2, 2]) == [1, -1, 3, -1, 5, -1]


def test_equal_loops_are_not_each_others_parents():
    """A loop given three times is no endless family."""
    assert max(depths(parents([circle(0, 0, 10)] * 3))) <= 2


def test_loops_that_begin_in_each_other_are_not_each_others_parents():
    """Of two loops of one box and area, either of which begins inside the other, one is the parent."""
    below = np.array([(5, 3), (10, 0), (10, 10), (0, 10), (0, 0)])
    above = np.array([(5, 7), (0, 10), (0, 0), (10, 0), (10, 10)])
    assert parents([below, above]) == [-1, 0]
    assert parents([above, below]) == [-1, 0]


def test_no_loops_have_no_parents():
    """Nothing gives nothing; loops of one or two points, without any width, are no parents."""
    assert parents([]) == []
    assert parents([circle(0, 0, 9), np.zeros((1, 2)), np.array([[0, -1.0], [0, 1]])]) == [-1, 0, 0]


discs = st.lists(
    st.tuples(st.integers(0, 1), st.integers(-30, 30), st.integers(-30, 30), st.sampled_from([1, 2, 3, 5, 8, 13, 21])),
    max_size=25,
    unique=True,
)


@given(discs, st.sampled_from([1 << 21, 7]), st.sampled_from([300, 0]))
def test_parents_of_random_discs(rows, most, few):
    """Discs that lie wholly in or outside each other get the smallest one around them; blocks change nothing."""
    kept = []
    for level, x, y, r in rows:
        apart = (
            np.hypot(x - a, y - b) > r + s or np.hypot(x - a, y - b) < 0.95 * abs(r - s) - 0.1
            for k, a, b, s in kept
            if k == level
        )
        if all(apart):
            kept.append((level, x, y, r))
    expected = []
    for level, x, y, r in kept:
        around = [(s, i) for i, (k, a, b, s) in enumerate(kept) if k == level and s > r and np.hypot(x - a, y - b) < s]
        expected.append(min(around)[1] if around else -1)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(nesting, "_MOST", most)
        patch.setattr(nesting, "_FEW", few)
        assert parents([circle(x, y, r) for _, x, y, r in kept], [row[0] for row in kept]) == expected


@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 9), st.integers(1, 5)), max_size=30))
def test_crossing_loops_stay_a_forest(rows):
    """Whatever loops cross, touch or repeat, none is its own ancestor."""
    depths(parents([circle(x, y, r) for x, y, r in rows]))


def test_tubes_in_tubes():
    """Two pipes, one in the other, with slices of depths 0 to 3: by turns counter-clockwise and clockwise."""
    mesh = joined(tube(40, 30), tube(20, 10))
    slices = slice_mesh(mesh, np.arange(8) * 6 + 1.0)
    assert (successors(mesh.faces, slices) >= 0).all()
    outline = linked(mesh.faces, slices)
    areas = loop_areas(outline.start, outline.loop_start)
    loop_slice = outline.slice[outline.loop_start[:-1]]
    parent = loop_parents(outline.start, outline.loop_start, loop_slice)
    depth = np.array(depths(parent))
    for level in range(8):
        here = np.flatnonzero(loop_slice == level)
        here = here[np.argsort(depth[here])]
        assert depth[here].tolist() == [0, 1, 2, 3]
        assert parent[here[1:]].tolist() == here[:-1].tolist()
        assert np.sign(areas[here]).tolist() == [1, -1, 1, -1]
        polygon = 32 * np.sin(2 * np.pi / 64)
        assert areas[here].sum() == pytest.approx(polygon * (1600 - 900 + 400 - 100))


def test_cavity_is_a_son_of_its_body():
    """A sealed cavity is held by the body around it and not by the one beside it."""
    body = joined(
        box((0, 0, 0), (30, 30, 30)), reversed_mesh(box((10, 10, 10), (20, 20, 20))), box((40, 0, 0), (70, 30, 30))
    )
    outline = linked(body.faces, slice_mesh(body, np.array([15.0])))
    areas = loop_areas(outline.start, outline.loop_start)
    parent = loop_parents(outline.start, outline.loop_start, outline.slice[outline.loop_start[:-1]])
    [cavity] = np.flatnonzero(areas < 0)
    assert outline.start[outline.loop_start[parent[cavity]], 0] <= 30
    assert (parent >= 0).sum() == 1
