"""Samples weigh the surface fairly, face outwards, and belong to the cell behind them."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples, face_normals, inner_cells, surface_area
from legorize_addon.core.units import BRICK, STUD
from tests.core.solids import area, box, mesh_of, sphere, without
from tests.core.textured import cells, cylinder, painted, split_at_x, stages


def upright_and_level(mesh) -> tuple[float, float]:
    """Return how much of a mesh's area is upright and how much level, each face shared by its normal squared."""
    corners = mesh.vertices[mesh.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    size = np.linalg.norm(normal, axis=1)
    return float(((normal[:, :2] ** 2).sum(axis=1) / size).sum()), float((normal[:, 2] ** 2 / size).sum())


@pytest.mark.parametrize("cusp", [0.1, 9.6])
@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_upright_walls_weigh_their_area(cusp, turn):
    """Pieces of trajectory on the walls of a prism stand for just the walls' area, however many slices there are."""
    prism = box((0, 0, 0), (61.3, 43.7, 48))
    rotation = np.array([[np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    built = stages(mesh_of(prism.vertices @ rotation, prism.faces), cusp=cusp)
    assert built.steep().area.sum() == pytest.approx(2 * (61.3 + 43.7) * 48)


def test_level_surface_weighs_its_area():
    """Hits of vertical rays on the top and bottom of a prism stand for their area, but for the lattice's grain."""
    samples = stages(box((0, 0, 0), (161.3, 143.7, 48))).level()
    assert samples.area.sum() == pytest.approx(2 * 161.3 * 143.7, rel=0.03)
    assert not samples.along.any()


def test_ray_on_a_common_edge_hits_once():
    """Rays through the edges and corners of a flat top do not count for every face there."""
    turn = np.arange(24) * 2 * np.pi / 24
    rim = 40 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    here, after = 1 + np.arange(24), 1 + (np.arange(24) + 1) % 24
    fans = [np.column_stack([here * 0, here, after]), np.column_stack([here * 0 + 25, after, here])]
    samples = stages(mesh_of([[0, 0, 20], *np.insert(rim, 2, 20, axis=1), [0, 0, 0]], np.concatenate(fans))).level()
    # one hit above and one below at every place of the lattice
    place = np.round(samples.place[:, 1:], 6)
    _, count = np.unique(place, axis=0, return_counts=True)
    assert count.max() == 2


@pytest.mark.parametrize("stretch", [0.4, 1.0, 2.0])
def test_slopes_weigh_their_area(stretch):
    """Trajectories and rays together weigh a ball, flattened or stretched, by its area on every slope."""
    ball = sphere(24, 100.0)
    mesh = mesh_of(ball.vertices * [1, 1, stretch], ball.faces)
    built = stages(mesh, cusp=0.1)
    upright, level = upright_and_level(mesh)
    assert upright + level == pytest.approx(area(mesh))
    assert built.steep().area.sum() == pytest.approx(upright, rel=0.01)
    assert built.level().area.sum() == pytest.approx(level, rel=0.01)


def test_surface_of_a_cell_is_that_of_its_samples():
    """The surface of all cells is that of all samples, and lies in the cells that they are in."""
    built = stages(sphere(12, 40.0))
    samples = built.steep().joined(built.level())
    found = surface_area(samples, built.grid.shape)
    assert found.shape == built.grid.shape
    assert found.sum() == pytest.approx(samples.area.sum())
    cell = samples.cell[samples.area.argmax()]
    assert found[tuple(cell)] == pytest.approx(samples.area[(samples.cell == cell).all(axis=1)].sum())


def test_samples_lie_on_the_surface_and_face_outwards():
    """Each sample of a ball is a radius from its middle, and its normal points away from it."""
    mesh = sphere(32, 100.0)
    built = stages(mesh)
    samples = built.steep().joined(built.level())
    way = samples.place[:, ::-1] * [STUD, STUD, BRICK] + built.grid.origin
    np.testing.assert_allclose(np.linalg.norm(way, axis=1), 100, atol=0.5)
    outwards = samples.normal[:, ::-1] * [STUD, STUD, BRICK]
    cosine = (outwards * way).sum(axis=1) / np.linalg.norm(outwards, axis=1) / np.linalg.norm(way, axis=1)
    assert cosine.min() > 0.99
    # in the cell, or on its border
    apart = samples.place - samples.cell
    assert apart.min() >= -1e-6
    assert apart.max() <= 1 + 1e-6


def test_colours_are_those_of_the_faces():
    """A prism in two colours gives each half's area in its own colour."""
    built = stages(split_at_x(cylinder(radius=80.0)))
    for samples in (built.steep(), built.level()):
        x = samples.place[:, 2] * STUD + built.grid.origin[0]
        aside = np.abs(x) > 1e-6
        np.testing.assert_array_equal(samples.colour[aside], np.where(x > 0, 1, 4)[aside])


def test_gaps_are_no_surface():
    """Edges that close the cut of an open mesh are not sampled."""
    closed = box((0, 0, 0), (64, 48, 38.4))
    x = closed.vertices[closed.faces][..., 0]
    open_ = without(closed, *np.flatnonzero((x == 64).all(axis=1)))
    built = stages(open_)
    assert built.trajectories.gaps == len(built.heights)
    assert built.steep().area.sum() == pytest.approx((2 * 64 + 48) * 38.4)
    assert cells(built.bricks()).max() >= 0


def test_joined_samples_follow_each_other():
    """Joining appends, field by field."""
    built = stages(box((0, 0, 0), (32, 24, 19.2)))
    one, two = built.steep(), built.level()
    both = one.joined(two)
    for name in ("place", "along", "cell", "normal", "area", "colour"):
        np.testing.assert_array_equal(getattr(both, name), np.concatenate([getattr(one, name), getattr(two, name)]))


def test_face_normals_point_along_the_box():
    """Normals of a box in cells are along one axis each, outwards, longest where the cell is shortest."""
    mesh = box((0, 0, 0), (10, 10, 10))
    normal = face_normals(mesh)
    middle = mesh.vertices[mesh.faces].mean(axis=1)[:, ::-1] - 5
    axis = np.abs(middle).argmax(axis=1)
    rows = np.arange(len(normal))
    np.testing.assert_array_equal((normal != 0).sum(axis=1), 1)
    np.testing.assert_allclose(
        normal[rows, axis], np.sign(middle[rows, axis]) * 100 / np.array([BRICK, STUD, STUD])[axis]
    )


def hand_made(cell, normal) -> SurfaceSamples:
    """Make samples in given cells with given normals."""
    cell, normal = np.array(cell), np.array(normal, float)
    zero = np.zeros_like(normal)
    return SurfaceSamples(cell + 0.5, zero, cell, normal, np.ones(len(cell)), np.zeros(len(cell), np.int16))


def test_inner_cell_is_behind_the_surface():
    """A sample in an empty cell belongs to the solid cell against its normal, by the steepest axis first."""
    solid = np.zeros((2, 3, 3), bool)
    solid[:, 1, 1] = solid[0, 2, 2] = True
    normals = {(0, 1, 1): (1, 0, 0), (0, 1, 2): (0, 0.2, 1), (0, 2, 1): (0, 1, 0.2), (0, 0, 0): (0, -2, -1),
               (0, 1, 0): (0, 0, 1), (1, 2, 2): (1, 0.1, 0.2), (0, 0, 2): (-0.1, -1, -0.5)}  # fmt: skip
    found = inner_cells(hand_made(list(normals), list(normals.values())), solid)
    here, beside = np.ravel_multi_index((0, 1, 1), solid.shape), np.ravel_multi_index((0, 2, 2), solid.shape)
    np.testing.assert_array_equal(found, [here, here, here, here, -1, beside, -1])


def test_inner_cell_of_a_convex_body_always_exists():
    """All surface of a ball, in its own or an outer cell, belongs to a solid cell beside it."""
    built = stages(sphere(24, 60.0))
    samples = built.steep().joined(built.level())
    solid = built.bricks(keep_thin=False).solid[:, 0]
    found = inner_cells(samples, solid)
    assert (found >= 0).mean() > 0.995
    some = found >= 0
    assert solid.ravel()[found[some]].all()
    cell = np.stack(np.unravel_index(found[some], solid.shape), axis=1)
    assert np.abs(cell - samples.cell[some]).max() <= 1


def test_area_of_painted_faces_adds_up():
    """Samples of each colour stand for the area of the faces in that colour."""
    mesh = box((0, 0, 0), (80, 64, 57.6))
    mesh = painted(mesh, np.repeat([1, 2, 4, 14, 15, 25], 2))
    built = stages(mesh)
    samples = built.steep().joined(built.level())
    for code in (1, 2, 4, 14, 15, 25):
        exact = area(mesh_of(mesh.vertices, mesh.faces[np.repeat([1, 2, 4, 14, 15, 25], 2) == code]))
        assert samples.area[samples.colour == code].sum() == pytest.approx(exact, rel=0.05)
