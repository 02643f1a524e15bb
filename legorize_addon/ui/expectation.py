"""What the next build will come to, shown before anything is built.

Drawing must not take long and may not change anything. So a panel only says
which objects it is about; they are read a moment later, and again once they
have changed, and the estimate follows the settings from what was read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_iface as iface

from ..core.errors import LegorizeError
from ..core.progress import duration
from ..core.settings import Settings
from . import counts, job
from .requests import by_uid, chosen_sources
from .setting_names import as_in_panel
from .settings_properties import settings_of
from .tab import redraw

if TYPE_CHECKING:
    from ..core.estimate import Measured
    from ..core.mesh import TriangleMesh

DELAY: Final = 0.3
"""Seconds after a change until objects are read again, so that dragging them stays smooth."""

LINES: Final = 3
"""Lines of an estimate: size in studs, in cm, and what building takes."""

KEPT: Final = 16
"""Estimates that are kept, so that drawing a panel again costs nothing."""


@dataclass(slots=True)
class _Known:
    """What was read last.

    Attributes
    ----------
    sources : tuple of int
        Session identifiers of the objects.
    mesh : TriangleMesh, optional
        Their triangles, if they could be read.
    changed : bool
        Whether they have changed since.
    """

    sources: tuple[int, ...] = ()
    mesh: TriangleMesh | None = None
    changed: bool = False


_known = _Known()


def expected(context: bpy.types.Context) -> tuple[str, ...]:
    """Return what the settings will come to for the chosen objects, in short lines.

    Parameters
    ----------
    context : bpy.types.Context

    Returns
    -------
    tuple of str
        Nothing where nothing is chosen or the objects were not read yet, in which case they are soon.
    """
    sources = tuple(source.session_uid for source in chosen_sources(context))
    if not sources:
        return ()
    if sources != _known.sources or _known.changed:
        _read_soon(sources)
    if sources != _known.sources or _known.mesh is None:
        return ()
    try:
        return _lines(_known.mesh, settings_of(context.scene.legorize.settings))
    except LegorizeError as error:
        return (as_in_panel(str(error)),)


@lru_cache(maxsize=KEPT)
def _lines(mesh: TriangleMesh, settings: Settings) -> tuple[str, ...]:
    # these modules are loaded once there is something to estimate
    from ..core.estimate import estimate_of

    found = estimate_of(_measured(mesh, settings.up), settings)
    wide, deep = (max(1, round(studs)) for studs in found.studs)
    return (
        counts.extent(wide, deep, found.layers),
        "{:.1f} x {:.1f} x {:.1f} cm".format(*found.cm),
        iface("about {}, {}, {} MB").format(
            counts.bricks(round(found.bricks), _rounded(found.bricks)),
            duration(found.seconds),
            _rounded(found.megabytes),
        ),
    )


@lru_cache(maxsize=1)
def _measured(mesh: TriangleMesh, up: str) -> Measured:
    """Measure a mesh once for all settings: a million triangles take a third of a second."""
    from ..core.estimate import Measured

    return Measured.of(mesh, up)


def _rounded(number: float) -> str:
    """Return three digits of a number: an estimate has no more."""
    return f"{round(float(f'{number:.3g}')):,}"


def _read_soon(sources: Sequence[int]) -> None:
    """Read objects a moment later, if nothing else is asked for until then."""
    if sources != _known.sources:
        _known.sources, _known.mesh = tuple(sources), None
    _known.changed = False
    if bpy.app.timers.is_registered(_read):
        bpy.app.timers.unregister(_read)
    bpy.app.timers.register(_read, first_interval=DELAY)


def _read() -> float | None:
    """Read the objects, unless they are hidden or gone; later if a job runs."""
    from ..reading import read_outline

    if job.running():
        return DELAY
    if bpy.context.mode == "OBJECT":
        objects = by_uid(bpy.data.objects, _known.sources)
        found = read_outline(objects, bpy.context.evaluated_depsgraph_get())
        # what a build hides was read before
        _known.mesh = found or _known.mesh
        _lines.cache_clear()
        _measured.cache_clear()
        redraw(bpy.context)
    return None


@persistent
def _note_changes(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Note that an object has changed its form or place."""
    if not _known.sources or _known.changed:
        return
    for update in depsgraph.updates:
        thing = update.id.original
        if update.is_updated_geometry or update.is_updated_transform:
            _known.changed |= isinstance(thing, bpy.types.Object) and thing.session_uid in _known.sources


@persistent
def _forget(*arguments: Any) -> None:
    """Forget what was read: another file is opened."""
    _known.sources, _known.mesh, _known.changed = (), None, False
    _lines.cache_clear()
    _measured.cache_clear()
    if bpy.app.timers.is_registered(_read):
        bpy.app.timers.unregister(_read)


def register() -> None:
    """Watch for changes, and for other files."""
    bpy.app.handlers.depsgraph_update_post.append(_note_changes)
    bpy.app.handlers.load_pre.append(_forget)


def unregister() -> None:
    """Undo :func:`register`."""
    _forget()
    bpy.app.handlers.load_pre.remove(_forget)
    bpy.app.handlers.depsgraph_update_post.remove(_note_changes)
