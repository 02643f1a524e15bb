"""Files opened or imported into an empty Blender: which kinds there are, and what of them is taken."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import bpy

from ..core.errors import MeshError
from ..scene import builds, clear_build

SHAPELESS: Final = ("CAMERA", "LIGHT", "LIGHT_PROBE", "SPEAKER")


def load(source: Path) -> list[bpy.types.Object]:
    """Open or import a file into an empty Blender; return what its renders would show, shown in the viewport too."""
    if not source.is_file():
        raise MeshError(f"There is no file {source}: name one that exists.")
    known = importers()
    kind = source.suffix.lower()
    if kind not in known:
        raise MeshError(f"{source.name} is of no known kind: use one of {', '.join(known)}.")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    operator, options = known[kind]
    try:
        operator(filepath=str(source.resolve()), **options)
    except RuntimeError as error:
        # an importer in Python hands on its traceback
        lines = [line for line in str(error).strip().splitlines() if not line.startswith("Location:")]
        reason = lines[-1].removeprefix("Error: ").rstrip(".")
        raise MeshError(f"{source.name} cannot be read as {kind} ({reason}): export it again.") from error
    if kind != ".blend":
        for armature in bpy.data.armatures:
            armature.pose_position = "REST"
    # else the bricks would be legorized, as they have hidden what they were made of
    for build in list(builds(bpy.context.scene)):
        clear_build(bpy.context.scene, build)
    return list(rendered(bpy.context.view_layer.layer_collection))


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
    """Yield the objects whose shape a render shows, and show them in the viewport, from which meshes are read."""
    if layer.exclude or layer.collection.hide_render:
        return
    layer.hide_viewport = layer.collection.hide_viewport = False
    for obj in layer.collection.objects:
        if not obj.hide_render and obj.type not in SHAPELESS:
            obj.hide_viewport = False
            obj.hide_set(False)
            yield obj
    for below in layer.children:
        yield from rendered(below)
