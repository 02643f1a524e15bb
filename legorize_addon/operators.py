"""Build and remove: from the context to the core, from the core to the scene, and what to tell the user."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.handlers import persistent

from . import job
from .core.errors import BuildError, Cancelled, LegorizeError
from .core.progress import Progress
from .core.settings import Settings
from .core.units import MM_PER_METRE
from .properties import current_build, label, settings_of
from .reading.shown import has_surface
from .result import show_result
from .scene import BUILD_KEY, OWN_KEY, builds, builds_of, clear_build, show_sources, sources_of
from .view import readable

if TYPE_CHECKING:
    from .core.build import Build
    from .core.mesh import TriangleMesh

TICK: Final = 0.1
"""Seconds between two looks at a running job."""

NAVIGATION: Final = frozenset(
    {"MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "TRACKPADPAN", "TRACKPADZOOM"}
)
"""Events that pass while a job runs: one may look around, not change the scene under its feet."""


@dataclass(frozen=True, slots=True, eq=False)
class Order:
    """What a build is made of, read on the main thread.

    Attributes
    ----------
    name : str
        Of the model: the names of its source objects.
    scene : int
        Session identifier of the scene that gets the model.
    sources : tuple of int
        Session identifiers of the objects: references to them would not outlive an undo, and a linked object and one of
        the file may have the same name.
    mesh : TriangleMesh
        Their surface.
    remarks : tuple of str
        What could not be read literally.
    settings : Settings
        The user's choices.
    mm_per_unit : float
        World mm per Blender unit.
    """

    name: str
    scene: int
    sources: tuple[int, ...]
    mesh: TriangleMesh
    remarks: tuple[str, ...]
    settings: Settings
    mm_per_unit: float

    def work(self, progress: Progress) -> Build:
        """Run the core; no Blender in here."""
        from .core.pipeline import legorize

        return legorize(self.mesh, self.settings, progress)


def chosen_sources(context: bpy.types.Context) -> list[bpy.types.Object]:
    """Return the objects to legorize, by name.

    These are the selected objects with a surface, for a selected brick model
    the objects it was made of, and with nothing selected those of the model
    that the panel shows.
    """
    selected = [thing for thing in context.selected_objects if OWN_KEY not in thing and has_surface(thing)]
    models = builds_of(context.scene, [thing for thing in context.selected_objects if OWN_KEY in thing])
    if not selected and not models and current_build(context.scene):
        models = [current_build(context.scene)]
    again = [source for model in models for source in sources_of(model)]
    return sorted({*selected, *again}, key=lambda thing: (thing.name, thing.library.filepath if thing.library else ""))


class Reporting:
    """The one place where an expected failure becomes a report."""

    def reported(self, work: Callable[..., set[str]], *arguments: Any) -> set[str]:
        """Call a function; report its failure and cancel if it has one that the user can mend."""
        try:
            return work(*arguments)
        except LegorizeError as error:
            self.report({"ERROR"}, str(error))
        except Cancelled:
            self.report({"INFO"}, "Stopped: nothing was changed.")
        return {"CANCELLED"}


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
            cls.poll_message_set("A model is being built: wait for it, or press Esc to stop it.")
        elif context.mode != "OBJECT":
            cls.poll_message_set("Leave the edit mode first.")
        elif not chosen_sources(context):
            cls.poll_message_set(cls.nothing_chosen)
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
        order = self._take_order(context)
        return self._show(context, order, order.work(lambda stage, share: None))

    def _start(self, context: bpy.types.Context) -> set[str]:
        self._order = self._take_order(context)
        self._job = job.Job(self._order.work)
        self._timer = context.window_manager.event_timer_add(TICK, window=context.window)
        context.window_manager.modal_handler_add(self)
        self._job.start()
        return {"RUNNING_MODAL"}

    def _show_progress(self, context: bpy.types.Context) -> None:
        stage, share = self._job.progress
        text = "Stopping" if self._job.stopping else f"{label(stage)} {share:.0%} (Esc to stop)"
        context.workspace.status_text_set(f"Legorize: {text}")
        _redraw(context)

    def _finish(self, context: bpy.types.Context) -> set[str]:
        return self._show(context, self._order, self._job.result())

    def _close(self, context: bpy.types.Context) -> None:
        if self._timer is not None:
            context.window_manager.event_timer_remove(self._timer)
            self._timer = None
        if context.workspace is not None:
            context.workspace.status_text_set(None)
        _redraw(context)


class LEGORIZE_OT_build(Working, bpy.types.Operator):
    """Make a brick model of the chosen objects."""

    bl_idname = "legorize.build"
    bl_label = "Legorize"
    bl_description = (
        "Build the selected objects of bricks, in place of an earlier model of theirs; "
        "the objects are hidden, not changed, and come back when the model is removed"
    )
    bl_options = {"REGISTER", "UNDO"}

    nothing_chosen = "Select an object with a surface."

    def _take_order(self, context: bpy.types.Context) -> Order:
        return order_of(context, chosen_sources(context), settings_of(context.scene.legorize.settings))

    def _show(self, context: bpy.types.Context, order: Order, build: Build) -> set[str]:
        [scene] = _by_uid(bpy.data.scenes, [order.scene]) or [None]
        if scene is None:
            raise BuildError("The scene was deleted while its model was being built: open another one and start again.")
        notes = (*order.remarks, *build.notes)
        view = scene.legorize
        collection = show_result(
            scene,
            build,
            mm_per_unit=order.mm_per_unit,
            name=order.name,
            sources=_by_uid(bpy.data.objects, order.sources),
            notes=notes,
            detail=view.detail,
        )
        view.build = collection
        view.show_sources = False
        if scene == context.scene:
            _select_only(context, collection[BUILD_KEY]["root"])
        self.report({"INFO"}, f"Built of {len(build.bricks)} bricks.")
        for note in notes:
            self.report({"WARNING"}, note)
        return {"FINISHED"}


class OnBuild(Reporting):
    """What works on the build that the panel shows."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is a build, and why not."""
        if job.running():
            cls.poll_message_set("A model is being built: wait for it, or press Esc to stop it.")
        elif not current_build(context.scene):
            cls.poll_message_set("Legorize an object first.")
        else:
            return True
        return False


class LEGORIZE_OT_clear(OnBuild, bpy.types.Operator):
    """Remove the build that the panel shows."""

    bl_idname = "legorize.clear"
    bl_label = "Remove Model"
    bl_description = "Remove the brick model and show the objects that it was made of again"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Remove the build."""
        clear_build(context.scene, current_build(context.scene))
        return {"FINISHED"}


def order_of(context: bpy.types.Context, sources: Sequence[bpy.types.Object], settings: Settings) -> Order:
    """Read objects, which may be hidden, for a build.

    Parameters
    ----------
    context : bpy.types.Context
        Its scene has the objects.
    sources : sequence of bpy.types.Object
        With a surface.
    settings : Settings
        Of the build.

    Returns
    -------
    Order
    """
    from .read_mesh import read_objects

    with readable(sources):
        context.view_layer.update()
        mesh, remarks = read_objects(sources, context.evaluated_depsgraph_get())
    return Order(
        name=" + ".join(source.name for source in sources),
        scene=context.scene.session_uid,
        sources=tuple(source.session_uid for source in sources),
        mesh=mesh,
        remarks=remarks,
        settings=settings,
        mm_per_unit=context.scene.unit_settings.scale_length * MM_PER_METRE,
    )


def _by_uid(blocks: Iterable[bpy.types.ID], uids: Sequence[int]) -> list[Any]:
    """Return the datablocks with some session identifiers, without those deleted since."""
    there = {block.session_uid: block for block in blocks}
    return [there[uid] for uid in uids if uid in there]


def _select_only(context: bpy.types.Context, thing: bpy.types.Object) -> None:
    for other in context.selected_objects:
        other.select_set(False)
    thing.select_set(True)
    context.view_layer.objects.active = thing


def _redraw(context: bpy.types.Context) -> None:
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


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


classes = (LEGORIZE_OT_build, LEGORIZE_OT_clear)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the operators, what stops jobs when another file is opened, and what hides its linked sources."""
    _register_classes()
    bpy.app.handlers.load_pre.append(_stop_jobs)
    bpy.app.handlers.load_post.append(_hide_linked_sources)


def unregister() -> None:
    """Undo :func:`register`, after stopping what runs."""
    job.stop()
    bpy.app.handlers.load_post.remove(_hide_linked_sources)
    bpy.app.handlers.load_pre.remove(_stop_jobs)
    _unregister_classes()
