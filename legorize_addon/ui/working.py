"""What operators have in common: long work in a thread with its progress, file browsers before it, work on a build."""

from __future__ import annotations

from typing import Any, Final

import bpy
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_tip as tip

from ..scene import damage
from ..view import shows_step
from . import job
from .current import current_build
from .progress_text import progress_text
from .reporting import Reporting
from .requests import chosen_sources, why_nothing
from .tab import redraw

TICK: Final = 0.1
"""Seconds between two looks at a running job."""

BUSY: Final = n("A model is being built: wait for it, or press Esc to stop it.")

NAVIGATION: Final = frozenset(
    {"MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM"}
)
"""Events that are allowed while a job runs: looking around, but not changing the scene."""


def leave_mode(context: bpy.types.Context) -> None:
    """Go to Object Mode from any other, in which objects hold what was changed last; undo comes back to it."""
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


class Working(Reporting):
    """What takes long: done in a worker thread where there is a window, and straight through where there is none.

    A class that has this one among its bases is an operator with the sentence
    ``nothing_chosen``, to be shown where nothing is selected, and two methods:
    ``_take_order(context)`` returns what ``work(progress)`` can be called of, and
    ``_show(context, order, result)`` shows what came of it.
    """

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is something to work on, and why not."""
        if job.running():
            cls.poll_message_set(tip(BUSY))
        elif not chosen_sources(context):
            # looked for when the reason is read, not whenever the button is drawn
            cls.poll_message_set(why_nothing, context.scene, context.view_layer, cls.nothing_chosen)
        else:
            return True
        return False

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Work in a worker thread, so that Blender stays alive."""
        if bpy.app.background:
            return self.execute(context)
        return self.reported(self._start, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Work straight through."""
        return self.reported(self._work_now, context)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Show how far the job has come; show its result at the end."""
        if self._timer is None:
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            self._job.cancel()
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if event.type in NAVIGATION else {"RUNNING_MODAL"}
        self._show_progress(context)
        if self._job.is_alive():
            return {"RUNNING_MODAL"}
        self._close(context)
        return self.reported(self._finish, context)

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop: Blender closes the window or opens another file."""
        job.stop()
        self._close(context)

    def _work_now(self, context: bpy.types.Context) -> set[str]:
        leave_mode(context)
        order = self._take_order(context)
        return self._show(context, order, order.work(lambda stage, share: None))

    def _start(self, context: bpy.types.Context) -> set[str]:
        context.window_manager.legorize_said = ""
        leave_mode(context)
        return self._begin(context, self._take_order(context))

    def _begin(self, context: bpy.types.Context, order: Any) -> set[str]:
        self._order = order
        self._job = job.Job(self._order.work)
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        self._job.start()
        return {"RUNNING_MODAL"}

    def _show_progress(self, context: bpy.types.Context) -> None:
        text = progress_text(*self._job.progress, self._job.seconds_left, stopping=self._job.stopping)
        context.workspace.status_text_set(
            f"Legorize: {text}" + ("" if self._job.stopping else f" ({iface('Esc stops')})")
        )
        redraw(context)

    def _finish(self, context: bpy.types.Context) -> set[str]:
        return self._show(context, self._order, self._job.result())

    def _close(self, context: bpy.types.Context) -> None:
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        redraw(context)


class Browsing(Working):
    """What works on a file that is asked for first.

    Attributes
    ----------
    kept : tuple of str
        Its properties, the path among them, which go on to the work.
    """

    kept: tuple[str, ...] = ("filepath",)
    _browsed = False

    def propose(self, context: bpy.types.Context) -> None:
        """Set the path that the file browser begins with; that of last time if there is nothing to propose."""

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask for the file; start the work once there is one."""
        if self.chosen:
            return Working.invoke(self, context, event)
        self.propose(context)
        self._browsed = True
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Work straight through; after the file browser, which ends this operator, in another one with progress."""
        if bpy.app.background or not self._browsed:
            return Working.execute(self, context)
        call = getattr(bpy.ops.legorize, type(self).bl_idname.partition(".")[2])
        return call("INVOKE_DEFAULT", chosen=True, **{name: getattr(self, name) for name in self.kept})


A_STEP: Final = n("This is a step of the method, not a model to build.")


class OnBuild(Reporting):
    """What works on the build that the panel shows.

    Attributes
    ----------
    mends : bool
        Whether it works on a damaged one, too.
    of_steps : bool
        Whether it works on a step of the method, too.
    """

    mends = False
    of_steps = False

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is a build, and why not."""
        if job.running():
            cls.poll_message_set(tip(BUSY))
        elif not current_build(context.scene):
            cls.poll_message_set(tip("Legorize an object first."))
        elif not cls.mends and damage(current_build(context.scene)):
            cls.poll_message_set(damage(current_build(context.scene)).removesuffix("."))
        elif not cls.of_steps and shows_step(current_build(context.scene)):
            cls.poll_message_set(tip(A_STEP))
        else:
            return True
        return False


def select_only(context: bpy.types.Context, *things: bpy.types.Object) -> None:
    """Select some objects and no other one."""
    for other in context.selected_objects:
        other.select_set(False)
    # what lies in an unticked collection cannot be selected
    for thing in (thing for thing in things if thing.name in context.view_layer.objects):
        thing.select_set(True)
        context.view_layer.objects.active = thing
