"""A run's result into the scene: the finished model, with its supports at hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import bpy

from .core.catalogue import load_catalogue
from .core.model import Role
from .part_meshes import Detail
from .scene import BUILD_KEY, show_build
from .view import roles_shown, show_role

if TYPE_CHECKING:
    from .core.build import Build


def show_result(
    scene: bpy.types.Scene,
    build: Build,
    *,
    mm_per_unit: float,
    name: str,
    sources: Sequence[bpy.types.Object],
    notes: Sequence[str],
    detail: Detail = "high",
) -> bpy.types.Collection:
    """Put a model and its supports into a scene; supports that are taken out again are hidden at first.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene that gets the collection.
    build : Build
        What the core made.
    mm_per_unit : float
        World mm per Blender unit.
    name : str
        Name of the source, for the collection.
    sources : sequence of bpy.types.Object
        Objects that the model was made of.
    notes : sequence of str
        Remarks to show beside the result.
    detail : {"low", "high"}, optional
        Detail of the part meshes.

    Returns
    -------
    bpy.types.Collection
        The build in the scene.

    Raises
    ------
    BuildError
        There are no bricks.
    """
    supports = build.supports
    shown = show_build(
        scene,
        supports.bricks,
        load_catalogue(),
        origin=build.grid.origin,
        scale=build.scale,
        mm_per_unit=mm_per_unit,
        name=name,
        sources=sources,
        settings=build.settings,
        notes=notes,
        stability=build.stability,
        moves=supports.moves,
        detail=detail,
    )
    shown[BUILD_KEY]["building"]["by_hand"] = len(supports.unsteady)
    if Role.SUPPORT_OUTSIDE in roles_shown(shown):
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=False)
    return shown
