"""What to do first, in a box of the panel, until there is a model or the box is closed for good."""

from __future__ import annotations

from typing import Final

import bpy
from bpy.app.translations import pgettext_n as n

from ..scene import builds
from .preferences import preferences
from .tab import draw_wrapped

HINTS: Final = (
    n("1. Select an object"),
    n("2. Choose a size"),
    n("3. Press Legorize"),
    n("4. Then: Layers has the building steps and the booklet"),
)


def hints_wanted() -> bool:
    """Tell whether the preferences have hints on and no scene of the file has a model."""
    kept = preferences()
    return kept is not None and kept.show_hints and not any(builds(scene) for scene in bpy.data.scenes)


def draw_hints(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Draw the box with its cross, where it is wanted."""
    if not hints_wanted():
        return
    box = layout.box().column(align=True)
    head = box.row()
    head.label(text="First steps", icon="HELP")
    head.operator(LEGORIZE_OT_close_hints.bl_idname, text="", icon="X", emboss=False)
    for hint in HINTS:
        draw_wrapped(context, box, hint, "NONE")


class LEGORIZE_OT_close_hints(bpy.types.Operator):
    """Switch the hints off in the preferences."""

    bl_idname = "legorize.close_hints"
    bl_label = "Close Hints"
    bl_description = "Do not show the hints any more; the preferences of the add-on bring them back"
    bl_options = {"REGISTER", "INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there are preferences to keep it in."""
        return preferences() is not None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Keep it for all files."""
        preferences().show_hints = False
        context.preferences.is_dirty = True
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((LEGORIZE_OT_close_hints,))
