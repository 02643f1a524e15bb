"""Bricks go into the scene and come back; nothing else changes."""

from __future__ import annotations

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model import columns
from legorize_addon.core.model.bricks import Role
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.unit_grid import CELL_SIZE
from legorize_addon.core.settings import Settings
from legorize_addon.core.units import BRICK, PLATE, STUD
from legorize_addon.scene.builds import builds, builds_of, layers_of, point_objects, show_sources, sources_of
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.part_meshes import STUD_HEIGHT, set_detail
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.view.visibility import readable
from tests.blender.bricks import assert_same, content, instances, random_table, show, table
from tests.core.any_bricks import SMALL

CATALOGUE = load_catalogue()
ONE = CATALOGUE.part_row("3005")


def add_cube(name: str = "Cube") -> bpy.types.Object:
    """Add an object to legorize."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.name = name
    return bpy.context.object


def tower(n: int) -> list[tuple[int, ...]]:
    """Return the rows of a tower of n small bricks in red."""
    return [(ONE, 0, 0, 3 * layer, 0, 4) for layer in range(n)]


@pytest.mark.parametrize("n", [1, 7, 2000])
def test_table_comes_back(n: int) -> None:
    """What is read from a build is what was shown, row by row and to the type."""
    bricks = random_table(n, seed=n)
    assert_same(read_bricks(show(bricks)), bricks)


def test_table_survives_a_file(tmp_path) -> None:
    """A saved .blend gives the same bricks and what is needed to place them."""
    bricks = random_table(50)
    show(
        bricks, origin=(1.5, -2.25, 0.1), scale=0.3, mm_per_unit=1000.0, settings=Settings(width=17), notes=["Careful."]
    )
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=path)
    [build] = builds(bpy.context.scene)
    assert_same(read_bricks(build), bricks)
    state = build[BUILD_KEY].to_dict()
    assert (state["origin"], state["scale"], state["mm_per_unit"]) == ([1.5, -2.25, 0.1], 0.3, 1000.0)
    assert Settings(**state["settings"]) == Settings(width=17)
    assert state["notes"] == ["Careful."]
    assert len(instances()) == 50


def test_rows_of_the_catalogue_may_change() -> None:
    """Parts are known by their numbers: another order of the catalogue's rows gives the same parts."""
    build = show(table([(ONE, 0, 0, 0, 0, 4)]))
    build[BUILD_KEY]["part_numbers"] = list(build[BUILD_KEY]["part_numbers"])[::-1]
    assert read_bricks(build).part.tolist() == [len(CATALOGUE.parts) - 1 - ONE]


def tops(row: int, turn: int) -> NDArray[np.float64]:
    """Return the points at the top of the studs of a part at 5, 7, 4, (n, 2)."""
    [(mesh, _, matrix)] = instances()
    points = np.array([vertex.co for vertex in mesh.vertices]) @ matrix[:3, :3].T + matrix[:3, 3]
    height = (4 + CATALOGUE.parts[row].height) * PLATE + STUD_HEIGHT
    return points[np.isclose(points[:, 2], height, atol=1e-3), :2]


@pytest.mark.parametrize(
    "row", [row for row in SMALL if not CATALOGUE.parts[row].jumper], ids=lambda row: CATALOGUE.parts[row].number
)
def test_studs_stand_over_the_cells(row: int) -> None:
    """In each turn the studs of the instances stand in the middle of the part's cells, at its height; not on tiles."""
    part = CATALOGUE.parts[row]
    for turn in range(4):
        build = show(table([(row, 5, 7, 4, turn, 4)]))
        top = tops(row, turn)
        cells = np.unique(np.floor(top / STUD).astype(int), axis=0)
        found = columns(part, turn)
        np.testing.assert_array_equal(cells - np.array([5, 7]), found.xy[found.stud])
        for cell in cells:
            inside = top[(np.floor(top / STUD) == cell).all(axis=1)]
            np.testing.assert_allclose(inside.mean(axis=0), (cell + 0.5) * STUD, atol=1e-3)
        clear_build(bpy.context.scene, build)


@pytest.mark.parametrize("number", ["15573", "87580"])
def test_the_stud_of_a_jumper_is_in_its_middle(number: str) -> None:
    """In each turn it stands between the cells."""
    row = CATALOGUE.part_row(number)
    part = CATALOGUE.parts[row]
    for turn in range(4):
        build = show(table([(row, 5, 7, 4, turn, 4)]))
        middle = np.array([5, 7]) + (columns(part, turn).xy.max(axis=0) + 1) / 2
        np.testing.assert_allclose(tops(row, turn).mean(axis=0), middle * STUD, atol=1e-3)
        clear_build(bpy.context.scene, build)


def test_every_brick_has_its_own_part_and_colour() -> None:
    """Each instance has the mesh of its part and the material of its colour, where its brick is."""
    bricks = random_table(300)
    show(bricks)
    found = sorted(
        (mesh["legorize_mesh"].split()[0], int(material.split()[1]), *np.round(matrix[:3, 3], 2).tolist())
        for mesh, material, matrix in instances()
    )
    middle = []
    for part, corner, turn in zip(bricks.part, bricks.corner, bricks.turn, strict=True):
        sides = [CATALOGUE.parts[part].length, CATALOGUE.parts[part].width]
        middle.append((corner + [*(sides[::-1] if turn % 2 else sides), 0] / np.array([2, 2, 1])) * CELL_SIZE)
    expected = sorted(
        (CATALOGUE.parts[part].number, int(code), *np.round(place, 2).tolist())
        for part, code, place in zip(bricks.part, bricks.colour, middle, strict=True)
    )
    assert [row[:2] for row in found] == [row[:2] for row in expected]
    np.testing.assert_allclose([row[2:] for row in found], [row[2:] for row in expected], atol=0.02)


def test_colours_are_linear() -> None:
    """The viewport's and the shader's colour are the catalogue's sRGB value in linear light."""
    show(table([(ONE, 0, 0, 0, 0, 4)]))
    [material] = bpy.data.materials
    srgb = np.array(CATALOGUE.colours[CATALOGUE.colour_row(4)].rgb) / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    np.testing.assert_allclose(material.diffuse_color[:3], linear, atol=1e-4)
    [shader] = [node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
    np.testing.assert_allclose(shader.inputs["Base Color"].default_value[:3], linear, atol=1e-4)


def test_model_lies_over_its_source() -> None:
    """A model point is the world point that it was made of: divided by the scale and by the mm of a unit."""
    origin, scale, mm_per_unit = np.array([-40.0, 16.0, 8.0]), 0.25, 1000.0
    show(table([(ONE, 2, 1, 3, 0, 4)]), origin=origin, scale=scale, mm_per_unit=mm_per_unit)
    [(_, _, matrix)] = instances()
    model = origin + np.array([2.5, 1.5, 3.0]) * CELL_SIZE
    np.testing.assert_allclose(matrix[:3, 3], model / scale / mm_per_unit, rtol=1e-6)
    np.testing.assert_allclose(np.linalg.norm(matrix[:3, :3], axis=0), 1 / scale / mm_per_unit, rtol=1e-6)


def test_layers_and_supports_are_told_apart() -> None:
    """A layer is a collection, named from the lowest, of the model and its supports; empty layers are left out."""
    rows = [(ONE, 0, 0, 0, 0, 4), (ONE, 1, 0, 2, 0, 4, Role.PLATE), (ONE, 1, 0, 0, 0, 4, Role.SUPPORT_OUTSIDE)]
    rows.append((ONE, 0, 0, 9, 0, 4, Role.SUPPORT_OUTSIDE))
    build = show(table(rows))
    assert [layer.name for layer in layers_of(build)] == ["Layer 001", "Layer 004"]
    assert [[points.name for points in layer.objects] for layer in layers_of(build)] == [
        ["Layer 001 bricks", "Layer 001 supports"],
        ["Layer 004 supports"],
    ]


def test_layers_know_only_their_own_parts() -> None:
    """Each layer picks from the kinds of bricks in it, not from those of the whole model."""
    build = show(table([*tower(3), (CATALOGUE.part_row("3001"), 4, 0, 3, 0, 1)]))
    parts = build[BUILD_KEY]["parts"]
    assert len(parts.objects) == 2
    assert [len(own.objects) for own in parts.children] == [1, 2, 1]
    assert sorted(mesh["legorize_mesh"] for mesh, _, _ in instances()) == ["3001 high"] + 3 * ["3005 high"]


def test_summary_is_right() -> None:
    """The figures of the panel: bricks, kinds, the size in studs and layers, the mass."""
    four = CATALOGUE.part_row("3001")
    summary = show(table([(four, 3, 5, 0, 1, 4), (ONE, 3, 5, 3, 0, 1)]))[BUILD_KEY]["summary"].to_dict()
    mass = summary.pop("mass")
    assert summary == {"bricks": 2, "parts": 2, "colours": 2, "studs_x": 2, "studs_y": 4, "layers": 2}
    assert mass == pytest.approx(CATALOGUE.parts[four].mass + CATALOGUE.parts[ONE].mass)


def test_source_is_hidden_not_changed() -> None:
    """The source keeps its data; it is hidden after a build and as before once the build is removed."""
    cube, lamp = add_cube(), add_cube("Lamp")
    lamp.hide_render = True
    before = np.array([vertex.co for vertex in cube.data.vertices])
    build = show(table(tower(2)), cube, lamp)
    assert (cube.hide_viewport, cube.hide_render) == (True, True)
    np.testing.assert_array_equal([vertex.co for vertex in cube.data.vertices], before)
    assert not cube.keys()
    show_sources(build, visible=True)
    assert (cube.hide_viewport, cube.hide_render) == (False, False)
    show_sources(build, visible=False)
    clear_build(bpy.context.scene, build)
    assert [(thing.hide_viewport, thing.hide_render) for thing in (cube, lamp)] == [(False, False), (False, True)]


def test_again_replaces() -> None:
    """A second build of the same source takes the place of the first; one of another source stands beside it."""
    cube, other = add_cube(), add_cube("Other")
    show(table(tower(5)), other, name="Other")
    show(random_table(40), cube)
    once = content()
    build = show(random_table(40), cube)
    assert content() == once
    assert len(builds(bpy.context.scene)) == 2
    assert builds_of(bpy.context.scene, [cube]) == [build]
    assert builds_of(bpy.context.scene, [point_objects(build)[0]]) == [build]
    assert sources_of(build) == [cube]
    assert not add_cube("Third").hide_viewport


def test_source_may_be_deleted() -> None:
    """A build outlives its source."""
    cube = add_cube()
    build = show(table(tower(1)), cube)
    bpy.data.objects.remove(cube)
    assert sources_of(build) == []
    show_sources(build, visible=True)
    clear_build(bpy.context.scene, build)
    assert builds(bpy.context.scene) == []


def test_clearing_leaves_nothing_but_the_users() -> None:
    """Removing a build removes all that it brought, keeps what other builds use and what the user put into it."""
    cube, guest = add_cube(), add_cube("Guest")
    empty = content()
    build = show(random_table(40), cube)
    layer = layers_of(build)[0]
    layer.objects.link(guest)
    bpy.context.scene.collection.objects.unlink(guest)
    clear_build(bpy.context.scene, build)
    assert content() == empty
    assert guest.name in bpy.context.scene.objects
    kept = show(table(tower(2)), cube)
    passing = show(random_table(40), guest)
    clear_build(bpy.context.scene, passing)
    assert len(instances()) == 2
    assert_same(read_bricks(kept), table(tower(2)))


def test_impossible_bricks_change_nothing() -> None:
    """No bricks at all, or a colour that nobody makes, is refused before the scene is touched."""
    cube = add_cube()
    show(table(tower(1)), cube)
    before = content()
    with pytest.raises(BuildError, match="no bricks"):
        show(table(tower(1)).take(np.array([], dtype=int)), cube)
    with pytest.raises(BuildError, match="Colour 9999"):
        show(table([(ONE, 0, 0, 0, 0, 9999)]), cube)
    assert content() == before


def test_emptied_build_is_named() -> None:
    """A build whose layers were all deleted says so."""
    build = show(table(tower(2)))
    for points in point_objects(build):
        bpy.data.objects.remove(points)
    with pytest.raises(BuildError, match="'Legorize thing' has no bricks"):
        read_bricks(build)


def test_moved_point_is_a_moved_brick() -> None:
    """A brick whose point was moved is read where it is now."""
    build = show(table(tower(2)))
    points = point_objects(build)[1].data
    points.vertices[0].co.x += 2 * STUD + 0.01
    assert read_bricks(build).corner.tolist() == [[0, 0, 0], [2, 0, 3]]


def test_detail_changes_the_meshes_only() -> None:
    """Another detail gives the same bricks in other meshes, with the same materials."""
    build = show(random_table(60), detail="low")
    low = {(material, *matrix.ravel()) for _, material, matrix in instances()}
    set_detail(build[BUILD_KEY]["parts"], CATALOGUE, "high")
    assert {mesh["legorize_mesh"].split()[1] for mesh, _, _ in instances()} == {"high"}
    assert {(material, *matrix.ravel()) for _, material, matrix in instances()} == low


def test_hidden_objects_are_readable_for_a_while() -> None:
    """Hidden sources are evaluated inside the context and hidden again after it, whatever happens."""
    cube = add_cube()
    cube.hide_viewport = True
    with readable(bpy.context, [cube]):
        assert not cube.hide_viewport
    assert cube.hide_viewport
    with pytest.raises(ReferenceError), readable(bpy.context, [cube]):
        raise ReferenceError
    assert cube.hide_viewport


def test_tall_bricks_belong_to_their_lowest_layer() -> None:
    """A brick three layers high stands in the layer where it begins; its top reaches into the third."""
    row = CATALOGUE.part_row("14716")
    build = show(table([(row, 0, 0, 3, 0, 4)]))
    assert [layer.name for layer in layers_of(build)] == ["Layer 002"]
    [(mesh, _, matrix)] = instances()
    assert matrix[2, 3] == pytest.approx(BRICK)
    assert max(vertex.co.z for vertex in mesh.vertices) == pytest.approx(3 * BRICK + STUD_HEIGHT, abs=1e-4)
