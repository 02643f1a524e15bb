"""The question before a model is built that is larger than the limits of the settings."""

from __future__ import annotations

from typing import Final

import bpy

from .tab import PIXELS_PER_LETTER, wrapped

WIDTH: Final = 400
"""Width of the question in pixels."""


def ask(reason: str) -> None:
    """Ask whether to build a model all the same; the answer builds it."""
    bpy.ops.legorize.build_larger("INVOKE_DEFAULT", reason=reason)


class LEGORIZE_OT_build_larger(bpy.types.Operator):
    """Ask before a model is built that is larger than the limits of the settings."""

    bl_idname = "legorize.build_larger"
    bl_label = "Build This Large Model?"
    bl_description = "Build the model although it is above the limits of the settings"
    bl_options = {"INTERNAL"}

    reason: bpy.props.StringProperty(
        name="Reason",
        description="The estimated size of the model",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask."""
        return context.window_manager.invoke_props_dialog(self, width=WIDTH, confirm_text="Build")

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the sentence."""
        lines = self.layout.column(align=True)
        for row, line in enumerate(wrapped(self.reason, int(WIDTH / PIXELS_PER_LETTER))):
            lines.label(text=line, icon="BLANK1" if row else "QUESTION")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Build it."""
        bpy.ops.legorize.build("INVOKE_DEFAULT", larger=True)
        return {"FINISHED"}


classes = (LEGORIZE_OT_build_larger,)
register, unregister = bpy.utils.register_classes_factory(classes)
