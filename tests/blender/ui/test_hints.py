"""Hints are there until there is a model, or until they were closed for good."""

from __future__ import annotations

from types import SimpleNamespace

import bpy
import pytest

from legorize_addon.ui import hints, preferences
from tests.blender.bricks import show, table

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def kept(monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """Return preferences; Blender itself keeps them only of installed extensions."""
    own = SimpleNamespace(show_hints=True)
    monkeypatch.setattr(hints, "preferences", lambda: own)
    return own


def test_hints_go_when_there_is_a_model(kept) -> None:
    """An empty file has them, one with a model in any scene has not."""
    assert hints.hints_wanted()
    show(table([(0, 0, 0, 0, 0, 4)]))
    assert not hints.hints_wanted()
    bpy.context.window.scene = bpy.data.scenes.new("other")
    assert not hints.hints_wanted()


def test_closed_is_kept(kept) -> None:
    """The cross switches the preference off, and switched on again it brings them back."""
    assert bpy.ops.legorize.close_hints() == {"FINISHED"}
    assert not kept.show_hints
    assert not hints.hints_wanted()
    kept.show_hints = True
    assert hints.hints_wanted()


def test_none_where_nothing_can_be_kept() -> None:
    """Run from its sources, the add-on has no preferences, and no box that would come again and again."""
    assert preferences.preferences() is None
    assert not hints.hints_wanted()
    assert not bpy.ops.legorize.close_hints.poll()


def test_on_at_first() -> None:
    """The preference is on by default."""
    assert preferences.LegorizePreferences.bl_rna.properties["show_hints"].default is True
