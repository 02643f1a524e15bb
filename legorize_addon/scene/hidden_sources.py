"""What the scene keeps about hidden originals, to show them again after a model was deleted in Blender's own way.

A build hides what it was made of and keeps how that was hidden before. The build
may be deleted together with this, so the scene keeps a second copy.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Final

import bpy

from .builds import all_builds, hidden_by
from .source_state import SourceState
from .state import state_of

HIDDEN_SOURCES_KEY: Final = "legorize_hidden_sources"


def remember(scene: bpy.types.Scene, sources: Iterable[SourceState]) -> None:
    """Let a scene know how objects were hidden before a build; what it knows of them already is replaced."""
    new = list(sources)
    known = {entry.source for entry in new}
    _write(scene, [*(entry for entry in _read(scene) if entry.source not in known), *new])


def forget(scene: bpy.types.Scene, sources: Iterable[bpy.types.Object]) -> None:
    """Let a scene forget objects that are as they were before."""
    gone = set(sources)
    _write(scene, [entry for entry in _read(scene) if entry.source not in gone])


def as_before(scene: bpy.types.Scene, source: bpy.types.Object) -> SourceState:
    """Return how an object was hidden before any build hid it."""
    held = (entry for build in all_builds() for entry in state_of(build).hidden)
    known = (entry for entry in (*held, *orphans(scene)) if entry.source == source)
    return next(known, SourceState.of(source))


def orphans(scene: bpy.types.Scene) -> list[SourceState]:
    """Return the objects of a scene that a build hid which is there no more, and how they were hidden before."""
    entries = [entry for entry in _read(scene) if _still_hidden(scene, entry)]
    if not entries:
        return []
    held = {thing for build in all_builds() for thing in hidden_by(build)}
    return [entry for entry in entries if entry.source not in held]


def show_orphans(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Show the orphans of a scene as they were before, and return them."""
    found = orphans(scene)
    for entry in found:
        entry.restore()
    sources = [entry.source for entry in found]
    forget(scene, sources)
    return sources


def _still_hidden(scene: bpy.types.Scene, entry: SourceState) -> bool:
    source = entry.source
    hidden = (source.hide_viewport, source.hide_render)
    return scene in source.users_scene and hidden != (entry.hide_viewport, entry.hide_render)


def _read(scene: bpy.types.Scene) -> list[SourceState]:
    stored = scene.get(HIDDEN_SOURCES_KEY)
    if not hasattr(stored, "to_dict"):
        return []
    found = [SourceState.read(entry) for entry in stored.values() if hasattr(entry, "to_dict")]
    return [entry for entry in found if entry is not None]


def _write(scene: bpy.types.Scene, entries: list[SourceState]) -> None:
    if entries:
        scene[HIDDEN_SOURCES_KEY] = {str(i): entry.stored() for i, entry in enumerate(entries)}
    elif hasattr(scene.get(HIDDEN_SOURCES_KEY), "to_dict"):
        del scene[HIDDEN_SOURCES_KEY]
