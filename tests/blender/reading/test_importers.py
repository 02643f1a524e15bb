"""Files as they are read: at rest or in the pose of a frame, all objects or some, and what cannot be read."""

from __future__ import annotations

import json
import struct
import tempfile
from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import MeshError, SettingsError
from legorize_addon.reading.at_rest import fbx_is_animated, without_animation
from legorize_addon.reading.importers import load
from legorize_addon.reading.objects import read_rendered
from tests.blender.builders import add_object
from tests.core.files.sources.test_lost_places import write as write_box
from tests.core.files.sources.written import TRIANGLES

IMPORTED = [".glb", ".gltf", ".fbx"]
REMARK = "was left out: --frame takes the pose of a frame."


def box(name: str, z: float = 0.0) -> bpy.types.Object:
    """Add a box of 4 x 2 x 1 units that stands at a height."""
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, z))
    obj = bpy.context.object
    obj.name = name
    obj.data.vertices.foreach_set(
        "co", (np.array([vertex.co for vertex in obj.data.vertices]) * (4, 2, 1)).astype(np.float32).ravel()
    )
    return obj


def save(path: Path) -> Path:
    """Write the scene, with its animation."""
    target = str(path)
    {
        ".blend": lambda: bpy.ops.wm.save_as_mainfile(filepath=target, copy=True),
        ".glb": lambda: bpy.ops.export_scene.gltf(filepath=target, export_format="GLB"),
        ".gltf": lambda: bpy.ops.export_scene.gltf(filepath=target, export_format="GLTF_SEPARATE"),
        ".fbx": lambda: bpy.ops.export_scene.fbx(filepath=target),
    }[path.suffix]()
    return path


def heights(source: Path, **options: object) -> tuple[list[float], tuple[str, ...]]:
    """Return the lowest and highest z that is read of a file, in units, and the remarks."""
    objects, remarks, _ = load(source, **options)
    mesh, more = read_rendered(objects, bpy.context)
    z = mesh.vertices[:, 2] / 1000
    return [round(float(z.min()), 3), round(float(z.max()), 3)], (*remarks, *more)


def animate(lid: bpy.types.Object, low: float, high: float) -> None:
    """Let an object rise from frame 1 to frame 25."""
    for frame, z in ((1, low), (25, high)):
        lid.location.z = z
        lid.keyframe_insert("location", frame=frame)


def gltf_scene(path: Path) -> tuple[dict, bytes]:
    """Return the scene of a .glb file and what follows it."""
    content = path.read_bytes()
    length = struct.unpack_from("<I", content, 12)[0]
    return json.loads(content[20 : 20 + length]), content[20 + length :]


def write_glb(path: Path, scene: dict, rest: bytes) -> Path:
    """Write a .glb file."""
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    head = struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest)) + struct.pack("<I4s", len(text), b"JSON")
    path.write_bytes(head + text + rest)
    return path


def opening_lid(path: Path) -> Path:
    """Write a box with a lid on it whose node rests on the box and whose animation begins 10 units above."""
    box("base")
    animate(box("lid", 1), 10, 12)
    scene, rest = gltf_scene(save(path.with_suffix(".glb")))
    for node in scene["nodes"]:
        if node["name"] == "lid":
            node["translation"] = [0, 1, 0]
    if path.suffix == ".glb":
        return write_glb(path, scene, rest)
    # the same, in two files of which the second one has a name to be quoted
    (path.parent / "all data.bin").write_bytes(rest[8:])
    scene["buffers"][0]["uri"] = "all%20data.bin"
    path.write_text(json.dumps(scene))
    return path


@pytest.mark.parametrize("kind", [".glb", ".gltf"])
def test_nodes_are_at_rest(kind: str, tmp_path: Path) -> None:
    """An animated node is where its own transform puts it, not at its first key; one remark says so."""
    found, remarks = heights(opening_lid(tmp_path / f"lid{kind}"))
    assert found == [-0.5, 1.5]
    assert remarks == (f"The animation in lid{kind} {REMARK}",)
    assert not bpy.data.actions


@pytest.mark.parametrize("kind", [".glb", ".gltf"])
@pytest.mark.parametrize(("frame", "top"), [(1, 10.5), (25, 12.5)])
def test_pose_of_a_frame(kind: str, frame: int, top: float, tmp_path: Path) -> None:
    """A frame that is asked for is taken, without a remark."""
    assert heights(opening_lid(tmp_path / f"lid{kind}"), frame=frame) == ([-0.5, top], ())


def test_fbx_is_at_rest(tmp_path: Path) -> None:
    """FBX: the node's own place, which its writer takes from the frame of writing; with a frame, the animation."""
    box("base")
    animate(box("lid"), 10, 12)
    bpy.context.scene.frame_set(1)
    source = save(tmp_path / "lid.fbx")
    found, remarks = heights(source)
    assert found == [-0.5, 10.5]
    assert remarks == (f"The animation in lid.fbx {REMARK}",)
    assert not bpy.data.actions
    assert heights(source, frame=25) == ([-0.5, 12.5], ())


@pytest.mark.parametrize("kind", IMPORTED)
def test_no_animation_no_remark(kind: str, tmp_path: Path) -> None:
    """Files without animation are read without a remark, at every frame alike."""
    box("base")
    source = save(tmp_path / f"still{kind}")
    assert heights(source) == heights(source, frame=7) == ([-0.5, 0.5], ())


@pytest.mark.parametrize("animated", [True, False])
def test_shape_keys_are_at_rest(animated: bool, tmp_path: Path) -> None:
    """A shape key has the weight that the mesh gives it, which is no animation, whatever an animation begins with."""
    obj = box("base")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="taller")
    for point in key.data:
        point.co.z += 2 * (point.co.z > 0)
    key.value = 0.5
    if animated:
        for frame, value in ((1, 1.0), (25, 0.0)):
            key.value = value
            key.keyframe_insert("value", frame=frame)
    scene, rest = gltf_scene(save(tmp_path / "keys.glb"))
    scene["meshes"][0]["weights"] = [0.5]
    source = write_glb(tmp_path / "keys.glb", scene, rest)
    found, remarks = heights(source)
    assert found == pytest.approx([-0.5, 1.5], abs=0.01)
    assert len(remarks) == animated
    if animated:
        assert heights(source, frame=1)[0] == [-0.5, 2.5]


@pytest.mark.parametrize("kind", IMPORTED)
def test_bones_are_at_rest(kind: str, tmp_path: Path) -> None:
    """A skinned box is as it was modelled; with a frame it takes the pose of the bone."""
    obj = box("base")
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    obj.vertex_groups.new(name="Bone").add(range(8), 1.0, "REPLACE")
    obj.parent, obj.modifiers.new("rig", "ARMATURE").object = rig, rig
    for frame, scale in ((1, 3), (10, 2)):
        rig.pose.bones[0].scale = (1, scale, 1)
        rig.pose.bones[0].keyframe_insert("scale", frame=frame)
    source = save(tmp_path / f"rig{kind}")
    found, remarks = heights(source)
    assert found == pytest.approx([-0.5, 0.5], abs=1e-3)
    assert remarks == (f"The animation in rig{kind} {REMARK}",)
    assert heights(source, frame=10)[0] == pytest.approx([-1, 1], abs=1e-3)


def test_blend_is_as_its_author_left_it(tmp_path: Path) -> None:
    """A .blend is taken at the frame at which it was saved, as its render would be, without a remark."""
    animate(box("lid"), 10, 12)
    bpy.context.scene.frame_set(25)
    source = save(tmp_path / "scene.blend")
    assert heights(source) == ([11.5, 12.5], ())
    assert heights(source, frame=1) == ([9.5, 10.5], ())


def test_blend_with_tracks_drivers_and_constraints(tmp_path: Path) -> None:
    """Strips, drivers and constraints are in force at the frame at which a .blend was saved."""
    lid, driven, held = box("lid"), box("driven"), box("held")
    animate(lid, 10, 12)
    action = lid.animation_data.action
    lid.animation_data.action = None
    lid.animation_data.nla_tracks.new().strips.new("rise", 11, action)
    driver = driven.driver_add("location", 2).driver
    driver.type = "SUM"
    variable = driver.variables.new()
    variable.type = "TRANSFORMS"
    variable.targets[0].id, variable.targets[0].transform_type = lid, "LOC_Z"
    held.constraints.new("COPY_LOCATION").target = lid
    bpy.context.scene.frame_set(35)
    assert heights(save(tmp_path / "scene.blend")) == ([11.5, 12.5], ())


def stool() -> bpy.types.Object:
    """Add a stool 2 units high: a round seat of 1.4 units on three legs that stand closer, in one object."""
    legs = [((0.5 * np.cos(i), 0.5 * np.sin(i), 0.9), (0.1, 0.1, 0.9)) for i in (0, 2, 4)]
    for place, size in [((0, 0, 1.9), (0.7, 0.7, 0.1)), *legs]:
        bpy.ops.mesh.primitive_cylinder_add(location=place, scale=size)
    bpy.ops.object.select_all(action="SELECT")
    bpy.ops.object.join()
    bpy.ops.object.transform_apply()
    return bpy.context.object


def stands(source: Path, **options: object) -> bool:
    """Return whether the stool in a file is read on its legs."""
    objects, _, _ = load(source, **options)
    vertices = read_rendered(objects, bpy.context)[0].vertices / 1000
    high = vertices[vertices[:, 2] > vertices[:, 2].max() - 0.1]
    return np.ptp(vertices[:, 2]) > 1.9 and np.ptp(high[:, 0]) > 1.3


EXPORTERS = {".obj": "obj_export", ".ply": "ply_export", ".stl": "stl_export"}
FORWARD = {"Y": "NEGATIVE_Z", "Z": "Y", "X": "Y"}


def save_along(path: Path, axis: str) -> Path:
    """Write the scene so that an axis of the file points up."""
    export = getattr(bpy.ops.wm, EXPORTERS[path.suffix])
    export(filepath=str(path), up_axis=axis, forward_axis=FORWARD[axis])
    return path


@pytest.mark.parametrize("kind", EXPORTERS)
@pytest.mark.parametrize("axis", ["Y", "Z"])
def test_shapes_stand_by_themselves(kind: str, axis: str, tmp_path: Path) -> None:
    """A stool stands on its legs whichever way its file lies; where it was turned one remark says so."""
    stool()
    source = save_along(tmp_path / f"stool{kind}", axis)
    assert stands(source)
    found, remarks = heights(source)
    assert found == pytest.approx([0, 2], abs=1e-4)
    usual = "y" if kind == ".obj" else "z"
    turned = f"stool{kind} was turned to stand on its base, with its {axis.lower()} axis up"
    said = f"{turned}: --up {usual} leaves it as it was."
    assert remarks == (() if axis.lower() == usual else (said,))


@pytest.mark.parametrize("kind", EXPORTERS)
@pytest.mark.parametrize("axis", "XYZ")
@pytest.mark.parametrize("asked", "xyz")
def test_axis_that_is_asked_for_points_up(kind: str, axis: str, asked: str, tmp_path: Path) -> None:
    """The axis of the file that is named points up, whatever the shape says, and without a remark."""
    stool()
    source = save_along(tmp_path / f"stool{kind}", axis)
    assert stands(source, up=asked) == (axis.lower() == asked)
    assert heights(source, up=asked)[1] == ()


@pytest.mark.parametrize("kind", EXPORTERS)
@pytest.mark.parametrize("axis", ["Y", "Z"])
def test_doubtful_shapes_keep_the_usual_axis(kind: str, axis: str, tmp_path: Path) -> None:
    """A box could stand on all its sides: the importer's usual axis stays, without a remark."""
    box("base", 0.5)
    found, remarks = heights(save_along(tmp_path / f"box{kind}", axis))
    usual = "Y" if kind == ".obj" else "Z"
    assert (found[1] - found[0], remarks) == (pytest.approx(1 if axis == usual else 2), ())


@pytest.mark.parametrize("kind", [".glb", ".fbx", ".blend"])
@pytest.mark.parametrize("frame", [None, 1])
def test_kinds_with_an_axis_keep_it(kind: str, frame: int | None, tmp_path: Path) -> None:
    """A stool that lies in a file with an axis of its own stays lying, unless another axis is asked for."""
    lying = stool()
    # up in Blender along y, or along -y, which is z in a .glb
    lying.rotation_euler.x = np.pi / 2 if kind == ".glb" else -np.pi / 2
    lying.keyframe_insert("rotation_euler", frame=1)
    bpy.context.scene.frame_set(1)
    source, asked = save(tmp_path / f"stool{kind}"), "z" if kind == ".glb" else "y"
    assert not stands(source, frame=frame)
    assert stands(source, frame=frame, up=asked) == (kind != ".blend")
    assert load(source, frame=frame, up=asked).up == ("y" if kind == ".blend" else "auto")


def test_still_kinds_have_no_frames(tmp_path: Path) -> None:
    """A frame of a file that cannot be animated is refused, as a flag without effect is."""
    box("base")
    bpy.ops.wm.stl_export(filepath=str(tmp_path / "box.stl"))
    with pytest.raises(SettingsError, match=r"\.stl files hold no animation: leave --frame out\."):
        load(tmp_path / "box.stl", frame=3)


def test_curves_of_an_fbx(tmp_path: Path) -> None:
    """Curves are found in binary files and in files of text, and an object that is called like one is none."""
    box("AnimationCurve")
    assert not fbx_is_animated(save(tmp_path / "still.fbx"))
    (tmp_path / "text.fbx").write_text('; FBX 7.4.0\nObjects: {\n\tAnimationCurve: 12, "AnimCurve::", "" {\n')
    assert fbx_is_animated(tmp_path / "text.fbx")
    (tmp_path / "empty.fbx").touch()
    assert not fbx_is_animated(tmp_path / "empty.fbx")


@pytest.mark.parametrize(
    "content",
    [b"", b"glTF", b"{", b"[]", b'{"animations": 3, "buffers": {}, "images": [4]}', b"glTF" + bytes(40), b"\xff\xfe{"],
)
@pytest.mark.parametrize("kind", [".glb", ".gltf"])
def test_broken_files_are_left_to_the_importer(content: bytes, kind: str, tmp_path: Path) -> None:
    """What is no glTF is not touched, and refused in one sentence."""
    source = tmp_path / f"broken{kind}"
    source.write_bytes(content)
    without_animation(source, tmp_path)
    source.write_bytes(content)
    with pytest.raises(MeshError, match=r"^[^\n]+\.$"):
        load(source)


def test_objects_by_name(tmp_path: Path) -> None:
    """Named objects are taken alone, without a surface for all below them; unknown names list what there is."""
    base, lid, group = box("base"), box("lid", 5), add_object(None, "group")
    base.parent = group
    knob = box("knob", 8)
    knob.parent = base
    box("other", 20)
    bpy.context.view_layer.update()
    source = save(tmp_path / "scene.blend")
    assert lid.parent is None
    names = {
        ("base",): ["base"], ("lid",): ["lid"], ("group",): ["base", "group", "knob"], ("lid", "base"): ["base", "lid"],
    }  # fmt: skip
    for asked, expected in names.items():
        assert sorted(obj.name for obj in load(source, names=asked).objects) == expected
    with pytest.raises(MeshError, match=r"no object 'nose'.*'base'.*'group'.*'knob'.*'lid'.*'other'\.$"):
        load(source, names=("base", "nose"))


def test_hidden_objects_cannot_be_named(tmp_path: Path) -> None:
    """An object that renders do not show is not there."""
    box("base")
    box("hidden").hide_render = True
    with pytest.raises(MeshError, match="no object 'hidden'"):
        load(save(tmp_path / "scene.blend"), names=("hidden",))


@pytest.mark.parametrize("name", ["a.obj", "a.stl", "text.stl", "a.ply", "big.ply", "text.ply", "a.glb", "a.gltf"])
def test_vertices_without_a_place_bend_nothing(name: str, tmp_path: Path) -> None:
    """A box with one corner that is nowhere lacks the faces at it, the others are where they were, and that is told."""
    objects, remarks, _ = load(write_box(tmp_path, name, float("nan"), [7]))
    mesh, more = read_rendered(objects, bpy.context)
    corners = np.round(mesh.vertices[mesh.faces] / 1000, 3)
    assert len(mesh.faces) == 12 - int((TRIANGLES == 7).any(axis=1).sum())
    assert ((corners == 0) | (np.abs(corners) == 1)).all()
    # no face leans, as one that ends at the origin instead would
    assert (np.ptp(corners, axis=1) == 0).any(axis=1).all()
    assert [remark for remark in (*remarks, *more) if "not finite numbers: the faces at" in remark]
    assert not list(Path(tempfile.gettempdir()).glob("legorize-*/" + name))


def test_a_file_with_nothing_but_such_vertices_is_refused(tmp_path: Path) -> None:
    """Nothing is left that could be built."""
    objects, _, _ = load(write_box(tmp_path, "a.obj", float("nan"), list(range(8))))
    with pytest.raises(MeshError):
        read_rendered(objects, bpy.context)


def test_an_animated_file_loses_both(tmp_path: Path) -> None:
    """A .gltf with animation and a vertex without a place: the copy of the copy finds its files."""
    box("lid")
    animate(bpy.context.object, 0, 3)
    path = save(tmp_path / "lid.gltf")
    data = bytearray((tmp_path / "lid.bin").read_bytes())
    document = json.loads(path.read_text(encoding="utf-8"))
    accessor = document["accessors"][document["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
    struct.pack_into("<f", data, document["bufferViews"][accessor["bufferView"]].get("byteOffset", 0), float("inf"))
    (tmp_path / "lid.bin").write_bytes(data)
    _, remarks, _ = load(path)
    assert any("the faces at it were left out" in remark for remark in remarks)
    assert any(REMARK in remark for remark in remarks)
