"""Which build the panel shows."""

from __future__ import annotations

import bpy

from ..scene import builds


def current_build(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """Return the build that the panel shows: the one chosen, else the newest; None without any."""
    there = builds(scene)
    return scene.legorize.build if scene.legorize.build in there else next(reversed(there), None)
