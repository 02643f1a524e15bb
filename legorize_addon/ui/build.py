"""Build and remove: from the context to the core, from the core to the scene, and what to tell the user."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_iface as iface
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_rpt as rpt
from bpy.app.translations import pgettext_tip as tip

from ..core.errors import BuildError, LimitError
from ..scene import Source, builds, clear_build, damage, orphans, show_orphans, show_sources, state_of, sweep
from ..view import show_result, shows_step
from . import counts, job
from .build_larger import ask
from .duplicates import adopt
from .live import leave_preview
from .progress_text import progress_text
from .properties import current_build
from .reporting import Reporting, forget_status
from .requests import BuildRequest, build_request, by_uid, chosen_sources, why_nothing
from .session import SESSION
from .setting_names import as_in_panel
from .settings_properties import settings_of, take_renamed
from .tab import redraw

if TYPE_CHECKING:
    from ..core.build import Build

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


class Building(Working):
    """What makes a brick model of objects; afresh, or from what earlier runs of the session have found."""

    afresh = True
    nothing_chosen = n("Select an object with a surface.")

    larger: bpy.props.BoolProperty(
        name="Larger Than the Limits",
        description="Also build models above the limits of the settings",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    def _sources(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to build."""
        return chosen_sources(context)

    def _take_order(self, context: bpy.types.Context) -> BuildRequest:
        renamed = take_renamed(context.scene.legorize.settings)
        order = build_request(context, self._sources(context), settings_of(context.scene.legorize.settings))
        # also one that is still being made
        leave_preview(context)
        trial = SESSION.memo.trial(afresh=self.afresh)
        order = replace(order, remarks=(*renamed, *order.remarks), trial=trial)
        return order.within_limits() if self.larger else order

    def _begin(self, context: bpy.types.Context, order: BuildRequest) -> set[str]:
        try:
            order.check_limits()
        except LimitError as reason:
            ask(as_in_panel(str(reason)))
            return {"CANCELLED"}
        return super()._begin(context, order)

    def _show(self, context: bpy.types.Context, order: BuildRequest, build: Build) -> set[str]:
        # which knows this module
        from .edits import list_edits
        from .parts import list_parts_of

        [scene] = by_uid(bpy.data.scenes, [order.scene]) or [None]
        if scene is None:
            raise BuildError("The scene was deleted while its model was being built: open another one and start again.")
        notes = (*order.remarks, *build.notes)
        view = scene.legorize
        collection = show_result(
            scene,
            build,
            Source(order.name, by_uid(bpy.data.objects, order.sources), notes=notes),
            mm_per_unit=order.mm_per_unit,
            detail=view.detail,
            replaces=by_uid(bpy.data.collections, order.replaces),
        )
        list_parts_of(collection, build)
        list_edits(collection)
        if order.trial is not None:
            SESSION.keep(order.trial, collection)
        view.build = collection
        view.show_sources = False
        if scene == context.scene:
            select_only(context, state_of(collection).root)
        self.report({"INFO"}, rpt("Model built: {}.").format(counts.bricks(len(build.bricks))))
        for note in notes:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


class LEGORIZE_OT_build(Building, bpy.types.Operator):
    """Make a brick model of the chosen objects."""

    bl_idname = "legorize.build"
    bl_label = "Legorize"
    bl_description = (
        "Turn the selected objects into a brick model, which replaces their earlier one; the objects are hidden, "
        "not changed, and come back when the model is removed"
    )
    bl_options = {"REGISTER", "UNDO"}


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


class LEGORIZE_OT_clear(OnBuild, bpy.types.Operator):
    """Remove the build that the panel shows."""

    bl_idname = "legorize.clear"
    bl_label = "Remove Model"
    bl_description = "Remove the brick model and show its original objects again"
    bl_options = {"REGISTER", "UNDO"}
    mends = of_steps = True

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Remove the build."""
        adopt(context)
        leave_preview(context)
        clear_build(context.scene, current_build(context.scene))
        return {"FINISHED"}


class LEGORIZE_OT_show_originals(bpy.types.Operator):
    """Show what a model hid that was deleted since."""

    bl_idname = "legorize.show_originals"
    bl_label = "Show Originals"
    bl_description = "Show the original objects of brick models that were deleted"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there are such objects."""
        cls.poll_message_set(tip("There are no hidden originals of deleted models."))
        return bool(orphans(context.scene))

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Show and select them, and clear up what the model left behind."""
        sources = show_orphans(context.scene)
        sweep()
        select_only(context, *sources)
        self.report({"INFO"}, rpt("Shown again: {}.").format(", ".join(source.name for source in sources)))
        return {"FINISHED"}


def select_only(context: bpy.types.Context, *things: bpy.types.Object) -> None:
    """Select some objects and no other one."""
    for other in context.selected_objects:
        other.select_set(False)
    # what lies in an unticked collection cannot be selected
    for thing in (thing for thing in things if thing.name in context.view_layer.objects):
        thing.select_set(True)
        context.view_layer.objects.active = thing


@persistent
def _stop_jobs(*arguments: Any) -> None:
    job.stop()


@persistent
def _hide_linked_sources(*arguments: Any) -> None:
    """Hide the sources of builds again that belong to other files: this one cannot keep that they are hidden."""
    for scene in bpy.data.scenes:
        for build in builds(scene):
            if not (scene.legorize.show_sources and build == current_build(scene)):
                show_sources(build, visible=False, linked_only=True)


classes = (LEGORIZE_OT_build, LEGORIZE_OT_clear, LEGORIZE_OT_show_originals)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the operators, what stops jobs when another file is opened, and what hides its linked sources."""
    _register_classes()
    bpy.app.handlers.load_pre.append(_stop_jobs)
    bpy.app.handlers.load_post.append(_hide_linked_sources)


def unregister() -> None:
    """Undo :func:`register`, after stopping what runs."""
    job.stop()
    forget_status()
    bpy.app.handlers.load_post.remove(_hide_linked_sources)
    bpy.app.handlers.load_pre.remove(_stop_jobs)
    _unregister_classes()
