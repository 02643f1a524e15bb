"""Mirrored halves."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from legorize_addon.core.building.mirror import OFF, SYMMETRIC, MirrorPlane, boxes, mirror_images, mirror_plane
from legorize_addon.core.model.bricks import NOBODY
from tests.core.standing import CATALOGUE, table

GATE = (
    ("3003", 0, 0, 0),
    ("3003", 6, 0, 0),
    ("3008", 0, 0, 3),
    ("3008", 0, 1, 3),
    ("3010", 0, 0, 6),
    ("3010", 4, 0, 6),
)


def test_boxes_are_the_squares_that_bricks_cover():
    """First and last square, turned bricks included."""
    assert boxes(table(("3001", 2, 3, 0), ("3001", 2, 3, 3, 1)), CATALOGUE).tolist() == [[2, 5, 3, 4], [2, 3, 3, 6]]


@pytest.mark.parametrize("shift", [-7, 0, 5])
def test_images_of_a_gate(shift):
    """Pillars and upper beams are images of each other, what lies across the plane is its own."""
    bricks = table(*((number, x + shift, y, z) for number, x, y, z in GATE))
    assert mirror_images(bricks, CATALOGUE).tolist() == [1, 0, 2, 3, 5, 4]
    assert mirror_plane(bricks, CATALOGUE) == MirrorPlane(0, 7 + 2 * shift)


def test_the_plane_lies_along_y_as_well():
    """A gate that is turned is mirrored in the other axis; nothing has no plane."""
    turned = table(*((number, y, x, z, 1) for number, x, y, z in GATE))
    assert mirror_plane(turned, CATALOGUE) == MirrorPlane(1, 7)
    assert mirror_plane(table(), CATALOGUE) is None


def test_one_more_brick_has_no_image():
    """What is at one side alone has none, and shifts the outline without harm."""
    found = mirror_images(table(*GATE, ("3005", 8, 0, 0)), CATALOGUE)
    assert found.tolist() == [1, 0, 2, 3, 5, 4, NOBODY]


def test_no_symmetry_no_images():
    """Where less than half of the bricks have images, none have."""
    rng = np.random.default_rng(1)
    rows = [("3005", int(x), int(y), 3 * z) for z, (x, y) in enumerate(rng.integers(0, 30, (40, 2)))]
    assert (mirror_images(table(*rows), CATALOGUE) == NOBODY).all()
    assert mirror_plane(table(*rows), CATALOGUE) is None


def test_images_are_mutual():
    """The image of an image is the brick."""
    found = mirror_images(table(*GATE), CATALOGUE)
    assert (found[found] == np.arange(len(found))).all()


def plain(bricks):
    """Try every plane, and look for the image of every brick among all bricks."""
    outline = boxes(bricks, CATALOGUE).tolist()
    kind = list(zip(bricks.part.tolist(), bricks.corner[:, 2].tolist(), strict=True))
    best, most = [NOBODY] * len(bricks), int(SYMMETRIC * len(bricks))
    for axis in (0, 2):
        twice = min(box[axis] for box in outline) + max(box[axis + 1] for box in outline)
        for shift in sorted(range(-OFF, OFF + 1), key=abs):
            found = []
            for own, box in zip(kind, outline, strict=True):
                image = list(box)
                image[axis : axis + 2] = twice + shift - box[axis + 1], twice + shift - box[axis]
                same = [k for k, other in enumerate(outline) if other == image and kind[k] == own]
                found += same or [NOBODY]
            if len(found) - found.count(NOBODY) > most:
                best, most = found, len(found) - found.count(NOBODY)
    return best


@settings(deadline=None, max_examples=100)
@given(st.integers(0, 10**6))
def test_images_are_those_found_by_looking_at_all_bricks(seed):
    """Bricks in rows, many of them with an image in x or in y, some without, some outside of the outline's middle."""
    rng = np.random.default_rng(seed)
    rows, taken, axis = [], set(), int(rng.integers(2))
    for _ in range(rng.integers(1, 12)):
        number, wide, deep = (("3005", 1, 1), ("3004", 2, 1), ("3003", 2, 2))[rng.integers(3)]
        place = [*rng.integers(-6, 6, 2).tolist(), 3 * int(rng.integers(2))]
        image = [*place]
        image[axis] = -place[axis] - (wide, deep)[axis]
        for x, y, z in [place, image][: 1 + (rng.random() < 0.7)]:
            cells = {(x + i, y + j, z) for i in range(wide) for j in range(deep)}
            if not cells & taken:
                taken |= cells
                rows.append((number, x, y, z))
    assert mirror_images(table(*rows), CATALOGUE).tolist() == plain(table(*rows))


@pytest.mark.parametrize("off", range(-OFF - 1, OFF + 2))
def test_plane_lies_two_studs_off_the_middle_at_most(off):
    """A row that goes on at one side by some half studs still has its images, up to four."""
    rows = [("3005", 0, 0, 0), ("3004", 3, 4, 0), ("3005", 9, 0, 0), ("3004", 5, 4, 0)]
    # one more brick far out moves the middle of the outline
    more = ("3024", 9 - off, 8, 0) if off < 0 else ("3024", -off, 8, 0)
    found = mirror_images(table(*rows, more), CATALOGUE).tolist()
    assert found == ([2, 3, 0, 1, NOBODY] if abs(off) <= OFF else [NOBODY] * 5)


def test_of_two_planes_with_as_many_images_the_lower_one_is_taken():
    """Two kinds of bricks in turn: half a stud below the middle and above it, three of four have images."""
    rows = [("3005", 2, 0, 0), ("3024", 3, 3, 0), ("3005", 4, 0, 0), ("3024", 5, 3, 0)]
    assert mirror_images(table(*rows), CATALOGUE).tolist() == [2, 1, 0, NOBODY]
