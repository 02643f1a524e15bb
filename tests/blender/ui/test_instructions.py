"""The buttons that write the booklet and the layer maps."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import Cancelled
from legorize_addon.core.instructions import Title, booklet
from legorize_addon.core.instructions.svg import svg
from legorize_addon.scene.builds import point_objects
from legorize_addon.scene.collections import read_bricks, steps_of
from legorize_addon.scene.state import BUILD_KEY
from legorize_addon.ui import instructions
from legorize_addon.ui.current import current_build
from legorize_addon.ui.instructions import BookletRequest, MapsRequest
from tests.blender.builders import add_table_on_one_leg

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def build() -> bpy.types.Collection:
    """Return the model of a table on one leg: supports have to carry its ends."""
    add_table_on_one_leg()
    bpy.context.object.name = "Table"
    bpy.context.scene.legorize.settings.width = 12
    assert bpy.ops.legorize.build() == {"FINISHED"}
    return current_build(bpy.context.scene)


def test_the_booklet_is_written(build, tmp_path):
    """Both files are there, with the name of the model, its steps and the paper."""
    assert bpy.ops.legorize.booklet(filepath=str(tmp_path / "table.html"), paper="Letter") == {"FINISHED"}
    assert sorted(path.name for path in tmp_path.iterdir()) == ["table.html", "table.pdf"]
    text = (tmp_path / "table.html").read_text(encoding="utf-8")
    assert "<title>Table: building instructions</title>" in text
    assert f"{len(steps_of(build))} steps" in text
    assert 'width="279.4mm"' in text
    assert (tmp_path / "table.pdf").read_bytes().startswith(b"%PDF")


def test_steps_survive_the_file(build, tmp_path):
    """Saved and opened again, a build knows the same steps."""
    before = steps_of(build)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "a.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "a.blend"))
    after = steps_of(current_build(bpy.context.scene))
    for name in before.moves.__slots__:
        one, other = getattr(before.moves, name), getattr(after.moves, name)
        assert one.dtype == other.dtype
        assert np.array_equal(one, other)
    for one, other in zip(before.submodels, after.submodels, strict=True):
        assert (one.number, one.kind, one.parent, one.piece, one.like) == (
            other.number, other.kind, other.parent, other.piece, other.like,
        )  # fmt: skip
        assert np.array_equal(one.rows, other.rows)
    assert np.array_equal(
        after.moves.step_of(len(read_bricks(current_build(bpy.context.scene)))),
        read_bricks(current_build(bpy.context.scene)).step,
    )


def test_layer_maps_are_written(build, tmp_path):
    """A folder with a map of each layer, in the size of the bricks where that is asked for."""
    folder = tmp_path / "maps"
    assert bpy.ops.legorize.layer_maps(filepath=str(folder), actual_size=True) == {"FINISHED"}
    maps = sorted(folder.iterdir())
    assert [path.name for path in maps] == [f"{number:03}.svg" for number in range(1, len(maps) + 1)]
    assert all("matrix(8 0 0 -8 " in path.read_text(encoding="utf-8") for path in maps)


@pytest.mark.parametrize("lost", ["steps", "brick"])
def test_what_is_not_known_is_told(build, lost, tmp_path):
    """A build of an earlier version, or with deleted bricks, gets a sentence, and no file is written."""
    if lost == "steps":
        del build[BUILD_KEY]["steps"]
    else:
        bpy.data.objects.remove(point_objects(build)[0])
    sentence = (
        "does not know how all of its bricks are built: leg" if lost == "steps" else "deleted by hand since .* leg"
    )
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.legorize.booklet(filepath=str(tmp_path / "a.html"))
    assert not list(tmp_path.iterdir())


def test_the_folder_must_be_there(build, tmp_path):
    """A place that cannot be written is told in a sentence."""
    with pytest.raises(RuntimeError, match="cannot be written"):
        bpy.ops.legorize.booklet(filepath=str(tmp_path / "missing" / "a.html"))


def test_without_a_model_the_buttons_are_grey():
    """There is nothing to draw."""
    assert not bpy.ops.legorize.booklet.poll()
    assert not bpy.ops.legorize.layer_maps.poll()


@pytest.mark.parametrize("what", ["booklet", "maps"])
def test_stopped_work_leaves_nothing(build, what, tmp_path):
    """Whoever presses Esc finds the folder as it was."""
    bricks, steps, old = read_bricks(build), steps_of(build), tmp_path / "a.html"
    old.write_text("old", encoding="utf-8")
    requests = {
        "booklet": BookletRequest(bricks, steps, Title("Table"), "A4", old),
        "maps": MapsRequest(bricks, "A4", False, Path(tmp_path / "maps")),
    }

    def stop(stage: str, share: float) -> None:
        if share > 0.2:
            raise Cancelled

    with pytest.raises(Cancelled):
        requests[what].work(stop)
    assert [path.name for path in tmp_path.iterdir()] == ["a.html"]
    assert old.read_text(encoding="utf-8") == "old"


def test_a_stopped_booklet_goes_on(build, tmp_path, monkeypatch):
    """Asked for again, its first pages are there; the files are those of a run that was not stopped."""
    assert bpy.ops.legorize.booklet(filepath=str(tmp_path / "whole.html")) == {"FINISHED"}
    request = BookletRequest(read_bricks(build), steps_of(build), Title("Table"), "A4", tmp_path / "a.html")
    drawn = []
    monkeypatch.setattr(booklet, "svg", lambda page, name: drawn.append(name) or svg(page, name=name))

    def stop(stage: str, share: float) -> None:
        if share > 0.6:
            raise Cancelled

    with pytest.raises(Cancelled):
        request.work(stop)
    n_first = len(drawn)
    request.work(lambda stage, share: None)
    assert 0 < n_first < len(drawn) == len(set(drawn))
    for suffix in (".html", ".pdf"):
        assert (tmp_path / f"a{suffix}").read_bytes() == (tmp_path / f"whole{suffix}").read_bytes()


def test_a_name_in_other_scripts_is_drawn(build, tmp_path):
    """A name in Greek or Chinese letters is outlines in both files; what no font has is told."""
    build.name = "Legorize Αλεπού 狐"
    assert bpy.ops.legorize.booklet(filepath=str(tmp_path / "a.html")) == {"FINISHED"}
    text = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "<title>Αλεπού 狐: building instructions</title>" in text
    assert ">Αλεπού" not in text[text.index("<svg") :]
    assert b"[U+" not in (tmp_path / "a.pdf").read_bytes()


def test_no_name_is_one_of_blenders_own():
    """A property of every operator, as its options, would be hidden by a name of ours, or hide it."""
    own = {entry.identifier for entry in bpy.types.Operator.bl_rna.properties}
    for operator in (*instructions.classes, instructions.OnPaper):
        assert not {name for name in vars(operator) if not name.startswith("bl_")} & own
