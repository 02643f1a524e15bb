"""What is told of commands: an expected failure is reported, and a sentence stands in the status bar for a while."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import bpy
from bpy.app.translations import pgettext_rpt as rpt

from ..core.errors import Cancelled, LegorizeError, enough_memory
from . import job
from .duplicates import adopt
from .progress_text import STOPPED
from .setting_names import as_in_panel

SAID: Final = 6.0
"""Seconds for which a sentence stays in the status bar: about as long as one of Blender's own."""


class Reporting:
    """The one place where an expected failure becomes a report."""

    def reported(self, work: Callable[..., set[str]], *arguments: Any) -> set[str]:
        """Call a function, for which copies of models are models; report an expected failure and cancel."""
        adopt(bpy.context)
        try:
            with enough_memory():
                return work(*arguments)
        except LegorizeError as error:
            self.report({"ERROR"}, as_in_panel(str(error)))
        except Cancelled:
            self.report({"INFO"}, rpt(STOPPED))
            bpy.context.window_manager.legorize_said = STOPPED
            if not bpy.app.background:
                _say_in_status_bar(bpy.context, rpt(STOPPED))
        return {"CANCELLED"}


def _say_in_status_bar(context: bpy.types.Context, sentence: str) -> None:
    context.workspace.status_text_set(f"Legorize: {sentence}")
    forget_status()
    bpy.app.timers.register(_clear_status, first_interval=SAID)


def _clear_status() -> None:
    if not job.running():
        for workspace in bpy.data.workspaces:
            workspace.status_text_set(None)


def forget_status() -> None:
    """Remove the timers of jobs before their window or file goes away."""
    if bpy.app.timers.is_registered(_clear_status):
        bpy.app.timers.unregister(_clear_status)
