"""Duplicates of models: as soon as Blender has copied the root of one, the copy is a model of its own.

That is done between two commands of the user, and before a command of ours.
"""

from __future__ import annotations

from collections.abc import Container
from itertools import repeat
from typing import Final

import bpy
from bpy.app.handlers import persistent

from ..scene import adopt_copies, all_builds, copied_roots, is_copied_root, state_of
from . import job
from .session import SESSION

DELAY: Final = 0.1
"""Seconds between two looks whether the command that copies has ended, chosen: an eye takes it for at once."""

COPYING: Final = ("OBJECT_OT_duplicate_move", "TRANSFORM_OT_")
"""Beginnings of the names of commands that move what they have copied."""


def adopt(context: bpy.types.Context, left: Container[int] = ()) -> bool:
    """Make models of the copies in a scene, of which the panel shows the active one; return whether there were any."""
    found = adopt_copies(context.scene, left)
    active = context.view_layer.objects.active
    for build, copy in found:
        SESSION.share(build, copy)
        # before Blender 5.0 nothing is active after pasting, in a scene that shows no model yet
        if state_of(copy).root == active or context.scene.legorize.build is None:
            context.scene.legorize.build = copy
    return bool(found)


@persistent
def _note_copies(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Look soon if a root was copied, or moved, which looks the same from here."""
    if bpy.app.background or bpy.app.timers.is_registered(_adopt_soon):
        return
    things = (update.id.original for update in depsgraph.updates if isinstance(update.id, bpy.types.Object))
    if any(map(is_copied_root, things)):
        bpy.app.timers.register(_adopt_soon, first_interval=0.0)


def _adopt_soon() -> float | None:
    """Adopt copies once no command is at work, which may hold on to what it has begun with; undo takes it back."""
    context = bpy.context
    windows = context.window_manager.windows
    working = {operator.bl_idname for window in windows for operator in window.modal_operators}
    if job.running() or context.mode != "OBJECT" or any(map(str.startswith, working, repeat(COPYING))):
        return DELAY
    for window in windows:
        with context.temp_override(window=window):
            if adopt(bpy.context, SESSION.left):
                bpy.ops.ed.undo_push(message="Duplicate Model")
    return None


@persistent
def _leave_copies(*arguments: object) -> None:
    """Leave what is a copy after an undo or a redo until a command of ours needs it, so that both can go on."""
    SESSION.left = {root.session_uid for build in all_builds() for root in copied_roots(build)}


def register() -> None:
    """Notice copies."""
    for handler in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post, bpy.app.handlers.load_post):
        handler.append(_leave_copies)
    bpy.app.handlers.depsgraph_update_post.append(_note_copies)


def unregister() -> None:
    """Undo :func:`register`."""
    for handler in (bpy.app.handlers.undo_post, bpy.app.handlers.redo_post, bpy.app.handlers.load_post):
        handler.remove(_leave_copies)
    bpy.app.handlers.depsgraph_update_post.remove(_note_copies)
    if bpy.app.timers.is_registered(_adopt_soon):
        bpy.app.timers.unregister(_adopt_soon)
