"""What is read of a scene: what Blender shows of the chosen objects.

There is one rule. Blender's dependency graph lists all that is shown, with
modifiers, instances, levels of subdivision and animation as they are shown, and
exactly that is taken. There are two such lists, and this is the one difference
between the ways into the add-on: the button takes the viewport's, as the user
looks at it; a file that is read without a window is taken as its renders would
show it. Of the second list, objects go too that stand in no picture by
themselves: those invisible to cameras, holdouts, those that give indirect light
only, and catchers of shadows.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from types import MappingProxyType
from typing import Any, Final, NamedTuple, TypeVar

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.errors import LegorizeError, MeshError
from .object_values import ObjectValues

Found = TypeVar("Found")

SURFACES: Final = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META"})
"""Types of objects that have a surface of their own."""

_ENGINE: Final = "LEGORIZE_READ"
_RESULT: Final = "Render Result"
_PENCILS: Final = ("GPENCIL", "GREASEPENCIL")

_QUICK: Final = MappingProxyType(
    {
        "engine": _ENGINE,
        "resolution_x": 4,
        "resolution_y": 4,
        "resolution_percentage": 100,
        "use_border": False,
        "use_compositing": False,
        # crashes, as this engine leaves it no picture to draw on
        "use_freestyle": False,
        "use_motion_blur": False,
        "use_sequencer": False,
        "use_multiview": False,
        "use_persistent_data": False,
    }
)
"""Settings of a render that is over at once: one layer, one eye, nothing behind it."""


class Shown(NamedTuple):
    """A mesh that is shown.

    Attributes
    ----------
    mesh : bpy.types.Object
        Evaluated, with a mesh; valid for as long as the next one is not asked for.
    owner : bpy.types.Object
        The chosen object that shows it, itself or by instancing; not evaluated.
    matrix : (4, 4) float64 array
        From the mesh to the world, in Blender units.
    values : ObjectValues
        What the object or instance tells its materials.
    """

    mesh: bpy.types.Object
    owner: bpy.types.Object
    matrix: NDArray[np.float64]
    values: ObjectValues


def has_surface(obj: bpy.types.Object) -> bool:
    """Return whether an object may show a surface: its own, or that of a collection that it instances."""
    return obj.type in SURFACES or obj.instance_collection is not None


def shown(chosen: Iterable[bpy.types.Object], depsgraph: bpy.types.Depsgraph) -> Iterator[Shown]:
    """Yield the meshes that a dependency graph shows of the chosen objects.

    Curves, texts and metaballs come as instances of the meshes they make.

    Parameters
    ----------
    chosen : iterable of bpy.types.Object
    depsgraph : bpy.types.Depsgraph
        Up to date; of the viewport, or of a render.

    Yields
    ------
    Shown
        Only while the dependency graph lives.
    """
    wanted = {obj.original for obj in chosen}
    for instance in depsgraph.object_instances:
        owner = (instance.parent if instance.is_instance else instance.object).original
        if instance.object.type != "MESH" or not instance.show_self or owner not in wanted:
            continue
        if depsgraph.mode == "VIEWPORT" or _in_pictures(instance.object, owner, depsgraph.view_layer):
            matrix = np.array(instance.matrix_world, dtype=np.float64)
            yield Shown(instance.object, owner, matrix, ObjectValues.of(instance, depsgraph))


def when_rendered(context: bpy.types.Context, read: Callable[[bpy.types.Depsgraph], Found]) -> Found:
    """Return what a function reads in the dependency graph of a render.

    Blender builds that graph for renders alone and hands it to their engine. So
    an engine that draws nothing reads it.

    Parameters
    ----------
    context : bpy.types.Context
        Its view layer is rendered, at the scene's current frame.
    read : callable
        Takes the dependency graph, which is gone afterwards.

    Returns
    -------
    object
        What the function returned.

    Raises
    ------
    LegorizeError
        The function's own, or Blender refuses to render.
    """
    reading = _Reading(read, context.view_layer)
    with _engine(reading), _quick(context.scene, context.view_layer):
        try:
            bpy.ops.render.render(scene=context.scene.name, layer=context.view_layer.name)
        except RuntimeError as error:
            reason = str(error).strip().removeprefix("Error: ").rstrip(".")
            raise MeshError(f"Blender refuses to render the scene ({reason}): correct its render settings.") from error
    return reading.result()


class _Reading:
    """A function that is called by a render, and what came of it."""

    def __init__(self, read: Callable[[bpy.types.Depsgraph], Any], layer: bpy.types.ViewLayer) -> None:
        self._read, self._layer = read, layer
        self._found: list[Any] = []
        self._failure: BaseException | None = None

    def __call__(self, depsgraph: bpy.types.Depsgraph) -> None:
        # all layers that are in use are rendered, one after the other
        if depsgraph.view_layer.name != self._layer.name:
            return
        try:
            self._found.append(self._read(depsgraph))
        except LegorizeError as error:
            # Blender would print it
            self._failure = error
        finally:
            # a bug is printed by Blender, which then goes on
            self._failure = self._failure or sys.exception()

    def result(self) -> Any:
        """Return what the function returned, or raise what it raised."""
        if self._failure is not None:
            raise self._failure
        [found] = self._found
        return found


def _in_pictures(mesh: bpy.types.Object, owner: bpy.types.Object, layer: bpy.types.ViewLayer) -> bool:
    """Return whether pictures show an object itself, as Cycles decides it: an instance needs its owner's leave too."""
    if owner.holdout_get(view_layer=layer) or owner.indirect_only_get(view_layer=layer):
        return False
    return all(
        obj.visible_camera and not obj.is_holdout and not obj.is_shadow_catcher for obj in (mesh.original, owner)
    )


@contextmanager
def _engine(reading: _Reading) -> Iterator[None]:
    """Let Blender know an engine that reads instead of drawing, for as long as the context lasts."""

    class LegorizeReadEngine(bpy.types.RenderEngine):
        """Called by Blender with the dependency graph of a render."""

        bl_idname = _ENGINE
        bl_label = "Legorize"

        def render(self, depsgraph: bpy.types.Depsgraph) -> None:
            """Read."""
            reading(depsgraph)

    bpy.utils.register_class(LegorizeReadEngine)
    try:
        yield
    finally:
        bpy.utils.unregister_class(LegorizeReadEngine)


@contextmanager
def _quick(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> Iterator[None]:
    """Set a scene up for a render that draws nothing; leave it as it was."""
    with ExitStack() as undo:
        if _RESULT not in bpy.data.images:
            undo.callback(_remove_result)
        for name, value in _QUICK.items():
            _set(undo, scene.render, name, value)
        _set(undo, layer, "use", True)
        # would be drawn over the picture by the graphics card, which there may be none of
        for pencil in [obj for obj in bpy.data.objects if obj.type in _PENCILS]:
            _set(undo, pencil, "hide_render", True)
        # no render begins without a camera
        camera = bpy.data.cameras.new("legorize read")
        undo.callback(bpy.data.cameras.remove, camera)
        view = bpy.data.objects.new("legorize read", camera)
        undo.callback(bpy.data.objects.remove, view)
        _set(undo, scene, "camera", view)
        yield


def _set(undo: ExitStack, owner: Any, name: str, value: Any) -> None:
    """Set a property for a while."""
    undo.callback(setattr, owner, name, getattr(owner, name))
    setattr(owner, name, value)


def _remove_result() -> None:
    if _RESULT in bpy.data.images:
        bpy.data.images.remove(bpy.data.images[_RESULT])


def image_of(things: Iterable[bpy.types.Object]) -> bpy.types.Image | None:
    """Return the image of the first empty among some objects that shows one."""
    for thing in things:
        if thing.type == "EMPTY" and thing.empty_display_type == "IMAGE" and thing.data is not None:
            return thing.data
    return None
