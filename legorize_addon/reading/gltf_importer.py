"""What this Blender's importer of glTF can read: it depends on its version and on how it was built."""

from __future__ import annotations

import logging
from typing import Final

import bpy

from .quiet import quiet

_DRACO: Final = {"KHR_draco_mesh_compression"}
_MESHOPT: Final = {"EXT_meshopt_compression", "KHR_meshopt_compression"}
_WEBP: Final = {"EXT_texture_webp"}


def readable_extensions() -> frozenset[str]:
    """Return the names of the glTF extensions that the importer knows and has the libraries for."""
    # an add-on of Blender, which is there once bpy has started; it prints which libraries it finds
    with quiet():
        import io_scene_gltf2
        from io_scene_gltf2.io.imp.gltf2_io_gltf import glTFImporter

        importer = glTFImporter("", {"import_user_extensions": [], "loglevel": logging.CRITICAL})
        known = set(importer.extensions_managed)
        if not io_scene_gltf2.is_draco_available():
            known -= _DRACO
        if known & _MESHOPT and not io_scene_gltf2.is_meshopt_available():
            known -= _MESHOPT
    # not every build says so
    if not getattr(bpy.app.build_options, "image_webp", True):
        known -= _WEBP
    return frozenset(known)
