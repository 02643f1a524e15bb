"""The weakest brick is found, seen from above, and in its place in the world."""

from __future__ import annotations

import bpy
import numpy as np
import pytest

from legorize_addon.core.errors import BuildError
from legorize_addon.core.model.assembly import Assembly
from legorize_addon.core.model.catalogue import load_catalogue
from legorize_addon.core.statics.stability import stability
from legorize_addon.scene.brick_points import middles
from legorize_addon.scene.placing import world_from_mm
from legorize_addon.scene.state import state_of
from legorize_addon.view.heat_map import heat_map_shown
from legorize_addon.view.weakest import show_weakest
from tests.blender.bricks import show, table

pytestmark = pytest.mark.usefixtures("addon")

CATALOGUE = load_catalogue()
ONE, BEAM = CATALOGUE.part_row("3005"), CATALOGUE.part_row("3008")
# a long beam to one side on a tower, with more of the tower above
ARM = table([(ONE, 0, 0, 0, 0, 4), (ONE, 0, 0, 3, 0, 4), (BEAM, 0, 0, 6, 0, 4), (ONE, 0, 0, 9, 0, 4)])


def test_it_is_shown_without_what_lies_above() -> None:
    """The heat map is on, the layers end with it, and its place is that of the object that was moved."""
    found = stability(Assembly(ARM, CATALOGUE))
    weakest = int(found.margin_by_studs.argmin())
    build = show(ARM, stability=found)
    state_of(build).root.location = (3, 2, 1)
    bpy.context.view_layer.update()
    place = show_weakest(bpy.context.scene, build)
    assert heat_map_shown(build)
    assert state_of(build).top_layer == ARM.corner[weakest, 2] // 3 + 1
    expected = world_from_mm(build) @ place.__class__(middles(ARM, CATALOGUE)[weakest])
    np.testing.assert_allclose(place, expected, atol=1e-5)


def test_what_was_not_checked_is_told() -> None:
    """A build without margins has no weakest brick."""
    build = show(ARM)
    with pytest.raises(BuildError, match="was not checked"):
        show_weakest(bpy.context.scene, build)


def test_the_button_works_without_a_window() -> None:
    """There is no view to turn then, but layers and heat map are shown."""
    build = show(ARM, stability=stability(Assembly(ARM, CATALOGUE)))
    assert bpy.ops.legorize.show_weakest() == {"FINISHED"}
    assert heat_map_shown(build)
