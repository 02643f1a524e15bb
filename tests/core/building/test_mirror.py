"""Mirrored halves."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.building.mirror import boxes, mirror_images
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


def test_one_more_brick_has_no_image():
    """What is at one side alone has none, and shifts the outline without harm."""
    found = mirror_images(table(*GATE, ("3005", 8, 0, 0)), CATALOGUE)
    assert found.tolist() == [1, 0, 2, 3, 5, 4, NOBODY]


def test_no_symmetry_no_images():
    """Where less than half of the bricks have images, none have."""
    rng = np.random.default_rng(1)
    rows = [("3005", int(x), int(y), 3 * z) for z, (x, y) in enumerate(rng.integers(0, 30, (40, 2)))]
    assert (mirror_images(table(*rows), CATALOGUE) == NOBODY).all()


def test_images_are_mutual():
    """The image of an image is the brick."""
    found = mirror_images(table(*GATE), CATALOGUE)
    assert (found[found] == np.arange(len(found))).all()
