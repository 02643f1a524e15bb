"""Level surface is found where it is, and only where it is level."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from legorize_addon.core.slicing import fit_grid
from legorize_addon.core.slicing.level_faces import PHASES, LevelFaces
from legorize_addon.core.units import PLATE
from tests.core.solids import box, joined, sphere


def level_faces(mesh):
    """Return those of a mesh on its usual grid."""
    return LevelFaces.of(mesh, fit_grid(mesh, symmetric=True, plates=True))


def test_the_faces_of_a_box_err_by_their_distance_to_the_planes():
    """A box of 3 x 2 studs that ends a quarter of a plate above a plane."""
    found = level_faces(box((5, 5, 7), (29, 21, 7 + 6.25 * PLATE)))
    there = found.area > 1e-9
    assert found.height[there] == pytest.approx([0, 6.25])
    assert found.area[there] == pytest.approx([6, 6])
    # bottom and top, by quarters of a plate
    quarters = {0: 0 + 1, -1: 1 + 2, 1: 1 + 0, 2: 2 + 1}
    assert found.errors(1.0) == pytest.approx([6 * quarters[phase] / 4 for phase in PHASES])
    # a little smaller, it ends at a plane
    assert found.errors(6 / 6.25)[0] == pytest.approx(0)


def test_what_is_hidden_or_upright_does_not_count():
    """A box within another one, and the sides of both."""
    outer, inner = box((0, 0, 0), (40, 40, 5 * PLATE)), box((8, 8, 1.5 * PLATE), (32, 32, 2.5 * PLATE))
    alone, both = level_faces(outer), level_faces(joined(outer, inner))
    assert both.area == pytest.approx(alone.area)


def test_round_surface_asks_for_no_height():
    """On a ball of twelve studs all phases err alike."""
    errors = level_faces(sphere(48, 6 * 8)).errors(1.0)
    assert errors == pytest.approx(np.full(len(PHASES), errors.mean()), rel=0.04)


def test_weighted_surface_counts_more():
    """Of two boxes, the heavier one says where planes lie."""
    low, high = box((0, 0, 0), (24, 24, 4 * PLATE)), box((48, 0, 0), (72, 24, 6.5 * PLATE))
    mesh = joined(low, high)
    heavy = level_faces(replace(mesh, weight=np.repeat([0.0, 3.0], 8)))
    at = {height: area for height, area in zip(heavy.height, heavy.area, strict=True) if area > 1e-9}
    assert at[6.5] == pytest.approx(4 * at[4.0])
