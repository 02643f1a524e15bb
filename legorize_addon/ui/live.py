"""Live preview: while it is on, a change of settings is shown by quick bricks until the model is built.

As for :mod:`.expectation`, drawing a panel only notes what is asked for; a moment
later it is made in a thread, so that Blender lives on, and shown.
"""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from threading import Event
from typing import TYPE_CHECKING, Any, Final

import bpy
from bpy.app.handlers import persistent
from bpy.app.translations import pgettext_iface as iface

from ..core.errors import BuildError, LegorizeError, enough_memory
from ..core.memo import Memo
from ..core.settings import Settings
from ..core.units import MM_PER_METRE
from ..scene import end_preview, preview_in, show_preview
from ..view import readable
from . import counts, job
from .current import current_build
from .requests import by_uid, chosen_sources, replaced_by, resolved_settings
from .setting_names import as_in_panel
from .settings_properties import settings_of
from .tab import draw_wrapped, redraw

if TYPE_CHECKING:
    from ..core.mesh import TriangleMesh
    from ..core.preview import Preview

DELAY: Final = 0.1
"""Seconds after the last change until work begins, chosen: a slider that is dragged changes more often than that."""

BETWEEN: Final = 0.02
"""Seconds after which it is asked again whether the work has ended, chosen: an eye takes it for at once."""

MEMORY: Final = 60_000_000
"""Bytes of earlier previews that are kept, chosen: an object was measured to take 4 to 8 MB, each size of it 1.5."""

FACES: Final = 100_000
TEXELS: Final = 8_000_000
"""Faces and texels of objects that are read: Blender waits for that. Half a second of CPU was measured for each."""

Asked = tuple[tuple[int, ...], int, Settings]
"""Session identifiers of objects and of the build that the panel shows, 0 without one, and settings."""


@dataclass(slots=True)
class _Live:
    """What is shown, or will be.

    Attributes
    ----------
    asked : Asked, optional
        What was asked for last.
    mesh : TriangleMesh, optional
        Of these objects, if they were read and have not changed since.
    materials : tuple of int
        Session identifiers of their materials.
    work : iterator, optional
        What makes the preview, part by part.
    dropped : Event
        Set once nobody wants it any more.
    said : str
        To be drawn in the panel.
    key : (KeyMap, KeyMapItem), optional
        The key that leaves it.
    thread : ThreadPoolExecutor, optional
        The one thread that all work is done in, as long as the switch is on.
    """

    asked: Asked | None = None
    mesh: TriangleMesh | None = None
    materials: tuple[int, ...] = ()
    work: Iterator[None] | None = None
    dropped: Event = field(default_factory=Event)
    said: str = ""
    key: tuple[bpy.types.KeyMap, bpy.types.KeyMapItem] | None = None
    thread: ThreadPoolExecutor | None = None


_live = _Live()
_memo: Final = Memo(MEMORY)


def draw_live(context: bpy.types.Context, layout: bpy.types.UILayout) -> None:
    """Draw the switch, what the preview shows, and how it ends; note what is to be shown."""
    layout.prop(context.window_manager, "legorize_live", icon="HIDE_OFF", toggle=True)
    if not context.window_manager.legorize_live:
        return
    follow(context)
    if _live.said:
        draw_wrapped(context, layout, _live.said, "INFO")
    if preview_in(context.scene) is not None:
        draw_wrapped(context, layout, iface("Whole bricks only, nothing is tested. Esc leaves it."), "BLANK1")


def follow(context: bpy.types.Context) -> None:
    """Note what the panel asks for; show it a moment later if the settings have changed."""
    sources, build = tuple(source.session_uid for source in chosen_sources(context)), current_build(context.scene)
    try:
        asked = sources, build.session_uid if build else 0, settings_of(context.scene.legorize.settings)
    except LegorizeError as error:
        _live.said = as_in_panel(str(error))
        return
    if asked == _live.asked:
        return
    before, _live.asked = _live.asked, asked
    _drop()
    if before is not None and before[2].weight != asked[2].weight:
        _live.mesh = None
    if before is None or before[:2] != asked[:2]:
        # other objects were chosen, or another model with its settings: nobody has changed one yet
        _live.mesh, _live.said = _live.mesh if before and before[0] == sources else None, ""
        return
    bpy.app.timers.register(_tick, first_interval=DELAY)


def _drop() -> None:
    """Stop the work on a preview that nobody wants any more, at the end of its part, and begin no other one."""
    _live.dropped.set()
    _live.work, _live.dropped = None, Event()
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)


def _tick() -> float | None:
    """Do one part of the work; say when to come again."""
    context = bpy.context
    if job.running():
        return DELAY
    if context.mode != "OBJECT" or _live.asked is None or not context.window_manager.legorize_live:
        return None
    if _live.work is None:
        _live.work = _working(context, _live.asked)
    try:
        next(_live.work)
    except StopIteration:
        _live.work = None
    except LegorizeError as error:
        _live.work, _live.said = None, as_in_panel(str(error))
        end_preview(context.scene, context.view_layer)
    else:
        return BETWEEN
    redraw(context)
    return None


def _working(context: bpy.types.Context, asked: Asked) -> Iterator[None]:
    """Read the objects if they have changed, make the preview, and show it."""
    sources, settings = _there(context, asked), resolved_settings(asked[2])
    if sources is None:
        return
    if _live.mesh is None:
        _live.mesh = _read(context, sources, settings.weight)
    mesh, dropped = _live.mesh, _live.dropped
    work = _thread().submit(_made, mesh, settings, dropped)
    while not work.done():
        yield
    # the user went on meanwhile
    found, sources = work.result(), _there(context, asked)
    if found is None or sources is None:
        return
    context.view_layer.update()
    unchanged = _live.mesh is mesh
    mm_per_unit = context.scene.unit_settings.scale_length * MM_PER_METRE
    show_preview(
        context.scene,
        context.view_layer,
        (found.bricks, found.catalogue),
        (found.origin, 1.0 / (found.scale * mm_per_unit)),
        sources,
        replaced_by(context, sources),
    )
    context.view_layer.update()
    if unchanged:
        # what was hidden is noted like a change
        _live.mesh = mesh
    bricks = counts.bricks(len(found.bricks), f"{len(found.bricks):,}")
    _live.said = iface("Preview: {}").format(bricks)
    if found.shown < found.studs:
        _live.said = iface("Preview at {} instead of {} studs: {}").format(found.shown, found.studs, bricks)


def _there(context: bpy.types.Context, asked: Asked) -> list[bpy.types.Object] | None:
    """Return the objects that were asked for; None if one of them is no longer in the scene."""
    found = [thing for thing in by_uid(bpy.data.objects, asked[0]) if context.scene in thing.users_scene]
    return found if len(found) == len(asked[0]) else None


def _made(mesh: TriangleMesh, settings: Settings, dropped: Event) -> Preview | None:
    """Make a preview, in the thread; None if nobody wants it any more."""
    # loaded here, because that takes seconds
    from ..core.preview import preview

    work = preview(mesh, settings, _memo)
    while not dropped.is_set():
        try:
            with enough_memory():
                next(work)
        except StopIteration as end:
            return end.value  # type: ignore[no-any-return]
    return None


def _load() -> None:
    """Load in the thread what the first preview would wait for."""
    from ..core.preview import load_tables

    load_tables()


def _thread() -> ThreadPoolExecutor:
    if _live.thread is None:
        _live.thread = ThreadPoolExecutor(1, "Legorize preview")
        # what fails here fails again, and is told, when it is needed
        _live.thread.submit(_load)
    return _live.thread


def _end_thread() -> None:
    """Stop the work, forget what it has found, and let the thread end."""
    _drop()
    if _live.thread is not None:
        _live.thread.submit(_memo.clear)
        _live.thread.shutdown(wait=False)
        _live.thread = None


def _read(context: bpy.types.Context, sources: list[bpy.types.Object], weight: str) -> TriangleMesh:
    from ..reading import read_objects

    faces = sum(len(source.data.polygons) for source in sources if source.type == "MESH")
    materials = {slot.material for source in sources for slot in source.material_slots if slot.material}
    _live.materials = tuple(material.session_uid for material in materials)
    trees = [material.node_tree for material in materials if material.node_tree]
    images = {node.image for tree in trees for node in tree.nodes if node.type == "TEX_IMAGE" and node.image}
    if faces > FACES or sum(image.size[0] * image.size[1] for image in images) > TEXELS:
        raise BuildError("This object is too large for a live preview: press Update to build it.")
    with readable(context, sources):
        context.view_layer.update()
        mesh, _ = read_objects(sources, context.evaluated_depsgraph_get(), weight=weight)
    context.view_layer.update()
    return mesh


class LEGORIZE_OT_end_preview(bpy.types.Operator):
    """Bring back what was there before the preview."""

    bl_idname = "legorize.end_preview"
    bl_label = "Leave Preview"
    bl_description = "Show the last model again as it was, instead of the live preview"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Tell whether there is a preview; without one, Esc means what it always means."""
        return preview_in(context.scene) is not None and job.running() is None

    def execute(self, context: bpy.types.Context) -> set[str]:
        """End the preview."""
        leave_preview(context)
        return {"FINISHED"}


def leave_preview(context: bpy.types.Context) -> None:
    """End the preview of a scene, and what would become the next one, even if the panel has not been drawn since."""
    end_preview(context.scene, context.view_layer)
    follow(context)
    _drop()
    _live.said = ""
    redraw(context)


def _switched(self: bpy.types.WindowManager, context: bpy.types.Context) -> None:
    """Begin with the settings as they are, or bring the last model back."""
    _live.asked, _live.mesh = None, None
    if self.legorize_live:
        _thread()
    else:
        _end_thread()
        leave_preview(context)


@persistent
def _note_changes(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Note that an object has changed its form or place, or a material its colours."""
    if _live.mesh is None or _live.asked is None:
        return
    for update in depsgraph.updates:
        thing, known = update.id.original, ()
        if isinstance(thing, bpy.types.Material):
            known = _live.materials
        elif isinstance(thing, bpy.types.Object) and (update.is_updated_geometry or update.is_updated_transform):
            known = _live.asked[0]
        if thing.session_uid in known:
            _live.mesh = None
            return


@persistent
def _end_everywhere(*arguments: Any) -> None:
    """End the previews of all scenes: no file keeps them, and an undo may bring back what showed one."""
    _drop()
    _live.said = ""
    for scene in bpy.data.scenes:
        end_preview(scene, scene.view_layers[0])


@persistent
def _forget(*arguments: Any) -> None:
    """Forget what was read: another file is opened."""
    _end_thread()
    _live.asked, _live.mesh, _live.said = None, None, ""


def _add_key() -> None:
    """Let Esc leave the preview, wherever the mouse is in a 3D viewport; without windows there are no keys."""
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is not None:
        keymap = configuration.keymaps.new("3D View Generic", space_type="VIEW_3D")
        _live.key = keymap, keymap.keymap_items.new(LEGORIZE_OT_end_preview.bl_idname, "ESC", "PRESS")


def register() -> None:
    """Register the switch, the operator and its key, and what ends previews."""
    bpy.utils.register_class(LEGORIZE_OT_end_preview)
    # not of a scene: no file keeps it, and a new session begins without it
    bpy.types.WindowManager.legorize_live = bpy.props.BoolProperty(
        name="Live Preview",
        description="Show a quick model while settings change, until the model is built or Esc is pressed",
        options={"SKIP_SAVE"},
        update=_switched,
    )
    _add_key()
    handlers = bpy.app.handlers
    handlers.depsgraph_update_post.append(_note_changes)
    handlers.load_pre.append(_forget)
    for each in (handlers.save_pre, handlers.undo_post, handlers.redo_post, handlers.load_post):
        each.append(_end_everywhere)


def unregister() -> None:
    """Undo :func:`register`, and end all previews."""
    handlers = bpy.app.handlers
    for each in (handlers.save_pre, handlers.undo_post, handlers.redo_post, handlers.load_post):
        each.remove(_end_everywhere)
    handlers.load_pre.remove(_forget)
    handlers.depsgraph_update_post.remove(_note_changes)
    if _live.key is not None:
        keymap, item = _live.key
        keymap.keymap_items.remove(item)
        _live.key = None
    _forget()
    _end_everywhere()
    del bpy.types.WindowManager.legorize_live
    bpy.utils.unregister_class(LEGORIZE_OT_end_preview)
