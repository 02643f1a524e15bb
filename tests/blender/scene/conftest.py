"""What the tests of the scene share."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
import pytest

import legorize_addon


@pytest.fixture
def registered() -> Iterator[None]:
    """Register the add-on for one test."""
    legorize_addon.register()
    yield
    legorize_addon.unregister()


@pytest.fixture
def cube() -> bpy.types.Object:
    """Return a selected cube."""
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.scene.legorize.settings.width = 6
    return bpy.context.object
