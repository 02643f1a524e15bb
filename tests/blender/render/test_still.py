"""A still shows the bricks in their colours and leaves the user's scene alone."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest
from PIL import Image

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.render.outlines import line_colour
from legorize_addon.render.still import AZIMUTH, render_still
from legorize_addon.scene.instancing import colour_material
from legorize_addon.scene.section import Section
from legorize_addon.view.visibility import cut_away, show_layers
from tests.blender.bricks import content, show, table

CATALOGUE = load_catalogue()
SIZE = (60, 40)
RED, BLUE = 4, 1


def picture(path: Path, **changes) -> np.ndarray:
    """Render the scene coarsely and return the pixels, (h, w, 3) float from 0 to 1."""
    render_still(bpy.context.scene, path, **{"samples": 4, "resolution": SIZE} | changes)
    with Image.open(path) as image:
        return np.asarray(image.convert("RGB")) / 255


def share(pixels: np.ndarray, code: int) -> float:
    """Return the share of the pixels that are plainly red or blue."""
    channel, others = (0, (1, 2)) if code == RED else (2, (0, 1))
    return float((pixels[..., channel] > 1.5 * pixels[..., others].max(axis=-1)).mean())


def test_bricks_fill_the_picture(tmp_path) -> None:
    """The model is seen whole: its colours are there, the rim of the picture is ground."""
    show(table([(11, 0, 0, 0, 0, RED), (11, 0, 0, 3, 0, BLUE)]), scale=0.01, mm_per_unit=1000.0)
    pixels = picture(tmp_path / "still.png")
    assert pixels.shape == (SIZE[1], SIZE[0], 3)
    assert share(pixels, RED) > 0.05
    assert share(pixels, BLUE) > 0.05
    rim = np.concatenate([pixels[0], pixels[-1], pixels[:, 0], pixels[:, -1]])
    assert np.ptp(rim, axis=1).max() < 0.2
    assert 0.3 < rim.mean() < 1


def test_hidden_layers_are_left_out(tmp_path) -> None:
    """Layers that the slider hides are not in the picture, which moves closer to the rest."""
    build = show(table([(11, 0, 0, 0, 0, RED), (11, 0, 0, 3, 0, BLUE)]))
    show_layers(bpy.context.scene, build, 1)
    pixels = picture(tmp_path / "still.png")
    assert share(pixels, BLUE) == 0
    assert share(pixels, RED) > 0.1


def test_section_is_looked_onto(tmp_path) -> None:
    """A cut shows what it lays open, from its own side; the section view goes with it, whichever side is hidden."""
    rows = [
        (0, x, y, z, 0, RED if x in (0, 9) or y in (0, 9) else BLUE)
        for x in range(10)
        for y in range(10)
        for z in (0, 3)
    ]
    build = show(table(rows))
    for axis, flip in [("x", False), ("x", True), ("y", False), ("y", True)]:
        cut_away(build, Section(axis, 0.5, flip))
        pixels = picture(tmp_path / "still.png", view="section")
        assert share(pixels, BLUE) > 0.05, (axis, flip)
    cut_away(build, Section("y", 0.5))
    assert share(picture(tmp_path / "still.png", view="front_right"), RED) > share(pixels, RED)


def test_level_section_is_seen_from_above(tmp_path) -> None:
    """A level cut shows the layer below it whole, with nothing of what lies above."""
    build = show(table([(11, 0, y, z, 0, BLUE if z == 3 else RED) for y in (0, 2, 4) for z in (0, 3, 6)]))
    cut_away(build, Section("z", 0.6))
    pixels = picture(tmp_path / "still.png", view="section")
    assert share(pixels, BLUE) > 2 * share(pixels, RED) > 0


def test_section_view_without_a_section(tmp_path) -> None:
    """A model that is not cut is seen from the front right."""
    show(table([(0, x, y, 0, 0, RED if y == 0 else BLUE) for x in range(8) for y in range(2)]))
    pictures = [picture(tmp_path / "still.png", view=view) for view in ("section", "front_right")]
    np.testing.assert_array_equal(*pictures)


def test_hidden_layers_are_left_out_of_any_render(tmp_path) -> None:
    """Renders of the user's own scene leave hidden layers out as well, whatever was rendered before."""
    scene = bpy.context.scene
    build = show(table([(11, 0, 0, 0, 0, RED), (11, 0, 0, 3, 0, BLUE)]))
    bpy.ops.object.camera_add(location=(16, 8, 200))
    scene.camera = bpy.context.object
    scene.render.engine, scene.cycles.samples, scene.render.filepath = "CYCLES", 1, str(tmp_path / "mine.png")
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    scene.world = bpy.data.worlds.new("grey")
    for persistent in (False, True):
        scene.render.use_persistent_data = persistent
        for top, shown, hidden in [(2, BLUE, RED), (1, RED, BLUE), (2, BLUE, RED)]:
            show_layers(scene, build, top)
            bpy.context.view_layer.update()
            bpy.ops.render.render(write_still=True)
            with Image.open(tmp_path / "mine.png") as image:
                pixels = np.asarray(image.convert("RGB")) / 255
            assert share(pixels, shown) > 0.01, (persistent, top)
            assert share(pixels, hidden) == 0, (persistent, top)


def test_views_differ(tmp_path) -> None:
    """From the front left another side of the model is seen than from the back right."""
    show(table([(0, x, y, 0, 0, RED if y == 0 else BLUE) for x in range(8) for y in range(2)]))
    red = {view: share(picture(tmp_path / f"{view}.png", view=view), RED) for view in AZIMUTH}
    assert min(red["front_left"], red["front_right"]) > 2 * max(red["back_left"], red["back_right"])


def test_below_shows_the_undersides(tmp_path) -> None:
    """From below the lowest layer covers those on it, with no ground before it and in full light."""
    show(table([(0, x, y, z, 0, RED if z else BLUE) for x in range(8) for y in range(8) for z in (0, 3)]))
    above, below = (picture(tmp_path / "still.png", view=view) for view in ("front_right", "below"))
    assert share(below, BLUE) > 3 * share(below, RED)
    assert share(above, RED) > 3 * share(above, BLUE)
    assert below.max() > 0.8 * above.max()


def test_below_is_not_mirrored(tmp_path) -> None:
    """What stands at the right of the picture from the front stands there from below as well."""
    show(table([(0, x, y, 0, 0, RED if x < 6 else BLUE) for x in range(12) for y in range(4)]))
    for view in ("front_right", "below"):
        pixels = picture(tmp_path / "still.png", view=view)
        left, right = pixels[:, : SIZE[0] // 2], pixels[:, SIZE[0] // 2 :]
        assert share(left, RED) > share(right, RED), view
        assert share(right, BLUE) > share(left, BLUE), view


def test_scene_is_as_before(tmp_path) -> None:
    """No data is left over, and engine, camera, world, path and selection are the user's."""
    scene = bpy.context.scene
    bpy.ops.object.camera_add()
    scene.camera = bpy.context.object
    scene.render.engine, scene.render.filepath = "BLENDER_WORKBENCH", "//mine"
    show(table([(0, 0, 0, 0, 0, RED)]))
    before = content()
    picture(tmp_path / "still.png")
    assert content() == before
    assert (scene.render.engine, scene.render.filepath) == ("BLENDER_WORKBENCH", "//mine")
    assert bpy.context.scene == scene
    assert scene.camera == bpy.context.object
    assert scene.world is None
    assert sorted(path.name for path in tmp_path.iterdir()) == ["still.png"]


def test_nothing_to_see_is_said(tmp_path) -> None:
    """A scene without bricks, and one with all layers hidden, give a sentence and no file."""
    with pytest.raises(BuildError, match="no brick model"):
        picture(tmp_path / "still.png")
    build = show(table([(0, 0, 0, 0, 0, RED)]))
    show_layers(bpy.context.scene, build, 0)
    before = content()
    with pytest.raises(BuildError, match="no bricks to show"):
        picture(tmp_path / "still.png")
    assert content() == before
    assert list(tmp_path.iterdir()) == []


def test_path_that_cannot_be_written_is_said(tmp_path) -> None:
    """A path that is a folder, or lies in a file, gives a sentence; nothing is left over."""
    show(table([(0, 0, 0, 0, 0, RED)]))
    before = content()
    (tmp_path / "folder.png").mkdir()
    (tmp_path / "file").touch()
    for path in (tmp_path / "folder.png", tmp_path / "file" / "still.png"):
        with pytest.raises(BuildError, match="cannot be written"):
            picture(path)
    assert content() == before
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "folder.png"]


def test_outlines_tell_bricks_apart(tmp_path) -> None:
    """Lines darken the edges of every brick and leave its faces; materials are as before, also after a failure."""
    show(table([(11, 0, 0, z, 0, RED) for z in (0, 3)]), scale=0.01, mm_per_unit=1000.0)
    before = content()
    nodes = {material.name: len(material.node_tree.nodes) for material in bpy.data.materials}
    plain, lined = (
        picture(tmp_path / "still.png", outlines=on, resolution=(240, 160), samples=16) for on in (False, True)
    )
    darker = lined.max(axis=-1) < 0.8 * plain.max(axis=-1)
    assert 0.02 < darker.mean() < 0.5 * share(plain, RED)
    assert share(lined, RED) > 0.7 * share(plain, RED)
    with pytest.raises(BuildError, match="cannot be written"):
        picture(tmp_path / "no" / "still.png", outlines=True)
    assert content() == before
    assert {material.name: len(material.node_tree.nodes) for material in bpy.data.materials} == nodes


def test_lines_are_seen_on_every_colour() -> None:
    """A line is darker than its brick, but lighter where the brick is dark; both differ by far."""
    for code in ("0", "4", "15", "72"):
        colour = CATALOGUE.colours[CATALOGUE.colour_row(int(code))]
        brick = np.array(colour_material(colour).diffuse_color[:3])
        line = np.array(line_colour(brick))
        assert abs(line - brick).max() > 0.07
        assert (line.max() > brick.max()) == (code == "0")


def test_outlines_stay_thin_on_small_bricks(tmp_path) -> None:
    """Where a plate has few pixels, lines take no more than their share of it."""
    show(table([(0, x, 0, 3 * z, 0, RED) for x in range(60) for z in range(2)]))
    plain, lined = (picture(tmp_path / "still.png", outlines=on) for on in (False, True))
    assert share(lined, RED) > 0.5 * share(plain, RED)


@pytest.mark.parametrize("name", ["{blend_name}", "{", "{{x}}", "#", "%04d"])
def test_path_is_taken_literally(tmp_path, name: str) -> None:
    """What Blender would replace in the path of a scene's output is a plain name here, and no other folder appears."""
    show(table([(11, 0, 0, 0, 0, RED)]))
    folder = tmp_path / name
    folder.mkdir()
    assert share(picture(folder / f"{name}.png", samples=1), RED) > 0.05
    assert [path.relative_to(tmp_path) for path in tmp_path.rglob("*")] == [Path(name), Path(name, f"{name}.png")]
