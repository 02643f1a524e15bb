"""Update a build: only what a change of settings reaches is computed; and builds side by side of the same objects."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_tip as tip

from ..core.errors import LegorizeError
from ..scene import builds, damage, is_own, sources_of, stand_beside
from ..view import edits_of
from . import job
from .build import Building
from .current import current_build
from .requests import BuildRequest, resolved_settings
from .session import SESSION
from .setting_names import as_in_panel
from .settings_properties import settings_of
from .working import BUSY

if TYPE_CHECKING:
    from ..core.build import Build


class _Again(Building):
    """Works on the objects of the build that the panel shows, whatever is selected."""

    afresh = False

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is a build that can be made again, and why not."""
        build = current_build(context.scene)
        if not build:
            cls.poll_message_set(tip("Legorize an object first."))
        elif damage(build):
            cls.poll_message_set(damage(build).removesuffix("."))
        elif not sources_of(build):
            cls.poll_message_set(tip("This model was not made of an object in the scene."))
        elif job.running():
            cls.poll_message_set(tip(BUSY))
        else:
            # they may be in another scene, from which the model was pasted, where nothing can be selected
            return True
        return False

    def _take_order(self, context: bpy.types.Context) -> BuildRequest:
        return replace(super()._take_order(context), edits=edits_of(current_build(context.scene)))

    def _sources(self, context: bpy.types.Context) -> list[bpy.types.Object]:
        return sorted(sources_of(current_build(context.scene)), key=lambda source: source.name)


class LEGORIZE_OT_update(_Again, bpy.types.Operator):
    """Make the build that the panel shows again with the settings as they are now."""

    bl_idname = "legorize.update"
    bl_label = "Update"
    bl_description = "Make this model again with the settings as they are now"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Say what will be done again."""
        return f"{tip(cls.bl_description)}. {_outlook(context)}".removesuffix(".")

    def _take_order(self, context: bpy.types.Context) -> BuildRequest:
        order = super()._take_order(context)
        return replace(order, replaces=(current_build(context.scene).session_uid,))


class LEGORIZE_OT_build_beside(_Again, bpy.types.Operator):
    """Make another build of the same objects, next to those that are there."""

    bl_idname = "legorize.build_beside"
    bl_label = "Build Beside"
    bl_description = (
        "Make another model of the same objects with the settings as they are now, next to this one, which stays as "
        "it is with its own settings"
    )
    bl_options = {"REGISTER", "UNDO"}

    def _take_order(self, context: bpy.types.Context) -> BuildRequest:
        return replace(super()._take_order(context), replaces=())

    def _show(self, context: bpy.types.Context, order: BuildRequest, build: Build) -> set[str]:
        before = current_build(context.scene)
        shown = super()._show(context, order, build)
        stand_beside(context.scene, context.scene.legorize.build, before)
        return shown


def _outlook(context: bpy.types.Context) -> str:
    """Say what an update will compute again if the objects are as they were."""
    from ..core.memo import reached
    from ..core.progress import Overall, silent
    from ..core.run import Run

    build = current_build(context.scene)
    steps = None if build is None else SESSION.steps_of(build)
    if steps is None:
        return tip("Everything is computed, because this model was not made since the file was opened.")
    try:
        settings = resolved_settings(settings_of(context.scene.legorize.settings))
        stages = reached(steps, Run.of(settings, Overall({}, silent)).answer)
    except LegorizeError as error:
        return as_in_panel(str(error))
    done = (
        tip("Computed again: {}.").format(", ".join(stages)) if stages else tip("No setting has changed that counts.")
    )
    return f"{done} {tip('Kept for this: {:.0f} MB.').format(SESSION.memo.nbytes / 1e6)}"


def follow(scene: bpy.types.Scene, thing: bpy.types.Object | None) -> None:
    """Let the panel show the build that an object belongs to, if it belongs to one."""
    if thing is None or not is_own(thing):
        return
    for build in builds(scene):
        if thing in set(build.all_objects) and build != scene.legorize.build:
            scene.legorize.build = build
            return


def _follow_active() -> None:
    """Follow the active object of the window's scene."""
    context = bpy.context
    if context.view_layer is not None:
        follow(context.scene, context.view_layer.objects.active)


_OWNER: Final = object()
"""Of what listens to Blender."""


@persistent
def _listen(*arguments: object) -> None:
    """Ask Blender to tell when another object becomes the active one."""
    bpy.msgbus.clear_by_owner(_OWNER)
    bpy.msgbus.subscribe_rna(
        key=(bpy.types.LayerObjects, "active"), owner=_OWNER, args=(), notify=_follow_active, options={"PERSISTENT"}
    )


classes = (LEGORIZE_OT_update, LEGORIZE_OT_build_beside)
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(classes)


def register() -> None:
    """Register the operators, and what follows the active object."""
    _register_classes()
    _listen()
    bpy.app.handlers.load_post.append(_listen)


def unregister() -> None:
    """Undo :func:`register`."""
    bpy.app.handlers.load_post.remove(_listen)
    bpy.msgbus.clear_by_owner(_OWNER)
    _unregister_classes()
