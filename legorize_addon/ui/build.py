"""Build and remove: from the context to the core, from the core to the scene, and what to tell the user."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_n as n
from bpy.app.translations import pgettext_rpt as rpt
from bpy.app.translations import pgettext_tip as tip

from ..core.errors import BuildError, LimitError
from ..scene import Source, builds, clear_build, orphans, show_orphans, show_sources, state_of, sweep
from ..view import show_result
from . import counts, job
from .build_larger import ask
from .current import current_build
from .duplicates import adopt
from .live import leave_preview
from .reporting import forget_status
from .requests import BuildRequest, build_request, by_uid, chosen_sources
from .session import SESSION
from .setting_names import as_in_panel
from .settings_properties import settings_of, take_renamed
from .working import OnBuild, Working, select_only

if TYPE_CHECKING:
    from ..core.build import Build


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
