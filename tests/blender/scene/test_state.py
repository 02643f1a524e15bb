"""The state of a build: ours is known by its form and version; a stranger's data is left alone."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.reading.importers import load
from legorize_addon.scene.builds import builds, damage, is_own
from legorize_addon.scene.collections import clear_build, read_bricks
from legorize_addon.scene.section import Section
from legorize_addon.scene.state import BUILD_KEY, VERSION, is_build, state_of
from legorize_addon.ui.current import current_build
from legorize_addon.view.heat_map import show_heat_map
from legorize_addon.view.steps import n_pieces, n_steps
from legorize_addon.view.visibility import cut_away, section_of, shown_bricks
from tests.blender.bricks import assert_same, content, instances, random_table, show

pytestmark = pytest.mark.usefixtures("registered")


def stranger(value: Any) -> bpy.types.Collection:
    """Return a collection of the user's with a property of the name that ours has."""
    own = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(own)
    own[BUILD_KEY] = value
    return own


STRANGE = [
    1,
    0.5,
    True,
    "yes",
    [1, 2],
    {},
    {"root": 1},
    {"version": 2},
    {"version": "2", "parts": None},
    {"sources": {"0": 3}, "parts": "x", "root": "y"},
]


@pytest.mark.parametrize("value", STRANGE, ids=str)
def test_strangers_property_is_left_alone(cube, value: Any, tmp_path) -> None:
    """Building, removing, pictures, exports and headless runs go on as if it were not there."""
    own = stranger(value)
    own.objects.link(cube)
    kept = own[BUILD_KEY].to_dict() if isinstance(value, dict) else value
    before = content()
    assert builds(bpy.context.scene) == []
    assert current_build(bpy.context.scene) is None
    assert bpy.ops.legorize.build() == {"FINISHED"}
    [build] = builds(bpy.context.scene)
    assert build != own
    assert bpy.ops.legorize.render_still(filepath=str(tmp_path / "x.png"), samples=1, width=32, height=16) == {
        "FINISHED"
    }
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert content() == before
    stays = own[BUILD_KEY].to_dict() if isinstance(value, dict) else own[BUILD_KEY]
    assert np.array_equal(stays, kept)
    path = tmp_path / "strange.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    assert {thing.name for thing in load(path).objects} == {"Cube"}
    assert BUILD_KEY in bpy.data.collections["Mine"]


def test_nothing_goes_because_data_names_it(cube) -> None:
    """Data of our form that names other people's objects and collections takes none of them along."""
    build = show(random_table(5))
    named = {**build[BUILD_KEY].to_dict()}
    clear_build(bpy.context.scene, build)
    other = bpy.data.collections.new("Other")
    bpy.context.scene.collection.children.link(other)
    other.objects.link(cube)
    lamp = bpy.data.objects.new("Lamp", None)
    own = stranger({**named, "root": cube, "plane": lamp, "parts": other, "heat": other})
    own.objects.link(cube)
    own.objects.link(lamp)
    for thing in (cube, lamp):
        thing["legorize_own"] = "mine"
    assert damage(own) or is_build(own)
    clear_build(bpy.context.scene, own)
    assert {cube.name, lamp.name} <= set(bpy.context.scene.objects.keys())
    assert list(other.objects) == [cube]


def test_strangers_marks_on_objects(cube) -> None:
    """A user's object with a property of the name of our mark can be legorized."""
    cube["legorize_own"] = "mine"
    assert not is_own(cube)
    assert bpy.ops.legorize.build() == {"FINISHED"}
    assert instances()


def test_strangers_property_on_the_scene(cube) -> None:
    """So does a scene whose property of the name of our record is something else."""
    bpy.context.scene["legorize_hidden_sources"] = "mine"
    assert not bpy.ops.legorize.show_originals.poll()
    assert bpy.ops.legorize.build() == {"FINISHED"}
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert not cube.hide_viewport


def as_of_0_1_0(build: bpy.types.Collection) -> None:
    """Make the state of a build one that version 0.1.0 wrote, and take away what it did not mark."""
    del build[BUILD_KEY]["version"]
    for mesh in bpy.data.meshes:
        if "legorize_points" in mesh:
            del mesh["legorize_points"]
    del bpy.context.scene["legorize_hidden_sources"]


def test_build_of_0_1_0_works(cube) -> None:
    """It is read, changed, rebuilt and removed like any other."""
    before = content()
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    bricks = read_bricks(build)
    as_of_0_1_0(build)
    assert state_of(build).version == 1
    assert damage(build) is None
    assert_same(read_bricks(build), bricks)
    show_heat_map(build, visible=True)
    show_heat_map(build, visible=False)
    cut_away(build, Section("x", 0.5))
    assert section_of(build) == Section("x", 0.5)
    assert 0 < len(shown_bricks(build)) <= len(bricks)
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    assert state_of(build).version == VERSION
    as_of_0_1_0(build)
    bpy.ops.legorize.clear()
    assert content() == before
    assert not cube.hide_viewport


def test_build_without_later_fields_works() -> None:
    """What the first builds did not know is as in a new one."""
    build = show(random_table(5))
    for name in ("version", "check", "building", "notes", "settings"):
        del build[BUILD_KEY][name]
    assert damage(build) is None
    state = state_of(build)
    assert (state.check, state.building, state.notes, state.settings) == ({}, {}, [], {})
    assert (n_steps(build), n_pieces(build)) == (0, 1)


def test_newer_build_is_refused_and_can_be_removed(cube) -> None:
    """A build of a newer version is left as it is, with one sentence, and can be removed."""
    before = content()
    bpy.ops.legorize.build()
    build = current_build(bpy.context.scene)
    build[BUILD_KEY]["version"] = VERSION + 1
    with pytest.raises(
        BuildError, match="built by a newer version of Legorize: update the extension, or remove the model"
    ):
        cut_away(build, Section("x", 0.5))
    with pytest.raises(RuntimeError, match="newer version"):
        bpy.ops.legorize.export_ldr(filepath="x.ldr")
    assert bpy.ops.legorize.clear() == {"FINISHED"}
    assert content() == before


def test_state_is_read_as_it_was_written() -> None:
    """Each field comes back in its own type."""
    build = show(random_table(30), origin=(1.5, -2.0, 0.25), scale=0.5, mm_per_unit=1000.0, notes=["Careful."])
    state = state_of(build)
    assert state.version == VERSION
    assert state.origin == (1.5, -2.0, 0.25)
    assert state.unit_per_mm == 1 / 500
    assert state.notes == ["Careful."]
    assert (state.root.type, state.plane.type) == ("MESH", "EMPTY")
    assert isinstance(state.parts, bpy.types.Collection)
    assert state.heat_parts is None
    assert len(state.extent) == 2
    assert all(low < high for low, high in zip(*state.extent, strict=True))
    state.section = Section("y", 0.25, flip=True)
    state.exploded, state.steps_done, state.top_layer, state.supports_shown = 0.5, 3, 2, True
    again = state_of(build)
    assert again.section == Section("y", 0.25, flip=True)
    assert (again.exploded, again.steps_done, again.top_layer, again.supports_shown) == (0.5, 3, 2, True)
