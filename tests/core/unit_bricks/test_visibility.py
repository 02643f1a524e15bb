"""Which surface the air reaches, and which outer face is nearest."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from legorize_addon.core.geometry.neighbourhoods import outer_air
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples
from legorize_addon.core.unit_bricks.visibility import nearest_faces, reached_by_air
from tests.core.solids import box, joined, reversed_mesh, sphere
from tests.core.textured import Stages, stages

SIDES = np.array([1.2, 1.0, 1.0])
"""Sides of a cell along layer, y and x in studs."""


def sampled(built: Stages) -> tuple[SurfaceSamples, np.ndarray]:
    """Return all samples of a mesh and their places in mm, x, y and z."""
    samples = built.steep().joined(built.level())
    return samples, samples.place[:, ::-1] * [8, 8, 9.6] + built.grid.origin


def reached_places(mesh) -> tuple[np.ndarray, np.ndarray]:
    """Return the places in mm of all samples of a mesh, and whether the air reaches them."""
    built = stages(mesh, cusp=0.1)
    samples, place = sampled(built)
    return place, reached_by_air(samples, built.grid.shape)


@pytest.mark.parametrize(
    "mesh",
    [
        box((0, 0, 0), (48, 40, 38.4)),
        sphere(16, 50.0),
        box((0, 0, 0), (80, 80, 2)),
        joined(sphere(12, 30.0), sphere(12, 20.0, (70, 0, 0))),
    ],
    ids=["box", "ball", "sheet", "two balls"],
)
def test_outside_is_reached_everywhere(mesh):
    """Nothing of a body's own outer surface is hidden, but for a few samples where facets meet."""
    _, reached = reached_places(mesh)
    assert reached.mean() > 0.995


def test_inside_of_a_closed_box_is_not_reached():
    """The surface of a box inside a box, and of the cavity around it, is hidden; the outside is not."""
    outer, cavity = box((0, 0, 0), (96, 96, 96)), reversed_mesh(box((16, 16, 16), (80, 80, 80)))
    place, reached = reached_places(joined(outer, cavity, box((30, 30, 30), (60, 60, 60))))
    inside = ((place > 8) & (place < 88)).all(axis=1)
    assert inside.sum() > 500
    assert not reached[inside].any()
    assert reached[~inside].mean() > 0.995


def test_overlapping_body_is_not_reached_where_it_is_covered():
    """Of a box stuck through another one, only what sticks out is reached."""
    place, reached = reached_places(joined(box((0, 0, 0), (80, 80, 80)), box((24.3, 24.3, 24.3), (120, 56.3, 56.3))))
    arm = np.abs(place[:, 1] - 40.3) < 16.5
    arm &= np.abs(place[:, 2] - 40.3) < 16.5
    assert not reached[arm & (place[:, 0] > 20) & (place[:, 0] < 68)].any()
    assert reached[arm & (place[:, 0] > 92)].all()


@pytest.mark.parametrize(("gap", "is_open"), [(2, False), (4, False), (24, True), (40, True)])
def test_crevices_narrower_than_a_stud_are_closed(gap, is_open):
    """The walls of a slot are reached in its depth where it is some studs wide, not where it is half a stud."""
    slot = joined(
        box((0, 0, 0), (48, 80, 96)), box((48 + gap, 0, 0), (96 + gap, 80, 96)), box((0, 0, 0), (96 + gap, 80, 19.2))
    )
    place, reached = reached_places(slot)
    walls = (np.abs(place[:, 0] - 48 - gap / 2) < gap / 2 + 0.1) & (np.abs(place[:, 1] - 40) < 16)
    deep = walls & (place[:, 2] > 32) & (place[:, 2] < 64)
    assert deep.sum() > 20
    assert (reached[deep] == is_open).mean() > 0.995


def test_window_lets_the_air_in():
    """A room with a window of several studs is reached inside; without it, it is not."""
    walls = [box((0, 0, 0), (96, 96, 9.6)), box((0, 0, 86.4), (96, 96, 96)), box((0, 0, 0), (8, 96, 96)),
             box((88, 0, 0), (96, 96, 96)), box((0, 0, 0), (96, 8, 96))]  # fmt: skip
    front = [box((0, 88, 0), (96, 96, 28.8)), box((0, 88, 57.6), (96, 96, 96)), box((0, 88, 0), (32, 96, 96)),
             box((64, 88, 0), (96, 96, 96))]  # fmt: skip
    for closing, seen in ([], True), ([box((32, 88, 28.8), (64, 96, 57.6))], False):
        place, reached = reached_places(joined(*walls, *front, *closing))
        room = ((place > [7.9, 7.9, 9.5]) & (place < [88.1, 80, 86.5])).all(axis=1)
        assert room.sum() > 300
        assert reached[room].mean() > 0.9 if seen else not reached[room].any()


def nearest_by_force(place, solid, air) -> tuple[np.ndarray, np.ndarray]:
    """Return the squared distance of points to the nearest outer face of each cell, (n, n_cells), all faces tried."""
    open_around = np.pad(air, 1, constant_values=True)
    least = np.full((len(place), solid.size), np.inf)
    for number, cell in enumerate(np.ndindex(*solid.shape)):
        for axis, side in product(range(3), (0, 1)) if solid[cell] else ():
            beside = np.array(cell) + 1
            beside[axis] += 2 * side - 1
            if open_around[tuple(beside)]:
                low, high = np.array(cell, float), np.array(cell, float) + 1
                low[axis] = high[axis] = cell[axis] + side
                way = (place - np.clip(place, low, high)) * SIDES
                least[:, number] = np.minimum(least[:, number], (way**2).sum(axis=1))
    return least


@pytest.mark.parametrize("seed", range(4))
def test_nearest_face_is_that_of_brute_force(seed):
    """Among random cells, the face found is the nearest of all within half a cell, and there is none only if so."""
    rng = np.random.default_rng(seed)
    solid = rng.random((4, 5, 6)) < rng.choice([0.15, 0.5, 0.85])
    air = outer_air(solid)
    place = rng.uniform(-1, np.array(solid.shape) + 1, (400, 3))
    found = nearest_faces(place, SIDES, solid, air)
    # only the eight cells around a point are looked at
    middles = np.argwhere(np.ones(solid.shape)) + 0.5
    around = (np.abs(place[:, None] - middles) <= 1).all(axis=2)
    distance = np.where(around, nearest_by_force(place, solid, air), np.inf)
    none = np.isinf(distance.min(axis=1))
    np.testing.assert_array_equal(found < 0, none)
    some = np.flatnonzero(~none)
    assert len(some) > 50
    np.testing.assert_allclose(distance[some, found[some]], distance[some].min(axis=1), atol=1e-9)


def test_face_of_a_sealed_cavity_is_no_outer_face():
    """A point in a sealed cavity belongs to no face, or to the outer face nearest to it, never to the cavity's."""
    solid = np.ones((3, 3, 3), bool)
    solid[1, 1, 1] = False
    air = outer_air(solid)
    assert not air.any()
    cell = nearest_faces(np.array([[1.5, 1.5, 1.1], [1.5, 1.5, -0.2]]), SIDES, solid, air)
    middle = np.ravel_multi_index((1, 1, 0), solid.shape)
    np.testing.assert_array_equal(cell, [middle, middle])
    thick = np.ones((5, 5, 5), bool)
    thick[2, 2, 2] = False
    assert nearest_faces(np.array([[2.5, 2.5, 2.5]]), SIDES, thick, outer_air(thick)) == [-1]
