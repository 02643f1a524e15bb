"""The button for mosaics: from an image of the file to bricks in the scene."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.scene.builds import builds
from legorize_addon.scene.collections import read_bricks


@pytest.fixture
def image() -> bpy.types.Image:
    """Return an image, red in its lower half and blue above."""
    found = bpy.data.images.new("picture", 8, 8)
    pixels = np.zeros((8, 8, 4), dtype=np.float32)
    pixels[..., 3], pixels[:4, :, 0], pixels[4:, :, 2] = 1, 1, 1
    found.pixels.foreach_set(pixels.ravel())
    return found


@pytest.fixture
def settings(addon) -> bpy.types.PropertyGroup:
    """Return the settings of the scene, for small mosaics in two colours."""
    group = bpy.context.scene.legorize.settings
    group.width, group.palette, group.mosaic = 8, "1,4", "plates"
    return group


def test_an_image_of_the_panel_becomes_a_mosaic(image, settings) -> None:
    """It lies around the origin with its lower edge in front; the same again takes its place."""
    bpy.context.scene.legorize.image = image
    assert bpy.ops.legorize.image() == {"FINISHED"}
    [build] = builds(bpy.context.scene)
    bricks = read_bricks(build)
    front = bricks.corner[bricks.colour == 4, 1]
    back = bricks.corner[bricks.colour == 1, 1]
    assert front.max() < back.min()
    assert build.name == "Legorize picture"
    assert bpy.ops.legorize.image() == {"FINISHED"}
    assert len(builds(bpy.context.scene)) == 1
    settings.width = 6
    assert bpy.ops.legorize.image() == {"FINISHED"}
    [build] = builds(bpy.context.scene)
    assert read_bricks(build).corner[:, 0].max() < 6


def test_an_image_of_an_empty_becomes_a_mosaic(image, settings) -> None:
    """Without an image in the panel that of the selected empty is taken; without any the button says why."""
    assert not bpy.ops.legorize.image.poll()
    empty = bpy.data.objects.new("reference", None)
    empty.empty_display_type, empty.data = "IMAGE", image
    bpy.context.scene.collection.objects.link(empty)
    empty.select_set(True)
    assert bpy.ops.legorize.image.poll()
    assert bpy.ops.legorize.image() == {"FINISHED"}
    assert len(builds(bpy.context.scene)) == 1
    assert not empty.hide_get()


def test_what_cannot_be_built_is_reported(image, settings) -> None:
    """One sentence, and the scene stays as it was."""
    bpy.context.scene.legorize.image = image
    settings.border = 4
    with pytest.raises(RuntimeError, match="leaves nothing"):
        bpy.ops.legorize.image()
    assert not builds(bpy.context.scene)
