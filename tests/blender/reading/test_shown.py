"""One rule says what is taken: what Blender shows, in the viewport for the button, in renders for the script."""

from __future__ import annotations

from collections.abc import Callable

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import MeshError
from legorize_addon.reading import shown
from legorize_addon.reading.importers import rendered
from legorize_addon.reading.objects import read_objects, read_rendered
from legorize_addon.reading.shown import when_rendered
from tests.blender.builders import add_object

HIDE = {"viewport": "hide_viewport", "renders": "hide_render"}


def cube(x: float, collection: bpy.types.Collection | None = None) -> bpy.types.Object:
    """Add a cube of a unit at a place along x, to the scene or to a collection only."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=(x, 0, 0))
    obj = bpy.context.object
    if collection is not None:
        collection.objects.link(obj)
        bpy.context.scene.collection.objects.unlink(obj)
    return obj


def in_viewport(objects: list[bpy.types.Object]) -> np.ndarray:
    """Return the vertices that the button takes, in Blender units."""
    bpy.context.view_layer.update()
    return read_objects(objects, bpy.context.evaluated_depsgraph_get())[0].vertices / 1000


def in_renders(objects: list[bpy.types.Object]) -> np.ndarray:
    """Return the vertices that the script takes, in Blender units."""
    return read_rendered(objects, bpy.context)[0].vertices / 1000


READERS = {"viewport": in_viewport, "renders": in_renders}


def centres(read: Callable[[list[bpy.types.Object]], np.ndarray], *objects: bpy.types.Object) -> list[float]:
    """Return where along x the cubes are that are taken."""
    return sorted({10 * round(x / 10) for x in read(list(objects))[:, 0].tolist()})


def instance_of(collection: bpy.types.Collection) -> bpy.types.Object:
    """Add an empty that shows a collection."""
    empty = add_object(None, "empty")
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    return empty


@pytest.mark.parametrize("mode", READERS)
@pytest.mark.parametrize("hidden", HIDE)
@pytest.mark.parametrize("what", ["object", "collection"])
def test_hidden_in_one_is_hidden_in_one(mode: str, hidden: str, what: str) -> None:
    """What is hidden in renders is taken by the button, and the other way about; also inside instanced collections."""
    collection = bpy.data.collections.new("parts")
    bpy.context.scene.collection.children.link(collection)
    kept, helper = cube(0, collection), cube(10)
    other = bpy.data.collections.new("helpers")
    collection.children.link(other)
    other.objects.link(helper)
    bpy.context.scene.collection.objects.unlink(helper)
    setattr(helper if what == "object" else other, HIDE[hidden], True)
    expected = [0] if mode == hidden else [0, 10]
    assert centres(READERS[mode], kept, helper) == expected
    bpy.context.scene.collection.children.unlink(collection)
    assert centres(READERS[mode], instance_of(collection)) == expected


@pytest.mark.parametrize("mode", READERS)
def test_instances_in_instances(mode: str) -> None:
    """A helper two collections down counts by the same rule."""
    inner, outer = bpy.data.collections.new("inner"), bpy.data.collections.new("outer")
    cube(0, inner)
    cube(10, inner).hide_render = True
    nested = instance_of(inner)
    outer.objects.link(nested)
    bpy.context.scene.collection.objects.unlink(nested)
    assert centres(READERS[mode], instance_of(outer)) == ([0] if mode == "renders" else [0, 10])


@pytest.mark.parametrize("mode", READERS)
@pytest.mark.parametrize("shown_in", READERS)
def test_modifiers_count_where_they_are_shown(mode: str, shown_in: str) -> None:
    """A modifier that only one of the two shows is there in that one only, also inside an instanced collection."""
    collection = bpy.data.collections.new("parts")
    for obj in (cube(0), cube(0, collection)):
        modifier = obj.modifiers.new("array", "ARRAY")
        modifier.count, modifier.relative_offset_displace = 2, (10, 0, 0)
        modifier.show_viewport, modifier.show_render = shown_in == "viewport", shown_in == "renders"
        taken = obj if obj.users_scene else instance_of(collection)
        assert centres(READERS[mode], taken) == ([0, 10] if mode == shown_in else [0])


@pytest.mark.parametrize(("mode", "vertices"), [("viewport", 26), ("renders", 386)])
def test_levels_of_subdivision(mode: str, vertices: int) -> None:
    """The viewport has one level here, renders have three."""
    obj = cube(0)
    modifier = obj.modifiers.new("divide", "SUBSURF")
    modifier.levels, modifier.render_levels = 1, 3
    assert len(READERS[mode]([obj])) == vertices


def test_resolution_of_curves_in_renders() -> None:
    """A curve is as fine as renders draw it."""
    bpy.ops.curve.primitive_bezier_circle_add()
    obj = bpy.context.object
    obj.data.bevel_depth = 0.1
    obj.data.resolution_u, obj.data.render_resolution_u = 2, 8
    assert len(in_renders([obj])) == 4 * len(in_viewport([obj]))


@pytest.mark.parametrize("property_name", ["visible_camera", "is_holdout", "is_shadow_catcher"])
@pytest.mark.parametrize("place", ["object", "in an instance", "instancer"])
def test_what_pictures_do_not_show(property_name: str, place: str) -> None:
    """Objects without a picture of their own are not taken of renders; the viewport shows them."""
    collection = bpy.data.collections.new("parts")
    helper = cube(10) if place == "object" else cube(10, collection)
    taken = helper if place == "object" else instance_of(collection)
    setattr(taken if place == "instancer" else helper, property_name, property_name != "visible_camera")
    assert centres(in_renders, cube(0), taken) == [0]
    assert centres(in_viewport, cube(0), taken) == [0, 10]


@pytest.mark.parametrize("property_name", ["holdout", "indirect_only", "exclude"])
def test_layers_of_helpers(property_name: str) -> None:
    """Collections that are holdouts, indirect only or excluded in the view layer are not taken of renders."""
    collection = bpy.data.collections.new("helpers")
    bpy.context.scene.collection.children.link(collection)
    objects = [cube(0), cube(10, collection)]
    setattr(bpy.context.view_layer.layer_collection.children["helpers"], property_name, True)
    assert centres(in_renders, *objects) == [0]


def test_eyes_of_the_outliner_do_not_hide_in_renders() -> None:
    """An eye closed in the outliner counts in the viewport alone."""
    objects = [cube(0), cube(10)]
    objects[1].hide_set(True)
    assert centres(in_renders, *objects) == [0, 10]
    assert centres(in_viewport, *objects) == [0]


def test_animated_hiding_counts() -> None:
    """What is hidden at the current frame by animation is not taken, however it is hidden at others."""
    objects = [cube(0), cube(10)]
    for frame in (1, 2):
        objects[1].hide_render = objects[1].hide_viewport = frame == 2
        objects[1].keyframe_insert("hide_render", frame=frame)
        objects[1].keyframe_insert("hide_viewport", frame=frame)
    for frame, expected in ((1, [0, 10]), (2, [0])):
        bpy.context.scene.frame_set(frame)
        assert centres(in_renders, *objects) == expected
        assert centres(in_viewport, *objects) == expected


@pytest.mark.parametrize("mode", READERS)
def test_the_current_frame_counts(mode: str) -> None:
    """Poses of objects, bones and shape keys are those that are seen at the current frame."""
    obj = cube(0)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="away")
    for point in key.data:
        point.co.x += 10
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    obj.vertex_groups.new(name="Bone").add(range(8), 1.0, "REPLACE")
    obj.modifiers.new("rig", "ARMATURE").object = rig
    for frame in (1, 2):
        for thing, path, value in (
            (obj, "location", (100 * (frame - 1), 0, 0)), (key, "value", frame - 1),
            (rig.pose.bones[0], "location", (1000 * (frame - 1), 0, 0)),
        ):  # fmt: skip
            setattr(thing, path, value)
            thing.keyframe_insert(path, frame=frame)
    for frame, place in ((1, 0), (2, 1110)):
        bpy.context.scene.frame_set(frame)
        assert centres(READERS[mode], obj) == [place]


def test_objects_of_a_scene_that_renders_may_show() -> None:
    """Listed are the objects of collections that renders show, each once; lights are not among them."""
    twice, hidden = bpy.data.collections.new("twice"), bpy.data.collections.new("hidden")
    for collection in (twice, hidden):
        bpy.context.scene.collection.children.link(collection)
    first = cube(0)
    twice.objects.link(first)
    cube(10, hidden)
    hidden.hide_render = True
    bpy.ops.object.light_add()
    assert list(rendered(bpy.context.view_layer.layer_collection)) == [first]


def test_reading_what_renders_show_leaves_the_scene() -> None:
    """Settings, data and camera of the scene are as before, also after a failure."""
    scene, obj = bpy.context.scene, cube(0)
    scene.render.resolution_x, scene.render.use_multiview = 123, True

    def state() -> tuple[object, ...]:
        blocks = [list(getattr(bpy.data, name).keys()) for name in ("objects", "cameras", "images", "scenes", "meshes")]
        render = {name: str(getattr(scene.render, name)) for name, _ in scene.render.bl_rna.properties.items()}
        return blocks, scene.camera, render, obj.hide_viewport

    before = state()
    in_renders([obj])
    assert state() == before
    obj.scale = (0, 0, 0)
    with pytest.raises(MeshError, match="scale of zero"):
        in_renders([obj])
    assert state() == before


def other_layers(scene: bpy.types.Scene) -> None:
    """Have a second view layer, which renders show too."""
    scene.view_layers.new("second")


def single_layer(scene: bpy.types.Scene) -> None:
    """Render only one of two layers."""
    scene.view_layers.new("second")
    scene.render.use_single_layer = True


def layer_not_in_use(scene: bpy.types.Scene) -> None:
    """Leave the layer out of renders of the whole scene."""
    scene.view_layers[0].use = False


def tiny_pictures(scene: bpy.types.Scene) -> None:
    """Render thumbnails."""
    scene.render.resolution_percentage = 1


def everything_on(scene: bpy.types.Scene) -> None:
    """Switch on what renders can do beside drawing."""
    for name in ("motion_blur", "freestyle", "border", "crop_to_border", "simplify", "multiview"):
        setattr(scene.render, f"use_{name}", True)


@pytest.mark.parametrize("change", [other_layers, single_layer, layer_not_in_use, tiny_pictures, everything_on])
def test_any_settings_of_renders(change: Callable[[bpy.types.Scene], None]) -> None:
    """Whatever a scene's renders are set to, its shown objects are read, once."""
    objects = [cube(0), cube(10)]
    change(bpy.context.scene)
    used = bpy.context.view_layer.use
    assert len(in_renders(objects)) == 16
    assert bpy.context.view_layer.use == used


def test_no_drawing_on_the_graphics_card() -> None:
    """Strokes of grease pencil, which a render would draw, are not in the one that reads, and in renders afterwards."""
    bpy.ops.object.grease_pencil_add(type="STROKE")
    pencil = bpy.context.object
    assert pencil.type not in when_rendered(bpy.context, lambda graph: [obj.type for obj in graph.objects])
    assert not pencil.hide_render


def test_a_refusal_to_render_is_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    """Should Blender refuse to render, the reason is told."""
    monkeypatch.setattr(shown, "_QUICK", {**shown._QUICK, "resolution_percentage": 1})
    with pytest.raises(MeshError, match=r"^Blender refuses to render the scene \(.*\): correct its render settings\.$"):
        in_renders([cube(0)])


def test_a_bug_while_reading_is_raised() -> None:
    """An error that is nobody's input does not get lost in Blender's renderer."""

    def fail(depsgraph: bpy.types.Depsgraph) -> None:
        raise ZeroDivisionError("a bug")

    with pytest.raises(ZeroDivisionError, match="a bug"):
        when_rendered(bpy.context, fail)
