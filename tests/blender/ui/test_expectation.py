"""The panel says what the settings will come to, follows them, and follows the objects."""

from __future__ import annotations

import bpy
import pytest

from legorize_addon.ui import expectation
from legorize_addon.ui.expectation import expected

pytestmark = pytest.mark.usefixtures("addon")


@pytest.fixture
def cube() -> bpy.types.Object:
    """Add a cube of 2 m."""
    bpy.ops.mesh.primitive_cube_add()
    return bpy.context.object


def soon() -> tuple[str, ...]:
    """Draw, wait until the objects were read, and draw again."""
    expected(bpy.context)
    assert bpy.app.timers.is_registered(expectation._read)
    expectation._read()
    bpy.app.timers.unregister(expectation._read)
    return expected(bpy.context)


def test_it_is_read_later_and_follows_the_settings(cube) -> None:
    """Drawing reads nothing; after that, each change of a setting counts at once."""
    assert expected(bpy.context) == ()
    lines = soon()
    assert lines[:2] == ("48 x 48 studs, 40 layers", "38.4 x 38.4 x 38.4 cm")
    bpy.context.scene.legorize.settings.width = 24
    assert expected(bpy.context)[0] == "24 x 24 studs, 20 layers"
    assert not bpy.app.timers.is_registered(expectation._read)


def test_it_follows_the_object(cube) -> None:
    """A changed object is read again, another one too."""
    soon()
    cube.scale.z = 2
    bpy.context.view_layer.update()
    assert soon()[0] == "48 x 48 studs, 80 layers"
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.scale.y = 0.5
    bpy.context.view_layer.update()
    assert expected(bpy.context) == ()
    assert soon()[0] == "48 x 24 studs, 40 layers"


def test_a_hidden_object_keeps_its_estimate(cube) -> None:
    """The original that a build hides can be built again: what is known of it still holds."""
    lines = soon()
    expectation._known.changed = True
    cube.hide_viewport = True
    bpy.context.view_layer.update()
    expectation._read()
    assert (
        expectation._lines(expectation._known.mesh, expectation.settings_of(bpy.context.scene.legorize.settings))
        == lines
    )


def test_settings_that_exclude_each_other_are_told(cube) -> None:
    """The sentence stands where the estimate would."""
    soon()
    settings = bpy.context.scene.legorize.settings
    settings.hollow, settings.open_bottom = False, True
    [sentence] = expected(bpy.context)
    assert sentence.startswith("Inside > Open bottom is on but hollow is off")


def test_nothing_is_said_of_nothing() -> None:
    """Without an object there is no estimate, and nothing to read."""
    assert expected(bpy.context) == ()
    assert not bpy.app.timers.is_registered(expectation._read)
