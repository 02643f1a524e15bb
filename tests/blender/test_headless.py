"""scripts/legorize.py: the files it writes, its exit status, and that a failure writes nothing."""

from __future__ import annotations

import errno
import importlib.util
import io
import json
import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable
from dataclasses import fields
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import SettingsError
from legorize_addon.core.files import folder
from legorize_addon.core.ldraw.reader import read_ldraw
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.settings import Settings
from legorize_addon.core.shopping.formats import FORMATS
from legorize_addon.scene.builds import builds as scene_builds
from legorize_addon.scene.collections import read_bricks
from legorize_addon.view.colour_errors import colour_errors_shown
from legorize_addon.view.heat_map import heat_map_shown
from legorize_addon.view.steps import exploded, steps_done
from legorize_addon.view.visibility import shown_bricks, shown_corners
from tests.blender.builders import add_image, add_object, image_material
from tests.core.foreign import nested_document

ROOT = Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "legorize.py"
FILES = {
    *("model.ldr", "model.mpd", "build_order.csv", "report.json"),
    *(kind.file for kind in FORMATS),
    *("tables/table_1.csv", "tables/table_3.csv"),
}
SUPPORT_FILES = {f"support-{kind.file}" for kind in FORMATS} | {"tables/table_2.csv", "tables/table_4.csv"}
BOX = (0.4, 0.2, 0.36)
ARM = ("--width", "16", "--hanging", "0")
RED, WHITE = 4, 15
# red but for the last texel of the topmost row
TEXELS = np.full((3, 4, 3), (201, 26, 9), dtype=np.uint8)
TEXELS[2, 3] = 255


@pytest.fixture(scope="module")
def script() -> ModuleType:
    """Return the script as a module."""
    spec = importlib.util.spec_from_file_location("legorize_script", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def out(tmp_path: Path) -> Path:
    """Return a folder for results that already holds something."""
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "model.ldr").write_text("an earlier model")
    (folder / "report.json").write_text('{"files": {"model.ldr": "checksum"}}')
    (folder / "mine.txt").write_text("not yours")
    return folder


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files below a folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def add_box(
    size: tuple[float, float, float], centre: tuple[float, float, float] = (0, 0, 0), image_file: Path | None = None
) -> bpy.types.Object:
    """Add a red box with a white corner towards +x, +y and +z: half of that edge, a third of the height."""
    bpy.ops.mesh.primitive_cube_add(size=1)
    obj = bpy.context.object
    corners = np.array([vertex.co for vertex in obj.data.vertices])
    loops = np.array([loop.vertex_index for loop in obj.data.loops])
    uvs = (np.column_stack([corners[loops, :2].mean(axis=1), corners[loops, 2]]) + 0.5).astype(np.float32)
    obj.data.uv_layers[0].uv.foreach_set("vector", uvs.ravel())
    obj.data.vertices.foreach_set("co", (corners * size + centre).astype(np.float32).ravel())
    image = add_image(TEXELS)
    if image_file is None:
        image.pack()
    else:
        image.filepath_raw, image.file_format = str(image_file), "PNG"
        image.save()
    obj.data.materials.append(image_material(image, extension="EXTEND"))
    return obj


def save(path: Path) -> Path:
    """Write everything to a file of the kind that its name says."""
    target = str(path)
    {
        ".blend": lambda: bpy.ops.wm.save_as_mainfile(filepath=target, copy=True),
        ".glb": lambda: bpy.ops.export_scene.gltf(filepath=target, export_format="GLB"),
        ".gltf": lambda: bpy.ops.export_scene.gltf(filepath=target, export_format="GLTF_SEPARATE"),
        ".obj": lambda: bpy.ops.wm.obj_export(filepath=target, path_mode="COPY"),
        ".stl": lambda: bpy.ops.wm.stl_export(filepath=target),
        ".ply": lambda: bpy.ops.wm.ply_export(filepath=target),
        ".fbx": lambda: bpy.ops.export_scene.fbx(filepath=target, path_mode="COPY", embed_textures=True),
    }[path.suffix]()
    return path


def report(folder: Path) -> dict[str, object]:
    """Return the report in a folder."""
    return json.loads((folder / "report.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("kind", [".blend", ".glb", ".gltf", ".obj", ".fbx", ".ply", ".stl"])
def test_every_kind_of_file(kind: str, script: ModuleType, tmp_path: Path) -> None:
    """A box of 4 x 2 studs and 3 bricks keeps its sides, and where the file has colours its white corner."""
    add_box(BOX, image_file=tmp_path / "paint.png")
    source = save(tmp_path / f"box{kind}")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4"]) == 0
    assert set(contents(tmp_path / "out")) == FILES
    facts = report(tmp_path / "out")
    assert facts["grid"] == {"x": 4, "y": 2, "layers": 3}
    assert facts["failed_checks"] == []
    if kind not in (".ply", ".stl"):
        catalogue = load_catalogue()
        bricks = read_ldraw((tmp_path / "out" / "model.ldr").read_text(), catalogue).bricks
        assert set(facts["counts"]["by_colour"]) == {str(RED), str(WHITE)}
        # half of the face on top of one white brick is red: rounding decides about a plate there
        assert np.ptp(bricks.corner[bricks.colour == RED, 2]) in (2 * 3, 2 * 3 + 2)
        place = bricks.corner[bricks.colour == WHITE] - bricks.corner.min(axis=0)
        assert place.min(axis=0).tolist() == [2, 1, 2 * 3]


@pytest.mark.parametrize("up", ["auto", "x", "y", "z"])
def test_up_is_told_and_in_the_matrix(up: str, script: ModuleType, tmp_path: Path) -> None:
    """The axis of a .blend that points up is that of the model; the report says which, and how the mesh was turned."""
    add_box((32, 16, 48), centre=(7, 8, 9))
    bpy.context.scene.unit_settings.scale_length = 0.001
    source = save(tmp_path / "box.blend")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--scale", "10", "--up", up]) == 0
    facts = report(tmp_path / "out")
    assert facts["settings"]["up"] == up
    assert facts["grid"] == {
        "x": {"x": 6, "y": 4}.get(up, 4), "y": {"y": 6}.get(up, 2), "layers": {"x": 4, "y": 2}.get(up, 5)
    }  # fmt: skip
    corners = [np.add((7, 8, 9), np.multiply(side, (16, 8, 24))) for side in ((-1, -1, -1), (1, 1, 1))]
    low, high = (np.array(facts["mesh_to_ldraw"]) @ (*corner, 1) for corner in corners)
    size = {"x": (48, 16, 32), "y": (32, 48, 16)}.get(up, (32, 16, 48))
    # x to x, z to -y, y to z; 20 LDU a stud of 8 mm
    np.testing.assert_allclose(np.abs(high - low)[:3], np.array(size)[[0, 2, 1]] * 2.5)


def test_lying_files_stand(script: ModuleType, tmp_path: Path) -> None:
    """A table whose file lies stands on its legs; the report says that it was turned."""
    add_box((1.4, 1.4, 0.2), centre=(0, 0, 1.9))
    for x, y in ((-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)):
        add_box((0.2, 0.2, 1.8), centre=(x, y, 0.9))
    path = tmp_path / "table.stl"
    bpy.ops.wm.stl_export(filepath=str(path), up_axis="Y", forward_axis="NEGATIVE_Z")
    assert script.main([str(path), "--out", str(tmp_path / "out"), "--height", "10"]) in (0, 2)
    facts = report(tmp_path / "out")
    assert facts["grid"]["x"] == facts["grid"]["y"] < 10
    assert [note for note in facts["notes"] if "turned to stand on its base, with its y axis up" in note]


def test_matrix_leads_from_the_mesh_to_the_bricks(script: ModuleType, tmp_path: Path) -> None:
    """The report's matrix takes the box's corners to the corners of the model, also under another unit scale."""
    bpy.context.scene.unit_settings.scale_length = 0.01
    add_box((32, 16, 36), centre=(7, 8, 9))
    source = save(tmp_path / "box.blend")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--scale", "1.0"]) == 0
    facts = report(tmp_path / "out")
    assert facts["grid"] == {"x": 4, "y": 2, "layers": 4}
    low, high = (np.array(facts["mesh_to_ldraw"]) @ (*corner, 1) for corner in ((-9, 0, -9), (23, 16, 27)))
    # x to x, z to -y, y to z; 20 LDU a stud, 24 a brick
    np.testing.assert_allclose((high - low)[:3], (80, -90, 40))


def test_blend_takes_what_renders_show(script: ModuleType, tmp_path: Path) -> None:
    """Objects hidden from renders do not count; those hidden in the viewport only do."""
    shown, hidden = add_box((1, 1, 1)), add_box((9, 1, 1))
    hidden.hide_render = True
    shown.hide_viewport = True
    excluded = bpy.data.collections.new("excluded")
    bpy.context.scene.collection.children.link(excluded)
    excluded.objects.link(add_object(hidden.data, "elsewhere"))
    bpy.context.scene.collection.objects.unlink(bpy.data.objects["elsewhere"])
    bpy.context.view_layer.layer_collection.children["excluded"].exclude = True
    source = save(tmp_path / "scene.blend")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "2"]) == 0
    assert report(tmp_path / "out")["grid"] == {"x": 2, "y": 2, "layers": 2}


def test_bones_are_at_rest(script: ModuleType, tmp_path: Path) -> None:
    """A model with a posed skeleton is taken as it was modelled."""
    box = add_box(BOX)
    bpy.ops.object.armature_add()
    rig = bpy.context.object
    box.vertex_groups.new(name="Bone").add(range(8), 1.0, "REPLACE")
    box.parent, box.modifiers.new("rig", "ARMATURE").object = rig, rig
    rig.pose.bones[0].scale = (1, 4, 1)
    rig.pose.bones[0].keyframe_insert("scale", frame=1)
    source = save(tmp_path / "rigged.glb")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4"]) == 0
    assert report(tmp_path / "out")["grid"] == {"x": 4, "y": 2, "layers": 3}


def test_picture_and_scene(script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The flags for the picture and the scene write them; the scene opens with the bricks in it."""
    monkeypatch.setattr(script, "render_still", partial(script.render_still, samples=1, resolution=(40, 30)))
    add_box(BOX)
    source = save(tmp_path / "box.glb")
    arguments = [str(source), "--out", str(tmp_path / "out"), "--width", "4", "--render", "--save-blend"]
    assert script.main(arguments) == 0
    assert set(contents(tmp_path / "out")) == FILES | {"render.png", "build.blend"}
    picture = bpy.data.images.load(str(tmp_path / "out" / "render.png"))
    pixels = np.empty(len(picture.pixels), dtype=np.float32)
    picture.pixels.foreach_get(pixels)
    assert np.ptp(pixels.reshape(-1, 4)[:, :3]) > 0.2
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    assert "Legorize box" in bpy.data.collections


@pytest.mark.parametrize("axis", "xyz")
def test_section_in_the_picture(axis: str, script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The picture is taken of the lower half of the bricks, from the section's side; the saved scene is whole."""
    seen = []

    def look(scene: bpy.types.Scene, path: Path, *, view: str, outlines: bool) -> None:
        [build] = scene_builds(scene)
        assert not outlines
        assert not heat_map_shown(build)
        seen.append((shown_bricks(build).corner[:, "xyz".index(axis)], view))

    monkeypatch.setattr(script, "render_still", look)
    add_box(BOX)
    flags = ["--section", f"{axis}=0.5", "--render", "--save-blend", "--width", "8", "--no-hollow"]
    assert script.main([str(save(tmp_path / "box.glb")), "--out", str(tmp_path / "out"), *flags]) == 0
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    [build] = scene_builds(bpy.context.scene)
    whole = shown_bricks(build)
    assert len(whole) == report(tmp_path / "out")["counts"]["bricks"]
    [(low, view)] = seen
    assert view == "section"
    assert 0 < len(low) < len(whole)
    along = whole.corner[:, "xyz".index(axis)]
    assert low.max() <= (along.min() + along.max() + 3) / 2


def test_frame_and_objects_are_flags(script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A frame gives the pose, names the objects; the report and the output tell what animation was left out."""
    box, lid = add_box((1, 1, 1)), add_box((1, 1, 1), centre=(0, 0, 1))
    box.name, lid.name = "box", "lid"
    for frame, x in ((1, 0), (25, 1)):
        lid.location.x = x
        lid.keyframe_insert("location", frame=frame)
    bpy.context.scene.frame_set(1)
    source = save(tmp_path / "box.glb")
    runs = {"rest": [], "pose": ["--frame", "25"], "lid": ["--object", "lid"], "both": ["--object=box", "--object=lid"]}
    found = {}
    for name, flags in runs.items():
        capsys.readouterr()
        assert script.main([str(source), "--out", str(tmp_path / name), "--scale", "0.32", *flags]) in (0, 2)
        facts = report(tmp_path / name)
        told = [line for line in capsys.readouterr().out.splitlines() if not re.match(r" *\d+% [a-z]", line)]
        assert told[:-3] == facts["notes"]
        found[name] = tuple(facts["grid"].values()), [note for note in facts["notes"] if "--frame" in note]
    remark = "The animation in box.glb was left out: --frame takes the pose of a frame."
    width = {name: grid[0] for name, (grid, _) in found.items()}
    assert width["pose"] == 2 * width["rest"]
    assert [found[name][1] for name in runs] == [[remark], [], [remark], [remark]]
    assert found["both"] == found["rest"]
    assert found["lid"][0][2] < found["rest"][0][2]


@pytest.mark.parametrize(
    ("flags", "view"), [([], "front_right"), (["--view", "below"], "below"), (["--section", "z=0.5"], "section"),
                        (["--section", "z=0.5", "--view", "below"], "below")],
)  # fmt: skip
def test_view_of_the_picture(
    flags: list[str], view: str, script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The picture is taken from where it is asked for, else from the front right or the section's side."""
    seen = []

    def look(scene: bpy.types.Scene, path: Path, *, view: str, outlines: bool) -> None:
        seen.append(view)

    monkeypatch.setattr(script, "render_still", look)
    add_box(BOX)
    arguments = [str(save(tmp_path / "box.glb")), "--out", str(tmp_path / "out"), "--width", "4", "--render"]
    assert script.main([*arguments, *flags]) == 0
    assert seen == [view]


@pytest.mark.parametrize(
    ("flag", "is_shown"), [("--heat-map", heat_map_shown), ("--colour-errors", colour_errors_shown)]
)
def test_outlines_and_other_colours_in_the_picture(
    flag: str,
    is_shown: Callable[[bpy.types.Collection], bool],
    script: ModuleType,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Both are there while the picture is taken; the saved scene shows the bricks in their own colours."""
    seen = []

    def look(scene: bpy.types.Scene, path: Path, *, view: str, outlines: bool) -> None:
        seen.append((view, outlines, [is_shown(build) for build in scene_builds(scene)]))

    monkeypatch.setattr(script, "render_still", look)
    add_box(BOX)
    flags = ["--outlines", flag, "--render", "--save-blend", "--width", "4"]
    assert script.main([str(save(tmp_path / "box.glb")), "--out", str(tmp_path / "out"), *flags]) == 0
    assert seen == [("front_right", True, [True])]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    assert not any(map(is_shown, scene_builds(bpy.context.scene)))


def add_arm() -> None:
    """Add an arm on a post, 16 x 4 studs and 8 bricks high: no part reaches its end, so a support has to carry it."""
    add_box((7, 4, 6 * 1.2), centre=(-2.5, 0, 3 * 1.2))
    add_box((16, 4, 2 * 1.2), centre=(2, 0, 7 * 1.2))


@pytest.mark.parametrize("flags", [[], ["--show-supports"], ["--no-show-supports"]])
def test_supports_in_the_picture(
    flags: list[str], script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The picture shows the finished model, with the flag its supports too; the saved scene has them at hand."""
    seen = []

    def look(scene: bpy.types.Scene, path: Path, **_: object) -> None:
        seen.extend(len(shown_bricks(build)) for build in scene_builds(scene))

    monkeypatch.setattr(script, "render_still", look)
    add_arm()
    arguments = [str(save(tmp_path / "arm.blend")), "--out", str(tmp_path / "out"), *ARM, "--render"]
    assert script.main([*arguments, "--save-blend", *flags]) == 0
    counts = report(tmp_path / "out")["counts"]
    assert counts["support_outside"] > 0
    supports = counts["support_outside"] if flags == ["--show-supports"] else 0
    assert seen == [counts["bricks"] + supports]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    [build] = scene_builds(bpy.context.scene)
    assert len(shown_bricks(build)) == counts["bricks"]
    assert len(read_bricks(build)) == counts["bricks"] + counts["support_outside"]


def test_pieces_apart_in_the_picture(script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A model that is split is taken apart for the picture alone."""
    seen = []

    def look(scene: bpy.types.Scene, path: Path, **_: object) -> None:
        [build] = scene_builds(scene)
        seen.append((exploded(build), np.ptp(shown_corners(build)[:, 2])))

    monkeypatch.setattr(script, "render_still", look)
    add_arm()
    add_box((4, 4, 4 * 1.2), centre=(-4, 0, 10 * 1.2))
    source = save(tmp_path / "arm.blend")
    flags = [*ARM, "--split", "2", "--render", "--save-blend"]
    assert script.main([str(source), "--out", str(tmp_path / "out"), *flags, "--explode", "0.5"]) == 0
    assert report(tmp_path / "out")["building"]["pieces"] == 2
    height = 12 * 9.6
    assert seen == [(0.5, pytest.approx(1.5 * height))]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    [build] = scene_builds(bpy.context.scene)
    assert exploded(build) == 0.0
    assert np.ptp(shown_corners(build)[:, 2]) == pytest.approx(height)


@pytest.mark.parametrize("flags", [[], ["--actual-size", "--paper", "Letter"]])
def test_layer_maps(flags: list[str], script: ModuleType, tmp_path: Path) -> None:
    """The flag writes a map of each layer, of the size that is asked for, with supports hatched."""
    add_arm()
    source = str(save(tmp_path / "arm.blend"))
    assert script.main([source, "--out", str(tmp_path / "out"), *ARM, "--layers", *flags]) == 0
    maps = sorted((tmp_path / "out" / "layers").iterdir())
    assert [path.name for path in maps] == [f"{number:03}.svg" for number in range(1, len(maps) + 1)]
    assert len(maps) >= report(tmp_path / "out")["grid"]["layers"]
    texts = [path.read_text(encoding="utf-8") for path in maps]
    assert all(text.startswith("<svg ") for text in texts)
    assert ('height="297mm"' in texts[0] or 'width="297mm"' in texts[0]) == (not flags)
    assert any("matrix(8 0 0 -8 " in text for text in texts) == bool(flags)


def test_method_files(script: ModuleType, tmp_path: Path) -> None:
    """The steps before the layout, with the supports in the maps."""
    add_arm()
    source = str(save(tmp_path / "box.blend"))
    assert script.main([source, "--out", str(tmp_path / "out"), *ARM, "--method"]) == 0
    made = tmp_path / "out" / "method"
    assert {path.name for path in made.iterdir()} == {
        *("tree.txt", "unit-bricks.ldr", "hollowing.ldr", "trajectories", "hollowing"),
    }
    assert any("support outside" in path.read_text(encoding="utf-8") for path in (made / "hollowing").iterdir())


def test_picture_of_a_layer_of_a_step(script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The picture shows one layer of the unit bricks alone; afterwards the model is in the scene as ever."""
    seen = []

    def draw(scene: bpy.types.Scene, path: Path, **options: object) -> None:
        """Note what is seen."""
        [build] = scene_builds(scene)
        seen.append((build.name, shown_bricks(build)))

    monkeypatch.setattr(script, "render_still", draw)
    add_box(BOX)
    flags = ["--width", "8", "--render", "--picture-of", "unit-bricks", "--top-layer", "2", "--single-layer"]
    assert script.main([str(save(tmp_path / "box.blend")), "--out", str(tmp_path / "out"), *flags]) == 0
    [(name, bricks)] = seen
    assert name.endswith("unit bricks")
    assert set((bricks.corner[:, 2] // 3).tolist()) == {1}
    [build] = scene_builds(bpy.context.scene)
    assert len(read_bricks(build)) == report(tmp_path / "out")["counts"]["bricks"]


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--picture-of", "hollowing"], "add --render"),
        (["--render", "--picture-of", "hollowing", "--heat-map"], "finished model"),
        (["--render", "--picture-of", "hollowing", "--colour-errors"], "finished model"),
        (["--render", "--single-layer"], "add --top-layer"),
        (["--top-layer", "2"], "add --render"),
        (["--render", "--top-layer", "0"], "number of a layer"),
    ],
)
def test_flags_of_the_method_without_effect(
    flags: list[str], words: str, script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One sentence, and nothing written."""
    assert script.main(["any.obj", "--out", str(tmp_path / "out"), *flags]) == 1
    assert words in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_booklet(script: ModuleType, tmp_path: Path) -> None:
    """The flag writes the booklet of the steps in both forms, named after the file."""
    add_arm()
    source = str(save(tmp_path / "arm.blend"))
    flags = [*ARM, "--instructions", "--paper", "Letter"]
    assert script.main([source, "--out", str(tmp_path / "out"), *flags]) == 0
    html = (tmp_path / "out" / "instructions.html").read_text(encoding="utf-8")
    assert "<title>arm: building instructions</title>" in html
    assert f"{report(tmp_path / 'out')['building']['steps']} steps" in html
    assert 'width="279.4mm"' in html
    assert (tmp_path / "out" / "instructions.pdf").read_bytes().startswith(b"%PDF")
    assert set(contents(tmp_path / "out")) == FILES | SUPPORT_FILES | {"instructions.html", "instructions.pdf"}


def test_contact_sheet(script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The flag alone writes the sheet of as many pictures; the saved scene is that of the finished model."""
    few = partial(script.render_contact_sheet, samples=1, resolution=(32, 24))
    monkeypatch.setattr(script, "render_contact_sheet", few)
    add_arm()
    flags = [*ARM, "--contact-sheet", "3", "--outlines", "--save-blend"]
    assert script.main([str(save(tmp_path / "arm.blend")), "--out", str(tmp_path / "out"), *flags]) == 0
    assert set(contents(tmp_path / "out")) == FILES | SUPPORT_FILES | {"contact-sheet.png", "build.blend"}
    sheet = bpy.data.images.load(str(tmp_path / "out" / "contact-sheet.png"))
    assert sheet.size[0] == 2 * 32 + 4
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    [build] = scene_builds(bpy.context.scene)
    assert steps_done(build) == 0


def test_film(script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Frames are files beside the others; the saved file opens with the film, and others can render it."""
    monkeypatch.setattr(script, "make_film", partial(script.make_film, samples=1, resolution=(32, 24)))
    add_arm()
    file = save(tmp_path / "arm.blend")
    flags = [*ARM, "--animate", "1", "--turntable", "2", "--save-blend", "--no-frames"]
    assert script.main([str(file), "--out", str(tmp_path / "out"), *flags]) == 0
    assert set(contents(tmp_path / "out")) == FILES | SUPPORT_FILES | {"build.blend"}
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "out" / "build.blend"))
    film = bpy.context.scene
    assert film.name == "Legorize Film"
    assert film.camera
    assert film.frame_end > 30
    assert script.main([str(file), "--out", str(tmp_path / "out"), *ARM, "--turntable", "2"]) == 0
    frames = {"frames/0001.png", "frames/0002.png"}
    assert set(contents(tmp_path / "out")) == FILES | SUPPORT_FILES | frames


def test_progress_of_pictures_is_shown(
    script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    """Films and contact sheets have their lines, though what renders print is hidden; no time is given before a film.

    Lines go to the stream of the process, as the renders' own do.
    """
    small = {"samples": 1, "resolution": (32, 24)}
    for name in ("make_film", "render_contact_sheet"):
        monkeypatch.setattr(script, name, partial(getattr(script, name), **small))
    add_arm()
    file = save(tmp_path / "arm.blend")
    monkeypatch.setattr(script, "sys", SimpleNamespace(stdout=os.fdopen(os.dup(1), "w"), stderr=sys.stderr))
    flags = [*ARM, "--contact-sheet", "2", "--turntable", "12"]
    assert script.main([str(file), "--out", str(tmp_path / "out"), *flags]) == 0
    lines = [line for line in capfd.readouterr().out.splitlines() if line[:4].strip().endswith("%")]
    tenths = [int(line[:3]) for line in lines if line[5:].startswith("film")]
    assert len(tenths) > 5
    assert tenths[-1] == 100
    assert any(line[5:].startswith("contact sheet") for line in lines)
    assert not [line for line in lines if " left" in line and not line[5:].startswith("film")]


def test_saved_scene_can_be_legorized_again(script: ModuleType, tmp_path: Path) -> None:
    """A scene that holds a build gives the model of what the build was made of, not of its bricks."""
    add_box(BOX)
    first, second = tmp_path / "first", tmp_path / "second"
    source = save(tmp_path / "box.glb")
    assert script.main([str(source), "--out", str(first), "--width", "4", "--save-blend"]) == 0
    assert script.main([str(first / "build.blend"), "--out", str(second), "--width", "4"]) == 0
    models = [(folder / "model.ldr").read_text().splitlines()[1:] for folder in (first, second)]
    assert models[0] == models[1]


def test_object_built_in_another_scene(script: ModuleType, tmp_path: Path) -> None:
    """An object that a build in another scene hides is legorized in its own scene."""
    add_box(BOX).name = "box"
    source = save(tmp_path / "box.blend")
    assert script.main([str(source), "--out", str(tmp_path / "first"), "--width", "4", "--save-blend"]) == 0
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "first" / "build.blend"))
    other = bpy.data.scenes.new("other")
    other.collection.objects.link(bpy.data.objects["box"])
    bpy.context.window.scene = other
    source = save(tmp_path / "two.blend")
    assert script.main([str(source), "--out", str(tmp_path / "second"), "--width", "4"]) == 0
    assert report(tmp_path / "second")["grid"] == report(tmp_path / "first")["grid"]


def test_failed_check_is_a_two(script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Of two boxes with a gap between them the upper floats: all is written, the report and stderr say so."""
    add_box((1, 1, 1))
    add_box((1, 1, 1), centre=(0, 0, 3))
    source = save(tmp_path / "two.blend")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4", "--supports", "none"]) == 2
    facts = report(tmp_path / "out")
    assert facts["connection"]["floating"] > 0
    # two pieces, bricks in the air, also while it is built, and so no stability
    assert len(facts["failed_checks"]) == 4
    assert capsys.readouterr().err.splitlines() == facts["failed_checks"]


def test_existing_folder_keeps_other_files(script: ModuleType, out: Path, tmp_path: Path) -> None:
    """Results replace files of their names and leave the others; nothing temporary stays."""
    add_box(BOX)
    source = save(tmp_path / "box.blend")
    assert script.main([str(source), "--out", str(out), "--width", "4"]) == 0
    assert set(contents(out)) == FILES | {"mine.txt"}
    assert (out / "model.ldr").read_text().startswith("0 box\n")


def test_own_file_with_the_name_of_a_result_is_kept(
    script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A file that no earlier run wrote is not replaced, and that is said before the work begins."""
    add_box(BOX)
    source = save(tmp_path / "box.blend")
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "parts.csv").write_text("the user's")
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4"]) == 1
    assert "parts.csv is a file that no earlier run wrote: move it away" in capsys.readouterr().err
    assert contents(tmp_path / "out") == {"parts.csv": b"the user's"}


def test_every_setting_is_a_flag(script: ModuleType) -> None:
    """Each field of Settings has its flag, and only what is said is changed."""
    parser, text = script.parser(), script.parser().format_help()
    for entry in fields(Settings):
        assert f"--{entry.name.replace('_', '-')}" in text
    plain = vars(parser.parse_args(["in.obj", "--out", "out"]))
    assert not plain.keys() & {entry.name for entry in fields(Settings)}
    assert parser.parse_args(["in.obj", "--out", "out", "--width", "1e3"]).width == 1000
    said = ["--no-hollow", "--one-to-one", "--cusp", "1.5", "--palette", "1,4", "--sampling", "image", "--height", "9"]
    options = vars(parser.parse_args(["in.obj", "--out", "out", *said]))
    given = {name: value for name, value in options.items() if name not in plain}
    assert script.settings_of(given) == Settings(
        hollow=False, one_to_one=True, cusp=1.5, palette="1,4", sampling="image", height=9, size_by="height"
    )


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--width", "0"], "width is 0"),
        (["--width", "100000"], "width is 100000"),
        (["--width", "many"], "'many' is no whole number"),
        (["--width", "12.5"], "'12.5' is no whole number"),
        (["--scale", "nan"], "scale is nan"),
        (["--scale", "1000000"], "studs"),
        (["--width", "3", "--height", "4"], "not allowed with"),
        (["--widht", "3"], "--widht"),
        (["--palette", "99999"], "99999"),
        (["--frame", "1.5"], "'1.5' is not a whole number from -1048574 to 1048574"),
        (["--frame", "2000000"], "'2000000' is not a whole number from -1048574 to 1048574"),
        (["--object", "nose"], "There is no object 'nose' that renders show: choose one of 'Cube'."),
        (["--section", "x=0.5"], "--section only changes the picture: add --render"),
        (["--view", "below"], "--view only changes the picture: add --render"),
        (["--view", "above", "--render"], "--view: invalid choice: 'above'"),
        (["--no-frames"], "--no-frames leaves a film to others: add --save-blend, and --animate or --turntable."),
        (["--animate", "0"], "'0' is not a whole number from 1 to 10000"),
        (["--outlines"], "--outlines only changes the picture: add --render"),
        (["--heat-map"], "--heat-map only changes the picture: add --render"),
        (["--colour-errors"], "--colour-errors only changes the picture: add --render"),
        (["--render", "--heat-map", "--colour-errors"], "one kind of colours: leave --heat-map or --colour-errors out"),
        (["--show-supports"], "--show-supports only changes the picture: add --render"),
        (["--explode", "0.5"], "--explode only changes the picture: add --render"),
        (["--explode", "1.5", "--render"], "'1.5' is not a number from 0 to 1"),
        (["--explode", "nan", "--render"], "'nan' is not a number from 0 to 1"),
        (["--actual-size"], "--actual-size only changes layer maps"),
        (["--contact-sheet", "0"], "'0' is not a whole number from 1 to 400"),
        (["--contact-sheet", "2.5"], "'2.5' is not a whole number from 1 to 400"),
        (["--section", "w=0.5", "--render"], "'w=0.5' is not a section"),
        (["--section", "x", "--render"], "'x' is not a section"),
        (["--section", "x=half", "--render"], "'x=half' is not a section"),
        (["--section", "z=1.5", "--render"], "from 0 to 1"),
        (["--section", "y=nan", "--render"], "from 0 to 1"),
    ],
)
def test_impossible_settings(
    flags: list[str], words: str, script: ModuleType, out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A value out of range, no number, a contradiction or an unknown flag is a 1 with one sentence."""
    add_box(BOX)
    assert_refused(script, save(tmp_path / "box.blend"), out, words, capsys, flags)


def no_file(path: Path) -> Path:
    """Name a file that is not there."""
    return path / "nothing.obj"


def unknown_kind(path: Path) -> Path:
    """Write a file of a kind that is no mesh."""
    (path / "mesh.txt").write_text("v 0 0 0")
    return path / "mesh.txt"


def broken(path: Path) -> Path:
    """Write a file that is not what its name says."""
    (path / "broken.ply").write_text("no mesh")
    return path / "broken.ply"


def empty_blend(path: Path) -> Path:
    """Save an empty scene."""
    return save(path / "empty.blend")


def no_faces(path: Path) -> Path:
    """Save a mesh of points."""
    mesh = bpy.data.meshes.new("points")
    mesh.from_pydata([(0, 0, 0), (1, 1, 1), (2, 0, 1)], [], [])
    add_object(mesh, "points")
    return save(path / "points.blend")


def no_numbers(path: Path) -> Path:
    """Save a box with a vertex at NaN."""
    add_box((1, 1, 1)).data.vertices[0].co.z = float("nan")
    return save(path / "nan.blend")


def zero_scale(path: Path) -> Path:
    """Save a box scaled to nothing."""
    add_box((1, 1, 1)).scale = (0, 0, 0)
    return save(path / "zero.blend")


def no_rotation(path: Path) -> Path:
    """Write a box whose node is turned by numbers too great, of which Blender makes not-a-number."""
    add_box((1, 1, 1))
    source = save(path / "turned.gltf")
    scene = json.loads(source.read_text())
    scene["nodes"][0]["rotation"] = [0, 0, 0, "BIG"]
    source.write_text(json.dumps(scene).replace('"BIG"', "1e999"))
    return source


def one_triangle(path: Path) -> Path:
    """Write a single triangle."""
    (path / "one.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    return path / "one.obj"


def missing_image(path: Path) -> Path:
    """Write a mesh whose material names an image that is not there."""
    add_box((1, 1, 1))
    save(path / "box.obj")
    (path / "box.mtl").write_text("newmtl paint\nKd 1 1 1\nmap_Kd lost.png\n")
    return path / "box.obj"


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (no_file, "There is no file"),
        (unknown_kind, "not a kind of file"),
        (broken, "is incomplete or damaged"),
        (empty_blend, "nothing to build from"),
        (no_faces, "no faces"),
        (no_numbers, "not finite numbers"),
        (zero_scale, "scale of zero"),
        (no_rotation, "a location, rotation or scale that is not finite"),
        (one_triangle, "triangle"),
    ],
)
def test_bad_input(
    make: Callable[[Path], Path], words: str, script: ModuleType, out: Path, tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    """What cannot be read is a 1 with one sentence, and the folder is as it was."""
    assert_refused(script, make(tmp_path), out, words, capsys, [])


def assert_refused(
    script: ModuleType, source: Path, out: Path, words: str, capsys: pytest.CaptureFixture[str], flags: list[str]
) -> None:
    """Check that a run ends with 1, says one sentence, and changes nothing."""
    before = contents(out.parent)
    capsys.readouterr()
    assert script.main([str(source), "--out", str(out), *flags]) == 1
    [sentence] = capsys.readouterr().err.splitlines()
    assert words in sentence
    assert sentence.endswith(".")
    assert contents(out.parent) == before
    assert not list(out.parent.rglob(".legorize-*"))


def test_a_missing_image_is_told(script: ModuleType, out: Path, tmp_path: Path) -> None:
    """A mesh whose image is not there is built in its plain colour, and the report names the file."""
    assert script.main([str(missing_image(tmp_path)), "--out", str(out), "--width", "8"]) == 0
    assert "lost.png" in (out / "report.json").read_text(encoding="utf-8")


@pytest.mark.parametrize("place", ["at", "below", "forbidden"])
def test_unwritable_folder(
    place: str,
    script: ModuleType,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A file at the folder's place or above it, and missing rights, give one sentence and a 1."""

    def forbid(near: Path) -> None:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    add_box(BOX)
    source = save(tmp_path / "box.blend")
    taken = tmp_path / "taken"
    if place == "forbidden":
        # root, as whom tests may run, is refused nothing
        monkeypatch.setattr(folder, "workplace", forbid)
    else:
        taken.write_text("a file")
    out = taken / "out" if place == "below" else taken
    assert_refused(script, source, out, str(out), capsys, [])


def test_folder_in_the_place_of_a_result(
    script: ModuleType, out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A folder that is called like a result stops everything before the first file is replaced."""
    add_box(BOX)
    (out / "model.ldr").unlink()
    (out / "report.json").unlink()
    (out / "report.json").mkdir()
    assert_refused(script, save(tmp_path / "box.blend"), out, "report.json is a folder", capsys, ["--width", "4"])


@pytest.mark.parametrize(
    ("source", "out", "words"),
    [
        ("box.obj", "", "The folder has no name"),
        ("", "out", "The file has no name"),
        ("caf\udce9.obj", "out", "is not UTF-8"),
        ("box.obj", "caf\udce9", "is not UTF-8"),
        ("a\0b.obj", "out", "NUL"),
        ("box.obj", "a\0b", "NUL"),
        (f"{'n' * 300}.obj", "out", "cannot be read"),
        ("box.obj", "n" * 300, "cannot be written"),
        ("n/" * 600 + "box.obj", "out", "longer than"),
        ("box.obj", "n/" * 600, "longer than"),
        (".", "out", "is a folder"),
    ],
)
def test_bad_paths(
    source: str, out: str, words: str, script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    """Names that no file can have, or that Blender cannot take, are a 1 with one sentence, and nothing is there."""
    add_box(BOX)
    save(tmp_path / "box.obj")
    before = contents(tmp_path)
    monkeypatch.chdir(tmp_path)
    capsys.readouterr()
    assert script.main([source, "--out", out, "--width", "4"]) == 1
    [sentence] = capsys.readouterr().err.splitlines()
    assert words in sentence
    assert sentence.endswith(".")
    assert sentence.isprintable()
    assert contents(tmp_path) == before


def test_working_folder_that_is_gone(
    script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys
) -> None:
    """Relative names are refused there; absolute ones work."""
    add_box(BOX)
    source = save(tmp_path / "box.obj")
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    assert script.main([str(source), "--out", "out", "--width", "4"]) == 1
    assert "working folder is no longer there" in capsys.readouterr().err
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4"]) == 0


def test_old_pictures_do_not_stay_beside_a_new_model(
    script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What an earlier run wrote and this one does not is gone; what somebody changed since stays, and is told."""
    add_box(BOX)
    source, out = save(tmp_path / "box.blend"), tmp_path / "out"
    for change in (False, True):
        assert script.main([str(source), "--out", str(out), "--width", "4", "--save-blend"]) == 0
        assert set(contents(out)) == FILES | {"build.blend"}
        if change:
            (out / "build.blend").write_bytes(b"mine")
        (tmp_path / "link").unlink(missing_ok=True)
        (tmp_path / "link").symlink_to(out)
        capsys.readouterr()
        assert script.main([str(source), "--out", str(tmp_path / "link"), "--width", "5"]) == 0
        assert set(contents(out)) == FILES | ({"build.blend"} if change else set())
        told = "build.blend was kept, because it was changed after an earlier run had written it."
        assert (told in capsys.readouterr().err) == change
    assert (tmp_path / "link").is_symlink()


@pytest.mark.parametrize("name", ["STEP", "FILE", "!LEGORIZE ROLE SHELL PIECE 3", "=1+1", "{blend_name}", "a\nb"])
def test_name_of_the_file_is_no_command(name: str, script: ModuleType, tmp_path: Path) -> None:
    """However the file is called, its model is the same but for the title."""
    add_box(BOX)
    source = save(tmp_path / "box.obj")
    named = tmp_path / name / f"{name}.obj"
    named.parent.mkdir()
    named.write_bytes(source.read_bytes())
    (named.parent / "box.mtl").write_bytes((tmp_path / "box.mtl").read_bytes())
    plain, odd = tmp_path / "plain", tmp_path / name / "odd"
    for path, out in ((source, plain), (named, odd)):
        assert script.main([str(path), "--out", str(out), "--width", "4"]) == 0
    assert set(contents(plain)) == set(contents(odd)) == FILES
    lines = [(folder / "model.ldr").read_text().split("\n") for folder in (plain, odd)]
    assert lines[0][1:] == lines[1][1:]
    assert lines[1][0].split()[1] == ("a" if "\n" in name else "Model")


def test_parser_complains_by_exception(script: ModuleType) -> None:
    """A wrong command line never ends with argparse's own 2, which would mean a failed check."""
    with pytest.raises(SettingsError, match="unrecognized"):
        script.parser().parse_args(["--widht", "3"])


def top_level(folder: Path) -> list[str]:
    """Return the names in a folder, those of folders with the number of their files."""
    return sorted(
        f"{path.name}/ ({len(list(path.iterdir()))})" if path.is_dir() else path.name for path in folder.iterdir()
    )


@pytest.mark.parametrize("before", [[], ["blender", "-b", "-P", "legorize.py", "--"]])
def test_whole_process(before: list[str], tmp_path: Path) -> None:
    """As a process of its own, called as Python does or as Blender does, it ends with the status of the run."""
    add_box(BOX)
    source = save(tmp_path / "box.glb")
    done = run_process([*(before or [str(SCRIPT)]), str(source), "--out", str(tmp_path / "out"), "--width", "4"])
    assert done.returncode == 0, done.stderr
    assert report(tmp_path / "out")["counts"]["bricks"] > 0
    # nothing of what the importer says between the stages
    *stages, model, files, verdict = done.stdout.splitlines()
    assert all(re.match(r" *\d+% [a-z]", stage) for stage in stages)
    assert re.match(r"Model: \d+ bricks in \d+ layers, ", model)
    assert files == f"Files in {tmp_path / 'out'}: {', '.join(top_level(tmp_path / 'out'))}."
    assert verdict == "Verdict: the model is proven to stand; every check passed."
    assert done.stderr == ""


@pytest.mark.skipif(os.name != "posix", reason="signals as exit status")
def test_crash_of_an_importer_leaves_nothing(tmp_path: Path) -> None:
    """When Blender itself is ended by a signal, that is said, and there is no folder to clear away."""
    add_box(BOX)
    source = save(tmp_path / "box.ply")
    before = contents(tmp_path)
    patch = "import os, legorize_addon.reading.importers as importers; "
    patch += "importers.importers = lambda: {'.ply': (lambda **_: os.abort(), {})};"
    done = run_process([str(SCRIPT), str(source), "--out", str(tmp_path / "out")], patch)
    assert done.returncode == -signal.SIGABRT
    assert "Aborted" in done.stderr
    assert contents(tmp_path) == before
    assert not list(tmp_path.rglob(".legorize-*"))


def test_bug_keeps_its_traceback(tmp_path: Path) -> None:
    """An unexpected exception is shown in full, the status is 1, and nothing is written."""
    add_box(BOX)
    source = save(tmp_path / "box.glb")
    patch = "import legorize_addon.core.pipeline as pipeline; pipeline.legorize = None;"
    done = run_process([str(SCRIPT), str(source), "--out", str(tmp_path / "out")], patch)
    assert done.returncode == 1
    assert "Traceback" in done.stderr
    assert "TypeError" in done.stderr
    assert not (tmp_path / "out").exists()


def run_process(argv: list[str], patch: str = "") -> subprocess.CompletedProcess[str]:
    """Run the script under the given command line in a process of its own."""
    code = f"import runpy, sys; {patch} sys.argv = {argv!r}; runpy.run_path({str(SCRIPT)!r}, run_name='__main__')"
    # Blender sets it in this process, and says so in another one that finds it
    env = {key: value for key, value in os.environ.items() if key != "OCIO"}
    return subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, env=env, capture_output=True, text=True, timeout=240, check=False
    )


def test_progress_is_a_line_for_each_stage(
    script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without a terminal there is a line for each stage, with a share that never goes back; then the result."""
    add_box(BOX)
    source = save(tmp_path / "box.blend")
    capsys.readouterr()
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4"]) == 0
    lines = [line for line in capsys.readouterr().out.splitlines() if line[:4].strip().endswith("%")]
    stages = [line[5:].split(",")[0] for line in lines]
    assert list(dict.fromkeys(stages))[:4] == ["import", "read", "mesh", "colours"]
    assert list(dict.fromkeys(stages))[-2:] == ["report", "files"]
    shares = [int(line[:3]) for line in lines]
    assert shares == sorted(shares)
    assert 90 < shares[-1] <= 100


def test_stages_that_take_turns_do_not_fill_the_page(script: ModuleType) -> None:
    """A stage that was named is named again only when more is done."""
    stream = io.StringIO()
    line = script.Line(stream)
    for share in (0.30, 0.31, 0.32, 0.33, 0.45):
        line("supports", share)
        line("stability", share)
    printed = [text.split(",")[0] for text in stream.getvalue().splitlines()]
    assert printed == [" 30% supports", " 30% stability", " 45% supports"]


def test_progress_on_a_terminal_is_one_line(script: ModuleType) -> None:
    """On a terminal the line is written over, by blanks where it was longer, and is gone in the end."""

    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    screen = Terminal()
    with script.Line(screen) as line:
        for stage, share in (("trajectories", 0.2), ("trajectories", 0.201), ("layout", 0.5)):
            line(stage, share)
    written = screen.getvalue()
    assert "\n" not in written
    first, second, *wiped = written.split("\r")[1:]
    assert first == " 20% trajectories"
    assert second.startswith(" 50% layout")
    assert len(second) >= len(first)
    assert "".join(wiped).strip() == ""


def test_bound_is_proven_on_request(script: ModuleType, tmp_path: Path) -> None:
    """The fewest bricks that any layout needs are in the report if --bound asks for them, else null."""
    add_box(BOX)
    source = save(tmp_path / "box.blend")
    found = []
    for flags in ([], ["--bound"]):
        assert script.main([str(source), "--out", str(tmp_path / "out"), "--width", "4", *flags]) == 0
        found.append(report(tmp_path / "out"))
    without, proven = (facts["layout"] for facts in found)
    assert without["fewest_possible"] is without["at_most_more_percent"] is None
    assert 1 <= proven["fewest_possible"] <= found[1]["counts"]["bricks"]


def test_a_giant_is_refused_before_the_work(
    script: ModuleType, out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A thin pole, 48 studs wide, is refused with its height; with the limit raised, it is built."""
    add_box((0.05, 0.05, 2))
    source = save(tmp_path / "pole.blend")
    assert_refused(script, source, out, "15 m high (1,600 layers)", capsys, [])
    assert_refused(script, source, out, "raise limit_size to 32", capsys, ["--width", "1", "--limit-size", "20"])
    assert script.main([str(source), "--out", str(out), "--width", "1", "--limit-size", "32"]) in (0, 2)
    assert report(out)["settings"]["limit_size"] == 32


def test_end_of_the_memory_is_a_sentence_everywhere(
    script: ModuleType, out: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whether reading, building or showing the model meets the end of the memory, the folder stays as it was."""

    def full(*_: object, **__: object) -> None:
        raise MemoryError

    add_box(BOX)
    source = save(tmp_path / "box.blend")
    for step in ("read_rendered", "legorize", "report", "output_texts", "show"):
        with monkeypatch.context() as patch:
            patch.setattr(script, step, full)
            flags = ["--width", "4", "--save-blend"]
            assert_refused(script, source, out, "There is not enough memory", capsys, flags)


def test_flags_of_an_earlier_version_are_read(script, capsys) -> None:
    """The earlier name of a setting works on the command line, with one remark; the help has today's name alone."""
    parser = script.parser()
    options = vars(parser.parse_args(["in.obj", "--out", "out", "--hold", "0.5"]))
    assert script.settings_of({"hold": options["hold"]}) == Settings(clutch=0.5)
    assert capsys.readouterr().err == "The setting hold is now called clutch: its value was used.\n"
    assert "--hold" not in parser.format_help()
    assert script.settings_of({"clutch": 0.5}) == Settings(clutch=0.5)
    assert not capsys.readouterr().err


def test_settings_are_printed_and_read(script, capsys, tmp_path) -> None:
    """A preset is changed by the file, the file by flags; what is printed can be read, and nothing is built."""
    file = tmp_path / "mine.json"
    file.write_text('{"hold": 0.5, "plate_gain": 0.3, "height": 7}', encoding="utf-8")
    assert script.main(["--preset", "cheapest", "--settings", str(file), "--seed", "3", "--print-settings"]) == 0
    printed, told = capsys.readouterr()
    assert told.count("clutch") == 1
    chosen = json.loads(printed)
    expected = {"clutch": 0.5, "plate_gain": 0.3, "size_by": "height", "height": 7, "layout": "exact", "seed": 3}
    assert {name: chosen[name] for name in expected} == expected
    file.write_text(printed, encoding="utf-8")
    assert script.main(["--settings", str(file), "--print-settings"]) == 0
    assert capsys.readouterr() == (printed, "")
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--settings", "gone.json"], "gone.json"),
        (["--settings", "word.json"], "There is no setting 'widht'"),
        (["--settings", "latin.json"], "is not a UTF-8 text"),
        (["--settings", "width.json"], "width is 0"),
        (["--preset", "best"], "invalid choice: 'best'"),
        (["in.obj"], "it needs a file to read, IN, and a folder, --out DIR"),
        (["--out", "out"], "it needs a file to read, IN, and a folder, --out DIR"),
    ],
)
def test_settings_that_cannot_be_read(script, capsys, tmp_path, monkeypatch, flags, words) -> None:
    """One sentence."""
    monkeypatch.chdir(tmp_path)
    Path("word.json").write_text('{"widht": 3}')
    Path("width.json").write_text('{"width": 0}')
    Path("latin.json").write_bytes(b'{"palette": "\xe4"}')
    assert script.main(flags) == 1
    printed, told = capsys.readouterr()
    assert printed == ""
    assert words in told
    assert told.count("\n") == 1


def test_brick_models_are_judged_and_laid_again(
    script: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A .mpd of somebody else gets all files but the tables of a mesh; laid again it passes every check."""
    monkeypatch.setattr(script, "render_still", partial(script.render_still, samples=1, resolution=(40, 30)))
    source = tmp_path / "tower.MPD"
    source.write_text(nested_document(), newline="")
    again = tmp_path / "again"
    assert script.main([str(source), "--out", str(tmp_path / "out"), "--layers"]) == 2
    assert script.main([str(source), "--out", str(again), "--again", "--render", "--save-blend"]) == 0
    bricks = FILES - {name for name in FILES if name.startswith("tables")}
    assert {name for name in contents(tmp_path / "out") if not name.startswith("layers")} == bricks
    assert bricks | {"render.png", "build.blend"} <= set(contents(again))
    before, after = (report(folder) for folder in (tmp_path / "out", again))
    assert before["counts"]["bricks"] == 64 > after["counts"]["bricks"]
    assert before["failed_checks"] == ["Components that are not joined: 16."]
    assert "16 parts are mirrored" in before["notes"][0]
    # our own file is read back as it was written
    assert script.main([str(again / "model.ldr"), "--out", str(tmp_path / "third")]) == 0
    first, third = (
        read_ldraw((folder / "model.ldr").read_text(), load_catalogue()) for folder in (again, tmp_path / "third")
    )
    assert rows(first.bricks) == rows(third.bricks)


@pytest.mark.parametrize(
    ("name", "flags", "message"),
    [
        ("m.ldr", ["--object", "A"], "--object and --frame choose from meshes"),
        ("m.obj", ["--again"], "--again and --steps are for brick models"),
        ("m.obj", ["--steps", "new"], "--again and --steps are for brick models"),
        ("m.ldr", ["--edits", "e.json"], "--edits are made in models of meshes"),
        ("m.obj", ["--edits", "e.json"], "There is no file e.json"),
        ("m.ldr", [], "m.ldr has no brick that can be read"),
        ("none.ldr", [], "There is no file"),
    ],
)
def test_wrong_use_of_brick_models(
    name: str, flags: list[str], message: str, script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Flags that belong to the other kind of file, and files without bricks, get one sentence and write nothing."""
    (tmp_path / "m.ldr").write_text("0 nothing\n")
    (tmp_path / "m.obj").write_text("v 0 0 0\n")
    assert script.main([str(tmp_path / name), "--out", str(tmp_path / "out"), *flags]) == 1
    assert message in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_edits_are_made_again(script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file of edits changes the model; what does not fit is printed; the file that is written does the same again."""
    add_box(BOX)
    source = save(tmp_path / "box.blend")
    edits = tmp_path / "edits.json"
    edits.write_text(
        '{"edits": [{"kind": "recolour", "part": "3005", "cell": [1, 1, 0], "colour": 1},'
        ' {"kind": "delete", "part": "3005", "cell": [2, 1, 0]}, {"kind": "lock", "part": "3001", "cell": [-9, 0, 0]}]}'
    )
    once, again = tmp_path / "once", tmp_path / "again"
    assert script.main([str(source), "--out", str(once), "--width", "8", "--edits", str(edits)]) == 0
    assert "An edit no longer fits: Lock Brick 2 x 4 in layer 1" in capsys.readouterr().out
    model = read_ldraw((once / "model.ldr").read_text(), load_catalogue()).bricks
    assert model.colour[(model.corner == (1, 1, 0)).all(axis=1)].tolist() == [1]
    assert report(once)["edits"]["made"] == 2
    written = ["--edits", str(once / "edits.json")]
    assert script.main([str(source), "--out", str(again), "--width", "8", *written]) == 0
    assert (again / "model.ldr").read_bytes() == (once / "model.ldr").read_bytes()
    assert (again / "edits.json").read_bytes() == (once / "edits.json").read_bytes()


def rows(bricks: Bricks) -> list[tuple[int, ...]]:
    """Return part, place, turn and colour of each brick, sorted."""
    return sorted(map(tuple, np.column_stack([bricks.part, bricks.corner, bricks.turn, bricks.colour]).tolist()))


def test_an_image_becomes_a_mosaic(script: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file with an image gives the files of a mosaic; flags of meshes are refused in one sentence."""
    image = bpy.data.images.new("picture", 8, 4)
    pixels = np.zeros((4, 8, 4), dtype=np.float32)
    pixels[..., 3], pixels[:2, :, 0], pixels[2:, :, 2] = 1, 1, 1
    image.pixels.foreach_set(pixels.ravel())
    image.file_format, image.filepath_raw = "PNG", str(tmp_path / "picture.png")
    image.save()
    arguments = [str(tmp_path / "picture.png"), "--out", str(tmp_path / "out"), "--width", "8", "--palette", "1,4"]
    assert script.main([*arguments, "--layers", "--save-blend"]) == 0
    made = contents(tmp_path / "out")
    assert {"model.ldr", "tiles.csv", "layers/001.svg", "build.blend", "report.json"} <= set(made)
    facts = report(tmp_path / "out")
    assert facts["grid"] == {"x": 8, "y": 4, "layers": 1}
    assert facts["input"] == {"pixels": [8, 4]}
    lines = [line.split() for line in made["model.ldr"].decode().splitlines() if line.startswith("1 ")]
    rows = {colour: {float(z) for _, code, _, _, z, *_ in lines if code == colour} for colour in ("1", "4")}
    # the front of the model, which has the smaller z in LDraw, is the lower edge of the image
    assert max(rows["4"]) < min(rows["1"])
    for flags in (["--frame", "3"], ["--object", "A"], ["--bound"]):
        assert script.main([*arguments, *flags]) == 1
        assert "leave --" in capsys.readouterr().err
