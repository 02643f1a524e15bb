"""Install a zip in a fresh Blender, use what it brings, and say what came of it (run by test_extension.py).

::

    python tests/installed_extension.py ZIP

Prints one line of JSON. The environment variable BLENDER_USER_RESOURCES has to
name an empty folder.
"""

from __future__ import annotations

import importlib
import json
import sys

import bpy
import numpy as np

NAME = "bl_ext.user_default.legorize"


def main(path: str) -> None:
    """Install, legorize a small textured cube, and switch the extension off again."""
    # from here on a library comes from the zip or not at all
    sys.path[:] = [folder for folder in sys.path if not folder.endswith("site-packages")]
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.extensions.package_install_files(filepath=path, repo="user_default", enable_on_install=True)
    found = {
        "numpy": np.__version__,
        "libraries": {name: importlib.import_module(name).__file__ for name in ("scipy", "sklearn", "xatlas")},
        "enabled": NAME in bpy.context.preferences.addons,
    }
    source = textured_cube()
    found["status"] = sorted(bpy.ops.legorize.build())
    builds = [each for each in bpy.context.scene.collection.children_recursive if "legorize" in each]
    points = [each for each in builds[0].all_objects if each.type == "MESH"]
    found["bricks"] = sum(len(each.data.vertices) for each in points)
    found["source_faces"] = len(source.data.polygons)
    kept = bpy.context.preferences.addons[NAME].preferences
    kept.palette = "4, 15"
    bpy.ops.wm.read_homefile(use_empty=True)
    found["palette"] = bpy.context.scene.legorize.settings.palette
    learning = importlib.import_module(f"{NAME}.legorize_addon.ui.learned_files")
    found["own_folder"] = str(learning.own_folder())
    bpy.ops.preferences.addon_disable(module=NAME)
    found["left_behind"] = [name for name in ("legorize",) if hasattr(bpy.types.Scene, name)]
    print(json.dumps(found))


def textured_cube() -> bpy.types.Object:
    """Return a selected cube of two metres with an image of four colours on every side."""
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    image = bpy.data.images.new("four colours", 2, 2)
    image.pixels = [1, 0, 0, 1, 0, 0.4, 0, 1, 0, 0, 1, 1, 1, 0.8, 0, 1]
    material = bpy.data.materials.new("four colours")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    shader = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    cube.data.materials.append(material)
    return cube


if __name__ == "__main__":
    main(sys.argv[1])
