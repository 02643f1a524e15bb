"""A run's result into the scene: the finished model, with its supports at hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import bpy

from ..core.model import Role, load_catalogue
from ..scene import Detail, builds_of, show_build, state_of
from .kept_view import KeptView
from .visibility import roles_shown, show_role

if TYPE_CHECKING:
    from ..core.build import Build


def show_result(
    scene: bpy.types.Scene,
    build: Build,
    *,
    mm_per_unit: float,
    name: str,
    sources: Sequence[bpy.types.Object],
    notes: Sequence[str],
    detail: Detail = "high",
    replaces: Sequence[bpy.types.Collection] | None = None,
) -> bpy.types.Collection:
    """Put a model and its supports into a scene; supports that are taken out again are hidden at first.

    What is shown of an earlier build that it replaces is shown of this one too:
    roles, layers, section, steps, pieces apart, heat map.

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
    replaces : sequence of bpy.types.Collection, optional
        Builds that it takes the place of; all builds of the sources if it is
        left out.

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
    earlier = builds_of(scene, sources) if replaces is None else replaces
    kept = KeptView.of(earlier)
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
        steps=supports.steps,
        detail=detail,
        replaces=earlier,
    )
    state_of(shown).add_building(by_hand=len(supports.unsteady))
    if Role.SUPPORT_OUTSIDE in roles_shown(shown):
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=False)
    if kept is not None:
        kept.show(scene, shown)
    return shown
