"""The button that shows the weakest brick."""

from __future__ import annotations

from typing import Final

import bpy
from mathutils import Vector

from ..core.units import STUD
from ..scene import state_of
from ..view import show_weakest
from .build import OnBuild
from .properties import current_build

STUDS_AWAY: Final = 16
"""How far the view stands from the brick: near enough to tell bricks apart, far enough to see where it is."""


class LEGORIZE_OT_show_weakest(OnBuild, bpy.types.Operator):
    """Turn the view to the weakest brick."""

    bl_idname = "legorize.show_weakest"
    bl_label = "Show Weakest Brick"
    bl_description = (
        "Show the heat map, hide the layers above the weakest brick, and turn the view to it; Top Layer shows the "
        "layers again"
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


register, unregister = bpy.utils.register_classes_factory((LEGORIZE_OT_show_weakest,))
