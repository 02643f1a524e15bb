"""Coloured trajectories: closed, of the right length in every colour, split where the texels' colour changes."""

from __future__ import annotations

import numpy as np
import pytest

from legorize_addon.core.colours.counted import count_texels
from legorize_addon.core.colours.dominant import SurfaceColours, surface_colours
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh, repair
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import COLOUR_ANY
from legorize_addon.core.slicing import trajectories as module
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import Trajectories, link_loops, linked
from tests.core.solids import box, joined, mesh_of, reversed_mesh, sphere, tube, walls, without
from tests.core.textured import CODES, blob, cylinder, painted, rgb_of, split_at_x, textured, torus


def colours_of(mesh: TriangleMesh) -> SurfaceColours:
    """Find the colours of a mesh, one for one."""
    catalogue = load_catalogue()
    return surface_colours(
        mesh,
        catalogue,
        n_colours=64,
        palette=catalogue.codes,
        one_to_one=False,
        rng=np.random.default_rng(0),
        texels=count_texels(mesh.images),
    )


def cut(mesh: TriangleMesh, heights, *, axis=2, chord_deviation=0.0) -> Trajectories:
    """Cut a mesh and link and colour its loops."""
    slices = slice_mesh(mesh, np.asarray(heights, dtype=np.float64), axis=axis)
    return link_loops(mesh, slices, colours_of(mesh), chord_deviation=chord_deviation)


def lengths(loops: Trajectories) -> np.ndarray:
    """Return the length of every edge in mm."""
    return np.linalg.norm(loops.ends - loops.points, axis=1)


def length_by_colour(loops: Trajectories) -> dict[int, float]:
    """Return the length of trajectory in every colour."""
    return {int(code): float(lengths(loops)[loops.colour == code].sum()) for code in np.unique(loops.colour)}


def outline_length(mesh: TriangleMesh, heights) -> float:
    """Return the length of all segments of a cut."""
    outline = linked(mesh.faces, slice_mesh(mesh, np.asarray(heights, dtype=np.float64)))
    return float(np.linalg.norm(outline.ends - outline.start, axis=1).sum())


def chequered(n=8, seed=0) -> TriangleMesh:
    """Make a cylinder with a chequered image around it, so that colours change all along its loops."""
    mesh = cylinder(40.0, 48.0, 24)
    x, y, z = np.moveaxis(mesh.vertices[mesh.faces], 2, 0)
    turn = np.arctan2(y, x) / (2 * np.pi)
    # across the back, where the angle jumps, the image goes on
    turn += (turn < turn.max(axis=1, keepdims=True) - 0.5) * 1.0
    image = rgb_of(CODES[np.random.default_rng(seed).integers(0, len(CODES), (n, 3 * n))].ravel()).reshape(n, 3 * n, 3)
    return textured(mesh, image, np.stack([turn, z / 48], axis=2))


# ------------------------------------------------------------- hierarchy


def test_fields_belong_together():
    """Every edge has a colour and a triangle, every loop a slice and a parent in it; edges fill the loops."""
    loops = cut(joined(tube(40, 30), tube(20, 10)), np.arange(5) * 9.6 + 4)
    n = len(loops.points)
    assert loops.loop_start[0] == 0
    assert loops.loop_start[-1] == len(loops.colour) == len(loops.face) == n
    assert np.bincount(loops.edge_loop).tolist() == np.diff(loops.loop_start).tolist()
    sons = loops.loop_parent >= 0
    np.testing.assert_array_equal(loops.loop_slice[loops.loop_parent[sons]], loops.loop_slice[sons])
    assert np.bincount(loops.loop_slice).tolist() == [4] * 5
    assert np.bincount(loops.loop_slice, sons).tolist() == [3] * 5
    assert loops.gaps == 0


def test_outer_loops_run_counter_clockwise_and_inner_ones_clockwise():
    """The sign of a loop's area follows from its depth on a torus; the sum is the area of the solid."""
    ring = torus(30, 12, 48, 24)
    loops = cut(ring, [-3.0, 0.5, 4.0])
    assert ((loops.areas() > 0) == (loops.loop_parent < 0)).all()
    areas = np.bincount(loops.loop_slice, loops.areas())
    np.testing.assert_allclose(areas, 4 * np.pi * 30 * np.sqrt(144 - np.array([9, 0.25, 16])), rtol=0.015)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_slices_across_any_axis_run_alike(axis):
    """Across x, y or z the outer loops run counter-clockwise and cavities clockwise."""
    mesh = joined(box((0, 0, 0), (30, 30, 30)), reversed_mesh(box((10, 10, 10), (20, 20, 20))))
    np.testing.assert_allclose(np.sort(cut(mesh, [15.0], axis=axis).areas()), [-100, 900])


@pytest.mark.parametrize("seed", range(4))
def test_areas_are_those_of_shapely(seed):
    """Loop areas agree with shapely's to 1e-9 on bumpy bodies that cross each other, in random planes."""
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(seed)
    bodies = [blob(6 + k, 30.0 + 5 * k, size=8, seed=seed) for k in range(3)]
    mesh = joined(
        *(
            mesh_of(b.vertices @ np.linalg.qr(rng.normal(size=(3, 3)))[0] + rng.normal(0, 15, 3), b.faces)
            for b in bodies
        )
    )
    mesh = repair(mesh)[0]
    loops = cut(mesh, np.sort(rng.uniform(-50, 50, 40)))
    assert loops.gaps == 0
    spans = zip(loops.loop_start[:-1], loops.loop_start[1:], strict=True)
    expected = [shapely.Polygon(loops.points[a:b]).area for a, b in spans]
    np.testing.assert_allclose(np.abs(loops.areas()), expected, rtol=1e-9)
    assert len(expected) > 40


# --------------------------------------------------------------- colours


def test_two_coloured_cylinder():
    """A cylinder split at x = 0 has half its circumference in each colour, within one per cent of pi r."""
    heights = np.arange(10) * 4.8 + 2
    for mesh in (split_at_x(cylinder(40.0)), halved_by_image(cylinder(40.0))):
        found = length_by_colour(cut(mesh, heights))
        assert found.keys() == {1, 4}
        np.testing.assert_allclose(list(found.values()), np.pi * 40 * 10, rtol=0.01)


def halved_by_image(mesh: TriangleMesh, turn=0.3) -> TriangleMesh:
    """Turn a mesh so that its faces cross x = 0, and lay an image of two texels over it, split there."""
    rotation = np.array([[np.cos(turn), np.sin(turn), 0], [-np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    mesh = mesh_of(mesh.vertices @ rotation, mesh.faces)
    u = mesh.vertices[mesh.faces][..., 0] / 100 + 0.5
    return textured(mesh, rgb_of([4, 1])[None], np.stack([u, 0 * u], axis=2), clamp=True)


def test_colour_changes_exactly_where_the_texels_do():
    """Colours meet at x = 0 to the last digits, and each is on its own side."""
    loops = cut(halved_by_image(cylinder(40.0)), [10.0, 20.0])
    change = loops.colour != np.roll(loops.colour, 1)
    assert change.sum() == 4
    np.testing.assert_allclose(loops.points[change, 0], 0, atol=1e-9)
    middle = (loops.points + loops.ends)[:, 0] / 2
    np.testing.assert_array_equal(loops.colour, np.where(middle > 0, 1, 4))


def test_lengths_by_colour_add_up():
    """The lengths of all colours are those of the uncoloured loops, to 1e-9."""
    mesh = chequered()
    heights = np.arange(12) * 4 + 1.5
    found = length_by_colour(cut(mesh, heights))
    assert len(found) >= 6
    assert sum(found.values()) == pytest.approx(outline_length(mesh, heights), rel=1e-9)


def test_colour_of_an_edge_is_that_of_every_texel_under_it():
    """Anywhere on an edge, but at its very ends, the image has just the edge's colour."""
    mesh = chequered(16)
    loops = cut(mesh, [5.0, 17.0, 31.0])
    surface = colours_of(mesh)
    for share in (1e-6, 0.25, 0.5, 0.75, 1 - 1e-6):
        points = loops.points + share * (loops.ends - loops.points)
        z = np.array([5.0, 17.0, 31.0])[loops.loop_slice[loops.edge_loop]]
        corners = mesh.vertices[mesh.faces[loops.face]]
        sides = np.stack([corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]], axis=2)
        weights = np.linalg.pinv(sides) @ (np.column_stack([points, z]) - corners[:, 0])[..., None]
        weights = np.concatenate([1 - weights.sum(axis=1), weights[..., 0]], axis=1)
        uvs = np.einsum("ki,kij->kj", weights, mesh.uvs[loops.face])
        long = lengths(loops) > 1e-3
        np.testing.assert_array_equal(surface.at(mesh.face_image[loops.face], uvs)[long], loops.colour[long])


def test_neighbouring_edges_of_a_segment_differ_in_colour():
    """Texels of one colour side by side make one edge."""
    mesh = chequered()
    loops = cut(mesh, [3.0, 25.0])
    inner = np.flatnonzero((loops.face[1:] == loops.face[:-1]) & (loops.edge_loop[1:] == loops.edge_loop[:-1]))
    assert len(inner)
    assert (loops.colour[inner] != loops.colour[inner + 1]).all()


def test_plain_colours_split_nothing():
    """Faces of one colour each give one edge a segment, in the colour of the face."""
    codes = CODES[np.random.default_rng(1).integers(0, len(CODES), 12)]
    mesh = painted(box((0, 0, 0), (30, 30, 30)), codes)
    loops = cut(mesh, [7.0])
    assert len(loops.points) == 8
    np.testing.assert_array_equal(loops.colour, codes[loops.face])


def test_repeated_images():
    """An image laid four times around a cylinder, in one direction or the other, changes colour eight times."""
    mesh = cylinder(40.0, 48.0, 64)
    x, y, _ = np.moveaxis(mesh.vertices[mesh.faces], 2, 0)
    turn = np.arctan2(y, x) / (2 * np.pi)
    turn += (turn < turn.max(axis=1, keepdims=True) - 0.5) * 1.0
    for times in (4, -4):
        loops = cut(textured(mesh, rgb_of([4, 1])[None], np.stack([times * turn, 0 * turn], axis=2)), [10.0])
        assert (loops.colour != np.roll(loops.colour, 1)).sum() == 8


def test_blocks_change_nothing(monkeypatch):
    """Looked at in small blocks, the texels under the segments give the same edges."""
    mesh = chequered()
    whole = cut(mesh, np.arange(9) * 5 + 2.0)
    monkeypatch.setattr(module, "_MOST_PIECES", 16)
    blocks = cut(mesh, np.arange(9) * 5 + 2.0)
    np.testing.assert_array_equal(whole.points, blocks.points)
    np.testing.assert_array_equal(whole.colour, blocks.colour)
    np.testing.assert_array_equal(whole.face, blocks.face)


# ------------------------------------------------------- gaps and deviation


def test_edges_over_gaps_have_no_colour_of_their_own():
    """The edge across an opening takes any colour and belongs to no triangle."""
    mesh = painted(box((0, 0, 0), (10, 10, 10)), 4)
    side = np.flatnonzero((mesh.vertices[mesh.faces][..., 0] == 10).all(axis=1))
    torn = painted(without(mesh, *side), 4)
    loops = cut(torn, [5.0])
    assert loops.gaps == 1
    np.testing.assert_array_equal(loops.colour == COLOUR_ANY, loops.face < 0)
    assert lengths(loops)[loops.face < 0].tolist() == [10]
    assert loops.areas().tolist() == [100]


def test_lone_wall_closes_on_itself():
    """A straight wall goes there and back: a loop without area, one of its edges the gap's."""
    loops = cut(walls([(0, 0), (20, 0), (50, 0)]), [5.0])
    assert len(loops.loop_slice) == 1
    assert loops.areas().tolist() == [0]
    assert length_by_colour(loops)[COLOUR_ANY] == pytest.approx(50)


@pytest.mark.parametrize("deviation", [0.1, 0.5, 2.0])
def test_deviation_thins_loops_out(deviation):
    """With a chord deviation there are fewer points on the same loops, and areas hardly change."""
    mesh = repair(sphere(24, 40.0))[0]
    heights = np.arange(-3, 4) * 9.6
    fine, coarse = cut(mesh, heights), cut(mesh, heights, chord_deviation=deviation)
    assert len(coarse.points) < len(fine.points)
    np.testing.assert_array_equal(coarse.loop_slice, fine.loop_slice)
    np.testing.assert_array_equal(coarse.loop_parent, fine.loop_parent)
    edge = lengths(fine).sum()
    assert abs(coarse.areas() - fine.areas()).sum() <= deviation * edge
    assert {tuple(p) for p in coarse.points.tolist()} <= {tuple(p) for p in fine.points.tolist()}


def test_deviation_keeps_the_ends_of_colours():
    """However coarse, every point where the colour changes stays."""
    mesh = chequered()
    fine, coarse = cut(mesh, [10.0, 30.0]), cut(mesh, [10.0, 30.0], chord_deviation=4.0)
    changes = fine.colour != np.roll(fine.colour, 1)
    assert {tuple(p) for p in fine.points[changes].tolist()} <= {tuple(p) for p in coarse.points.tolist()}
    assert length_by_colour(coarse).keys() == length_by_colour(fine).keys()


def test_no_slices_give_no_loops():
    """Planes beside the mesh give empty trajectories."""
    loops = cut(box(), [5.0, 7.0])
    assert len(loops.points) == len(loops.areas()) == len(loops.ends) == loops.gaps == 0
