"""The heat map shows what each brick has left, and leaves everything as it was; the panel says what was proven."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.model.verdict import UNSUPPORTED, Verdict
from legorize_addon.core.statics.stability import Stability, stability
from legorize_addon.render.still import render_still
from legorize_addon.scene.brick_points import NO_MARGIN, positions
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.part_meshes import set_detail
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.scene.verdict import UNCHECKED, check_lines
from legorize_addon.ui.current import current_build
from legorize_addon.view.heat_map import (
    FAILING,
    HANGING,
    NOT_CHECKED,
    RAMP,
    STEPS,
    has_margins,
    heat_colours,
    heat_map_shown,
    heat_of,
    show_heat_map,
)
from legorize_addon.view.visibility import cut_away
from tests.blender.bricks import assert_same, content, instances, random_table, show, table

CATALOGUE = load_catalogue()
ONE, BEAM = CATALOGUE.part_row("3005"), CATALOGUE.part_row("3008")
TOWER = table([(ONE, 0, 0, 3 * layer, 0, 4) for layer in range(4)])
LOOSE = table([(ONE, 0, 0, 0, 0, 4), (ONE, 0, 0, 3, 0, 4), (ONE, 5, 0, 9, 0, 4)])


def proof(bricks: Bricks, margin: NDArray[np.float64] | None = None) -> Stability:
    """Return what is proven of bricks, with other margins if some are given."""
    found = stability(Assembly(bricks, CATALOGUE))
    return found if margin is None else replace(found, margin=margin)


def show_random(n: int = 200, **changes) -> tuple[bpy.types.Collection, Bricks, Stability]:
    """Show bricks of all kinds with margins of all kinds."""
    bricks = random_table(n)
    margin = np.random.default_rng(1).choice([UNSUPPORTED, -0.4, 0.0, 0.3, 0.5, 0.99, 1.0], n)
    # bricks anywhere have no proof: that of a tower goes with them, of which the margins alone are looked at
    found = replace(proof(TOWER, margin), unsupported=np.flatnonzero(margin == UNSUPPORTED))
    return show(bricks, stability=found, **changes), bricks, found


def state(build: bpy.types.Collection) -> tuple[dict[str, Any], list[dict[str, list[float]]]]:
    """Return all that a build keeps: its custom properties and the attributes of its points."""
    attributes = []
    for points in point_objects(build):
        found = {}
        for attribute in points.data.attributes:
            vector = attribute.data_type == "FLOAT_VECTOR"
            values = np.empty(len(points.data.vertices) * (3 if vector else 1), dtype=np.float32)
            attribute.data.foreach_get("vector" if vector else "value", values)
            found[attribute.name] = values.tolist()
        attributes.append(found)
    return build[BUILD_KEY].to_dict(), attributes


def seen() -> list[tuple[str, str, tuple[float, ...]]]:
    """Return part, material and place of all that the viewport shows, in order."""
    return sorted((mesh.name, name, tuple(np.round(matrix, 3).ravel().tolist())) for mesh, name, matrix in instances())


def test_colours_go_by_the_margin() -> None:
    """Hanging, failing, nothing, half and all have the colours that the legend names; more left is never redder."""
    colours = heat_colours()
    assert len(colours) == STEPS + 3
    found = colours[heat_of(np.array([UNSUPPORTED, -1e-9, -7.0, 0.0, 1.0, NO_MARGIN]))]
    np.testing.assert_array_equal(found, [HANGING, FAILING, FAILING, RAMP[0], RAMP[-1], NOT_CHECKED])
    half = colours[heat_of(np.array([0.499, 0.501]))].astype(int)
    assert np.abs(half - RAMP[1]).max() < 50
    steps = heat_of(np.linspace(0, 1, 1000))
    assert (np.diff(steps) >= 0).all()
    assert set(steps) == set(range(2, STEPS + 2))
    ramp = colours[2:-1].astype(int)
    assert (np.diff(ramp[:, 0] - ramp[:, 1]) < 0).all()


def test_each_brick_has_the_colour_of_its_margin() -> None:
    """With the map on, each instance has its own part, its own place, and the material of its margin."""
    build, bricks, found = show_random()
    own = seen()
    show_heat_map(build, visible=True)
    assert heat_map_shown(build)
    assert [(mesh, place) for mesh, _, place in sorted(seen(), key=lambda row: (row[0], row[2]))] == [
        (mesh, place) for mesh, _, place in sorted(own, key=lambda row: (row[0], row[2]))
    ]
    expected = sorted(
        (f"Heat {heat}", CATALOGUE.parts[part].number, *np.round(place, 1).tolist())
        for heat, part, place in zip(heat_of(found.margin), bricks.part, positions(bricks, CATALOGUE), strict=True)
    )
    shown = sorted(
        (name, mesh.name.split()[1], *np.round(matrix[:3, 3].astype(np.float64), 1).tolist())
        for mesh, name, matrix in instances()
    )
    assert [row[:2] for row in shown] == [row[:2] for row in expected]
    np.testing.assert_allclose([row[2:] for row in shown], [row[2:] for row in expected], atol=0.11)


def test_solid_view_has_the_colours_too() -> None:
    """The colour of the viewport's solid mode is that of the shader."""
    build, _, _ = show_random()
    show_heat_map(build, visible=True)
    materials = [material for material in bpy.data.materials if "legorize_heat" in material]
    assert len(materials) > 4
    for material in materials:
        [shader] = [node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED"]
        np.testing.assert_allclose(shader.inputs["Base Color"].default_value, material.diffuse_color)


def test_off_is_as_before() -> None:
    """The map comes and goes: data, attributes, custom properties and what is seen are as before it."""
    build, bricks, _ = show_random()
    before = content(), state(build), seen()
    for _ in range(2):
        for _ in range(2):
            show_heat_map(build, visible=True)
            assert_same(read_bricks(build), bricks)
            assert "Brick" not in {name.split()[0] for _, name, _ in seen()}
        for _ in range(2):
            show_heat_map(build, visible=False)
            assert (content(), state(build), seen()) == before


def test_two_maps_do_not_meddle() -> None:
    """Of two builds each has its own switch, and one map's end leaves the other's colours."""
    first, _, _ = show_random(name="a")
    only = content()
    second, _, _ = show_random(name="b")
    for build in (first, second):
        show_heat_map(build, visible=True)
    both = {name for _, name, _ in seen()}
    show_heat_map(second, visible=False)
    assert heat_map_shown(first)
    assert both < {name for _, name, _ in seen()}
    clear_build(bpy.context.scene, second)
    assert {name for _, name, _ in seen()} == both
    show_heat_map(first, visible=False)
    assert content() == only


def test_clearing_takes_the_map_along() -> None:
    """Removing a build whose map is on leaves nothing."""
    before = content()
    build, _, _ = show_random()
    show_heat_map(build, visible=True)
    clear_build(bpy.context.scene, build)
    assert content() == before


def test_detail_and_section_go_on() -> None:
    """With the map on, the detail is changed and a cut made as without it; both outlast it."""
    build, bricks, _ = show_random(detail="low")
    show_heat_map(build, visible=True)
    assert {mesh["legorize_mesh"].split()[1] for mesh, _, _ in instances()} == {"low"}
    set_detail(build[BUILD_KEY]["parts"], CATALOGUE, "high")
    cut_away(build, Section("x", 0.5))
    assert 0 < len(instances()) < len(bricks)
    cut = [(mesh, place) for mesh, _, place in seen()]
    assert {mesh.split()[2] for mesh, _ in cut} == {"high"}
    show_heat_map(build, visible=False)
    assert sorted((mesh, place) for mesh, _, place in seen()) == sorted(cut)


def test_map_survives_a_file(tmp_path: Path) -> None:
    """A saved .blend opens with the map on, and it can be switched off there."""
    build, bricks, _ = show_random()
    before, own, name = content(), seen(), build.name
    show_heat_map(build, visible=True)
    mapped = seen()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    build = bpy.data.collections[name]
    assert heat_map_shown(build)
    assert seen() == mapped
    show_heat_map(build, visible=False)
    assert (content(), seen()) == (before, own)
    assert_same(read_bricks(build), bricks)


def test_emptied_layer_has_a_map() -> None:
    """A layer all of whose bricks a user deleted does not stand in the way of the others."""
    build = show(TOWER, stability=proof(TOWER))
    point_objects(build)[1].data.clear_geometry()
    for name, kind in (("part", "INT"), ("margin", "FLOAT")):
        point_objects(build)[1].data.attributes.new(name, kind, "POINT")
    show_heat_map(build, visible=True)
    assert len(instances()) == len(TOWER) - 1
    show_heat_map(build, visible=False)


def test_unchecked_builds_have_no_map() -> None:
    """A build without margins, as of an earlier version, has no map and says what to do; nothing changes."""
    build = show(TOWER)
    del build[BUILD_KEY]["check"]
    before = content()
    assert not has_margins(build)
    for visible in (True, False):
        with pytest.raises(BuildError, match="legorize the object again"):
            show_heat_map(build, visible=visible)
    assert content() == before
    for check in (build[BUILD_KEY].get("check"), {}):
        assert [text for text, _ in check_lines(check)] == [UNCHECKED]


def test_picture_has_the_colours(tmp_path: Path) -> None:
    """A render with the map on shows the brick that hangs in magenta and none in the brick's own red."""
    build = show(LOOSE, stability=proof(LOOSE))
    show_heat_map(build, visible=True)
    path = tmp_path / "heat.png"
    render_still(bpy.context.scene, path, samples=4, resolution=(80, 60))
    with Image.open(path) as image:
        red, green, blue = np.moveaxis(np.asarray(image.convert("RGB")) / 255, -1, 0)
    assert ((red > 1.5 * green) & (blue > 1.5 * green)).mean() > 0.01
    assert ((green > 1.3 * red) & (green > 1.3 * blue)).mean() > 0.01
    assert ((red > 1.5 * green) & (red > 1.5 * blue)).mean() < 0.003
    assert heat_map_shown(build)


def lines(bricks: Bricks, found: Stability) -> list[str]:
    """Return what the panel says."""
    return [text for text, _ in check_lines(show(bricks, stability=found)[BUILD_KEY]["check"])]


def test_panel_says_what_is_proven() -> None:
    """A tower stands; a long arm tips over; a brick in the air is counted; what is open is called so."""
    standing = lines(TOWER, proof(TOWER, np.array([1.0, 0.38, 0.9, 0.7])))
    assert standing == [
        "Stands by its studs alone: proven, no brick needs more than 62 % of its friction",
        "Weakest: Red Brick 1 x 1 in layer 2, at least 38 % of its friction left",
    ]
    arm = table([(ONE, 0, 0, 0, 0, 4), (BEAM, 0, 0, 3, 0, 4)])
    assert lines(arm, proof(arm))[0] == "Collapses: proven, it tips over"
    verdict, hanging, weakest = lines(LOOSE, proof(LOOSE))
    assert verdict.startswith("Collapses: bricks hang in the air; the others stand: proven")
    assert hanging == "Bricks that hang in the air: 1"
    assert weakest.startswith("Weakest: Red Brick 1 x 1 in layer 1")
    undecided = replace(proof(TOWER), standing=Verdict.UNDECIDED)
    assert lines(TOWER, undecided)[0].startswith("Not decided")


def test_failing_contacts_are_named() -> None:
    """A model that tears apart names the brick that goes first, and how much is missing at the weakest."""
    found = replace(proof(TOWER, np.array([-0.3, 1, 1, 1])), standing=Verdict.COLLAPSES, torn=np.array([[0, 1]]))
    assert lines(TOWER, found) == [
        "Collapses: proven, first at the Red Brick 1 x 1 in layer 2",
        "Weakest: Red Brick 1 x 1 in layer 1, short of 30 % of its friction",
    ]


def test_switch_works_on_the_panels_build(addon: None) -> None:
    """A click builds a checked model, the switch turns its map on and off; where there is none it does nothing."""
    view = bpy.context.scene.legorize
    view.heat_map = True
    assert not view.heat_map
    bpy.ops.mesh.primitive_cube_add(size=1)
    view.settings.width = 6
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    assert build[BUILD_KEY]["check"]["verdict"] == "stable"
    before = content()
    view.heat_map = True
    assert view.heat_map
    assert {name.split()[0] for _, name, _ in seen()} == {"Heat"}
    view.heat_map = False
    assert content() == before
    view.build = show(TOWER, name="old")
    view.heat_map = True
    assert not view.heat_map


def test_undo_takes_the_map_back(addon: None) -> None:
    """A step back and forth gives the colours of before and after."""
    bpy.ops.mesh.primitive_cube_add(size=1)
    view = bpy.context.scene.legorize
    view.settings.width = 6
    bpy.ops.legorize.build()
    bpy.ops.ed.undo_push(message="built")
    before = content(), seen()
    view.heat_map = True
    bpy.ops.ed.undo_push(message="heat map")
    after = content(), seen()
    bpy.ops.ed.undo()
    assert (content(), seen()) == before
    assert not bpy.context.scene.legorize.heat_map
    bpy.ops.ed.redo()
    assert (content(), seen()) == after
    assert bpy.context.scene.legorize.heat_map
