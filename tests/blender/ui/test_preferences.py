"""What the preferences keep goes to new files, and never over what a scene has of its own."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest

from legorize_addon.ui import preferences
from legorize_addon.ui.preferences import KEPT, PACKAGE, take

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """Return preferences; Blender itself keeps them only of installed extensions."""
    own = SimpleNamespace(palette="4, 15", prices="", owned="box.csv")
    monkeypatch.setattr(preferences, "preferences", lambda: own)
    return own


def settings() -> bpy.types.PropertyGroup:
    """Return the settings of the scene."""
    return bpy.context.scene.legorize.settings


def test_new_files_begin_with_them(kept) -> None:
    """Opened without a name, a file gets what there is, and nothing where there is nothing."""
    preferences._begin()
    assert [getattr(settings(), name) for name in KEPT] == ["4, 15", "", "box.csv"]
    assert not settings().is_property_set("prices")


def test_saved_files_and_own_choices_stay(kept, tmp_path) -> None:
    """A scene that has a palette keeps it; a file that has a name is somebody's work."""
    settings().palette = "1"
    take(bpy.context.scene, kept)
    assert settings().palette == "1"
    settings().property_unset("owned")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"))
    preferences._begin()
    assert settings().owned == ""


def test_both_ways_by_buttons(kept) -> None:
    """The scene's choices are kept, and come back."""
    settings().palette = "1, 2"
    assert bpy.ops.legorize.keep_preferences() == {"FINISHED"}
    assert (kept.palette, kept.owned) == ("1, 2", "")
    settings().palette = "4"
    assert bpy.ops.legorize.take_preferences() == {"FINISHED"}
    assert settings().palette == "1, 2"


def test_without_an_extension_the_buttons_say_why() -> None:
    """Run from its sources, Blender keeps nothing."""
    assert PACKAGE == "legorize_addon"
    assert preferences.preferences() is None
    with pytest.raises(RuntimeError, match="Install Legorize as an extension first"):
        bpy.ops.legorize.keep_preferences()
    with pytest.raises(RuntimeError, match="Install Legorize as an extension first"):
        bpy.ops.legorize.take_preferences()
