"""The buttons that show the weakest brick and the one of the worst colour, and the switch of the colour errors."""

from __future__ import annotations

from typing import Final

import bpy
from bpy.app.translations import pgettext_n as n
from bpy.props import BoolProperty
from mathutils import Vector

from ..core.units import STUD
from ..scene import damage, is_build, state_of
from ..view import colour_errors_shown, has_colour_errors, show_colour_errors, show_weakest, show_worst_colour
from .current import current_build
from .working import OnBuild

STUDS_AWAY: Final = 16
"""How far the view stands from the brick: near enough to tell bricks apart, far enough to see where it is."""


class LEGORIZE_OT_show_weakest(OnBuild, bpy.types.Operator):
    """Turn the view to the weakest brick."""

    bl_idname = "legorize.show_weakest"
    bl_label = "Show Weakest Brick"
    bl_description = (
        "Show the heat map, hide the layers above the weakest brick, and turn the view to it; the panel Layers "
        "shows them again"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show it."""
        return self.reported(self._show, context)

    def _show(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        place = show_weakest(context.scene, build)
        size = state_of(build).root.matrix_world.median_scale * STUD
        look_at(context, place, size)
        return {"FINISHED"}


def look_at(context: bpy.types.Context, place: Vector, stud: float) -> None:
    """Turn the 3D views of the window to a place in the world, so near that studs of a size can be told apart."""
    for view in _views(context):
        view.view_location, view.view_distance = place, STUDS_AWAY * stud
        if view.view_perspective == "CAMERA":
            view.view_perspective = "PERSP"


def _views(context: bpy.types.Context) -> list[bpy.types.RegionView3D]:
    """Return the 3D views of the window."""
    areas = context.window.screen.areas if context.window else ()
    return [area.spaces.active.region_3d for area in areas if area.type == "VIEW_3D"]


class LEGORIZE_OT_show_worst_colour(OnBuild, bpy.types.Operator):
    """Turn the view to the brick of the worst colour."""

    bl_idname = "legorize.show_worst_colour"
    bl_label = "Show Worst Colour"
    bl_description = (
        "Show the colour errors, hide the layers above the brick that differs most from the texture, and turn the view "
        "to it; the panel Layers shows them again"
    )
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show it."""
        return self.reported(self._show, context)

    def _show(self, context: bpy.types.Context) -> set[str]:
        build = current_build(context.scene)
        place = show_worst_colour(context.scene, build)
        look_at(context, place, state_of(build).root.matrix_world.median_scale * STUD)
        return {"FINISHED"}


def _shown(self: bpy.types.Collection) -> bool:
    return is_build(self) and colour_errors_shown(self)


def _set_shown(self: bpy.types.Collection, value: bool) -> None:
    if is_build(self) and not damage(self) and has_colour_errors(self):
        show_colour_errors(self, visible=value)


_register_classes, _unregister_classes = bpy.utils.register_classes_factory(
    (LEGORIZE_OT_show_weakest, LEGORIZE_OT_show_worst_colour)
)


def register() -> None:
    """Register the buttons, and hang the switch on builds."""
    _register_classes()
    bpy.types.Collection.legorize_colour_errors = BoolProperty(
        name=n("Colour errors"),
        description=n(
            "Colour each brick by how far its colour is from the texture, in the viewport and in renders: blue not at "
            "all, yellow a little, red much"
        ),
        get=_shown,
        set=_set_shown,
    )


def unregister() -> None:
    """Undo :func:`register`."""
    del bpy.types.Collection.legorize_colour_errors
    _unregister_classes()
