"""Opening or importing files into an empty Blender: the kinds of files, and which objects are read."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Final, NamedTuple

import bmesh
import bpy
import numpy as np

from ..core.errors import MeshError, SettingsError
from ..core.files.sources import check_source, is_lost, unchanged, without_lost_places
from ..scene import builds, clear_build
from .at_rest import ANIMATED, fbx_is_animated, without_animation
from .gltf_importer import readable_extensions
from .losses import told_losses
from .quiet import quiet
from .shown import has_surface
from .standing import AXES, stand

GLTF: Final = (".glb", ".gltf")
SHAPELESS: Final = ("CAMERA", "LIGHT", "LIGHT_PROBE", "SPEAKER")

_NAMED: Final = 20
"""Names of objects in a sentence."""


class Loaded(NamedTuple):
    """What a file brought into Blender.

    Attributes
    ----------
    objects : list of bpy.types.Object
        Those that renders of the view layer may show, or the chosen ones of them.
    remarks : tuple of str
        What was left out or changed, one sentence each.
    up : {"auto", "x", "y", "z"}
        The axis along which the core has to turn them still: that of the scene of a .blend, which stays as it is.
    """

    objects: list[bpy.types.Object]
    remarks: tuple[str, ...]
    up: str


def load(source: Path, *, frame: int | None = None, names: Sequence[str] = (), up: str = "auto") -> Loaded:
    """Open or import a file into an empty Blender.

    An imported model is at rest: objects, bones and shape keys are as they are
    without animation. A .blend is as its author left it: at the frame at which
    it was saved, with the poses that renders of that frame show.

    Parameters
    ----------
    source : pathlib.Path
        Of a kind in :func:`importers`.
    frame : int, optional
        Frame, as Blender counts, whose pose is taken instead.
    names : sequence of str, optional
        Objects to take; one without a surface stands for what is parented to it. All if there are no names.
    up : {"auto", "x", "y", "z"}, optional
        The axis of the file that points up, for .fbx and .blend that of Blender. In the first case .obj, .ply and .stl
        files are turned if their shape clearly says so, and others not at all.

    Returns
    -------
    Loaded

    Raises
    ------
    MeshError
        The file cannot be read, or has no object of a name.
    """
    kind = source.suffix.lower()
    if frame is not None and kind in importers() and kind not in (".blend", *ANIMATED):
        raise SettingsError(f"{kind} files hold no animation: leave --frame out.")
    with unchanged(source):
        losses = check_source(source, readable_extensions() if kind in GLTF else ())
        lost_textures = kind in GLTF and bool(losses)
        # a stop in the midst of it is Blender's to print, and comes out afterwards
        with quiet():
            bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        at_rest = frame is None and kind in ANIMATED
        with tempfile.TemporaryDirectory(dir=bpy.app.tempdir) as folder:
            path, lost = without_lost_places(source, Path(folder))
            losses += lost
            losses += _import_at_rest(source, kind, path) if at_rest else _run(source, kind, path)
        if lost:
            _take_lost()
        if lost_textures:
            _fill_textures()
    if frame is not None:
        bpy.context.scene.frame_set(frame)
    # else the bricks would be legorized, as they have hidden what they were made of, which other scenes may show too
    for scene in bpy.data.scenes:
        for build in builds(scene):
            clear_build(scene, build)
    objects = _chosen(list(rendered(bpy.context.view_layer.layer_collection)), names)
    if kind == ".blend" and losses and not any(map(_may_show, objects)):
        raise MeshError(losses[-1])
    if kind in AXES:
        losses += tuple(stand(objects, source.name, usual=AXES[kind], up=up, by_shape=kind not in ANIMATED))
    return Loaded(objects, losses, "auto" if kind in AXES else up)


def _may_show(obj: bpy.types.Object) -> bool:
    group = obj.instance_collection
    return has_surface(obj) or (group is not None and not group.is_missing)


def _fill_textures() -> None:
    """Give lost textures a white image: what is multiplied with them stays, and there is a remark already."""
    trees = [material.node_tree for material in bpy.data.materials if material.node_tree]
    bare = [node for tree in trees for node in tree.nodes if node.type == "TEX_IMAGE" and node.image is None]
    if not bare:
        return
    white = bpy.data.images.new("Lost texture", 1, 1)
    white.pixels = (1.0, 1.0, 1.0, 1.0)
    for node in bare:
        node.image = white


def _take_lost() -> None:
    """Take the vertices that have no place out of all meshes, with their faces."""
    for mesh in bpy.data.meshes:
        places = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
        mesh.vertices.foreach_get("co", places)
        lost = np.flatnonzero(is_lost(places.reshape(-1, 3)))
        if not len(lost):
            continue
        changed = bmesh.new()
        changed.from_mesh(mesh)
        changed.verts.ensure_lookup_table()
        bmesh.ops.delete(changed, geom=[changed.verts[row] for row in lost.tolist()], context="VERTS")
        changed.to_mesh(mesh)
        changed.free()


def _import_at_rest(source: Path, kind: str, path: Path) -> tuple[str, ...]:
    """Import a file, or a copy of it, without its animation; return remarks on that and on other losses."""
    if kind == ".fbx":
        losses = _run(source, kind, path, use_anim=False)
        animated = fbx_is_animated(source)
    else:
        with tempfile.TemporaryDirectory(dir=bpy.app.tempdir) as folder:
            copy = without_animation(path, Path(folder))
            losses = _run(source, kind, copy or path)
        animated = copy is not None
    for armature in bpy.data.armatures:
        armature.pose_position = "REST"
    remark = f"The animation in {source.name} was left out: --frame takes the pose of a frame."
    return (*losses, remark) if animated else losses


def _run(source: Path, kind: str, path: Path, **more: Any) -> tuple[str, ...]:
    """Run Blender's own operator for a file, or for a copy of it; return remarks on what it passes over."""
    operator, options = importers()[kind]
    try:
        with quiet() as said:
            operator(filepath=str(path.resolve()), **options, **more)
    except RuntimeError as error:
        if RecursionError.__name__ in str(error):
            raise MeshError(
                f"The objects of {source.name} are nested deeper than Blender can read: flatten their hierarchy and "
                "export it again."
            ) from error
        raise MeshError(f"{source.name} cannot be read as {kind} ({_reason(path, error)}): export it again.") from error
    return told_losses(source, bytes(said))


def _reason(path: Path, error: RuntimeError) -> str:
    """Return what an importer says of its failure, without places on this disk or in its code."""
    text = str(error).strip()
    lines = [line for line in text.splitlines() if not line.startswith("Location:")]
    reason = lines[-1].removeprefix("Error: ").replace(str(path.resolve()), path.name).rstrip(".")
    # an importer in Python passes on its traceback
    return f"the importer has failed with {reason}" if "Traceback" in text else reason


def _chosen(objects: list[bpy.types.Object], names: Sequence[str]) -> list[bpy.types.Object]:
    """Return the objects of some names, with all that is parented to them."""
    missing = [name for name in names if name not in {obj.name for obj in objects}]
    if missing:
        there = ", ".join(sorted(repr(obj.name) for obj in objects)[:_NAMED]) or "none"
        more = f" and {len(objects) - _NAMED} more" if len(objects) > _NAMED else ""
        raise MeshError(f"There is no object {missing[0]!r} that renders show: choose one of {there}{more}.")
    return [obj for obj in objects if not names or any(own.name in names for own in _standing_for(obj))]


def _standing_for(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Yield an object, and all without a surface that it is parented to, over whatever is between."""
    yield obj
    while obj.parent is not None:
        obj = obj.parent
        if not has_surface(obj):
            yield obj


def importers() -> dict[str, tuple[Any, dict[str, Any]]]:
    """Return Blender's own operator for every suffix, and its options."""
    gltf = (bpy.ops.import_scene.gltf, {})
    # the importer in C++, from 4.5 on, reads more kinds of FBX than the add-on
    fbx = bpy.ops.wm.fbx_import if "fbx_import" in dir(bpy.ops.wm) else bpy.ops.import_scene.fbx
    return {
        ".blend": (bpy.ops.wm.open_mainfile, {"load_ui": False, "use_scripts": False}),
        ".obj": (bpy.ops.wm.obj_import, {}),
        ".glb": gltf,
        ".gltf": gltf,
        ".ply": (bpy.ops.wm.ply_import, {}),
        ".stl": (bpy.ops.wm.stl_import, {}),
        ".fbx": (fbx, {}),
    }


def rendered(layer: bpy.types.LayerCollection) -> Iterator[bpy.types.Object]:
    """Yield the objects whose shape a render may show, each once."""
    objects: dict[bpy.types.Object, None] = {}
    _gather(layer, objects)
    yield from objects


def _gather(layer: bpy.types.LayerCollection, objects: dict[bpy.types.Object, None]) -> None:
    if layer.exclude or layer.collection.hide_render:
        return
    objects.update((obj, None) for obj in layer.collection.objects if not obj.hide_render and obj.type not in SHAPELESS)
    for below in layer.children:
        _gather(below, objects)
