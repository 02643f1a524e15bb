"""The door for meshes: what is refused, what is mended, and that it is mended once."""

from __future__ import annotations

from dataclasses import asdict, fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from legorize_addon.core.errors import MeshError
from legorize_addon.core.mesh.size import scale_mesh
from legorize_addon.core.mesh.triangle_mesh import Repairs, TriangleMesh, repair
from tests.core.solids import (
    BOX_FACES,
    area,
    box,
    joined,
    mesh_of,
    moebius,
    reversed_mesh,
    sheet,
    sphere,
    surface,
    volume,
    without,
)

DONE = ("welded", "degenerate", "duplicate", "flipped", "turned", "filled")
"""Counts of changes, all zero for a mesh that needs nothing."""


def same(one: TriangleMesh, other: TriangleMesh) -> bool:
    """Tell whether two meshes are equal to the last bit."""
    names = ("vertices", "faces", "uvs", "face_image")
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in names)


def flipped(mesh: TriangleMesh, rows) -> TriangleMesh:
    """Turn some faces."""
    faces = mesh.faces.copy()
    faces[rows] = faces[rows][:, ::-1]
    return mesh_of(mesh.vertices, faces)


def split(mesh: TriangleMesh) -> TriangleMesh:
    """Give every face vertices of its own."""
    return mesh_of(mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(3 * len(mesh.faces)))


# ---------------------------------------------------------------------- refusals

BAD = {
    "no vertices": (mesh_of(np.empty((0, 3)), []), "0 vertices and no faces"),
    "no faces": (mesh_of(box().vertices, []), "8 vertices and no faces"),
    "one triangle": (mesh_of(np.eye(3), [0, 1, 2]), "only 1 triangle:"),
    "not a number": (mesh_of(np.where(box().vertices == 1, np.nan, 0), BOX_FACES), "of 7 vertices"),
    "infinite": (mesh_of([[np.inf, 0, 0], *box().vertices[1:]], BOX_FACES), "of 1 vertex"),
    "zero scale": (mesh_of(box().vertices * 0, BOX_FACES), "0 mm in size"),
    "on a line": (mesh_of(box().vertices * [1, 0, 0], BOX_FACES), "Only 0 of 12"),
    "too great": (mesh_of(box().vertices * 1e300, BOX_FACES), r"1\.73e\+300 mm in size"),
    "greatest floats": (mesh_of((box().vertices * 2 - 1) * 1.7e308, BOX_FACES), "inf mm in size"),
    "too small": (mesh_of(box().vertices * 1e-9, BOX_FACES), r"1\.73e-09 mm in size"),
    "too far": (mesh_of(box().vertices + 1e11, BOX_FACES), r"1e\+11 mm from the origin"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_meshes_are_refused_in_one_sentence_with_the_number(name):
    """What cannot be built is refused, not mended."""
    mesh, words = BAD[name]
    with pytest.raises(MeshError, match=words) as refusal:
        repair(mesh)
    assert str(refusal.value).endswith(".")


def test_faces_outside_the_vertices_are_refused():
    """A vertex number without a vertex is told."""
    with pytest.raises(MeshError, match="vertex 8, but there are 8"):
        repair(replace(box(), faces=BOX_FACES + 1))


def test_infinite_image_coordinates_are_refused():
    """UVs that are no numbers would have no colour."""
    mesh = box()
    mesh.uvs[0, 0, 0] = np.nan
    with pytest.raises(MeshError, match="1 image coordinate"):
        repair(mesh)


def test_loose_vertices_are_left_out_whatever_they_are():
    """Vertices without faces do not count, not even when they are no numbers."""
    mesh = mesh_of([[np.nan] * 3, [1e30] * 3, *box().vertices], BOX_FACES + 2)
    assert same(repair(mesh)[0], box())


# ---------------------------------------------------------------------- good meshes

GOOD = {
    "box": box(),
    "sphere": repair(sphere())[0],
    "two boxes": joined(box(), box((3, 0, 0), (4, 1, 1))),
    "one box in another": joined(box(), box((0.2,) * 3, (0.8,) * 3)),
    "a cavity": joined(box(), reversed_mesh(box((0.2,) * 3, (0.8,) * 3))),
    "a body in a cavity": joined(box(), reversed_mesh(box((0.1,) * 3, (0.9,) * 3)), box((0.3,) * 3, (0.7,) * 3)),
    "boxes on an edge": repair(joined(box(), box((1, 1, 0), (2, 2, 1))))[0],
    "a flat sheet": sheet(),
    "a wavy sheet": sheet(12, 12, lambda x, y: 0.1 * np.sin(7 * x) * np.cos(9 * y)),
    "far away": mesh_of(box().vertices + 1e5, BOX_FACES),
    "tiny": mesh_of(box().vertices * 1e-4, BOX_FACES),
    "huge": mesh_of(box().vertices * 1e9, BOX_FACES),
}


@pytest.mark.parametrize("name", GOOD)
def test_a_good_mesh_comes_back_as_it_was(name):
    """Nothing to mend: every array is the same, every count of changes zero."""
    mended, repairs = repair(GOOD[name])
    assert same(mended, GOOD[name])
    assert {count: getattr(repairs, count) for count in DONE} == dict.fromkeys(DONE, 0)


def test_the_input_is_not_written_to():
    """A mesh that needs everything still is what it was afterwards."""
    mesh = without(flipped(joined(box(), box()), [3, 15]), 7)
    before = tuple(array.copy() for array in (mesh.vertices, mesh.faces, mesh.uvs, mesh.face_image))
    repair(mesh)
    for array, copy in zip((mesh.vertices, mesh.faces, mesh.uvs, mesh.face_image), before, strict=True):
        np.testing.assert_array_equal(array, copy)


def test_types_are_as_declared():
    """The arrays have the declared types after all repairs."""
    mesh, _ = repair(without(split(flipped(sphere(), [5])), 11))
    types = [getattr(mesh, name).dtype for name in ("vertices", "faces", "uvs", "face_image")]
    assert types == [np.float64, np.int32, np.float64, np.int32]


# ---------------------------------------------------------------------- orientation


def test_a_cube_with_one_face_turned():
    """The odd face is turned back, and named."""
    mesh, repairs = repair(flipped(box(), [5]))
    assert surface(mesh) == surface(box())
    assert (repairs.flipped, repairs.turned, repairs.watertight) == (1, 0, True)
    assert repairs.sentences() == ("Turned 1 triangle that faced the wrong way.",)


def test_faces_are_counted_as_turned_by_what_became_of_them():
    """With most of a cube inside out, those faces are turned and the others are not."""
    mesh, repairs = repair(flipped(box(), np.arange(8)))
    assert surface(mesh) == surface(box())
    assert (repairs.flipped, repairs.turned) == (8, 0)


def test_corners_keep_their_image_coordinates_when_a_face_is_turned():
    """The UVs change places with the corners (they tell x and y here)."""
    mesh, _ = repair(flipped(sphere(), np.arange(100)))
    np.testing.assert_array_equal(mesh.uvs, mesh.vertices[mesh.faces][..., :2])


def test_an_inside_out_sphere_is_turned_as_a_whole():
    """The volume becomes what it was without the sign."""
    inverted = reversed_mesh(sphere())
    mesh, repairs = repair(inverted)
    assert volume(mesh) == pytest.approx(-volume(inverted))
    assert volume(mesh) > 0
    assert repairs.sentences() == ("Turned the whole mesh, which was inside out.",)


@given(st.lists(st.booleans(), min_size=12, max_size=12), st.permutations(range(12)), st.booleans())
def test_any_shuffled_flipped_and_split_cube_becomes_the_cube(turn, order, apart):
    """Order, winding and shared vertices of the input do not matter."""
    mesh = flipped(box(), np.array(turn))
    mesh = mesh_of(mesh.vertices, mesh.faces[list(order)])
    mended, repairs = repair(split(mesh) if apart else mesh)
    assert surface(mended) == surface(box())
    assert (repairs.patches, repairs.bodies, repairs.watertight) == (1, 1, True)
    assert len(mended.vertices) == 8


@given(st.integers(0, 2**32 - 1))
def test_a_sphere_survives_random_flips_and_splits(seed):
    """The same on a greater mesh, with as many faces turned as not."""
    random = np.random.default_rng(seed)
    ball = repair(sphere(5, 2.0, (7, -3, 1)))[0]
    mesh = mesh_of(ball.vertices, random.permutation(ball.faces))
    mended, _ = repair(split(flipped(mesh, random.random(len(mesh.faces)) < 0.5)))
    assert surface(mended) == surface(ball)
    assert volume(mended) == pytest.approx(volume(ball))


def test_bodies_turned_one_by_one():
    """A body that is inside out beside others is turned alone."""
    mesh, repairs = repair(joined(box((0, 0, 0), (2, 2, 2)), reversed_mesh(box((3, 0, 0), (4, 1, 1)))))
    assert volume(mesh) == pytest.approx(9)
    assert (repairs.turned, repairs.patches, repairs.bodies) == (1, 2, 2)
    assert repairs.sentences() == ("Turned 1 of 2 surfaces, which faced inwards.",)


def test_a_cavity_in_an_inverted_body_stays_a_cavity():
    """A whole model inside out is turned as it is, cavities included."""
    hollow = joined(box(), reversed_mesh(box((0.2,) * 3, (0.8,) * 3)))
    mesh, repairs = repair(reversed_mesh(hollow))
    assert surface(mesh) == surface(hollow)
    assert repairs.turned == repairs.patches == 2


def test_an_inverted_body_that_sticks_out_of_another_is_no_cavity():
    """A limb turned inside out that begins inside the trunk is turned, not cut out of it."""
    mesh, _ = repair(joined(box((0, 0, 0), (2, 2, 2)), reversed_mesh(box((0.5,) * 3, (1.5, 1.5, 5)))))
    assert volume(mesh) == pytest.approx(8 + 4.5)


def test_an_inverted_body_in_two_others_is_turned():
    """Inside an even number of bodies there is no cavity."""
    shells = joined(box((0, 0, 0), (5, 5, 5)), box((1, 1, 1), (4, 4, 4)), reversed_mesh(box((2,) * 3, (3,) * 3)))
    assert volume(repair(shells)[0]) == pytest.approx(125 + 27 + 1)


def test_a_mended_cavity_is_taken_for_a_body():
    """Where the winding was mixed it says nothing, so the body is turned outwards."""
    inner = flipped(reversed_mesh(box((0.2,) * 3, (0.8,) * 3)), [4])
    assert volume(repair(joined(box(), inner))[0]) == pytest.approx(1 + 0.6**3)


def test_a_cavity_of_a_mended_body_stays_a_cavity():
    """The winding of a body that was mixed, mostly inwards, says nothing about its cavity."""
    hollow = joined(box(), reversed_mesh(box((0.2,) * 3, (0.8,) * 3)))
    assert surface(repair(flipped(hollow, np.arange(8)))[0]) == surface(hollow)


def test_the_lining_of_an_open_body_keeps_looking_inwards():
    """A cup of two open shells, the inner one towards the axis, is not filled up."""
    outer, inner = box((0, 0, 0), (4, 4, 4)), reversed_mesh(box((1, 1, 1), (3, 3, 4)))
    cup = joined(without(outer, 2, 3), without(inner, 2, 3))
    mesh, repairs = repair(cup)
    assert same(mesh, cup)
    assert (repairs.open_edges, repairs.watertight) == (8, False)
    assert surface(repair(reversed_mesh(cup))[0]) == surface(cup)


def test_an_open_body_is_turned_by_what_it_would_enclose():
    """A box without its lid is turned when it is inside out."""
    mesh, repairs = repair(reversed_mesh(without(box(), 2, 3)))
    assert surface(mesh) == surface(without(box(), 2, 3))
    assert (repairs.turned, repairs.open_edges) == (1, 4)


def test_sheets_go_with_the_bodies():
    """A flat sheet has no outside of its own: it is turned when most of the model is."""
    scene = joined(box(), mesh_of(sheet().vertices + np.array([0, 0, 2]), sheet().faces))
    assert surface(repair(reversed_mesh(scene))[0]) == surface(scene)


def test_a_moebius_strip_is_counted_and_left():
    """No winding is right everywhere; the strip is told of and kept."""
    mesh, repairs = repair(moebius())
    assert repairs.one_sided == repairs.patches == 1
    assert not repairs.watertight
    assert area(mesh) == pytest.approx(area(moebius()))
    assert "Kept 1 surface without an inside, like a Moebius strip." in repairs.sentences()


def test_a_closed_surface_without_an_inside_is_not_watertight():
    """The projective plane on six vertices has no open edge, and encloses nothing."""
    digits = ["012", "023", "034", "045", "015", "124", "134", "135", "235", "245"]
    plane = mesh_of(np.random.default_rng(0).random((6, 3)), [list(map(int, face)) for face in digits])
    _, repairs = repair(plane)
    assert (repairs.open_edges, repairs.non_manifold_edges, repairs.one_sided) == (0, 0, 1)
    assert not repairs.watertight


# ---------------------------------------------------------------------- duplicates


def test_a_cube_with_faces_drawn_twice():
    """Copies go, whichever way they look and whatever vertices they use."""
    extra = flipped(mesh_of(box().vertices, BOX_FACES[[0, 4, 8, 9]]), [1, 3])
    mesh, repairs = repair(joined(box(), extra))
    assert surface(mesh) == surface(box())
    assert (repairs.duplicate, repairs.watertight) == (4, True)
    assert repairs.sentences() == ("Removed 4 triangles on top of others.",)


def test_a_body_drawn_with_its_back_faces_keeps_its_volume():
    """A closed surface drawn for both sides is one body, not nothing."""
    mesh, repairs = repair(joined(reversed_mesh(sphere()), sphere()))
    assert surface(mesh) == surface(sphere())
    assert repairs.bodies == 1


def test_a_sheet_drawn_with_its_back_becomes_the_sheet():
    """A double-sided sheet is treated as a single one."""
    mesh, repairs = repair(joined(sheet(), reversed_mesh(sheet())))
    assert surface(mesh) == surface(sheet())
    assert repairs.duplicate == len(sheet().faces)


def test_a_wall_between_touching_boxes_cancels():
    """Two boxes that share a face stay two closed bodies: together they are watertight."""
    pair = joined(box(), box((1, 0, 0), (2, 1, 1)))
    mesh, repairs = repair(pair)
    assert surface(mesh) == surface(pair)
    assert (repairs.duplicate, repairs.watertight, repairs.bodies) == (0, True, 1)
    assert repairs.non_manifold_edges == 5


def test_a_fin_on_a_body_keeps_both_sides():
    """A double-sided fin encloses nothing, and leaves the body closed."""
    fin = mesh_of([[0, 0, 0], [0, 0, 1], [-1, 0, 1]], [[0, 1, 2], [0, 2, 1]])
    finned = joined(box(), fin)
    mesh, repairs = repair(finned)
    assert surface(mesh) == surface(finned)
    assert repairs.watertight


# ---------------------------------------------------------------------- degenerate triangles, cracks, holes


def test_triangles_without_area_go():
    """Points and lines drawn as triangles are no surface."""
    junk = [[0, 0, 5], [2, 2, 1], [0, 1, 8]]
    mesh, repairs = repair(mesh_of([*box().vertices, [0.5, 0, 0]], [*BOX_FACES, *junk]))
    assert surface(mesh) == surface(box())
    assert (repairs.degenerate, repairs.watertight) == (3, True)
    assert repairs.sentences() == ()


def test_a_crack_beside_a_vertex_on_an_edge_is_closed():
    """A long edge and the two short ones beside it become neighbours, whatever lies between."""
    vertices = [*box().vertices, [0.5, 0, 0]]
    halves = [[8, 2, 0], [8, 1, 2]]
    cracked = mesh_of(vertices, [*halves, *BOX_FACES[1:]])
    mesh, repairs = repair(cracked)
    assert (repairs.filled, repairs.open_edges, repairs.watertight) == (1, 0, True)
    assert volume(mesh) == pytest.approx(1)
    assert same(repair(mesh)[0], mesh)


def test_a_missing_triangle_is_filled_in_the_colours_around_it():
    """The hole gets one triangle, without a new vertex, with UVs of its rim."""
    mesh, repairs = repair(without(box(), 4))
    assert surface(mesh) == surface(box())
    assert (repairs.filled, repairs.watertight, len(mesh.vertices)) == (1, True, 8)
    np.testing.assert_array_equal(mesh.uvs[-1, :2], mesh.vertices[mesh.faces[-1, :2], :2])
    np.testing.assert_array_equal(mesh.uvs[-1, 2], mesh.uvs[-1, :2].mean(axis=0))
    assert repairs.sentences() == ("Filled 1 small hole.",)


def test_missing_triangles_that_touch_are_filled_each():
    """Two holes with one corner in common are two holes."""
    ball = repair(sphere(4))[0]
    corner = int(ball.faces[0, 0])
    at_corner = np.flatnonzero((ball.faces == corner).any(axis=1))
    apart = next(row for row in at_corner[1:] if len(np.intersect1d(ball.faces[row], ball.faces[at_corner[0]])) == 1)
    mesh, repairs = repair(without(ball, at_corner[0], apart))
    assert repairs.filled == 2
    assert surface(mesh) == surface(ball)


def test_a_small_hole_gets_a_fan():
    """All faces around a vertex missing: the hole is closed about its centre."""
    ball = repair(sphere(60, centre=(5, 6, 7)))[0]
    inner = next(row for row in range(len(ball.vertices)) if (ball.faces == row).sum() == 6)
    mesh, repairs = repair(without(ball, *np.flatnonzero((ball.faces == inner).any(axis=1))))
    assert (repairs.filled, repairs.watertight, len(mesh.faces)) == (1, True, len(ball.faces))
    assert volume(mesh) == pytest.approx(volume(ball), rel=1e-4)
    np.testing.assert_allclose(mesh.vertices[-1], ball.vertices[inner], atol=0.01)


def test_an_opening_of_the_shape_stays_open():
    """A box without its lid has lost nothing."""
    mesh, repairs = repair(without(box(), 2, 3))
    assert same(mesh, without(box(), 2, 3))
    assert (repairs.filled, repairs.open_edges, repairs.watertight) == (0, 4, False)
    assert repairs.sentences() == ("The mesh is open along 4 edges: slices are closed there.",)


def test_the_rim_of_a_small_sheet_is_no_hole():
    """A leaf that is small against the model is not closed to a pillow."""
    leaf = mesh_of(sheet().vertices * 0.01 + 2, sheet().faces)
    mesh, repairs = repair(joined(box(), leaf))
    assert repairs.filled == 0
    assert len(mesh.faces) == 12 + len(leaf.faces)


# ---------------------------------------------------------------------- welding


def test_vertices_next_to_each_other_are_welded_wherever_they_lie():
    """Offsets far below the size weld, on whichever side of a cell border they fall."""
    random = np.random.default_rng(1)
    loose = split(repair(sphere(6))[0])
    shaken = mesh_of(loose.vertices + random.uniform(-4e-7, 4e-7, loose.vertices.shape), loose.faces)
    mesh, repairs = repair(shaken)
    assert (repairs.watertight, repairs.bodies) == (True, 1)
    assert len(mesh.vertices) == len(repair(sphere(6))[0].vertices)
    assert repairs.welded == len(loose.vertices) - len(mesh.vertices)


def test_small_features_are_not_welded_away():
    """A body a thousandth of the model in size keeps all its vertices."""
    speck = box((2, 2, 2), (2.002,) * 3)
    mesh, repairs = repair(joined(box(), speck))
    assert (repairs.welded, len(mesh.vertices)) == (0, 16)


# ---------------------------------------------------------------------- invariants


@given(st.integers(0, 2**32 - 1), st.integers(2, 4), st.integers(4, 14), st.integers(4, 40))
def test_repairing_twice_is_repairing_once(seed, cells, n_vertices, n_faces):
    """Whatever tangle comes in, what came out needs nothing more."""
    random = np.random.default_rng(seed)
    vertices = random.integers(0, cells, (n_vertices, 3))
    tangle = mesh_of(vertices, random.integers(0, n_vertices, (n_faces, 3)))
    try:
        mesh, _ = repair(tangle)
    except MeshError:
        return
    again, repairs = repair(mesh)
    assert same(again, mesh)
    assert sum(getattr(repairs, count) for count in DONE) == 0


@given(st.integers(0, 2**32 - 1), st.integers(1, 5))
def test_a_cloud_of_boxes_has_its_bodies_and_volume(seed, n):
    """Boxes apart from each other, each inside out or not: all face outwards in the end."""
    random = np.random.default_rng(seed)
    boxes = [box((3 * i, 0, 0), (3 * i + random.uniform(0.1, 2), *random.uniform(0.1, 2, 2))) for i in range(n)]
    mesh, repairs = repair(joined(*(part if random.random() < 0.5 else reversed_mesh(part) for part in boxes)))
    assert (repairs.bodies, repairs.watertight) == (n, True)
    assert volume(mesh) == pytest.approx(sum(volume(part) for part in boxes))


# ---------------------------------------------------------------------- the rest


def test_scaled_multiplies_coordinates_and_nothing_else():
    """Scaling is about the origin; faces and images are shared."""
    mesh = box((1, 2, 3), (4, 5, 6))
    double = scale_mesh(mesh, 2)
    np.testing.assert_array_equal(double.vertices, 2 * mesh.vertices)
    assert double.faces is mesh.faces
    assert double.images is mesh.images


def test_a_report_of_nothing_says_nothing():
    """No count, no sentence."""
    nothing = Repairs(**dict.fromkeys((entry.name for entry in fields(Repairs)), 0) | {"watertight": True})
    assert nothing.sentences() == ()
    assert asdict(nothing)["watertight"] is True
