"""Learning from own models: a new file each time, used when chosen, and the way back to what is shipped."""

from __future__ import annotations

import os
from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.layout.learning.svm import read
from legorize_addon.core.model.catalogue import ASSETS
from legorize_addon.scene.collections import read_bricks
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.ui import learned_files
from legorize_addon.ui import learning as learning_operators
from legorize_addon.ui.current import current_build
from legorize_addon.ui.learned_files import own_folder, own_versions, resolved
from legorize_addon.ui.panels import classes
from legorize_addon.ui.settings_properties import settings_of

pytestmark = pytest.mark.usefixtures("addon")

SHIPPED = (ASSETS / "layout_svm.csv").read_text(encoding="utf-8")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return an empty folder that stands for the user's own."""
    monkeypatch.setattr(learned_files, "own_folder", lambda: tmp_path)
    return tmp_path


@pytest.fixture
def ball() -> bpy.types.Object:
    """Return a selected ball, to be built 16 studs wide by the quick layout."""
    bpy.ops.mesh.primitive_uv_sphere_add(radius=1)
    settings = bpy.context.scene.legorize.settings
    settings.width, settings.layout, settings.supports = 16, "fast", "none"
    return bpy.context.object


def chosen() -> str:
    """Return the file that the next build would use."""
    return str(settings_of(bpy.context.scene.legorize.settings).learned_from)


def built() -> tuple[list[int], list[list[int]]]:
    """Build what is selected; return parts and places."""
    assert bpy.ops.legorize.build() == {"FINISHED"}
    bricks = read_bricks(current_build(bpy.context.scene))
    return bricks.part.tolist(), bricks.corner.tolist()


def test_learning_adds_a_version(ball, folder: Path) -> None:
    """Samples of the selected object follow the shipped ones in a new file, which the next build uses."""
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    path = folder / "samples_v2.csv"
    assert chosen() == path.name
    samples, facts = read(path.read_text(encoding="utf-8"))
    shipped, _ = read(SHIPPED)
    np.testing.assert_array_equal(samples.levels[: len(shipped.pays)], shipped.levels)
    assert len(samples.pays) == len(shipped.pays) + 60
    assert facts["models"].endswith(f"then {ball.name}")
    assert not bpy.data.collections  # nothing was built
    assert (ASSETS / "layout_svm.csv").read_text(encoding="utf-8") == SHIPPED


def test_what_was_built_can_be_built_again(ball, folder: Path) -> None:
    """A build keeps the name of its samples; after learning more, the old choice gives the old bricks."""
    before = built()
    ball.hide_viewport = False
    current_build(bpy.context.scene)[BUILD_KEY]["root"].select_set(True)
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    second = chosen()
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    assert own_versions() == [0, 2, 3]
    assert read(Path(resolved(chosen())).read_text(encoding="utf-8"))[1]["version"] == "3"
    learned = built()
    assert current_build(bpy.context.scene)[BUILD_KEY]["settings"]["learned_from"] == chosen()
    assert bpy.ops.legorize.forget() == {"FINISHED"}
    assert chosen() == ""
    assert built() == before
    assert not bpy.ops.legorize.forget.poll()
    bpy.context.scene.legorize.settings.learned_from = str(folder / "samples_v3.csv")
    assert built() == learned
    assert Path(resolved(second)).exists()


def test_saved_scene_keeps_its_samples_beside_it(ball, folder: Path, tmp_path_factory) -> None:
    """The scene and its samples may go to another machine, or outlive the extension's own folder."""
    home, moved = tmp_path_factory.mktemp("home"), tmp_path_factory.mktemp("elsewhere") / "moved"
    bpy.ops.wm.save_as_mainfile(filepath=str(home / "saved.blend"))
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    assert chosen() == "//samples_v2.csv"
    assert not list(folder.iterdir())
    before = built()
    assert current_build(bpy.context.scene)[BUILD_KEY]["settings"]["learned_from"] == "//samples_v2.csv"
    bpy.ops.wm.save_mainfile()
    home.rename(moved)
    bpy.ops.wm.open_mainfile(filepath=str(moved / "saved.blend"))
    assert resolved(chosen()) == str(moved / "samples_v2.csv")
    assert built() == before
    assert own_versions() == [0, 2]


def test_name_is_looked_for_beside_the_scene_and_in_the_users_folder(folder: Path, tmp_path_factory) -> None:
    """A bare name is a file beside the .blend, else one of the user's own; a path is a path; nothing is nothing."""
    home = tmp_path_factory.mktemp("home")
    assert resolved("") == ""
    assert resolved(str(home / "x.csv")) == str(home / "x.csv")
    assert resolved("x.csv") == str(folder / "x.csv")
    bpy.ops.wm.save_as_mainfile(filepath=str(home / "saved.blend"))
    assert resolved("x.csv") == str(folder / "x.csv")
    (home / "x.csv").touch()
    assert resolved("x.csv") == str(home / "x.csv")


def test_selected_model_is_learned_as_it_was_built(ball, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A brick model is learned from in its own settings, another object in those of the panel, each by itself."""
    built()
    bpy.ops.mesh.primitive_cube_add(location=(5, 0, 0))
    cube = bpy.context.object
    current_build(bpy.context.scene)[BUILD_KEY]["root"].select_set(True)
    bpy.context.scene.legorize.settings.width = 30
    found = []
    monkeypatch.setattr(learning_operators.Lessons, "work", lambda order, progress: found.append(order) or SHIPPED)
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    assert [(model.name, model.settings.width) for model in found[0].models] == [(ball.name, 16), (cube.name, 30)]


def test_the_learned_layout_learns_its_own(ball, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the layout Learned its machine is taught; its file is none of the fast layout."""
    found, text = [], (ASSETS / "fill_svm.csv").read_text(encoding="utf-8")
    monkeypatch.setattr(learning_operators.Lessons, "work", lambda order, progress: found.append(order) or text)
    bpy.context.scene.legorize.settings.layout = "learned"
    assert bpy.ops.legorize.learn() == {"FINISHED"}
    assert (found[0].of_fill, found[0].text, found[0].version) == (True, text, 2)
    assert Path(resolved(chosen())).read_text(encoding="utf-8") == text
    bpy.context.scene.legorize.settings.layout = "fast"
    with pytest.raises(RuntimeError, match="Bricks > Training file is"):
        bpy.ops.legorize.learn()


def test_too_little_to_learn_from_is_said(folder: Path) -> None:
    """A small box teaches nothing: one sentence, no file, the choice as it was."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.scene.legorize.settings.width = 4
    with pytest.raises(RuntimeError, match="choose more or larger models"):
        bpy.ops.legorize.learn()
    assert chosen() == ""
    assert list(folder.iterdir()) == []


@pytest.mark.parametrize("layout", ["fast", "standard"])
def test_missing_file_is_said(ball, tmp_path: Path, layout: str) -> None:
    """A file that is gone gives a sentence, also where the layout would not use it."""
    bpy.context.scene.legorize.settings.learned_from = str(tmp_path / "gone.csv")
    bpy.context.scene.legorize.settings.layout = layout
    with pytest.raises(RuntimeError, match="or leave it empty"):
        bpy.ops.legorize.build()
    bpy.context.scene.legorize.settings.learned_from = ""
    assert bpy.ops.legorize.build() == {"FINISHED"}


def test_nothing_selected_is_nothing_to_learn() -> None:
    """Without objects and models the button is off."""
    assert not bpy.ops.legorize.learn.poll()


def test_own_folder_is_the_users() -> None:
    """What was learned lies among the user's files, not among those of the add-on."""
    assert own_folder().is_dir()
    assert own_folder().is_relative_to(Path(os.environ["BLENDER_USER_RESOURCES"]).resolve())


def test_buttons_stand_in_the_panel() -> None:
    """The panel of the group has both buttons below its settings, and no other one has any."""
    buttons = {panel.__name__: [button.bl_idname for button in getattr(panel, "buttons", ())] for panel in classes}
    assert {name: found for name, found in buttons.items() if found} == {
        "LEGORIZE_PT_bricks": ["legorize.learn", "legorize.forget"]
    }
