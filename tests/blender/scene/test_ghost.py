"""Originals as ghosts: wires in the viewport alone, and drawn as before when they are hidden or shown."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.scene.builds import ghost_shown, show_ghost, show_sources
from legorize_addon.scene.collections import clear_build
from tests.blender.bricks import show, table
from tests.blender.builders import add_quad

pytestmark = pytest.mark.usefixtures("addon")


def drawn(thing: bpy.types.Object) -> tuple[bool, bool, str, bool]:
    """Return how an object is shown."""
    return thing.hide_viewport, thing.hide_render, thing.display_type, thing.show_in_front


@pytest.fixture
def source() -> bpy.types.Object:
    """Return an object that its owner draws as a box."""
    thing = add_quad()
    thing.display_type = "BOUNDS"
    return thing


def test_it_is_there_in_the_viewport_alone(source: bpy.types.Object) -> None:
    """Wires before everything else, and not in renders."""
    build = show(table([(0, 0, 0, 0, 0, 4)]), source)
    assert not ghost_shown(build)
    show_ghost(build, visible=True)
    assert ghost_shown(build)
    assert drawn(source) == (False, True, "WIRE", True)


def test_hidden_again_it_is_drawn_as_before(source: bpy.types.Object) -> None:
    """The switch leaves nothing behind, and neither does the one that shows originals as they are."""
    build = show(table([(0, 0, 0, 0, 0, 4)]), source)
    show_ghost(build, visible=True)
    show_ghost(build, visible=False)
    assert drawn(source) == (True, True, "BOUNDS", False)
    show_ghost(build, visible=True)
    show_sources(build, visible=True)
    assert drawn(source) == (False, False, "BOUNDS", False)
    assert not ghost_shown(build)


def test_removing_the_model_gives_the_original_back(source: bpy.types.Object) -> None:
    """Visible in the viewport and in renders, drawn as its owner wants it."""
    build = show(table([(0, 0, 0, 0, 0, 4)]), source)
    show_ghost(build, visible=True)
    clear_build(bpy.context.scene, build)
    assert drawn(source) == (False, False, "BOUNDS", False)
