"""Colours of visible cells: counting, choosing, and agreement with a dense sampling of the surface."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from legorize_addon.core.colours.difference import ciede2000, lab_from_srgb
from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_ANY
from legorize_addon.core.unit_bricks.colour_votes import cell_weights, count_votes, likeliest_colours, winning_colours
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples
from tests.core.solids import joined, reversed_mesh, sphere
from tests.core.textured import Stages, blob, cells, painted, rgb_of, stages, turned_about_z

N_DENSE = 300_000
"""Points of the dense sampling, some 50 a visible cell."""


@cache
def bumpy() -> Stages:
    """Run the stages on a bumpy ball in many colours, about 50 studs wide."""
    return stages(blob(), grid=None)


@cache
def dense() -> tuple[np.ndarray, np.ndarray]:
    """Draw points evenly over the bumpy ball; return them in mm, and their brick colours."""
    built = bumpy()
    mesh, rng = built.mesh, np.random.default_rng(9)
    corners = mesh.vertices[mesh.faces]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    face = rng.choice(len(area), N_DENSE, p=area / area.sum())
    weight = rng.dirichlet([1, 1, 1], N_DENSE)[:, :, None]
    uv = (mesh.uvs[face] * weight).sum(axis=1)
    return (corners[face] * weight).sum(axis=1), built.surface.at(mesh.face_image[face], uv)


def outer_faces(solid, air) -> tuple[np.ndarray, np.ndarray]:
    """Return middles of the outer faces of cells in mm, grid corner at zero, and their cells' flat indices."""
    middles, owners = [], []
    around = np.pad(air, 1, constant_values=True)
    for axis in range(3):
        for side in (0, 1):
            there = np.roll(around, 1 - 2 * side, axis)[1:-1, 1:-1, 1:-1]
            cell = np.argwhere(solid & there)
            middle = cell + 0.5
            middle[:, axis] = cell[:, axis] + side
            middles.append(middle * [9.6, 8, 8])
            owners.append(np.ravel_multi_index(tuple(cell.T), solid.shape))
    return np.concatenate(middles), np.concatenate(owners)


def dense_colours(solid, air, seen) -> np.ndarray:
    """Colour visible cells by the dense sampling with the same rule, each point counting for its nearest outer face."""
    points, colour = dense()
    place = (points - bumpy().grid.origin)[:, ::-1]
    middle, owner = outer_faces(solid, air)
    # the nearest of the eight faces whose middles are nearest
    _, near = cKDTree(middle).query(place, k=8)
    half = np.where(np.isclose(middle % [9.6, 8, 8] / [9.6, 8, 8], 0.5), [4.8, 4, 4], 0)
    beside = np.maximum(np.abs(place[:, None] - middle[near]) - half[near], 0)
    best = (beside**2).sum(axis=2).argmin(axis=1)
    cell = owner[near[np.arange(len(place)), best]]
    codes = np.unique(colour)
    number = np.cumsum(seen.ravel()) - 1
    votes = np.zeros((int(seen.sum()), len(codes)))
    np.add.at(votes, (number[cell], np.searchsorted(codes, colour)), 1.0)
    lab = lab_from_srgb(rgb_of(codes))
    difference = np.where(votes > 0, votes @ ciede2000(lab[:, None], lab[None]), np.inf)
    return np.where(votes.any(axis=1), codes[difference.argmin(axis=1)], COLOUR_ANY)


def test_colours_agree_with_a_dense_sampling():
    """At 50 studs, 98 % of the visible cells that a trajectory crosses and 97 % of all have the dense colour."""
    built = bumpy()
    grid = built.bricks(keep_thin=False)
    solid = grid.solid[:, 0]
    air = outer_air(solid)
    seen = visible(solid, air)
    truth, ours = dense_colours(solid, air, seen), cells(grid)[seen]
    known = truth != COLOUR_ANY
    assert 45 <= built.grid.n_x <= 60
    assert known.mean() > 0.999
    pieces, level = built.pieces()
    crossed = np.zeros(solid.shape, bool)
    crossed[built.layer[level[pieces.edge]], pieces.cell[:, 1], pieces.cell[:, 0]] = True
    crossed = crossed[seen] & known
    assert crossed.mean() > 0.5
    assert (ours == truth)[crossed].mean() >= 0.98
    assert (ours == truth)[known].mean() >= 0.97


def test_far_fewer_points_than_a_voxelization():
    """Trajectories take at most a fifth of the points of a voxelization at 3.2 mm with 16 samples a voxel."""
    points, _ = dense()
    # the dense points miss some voxels, which makes the claim harder
    voxels = len(np.unique(np.floor(points / 3.2).astype(int), axis=0))
    assert voxels > 30_000
    assert len(bumpy().trajectories.points) <= 0.2 * 16 * voxels


def samples_at(place, colour, area=1.0, normal=(1.0, 0, 0)) -> SurfaceSamples:
    """Make samples at places given in cells."""
    place = np.array(place, float)
    return SurfaceSamples(
        place=place,
        along=np.zeros_like(place),
        cell=np.floor(place).astype(np.int64),
        normal=np.broadcast_to(np.array(normal), place.shape),
        area=np.broadcast_to(np.float64(area), len(place)).copy(),
        colour=np.array(colour, np.int16),
    )


def test_middle_shade_stands_for_many():
    """Where red, orange and yellow meet evenly, the cell is orange; where one covers most, it is that one."""
    solid = np.zeros((1, 1, 1), bool) | True
    place = [[1.0, 0.2 + 0.1 * k, 0.5] for k in range(6)]

    def colour(codes) -> int:
        [found] = likeliest_colours(samples_at(place, codes), outer_air(solid), solid, load_catalogue()).winners(solid)
        return int(found)

    assert colour([4, 4, 25, 25, 14, 14]) == 25
    assert colour([4, 4, 4, 4, 4, 14]) == 4
    assert colour([4, 14, 14, 14, 14, 14]) == 14


def test_colour_is_one_of_the_cell():
    """Between black and white nothing grey is made up: the cell takes one of its own colours."""
    solid = np.ones((1, 1, 2), bool)
    place = [[1.0, 0.5, 0.5], [1.0, 0.5, 0.6], [1.0, 0.5, 1.5]]
    found = likeliest_colours(samples_at(place, [0, 15, 71]), outer_air(solid), solid, load_catalogue()).winners(solid)
    assert found[0] in (0, 15)
    assert found[1] == 71


def bottle(wall=5.0, mouth=3.0, radius=70.0) -> TriangleMesh:
    """Make a round bottle in one closed surface, red outside and blue inside, with a mouth of some mm."""
    turn = np.linspace(-np.pi / 2, np.arccos(mouth / radius), 40)
    outer = radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    outer[0, 0] = 0
    inner = outer[::-1] * (1 - wall / radius)
    mesh = turned_about_z(np.concatenate([outer, inner]))
    corners = mesh.vertices[mesh.faces]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outside = (normal * corners.mean(axis=1)).sum(axis=1) > 0
    return painted(mesh, np.where(outside, 4, 1))


def test_inside_of_a_bottle_does_not_colour_its_outside():
    """The inner side of a thin wall, which no air reaches, gives no colour to the bricks, though it lies near them."""
    colours, count = np.unique(cells(stages(bottle()).bricks()), return_counts=True)
    shown = dict(zip(colours.tolist(), count.tolist(), strict=True))
    assert shown[4] > 400
    # a brick or two around the mouth
    assert shown.get(1, 0) <= 4


def test_lining_of_a_sealed_body_does_not_colour_its_outside():
    """A blue lining 4 mm under a red skin is never seen."""
    skin, lining = sphere(24, 70.0), reversed_mesh(sphere(24, 66.0))
    mesh = painted(joined(skin, lining), np.repeat([4, 1], len(skin.faces)))
    colour = cells(stages(mesh).bricks())
    assert set(np.unique(colour[colour >= 0]).tolist()) == {4}


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_votes_are_the_sums_by_cell_and_colour(seed):
    """Counting adds up the weights of each visible cell and colour, and of nothing else."""
    rng = np.random.default_rng(seed)
    seen = rng.random((2, 3, 4)) < 0.5
    n = 60
    cell, colour = rng.integers(-1, seen.size, n), rng.choice(np.array([COLOUR_ANY, 0, 4, 71], np.int16), n)
    weight = rng.random(n)
    codes, votes = count_votes(cell, colour, weight, seen)
    assert COLOUR_ANY not in codes
    for row, place in enumerate(np.flatnonzero(seen.ravel())):
        for column, code in enumerate(codes):
            expected = weight[(cell == place) & (colour == code)].sum()
            assert votes[row, column] == pytest.approx(expected)
    assert votes.sum() == pytest.approx(weight[(cell >= 0) & seen.ravel()[cell] & (colour != COLOUR_ANY)].sum())


def test_cells_without_votes_take_the_nearest_colour():
    """The nearest cell with votes counts in mm, in which a step upwards is longer than one aside."""
    seen = np.ones((2, 1, 3), bool)
    votes = np.array([[0, 0], [3, 1], [0, 0], [0, 0], [0, 0], [0, 2.0]])
    np.testing.assert_array_equal(winning_colours(np.int16([4, 15]), votes, votes, seen), [4, 4, 4, 4, 15, 15])


def test_best_score_wins_and_the_lower_code_a_tie():
    """The colour with the best score is chosen; of equal ones the lower code."""
    seen = np.ones((1, 1, 3), bool)
    votes = np.array([[1, 2], [2, 1], [2, 2.0]])
    np.testing.assert_array_equal(winning_colours(np.int16([4, 15]), votes, votes, seen), [15, 4, 4])


def test_no_votes_at_all_leave_the_colour_open():
    """Without any sample every cell is free to take any colour."""
    seen = np.ones((2, 2, 2), bool)
    codes, votes = count_votes(np.zeros(0, np.int64), np.zeros(0, np.int16), np.zeros(0), seen)
    np.testing.assert_array_equal(winning_colours(codes, votes, votes, seen), np.full(8, COLOUR_ANY))
    nothing = samples_at(np.zeros((0, 3)), [])
    found = likeliest_colours(nothing, outer_air(seen), seen, load_catalogue()).winners(seen)
    np.testing.assert_array_equal(found, np.full(8, COLOUR_ANY))


@pytest.mark.parametrize(("weight", "code"), [(None, 15), (0.9, 15), (3.0, 0)])
def test_a_weighted_pupil_wins_over_the_white_around_it(weight, code):
    """A third of black on white is white; if it counts four times as much, the cell is black."""
    solid = np.ones((1, 1, 1), bool)
    samples = samples_at([[1.0, 0.2 + 0.1 * k, 0.5] for k in range(6)], [0, 0, 15, 15, 15, 15])
    if weight is not None:
        samples = replace(samples, weight=np.where(samples.colour == 0, weight, 0.0))
    [found] = likeliest_colours(samples, outer_air(solid), solid, load_catalogue()).winners(solid)
    assert found == code


@pytest.mark.parametrize(("weight", "code"), [(None, 71), (0.0, 71), (3.0, 0)])
def test_weighted_cells_take_no_mixture(weight, code):
    """Of black and white in nearly equal parts with a rim of grey, grey is the likest; where it counts, black is."""
    solid = np.ones((1, 1, 1), bool)
    samples = samples_at([[1.0, 0.05 + 0.1 * k, 0.5] for k in range(9)], [0, 0, 0, 0, 71, 71, 15, 15, 15])
    samples = samples if weight is None else replace(samples, weight=np.full(9, weight))
    ballot = likeliest_colours(samples, outer_air(solid), solid, load_catalogue())
    assert ballot.winners(solid) == code
    assert ballot.codes[ballot.cost.argmin()] == code


def test_weights_of_cells_are_the_means_of_their_surface():
    """By area, 0 where no surface is; there are none without weights."""
    samples = samples_at([[0.5, 0.5, 0.5], [0.5, 0.5, 1.5], [0.5, 0.5, 1.5], [0.5, 0.5, 9.0]], [0] * 4)
    samples = replace(samples, area=np.array([1.0, 1, 3, 1]), weight=np.array([2.0, 0, 4, 9]))
    cell, seen = np.array([0, 1, 1, -1]), np.array([[[True, True, True, False]]])
    np.testing.assert_array_equal(cell_weights(cell, samples, seen), [2, 3, 0])
    assert cell_weights(cell, replace(samples, weight=None), seen) is None
