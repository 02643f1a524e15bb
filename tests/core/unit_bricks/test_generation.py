"""Unit bricks: which cells are filled, exactly, and in which colour they are seen."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy import ndimage

from legorize_addon.core.geometry.neighbourhoods import outer_air, visible
from legorize_addon.core.mesh.size import scale_mesh
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.unit_grid import COLOUR_ANY, COLOUR_EMPTY, Fill
from legorize_addon.core.slicing.lattice import Grid
from legorize_addon.core.slicing.levels import levels_of
from legorize_addon.core.unit_bricks.generation import half_covered, mean_areas
from tests.core.solids import box, joined, mesh_of, sphere, volume
from tests.core.textured import (
    blob,
    cells,
    cylinder,
    hollow_box,
    painted,
    rgb_of,
    split_at_x,
    stages,
    table,
    textured,
    torus,
)

CELL = 8 * 8 * 9.6
"""Volume of a unit brick in mm^3."""


def bricks(mesh: TriangleMesh, **options) -> np.ndarray:
    """Return the colours of a mesh's unit bricks, (n_layers, n_y, n_x)."""
    return cells(stages(mesh, symmetric=options.pop("symmetric", True)).bricks(**options))


def trimmed(colour: np.ndarray) -> np.ndarray:
    """Cut the empty rim off."""
    inside = ndimage.find_objects((colour != COLOUR_EMPTY).astype(int))[0]
    return colour[inside]


# -------------------------------------------------------------- which cells


def test_model_stands_on_its_lowest_cells():
    """Of a block on a pin too thin for cells the first layer is that of the block, at the height where it lies."""
    mesh = painted(joined(box((-16, -16, 24), (16, 16, 48)), box((-0.5, -0.5, 0), (0.5, 0.5, 24))), 14)
    grid = stages(mesh).bricks(keep_thin=False)
    filled = grid.solid.any(axis=(1, 2, 3))
    assert filled[0]
    assert grid.origin[2] + 9.6 * np.count_nonzero(filled) == pytest.approx(48)
    assert grid.origin[2] == pytest.approx(24, abs=4.8)


@pytest.mark.parametrize("symmetric", [True, False])
@pytest.mark.parametrize("size", [(1, 1, 1), (3, 2, 1), (5, 4, 6), (2, 7, 3)])
def test_aligned_box_is_exactly_its_cells(size, symmetric):
    """A box of whole studs and bricks becomes just so many cells, its hidden ones without a colour."""
    n_x, n_y, n_layers = size
    mesh = painted(box((-8 * n_x / 2, -8 * n_y / 2, 0), (8 * n_x / 2, 8 * n_y / 2, 9.6 * n_layers)), 14)
    built = stages(mesh)
    if not symmetric:
        # the literal grid may lie at any phase; here at the box's own
        built = stages(mesh, grid=Grid(np.array([-8 * n_x / 2 - 16, -8 * n_y / 2 - 8, 0]), n_layers, n_y + 3, n_x + 4))
    colour = trimmed(cells(built.bricks()))
    assert colour.shape == (n_layers, n_y, n_x)
    expected = np.full(colour.shape, 14)
    expected[1:-1, 1:-1, 1:-1] = COLOUR_ANY
    np.testing.assert_array_equal(colour, expected)


def test_all_six_faces_of_a_box_keep_their_colours():
    """Every cell of a face, but for the edges, has the face's colour; on edges it is that of a face there."""
    sides = np.repeat([1, 2, 4, 14, 15, 25], 2)
    mesh = painted(box((0, 0, 0), (48, 40, 57.6)), sides)
    colour = trimmed(bricks(mesh))
    middle = mesh.vertices[mesh.faces].mean(axis=1) - [24, 20, 28.8]
    faces = {"bottom": np.s_[0], "top": np.s_[-1], "front": np.s_[:, 0], "back": np.s_[:, -1], "left": np.s_[:, :, 0],
             "right": np.s_[:, :, -1]}  # fmt: skip
    ways = {"bottom": [0, 0, -1], "top": [0, 0, 1], "front": [0, -1, 0], "back": [0, 1, 0], "left": [-1, 0, 0],
            "right": [1, 0, 0]}  # fmt: skip
    shown = {name: int(sides[(middle / [24, 20, 28.8] @ np.array(ways[name])).argmax()]) for name in ways}
    assert len(set(shown.values())) == 6
    for name, place in faces.items():
        side = colour[place]
        assert (side[1:-1, 1:-1] == shown[name]).all()
        assert set(np.unique(side).tolist()) <= set(shown.values())


@pytest.mark.parametrize(("covered", "valid"), [(31.9, False), (32.0, True), (32.1, True)])
@pytest.mark.parametrize("along", [0, 1])
def test_half_a_square_is_enough(covered, valid, along):
    """A box that covers 31.9, 32.0 or 32.1 mm^2 of its outer cells fills them not, does and does."""
    size = np.array([24.0, 24.0, 9.6])
    size[along] = 16 + covered / 8
    grid = Grid(np.array([-8.0, -8, 0]), 1, 6, 6)
    colour = cells(stages(box((0, 0, 0), size), grid=grid).bricks(keep_thin=False))
    shape = trimmed(colour).shape
    assert shape[2 - along] == (3 if valid else 2)
    assert shape[1 + along] == 3


@pytest.mark.parametrize(("height", "layers"), [(9.6 * 2 + 4.7, 2), (9.6 * 2 + 4.9, 3)])
def test_half_a_brick_of_height_is_enough(height, layers):
    """A top layer is there from half a brick of height on."""
    assert len(trimmed(bricks(box((0, 0, 0), (40, 40, height)), keep_thin=False))) == layers


@pytest.mark.parametrize("radius", [60.0, 100.0, 160.0])
def test_ball_keeps_its_volume(radius):
    """The unit bricks of a ball have its volume within 2 %."""
    mesh = sphere(32, radius)
    n_cells = (bricks(mesh, keep_thin=False) != COLOUR_EMPTY).sum()
    assert n_cells * CELL == pytest.approx(volume(mesh), rel=0.02)


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_cells_are_those_half_covered_by_the_body(turn):
    """Against a fine lattice of points in a turned prism: no cell clearly over or under half is wrong."""
    rotation = np.array([[np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    body = box((-37.3, -29.1, 0), (37.3, 29.1, 28.8))
    built = stages(mesh_of(body.vertices @ rotation, body.faces))
    solid = built.bricks(keep_thin=False).solid[:, 0]
    fine = 16
    y, x = np.mgrid[: built.grid.n_y * fine, : built.grid.n_x * fine] + 0.5
    points = np.stack([x, y], axis=-1) * 8 / fine + built.grid.origin[:2]
    local = points @ rotation[:2, :2].T
    inside = (np.abs(local) < [37.3, 29.1]).all(axis=-1)
    share = inside.reshape(built.grid.n_y, fine, built.grid.n_x, fine).mean(axis=(1, 3))
    clear = np.abs(share - 0.5) > 0.02
    assert clear.mean() > 0.9
    for layer in solid:
        np.testing.assert_array_equal(layer[clear], (share > 0.5)[clear])


def test_hole_of_a_torus_is_open():
    """A ring keeps its hole, and is one piece."""
    solid = bricks(torus()) != COLOUR_EMPTY
    assert ndimage.label(solid)[1] == 1
    middle = solid.any(axis=0)
    labels, n = ndimage.label(~middle)
    assert n == 2
    assert (labels == labels[middle.shape[0] // 2, middle.shape[1] // 2]).sum() >= 20


def test_enclosed_cavity_stays_empty_and_its_walls_hidden():
    """A sealed cavity is kept, and the cells around it that no one sees from outside have no colour."""
    outer, inner = ((0, 0, 0), (72, 72, 67.2)), ((24, 24, 19.2), (48, 48, 48))
    mesh = hollow_box(outer, inner)
    mesh = painted(mesh, np.repeat([4, 1], 12))
    colour = trimmed(bricks(mesh))
    assert colour.shape == (7, 9, 9)
    assert (colour[2:5, 3:6, 3:6] == COLOUR_EMPTY).all()
    assert (colour == COLOUR_EMPTY).sum() == 27
    assert not (colour == 1).any()
    hidden = colour[1:-1, 1:-1, 1:-1]
    assert set(np.unique(hidden).tolist()) == {COLOUR_EMPTY, COLOUR_ANY}


def test_tunnel_walls_are_seen():
    """The walls of a tunnel of some studs have the tunnel's colour."""
    sides = [box((x, 0, 0), (x + 24, 96, 48)) for x in (0, 48)]
    ends = [box((24, 0, z), (48, 96, z + 9.6)) for z in (0, 38.4)]
    mesh = joined(*sides, *ends)
    corners = mesh.vertices[mesh.faces]
    inner = (np.ptp(corners[..., 0], axis=1) == 0) & np.isin(corners[:, 0, 0], [24, 48])
    colour = trimmed(bricks(painted(mesh, np.where(inner, 1, 4))))
    assert (colour[1:4, 3:-3, 3:6] == COLOUR_EMPTY).all()
    assert (colour[2, 3:-3, 2] == 1).all()
    assert (colour[2, 3:-3, 6] == 1).all()
    assert (colour[2, :, [0, 8]] == 4).all()


def test_overlapping_bodies_count_once():
    """Two bodies that overlap fill the cells of their union."""
    colour = trimmed(bricks(joined(box((0, 0, 0), (48, 24, 28.8)), box((24, 0, 0), (72, 24, 28.8)))))
    np.testing.assert_array_equal(colour != COLOUR_EMPTY, np.ones((3, 3, 9), bool))


@pytest.mark.parametrize("k", [10, 5, 2.5])
def test_size_in_cells_is_linear(k):
    """At k = 10, 5 and 2.5 a figure is k / 10 times as many cells long, but for one."""
    whole = joined(sphere(16, 160.0, (0, 0, 160)), box((-60, -40, 0), (60, 40, 200)))
    shape = np.array(trimmed(bricks(scale_mesh(whole, k / 10))).shape)
    np.testing.assert_allclose(shape, np.array([320 / 9.6, 40, 40]) * k / 10, atol=1)


# -------------------------------------------------------------- symmetry

MIRRORED = {
    "ball": sphere(16, 61.0),
    "cylinder": cylinder(43.0),
    "torus": torus(50.0, 17.0),
    "table": table(),
    "figure": joined(sphere(12, 30.0, (0, 3, 70)), box((-20, -10, 0), (-6, 8, 50)), box((6, -10, 0), (20, 8, 50))),
}


@pytest.mark.parametrize("name", MIRRORED)
@pytest.mark.parametrize("keep_thin", [True, False])
def test_symmetric_mesh_gives_symmetric_bricks(name, keep_thin):
    """What is the same left and right is the same in bricks: cells, and colours in bands of two layers."""
    mesh = MIRRORED[name]
    bottom = stages(mesh).grid.origin[2]
    height = np.repeat((mesh.vertices[mesh.faces][..., 2, None] - bottom) / (3 * 19.2), 2, axis=2)
    colour = bricks(textured(mesh, rgb_of([1, 4, 14])[:, None], height), keep_thin=keep_thin)
    np.testing.assert_array_equal(colour != COLOUR_EMPTY, colour[:, :, ::-1] != COLOUR_EMPTY)
    np.testing.assert_array_equal(colour, colour[:, :, ::-1])


def test_mirrored_mesh_gives_mirrored_bricks():
    """A mesh and its mirror image become bricks that are each other's mirror image."""
    mesh = blob(n=12, radius=90.0)
    turned = mesh_of(mesh.vertices * [-1, 1, 1], mesh.faces[:, ::-1])
    one, other = bricks(mesh_of(mesh.vertices, mesh.faces)), bricks(turned)
    assert (one != other[:, :, ::-1]).mean() < 1e-3


# -------------------------------------------------------------- colours


@pytest.mark.parametrize("longest", [False, True])
def test_two_coloured_cylinder_is_split_at_its_middle(longest):
    """Of a cylinder split at x = 0, every brick strictly on one side has the colour of that side."""
    built = stages(split_at_x(cylinder(height=57.6)))
    colour = cells(built.bricks(longest=longest))
    x = built.grid.origin[0] + np.arange(built.grid.n_x) * 8
    right, left = colour[:, :, x >= -1e-9], colour[:, :, x <= -8 + 1e-9]
    assert set(np.unique(right[right >= 0]).tolist()) == {1}
    assert set(np.unique(left[left >= 0]).tolist()) == {4}
    assert (right >= 0).sum() == (left >= 0).sum() > 50


@pytest.mark.parametrize("longest", [False, True])
def test_every_visible_cell_has_a_colour_and_no_hidden_one(longest):
    """Cells with a face to the outer air have a colour of the mesh; those inside are free."""
    colour = bricks(blob(n=12, radius=100.0), longest=longest)
    solid = colour != COLOUR_EMPTY
    seen = visible(solid, outer_air(solid))
    assert (colour[seen] >= 0).all()
    assert (colour[solid & ~seen] == COLOUR_ANY).all()


def test_roles_and_covers_follow_the_colours():
    """Visible cells are the shell, hidden ones the inside; all must be built before hollowing; plates are equal."""
    grid = stages(painted(box((0, 0, 0), (40, 40, 48)), 4)).bricks()
    empty, hidden = grid.colour == COLOUR_EMPTY, grid.colour == COLOUR_ANY
    np.testing.assert_array_equal(grid.cover, np.where(empty, Fill.EMPTY, Fill.REQUIRED))
    np.testing.assert_array_equal(grid.role[~empty], np.where(hidden, Role.INSIDE, Role.SHELL)[~empty])
    np.testing.assert_array_equal(grid.solid, ~empty)
    assert hidden.sum() == 3 * 3 * 3 * 3
    assert (grid.colour.dtype, grid.cover.dtype, grid.role.dtype) == (np.int16, np.uint8, np.uint8)


def test_two_runs_are_equal():
    """The same mesh gives the same cells to the last bit."""
    built = stages(blob(n=12, radius=80.0))
    one, other = built.bricks(), built.bricks()
    assert one.colour.tobytes() == other.colour.tobytes()


# -------------------------------------------------------------- the rules by themselves


@given(st.integers(0, 2**32 - 1))
def test_half_covered_is_the_mean_over_the_slices_of_a_layer(seed):
    """A cell is filled where its mean area over the slices of its layer is half or more; without slices it is not."""
    rng = np.random.default_rng(seed)
    layer = np.sort(rng.integers(0, 5, rng.integers(1, 9))).astype(np.int32)
    area = rng.choice([0.0, 16, 31.9, 32, 64], (len(layer), 3, 2))
    levels = levels_of(np.zeros(len(layer)), layer, np.zeros(len(layer), np.int8), Grid(np.zeros(3), 6, 3, 2))
    half = half_covered(mean_areas(area, levels, 6) / 64)
    for number in range(6):
        there = area[layer == number]
        expected = there.mean(axis=0) >= 32 - 1e-6 if len(there) else np.zeros((3, 2), bool)
        np.testing.assert_array_equal(half[number], expected)


@settings(max_examples=40)
@given(arrays(bool, (4, 4, 4)))
def test_outer_air_is_what_a_flood_from_outside_reaches(solid):
    """Empty cells are air if a way of empty cells, face to face, leads out of the grid."""
    air = np.pad(np.zeros_like(solid), 1, constant_values=True)
    space = ~np.pad(solid, 1)
    for _ in range(solid.size):
        air |= space & ndimage.binary_dilation(air)
    np.testing.assert_array_equal(outer_air(solid), air[1:-1, 1:-1, 1:-1])


@settings(max_examples=40)
@given(arrays(bool, (3, 4, 5)))
def test_visible_cells_touch_the_air_or_the_rim(solid):
    """A cell is seen if one of its six neighbours is outer air or lies outside the grid."""
    air = outer_air(solid)
    around = np.pad(air, 1, constant_values=True)
    neighbours = [np.roll(around, step, axis)[1:-1, 1:-1, 1:-1] for axis in range(3) for step in (-1, 1)]
    np.testing.assert_array_equal(visible(solid, air), solid & np.any(neighbours, axis=0))
