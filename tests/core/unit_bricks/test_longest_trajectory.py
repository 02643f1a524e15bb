"""The paper's literal rule: which of the nine squares count for a brick, and what they weigh."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.slicing.lattice import Grid
from legorize_addon.core.unit_bricks.longest_trajectory import excluded_neighbours, participants
from legorize_addon.core.unit_bricks.surface_samples import inner_cells
from tests.core.solids import mesh_of
from tests.core.textured import Stages, cells, cylinder, painted, split_at_x, stages


def prism(outline, height=9.6) -> TriangleMesh:
    """Raise a star-shaped outline, counter-clockwise around its middle, to an upright prism."""
    outline = np.asarray(outline, float)
    n = len(outline)
    middle = outline.mean(axis=0)
    below, above = np.insert(outline, 2, 0, axis=1), np.insert(outline, 2, height, axis=1)
    here, after = np.arange(n), (np.arange(n) + 1) % n
    low, high = np.full(n, 2 * n), np.full(n, 2 * n + 1)
    faces = [(here, after, after + n), (here, after + n, here + n), (low, after, here), (high, here + n, after + n)]
    vertices = np.concatenate([below, above, [[*middle, 0], [*middle, height]]])
    return mesh_of(vertices, np.concatenate([np.column_stack(each) for each in faces]))


def ellipse(a, b, turn=0.0, centre=(0, 0), n=160) -> np.ndarray:
    """Return points of an ellipse, counter-clockwise."""
    angle = np.arange(n) * 2 * np.pi / n
    x, y = a * np.cos(angle), b * np.sin(angle)
    return np.column_stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)]) + centre


def on_grid(mesh: TriangleMesh, n_x: int, n_y: int) -> Stages:
    """Run the stages on a grid of one layer whose corner is the origin."""
    return stages(mesh, grid=Grid(np.zeros(3), 1, n_y, n_x), cusp=9.6)


def used_squares(built: Stages) -> tuple[dict[tuple[int, int], set[tuple[int, int]]], np.ndarray]:
    """Return, for every brick (x, y) that a trajectory bounds, the squares that count for it; and the bricks."""
    pieces, _ = built.pieces()
    samples = built.steep()
    solid = built.bricks(keep_thin=False).solid[:, 0]
    brick = inner_cells(samples, solid)
    excluded = excluded_neighbours(built.trajectories, pieces.edge, brick, solid.shape)
    cell, entry = participants(samples.cell, brick, excluded, solid)
    used: dict[tuple[int, int], set[tuple[int, int]]] = {}
    for flat, piece in zip(cell, entry, strict=True):
        _, y, x = np.unravel_index(flat, solid.shape)
        used.setdefault((int(x), int(y)), set()).add((int(samples.cell[piece, 2]), int(samples.cell[piece, 1])))
    return used, solid[0].T


def test_brick_on_a_hilltop_counts_itself_left_and_right():
    """Figure 12, SP_i: without the former and the latter brick, the inner and the unpassed squares, three are left."""
    # between two squares that it cuts but hardly covers, the outline lifts one brick above its neighbours
    built = on_grid(prism([[16, 8], [48, 8], [48, 26], [31.5, 26], [31, 31], [25, 31], [24.5, 26], [16, 26]]), 8, 6)
    used, solid = used_squares(built)
    here = (3, 3)
    assert solid[here]
    assert not solid[2, 3]
    assert not solid[4, 3]
    assert used[here] == {here, (2, 3), (4, 3)}


def test_brick_on_a_corner_counts_itself_right_and_up_right():
    """Figure 12, SP_(i+1): the former brick on the left and the latter one above do not count; slivers beside do."""
    built = on_grid(prism([[10, 10], [34, 10], [34, 46], [10, 46]]), 7, 8)
    used, solid = used_squares(built)
    corner = (3, 1)
    assert solid[corner]
    assert not solid[4].any()
    assert used[corner] == {corner, (4, 1), (4, 2)}


def test_brick_on_a_straight_wall_counts_itself_alone():
    """Along a straight wall within one row of bricks, the neighbours are the former and the latter one."""
    used, _ = used_squares(on_grid(prism([[8.5, 8.5], [79.5, 8.5], [79.5, 47.5], [8.5, 47.5]]), 11, 7))
    assert used[(5, 1)] == {(5, 1)}
    assert used[(1, 3)] == {(1, 3)}


@pytest.mark.parametrize("cells_wide", [16, 24])
def test_few_squares_take_part(cells_wide):
    """On random ellipses at most three squares on average, and in four of five cases at most three, count."""
    rng = np.random.default_rng(cells_wide)
    counts = []
    for _ in range(8):
        a, b = cells_wide * 4 * rng.uniform(0.5, 1, 2)
        middle = cells_wide * 4 + 16 + rng.uniform(-4, 4, 2)
        size = cells_wide + 4
        used, _ = used_squares(on_grid(prism(ellipse(a, b, rng.uniform(0, np.pi), middle)), size, size))
        counts += [len(squares) for squares in used.values()]
    counts = np.array(counts)
    assert len(counts) > 150
    assert counts.mean() <= 3
    assert (counts <= 3).mean() >= 0.8
    assert counts.max() <= 5


def test_all_length_is_counted_once_for_the_brick_it_bounds():
    """Each piece in the own square of a brick counts for this brick, and for each brick at most once."""
    built = on_grid(prism(ellipse(50, 37, 0.3, (64, 60))), 16, 16)
    pieces, _ = built.pieces()
    samples = built.steep()
    solid = built.bricks(keep_thin=False).solid[:, 0]
    brick = inner_cells(samples, solid)
    excluded = excluded_neighbours(built.trajectories, pieces.edge, brick, solid.shape)
    cell, entry = participants(samples.cell, brick, excluded, solid)
    pairs = set(zip(cell.tolist(), entry.tolist(), strict=True))
    assert len(pairs) == len(cell)
    own = np.ravel_multi_index(tuple(samples.cell.T), solid.shape)
    for piece in np.flatnonzero(solid.ravel()[own]):
        assert (int(own[piece]), int(piece)) in pairs
    place = np.stack(np.unravel_index(cell, solid.shape), axis=1)
    assert np.abs(place - samples.cell[entry]).max() <= 1


def test_former_and_latter_are_the_neighbours_along_the_loop():
    """In a ring of bricks every brick leaves out the one before and the one after it, and no other."""
    built = on_grid(prism([[8, 8], [40, 8], [40, 40], [8, 40]]), 6, 6)
    pieces, _ = built.pieces()
    samples = built.steep()
    solid = built.bricks(keep_thin=False).solid[:, 0]
    excluded = excluded_neighbours(built.trajectories, pieces.edge, inner_cells(samples, solid), solid.shape)
    bits = excluded.reshape(solid.shape)[0]
    # bit 3 (y + 1) + x + 1 for a neighbour at (x, y)
    left, right, up, down = 1 << 3, 1 << 5, 1 << 7, 1 << 1
    assert bits[1, 2] == left | right
    assert bits[2, 1] == up | down
    assert bits[1, 1] == right | up
    assert bits[4, 4] == left | down
    assert bits[2, 2] == bits[0, 0] == 0


def test_two_coloured_cylinder_is_split_where_the_colours_meet():
    """In the literal mode too, every brick wholly on one side of x = 0 has the colour of that side."""
    built = stages(split_at_x(cylinder()))
    colour = cells(built.bricks(longest=True))
    x = built.grid.origin[0] + (np.arange(built.grid.n_x) + 0.5) * 8
    for side, code in (x > 4.1, 1), (x < -4.1, 4):
        there = colour[:, :, side]
        assert set(np.unique(there[there >= 0]).tolist()) == {code}


@pytest.mark.parametrize(("blue", "code"), [(5, 1), (4.1, 1), (3.9, 4), (3, 4)])
def test_longer_stretch_gives_its_colour(blue, code):
    """A brick whose stretch of wall is blue for more than half is blue, however much red there is on its top."""
    mesh = prism([[8, 8], [24, 8], [24 + blue, 8], [48, 8], [48, 40], [8, 40]])
    corners = mesh.vertices[mesh.faces]
    stretch = (corners[..., 1].max(axis=1) == 8) & (
        np.abs(corners[..., 0] - 24 - blue / 2).max(axis=1) < blue / 2 + 1e-9
    )
    colour = cells(on_grid(painted(mesh, np.where(stretch, 1, 4)), 7, 6).bricks(longest=True))[0]
    assert colour[1, 3] == code
    assert set(colour[1, [1, 2, 4, 5]].tolist()) == {4}


def test_level_surface_colours_what_no_trajectory_passes():
    """The top of a slab takes the colours of its top, though no trajectory runs there."""
    mesh = prism([[8, 8], [56, 8], [56, 48], [8, 48]])
    top = (mesh.vertices[mesh.faces][..., 2] > 9).all(axis=1)
    colour = cells(on_grid(painted(mesh, np.where(top, 2, 15)), 8, 7).bricks(longest=True))[0]
    assert (colour[2:5, 2:6] == 2).all()
    rim = colour[1:6, 1:7].copy()
    rim[1:-1, 1:-1] = 15
    assert (rim == 15).all()
