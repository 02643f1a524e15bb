"""Putting the result of a run into the scene: the finished model, with hidden supports."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..core.edits import edits_text
from ..core.model import SUPPORTS, Role, concatenate
from ..scene import (
    Detail,
    Model,
    Source,
    bricks_text,
    builds_of,
    damage,
    found_colours,
    keep_found_colours,
    read_bricks,
    show_build,
    state_of,
    surface_of,
)
from .kept_view import KeptView
from .visibility import roles_shown, show_role

if TYPE_CHECKING:
    from ..core.build import Finished
    from ..core.unit_bricks import WantedColours


def show_result(
    scene: bpy.types.Scene,
    build: Finished,
    source: Source,
    *,
    mm_per_unit: float,
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
    build : Finished
        What the core made.
    source : Source
        What it was made of.
    mm_per_unit : float
        World mm per Blender unit.
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
    earlier = builds_of(scene, source.objects) if replaces is None else replaces
    kept = KeptView.of(earlier)
    colours = next((found for each in earlier if (found := found_colours(each))), [])
    edits = next((each.edits for each in map(state_of, earlier) if each.edits[0]), ("", ""))
    place = (build.origin, build.scale, mm_per_unit)
    wanted = _surface_of(build, earlier)
    model = Model(supports.assembly, *place, stability=build.stability, steps=supports.steps, wanted=wanted)
    shown = show_build(scene, model, replace(source, settings=build.settings), detail=detail, replaces=earlier)
    state_of(shown).add_building(by_hand=len(supports.unsteady), **_costs(build))
    state_of(shown).keep_texts(build.texts)
    state_of(shown).edits = _edits_of(build) or edits
    keep_found_colours(shown, _colours_of(build) or colours)
    if Role.SUPPORT_OUTSIDE in roles_shown(shown):
        show_role(shown, Role.SUPPORT_OUTSIDE, visible=False)
    if kept is not None:
        kept.show(scene, shown)
    return shown


def _surface_of(build: Finished, earlier: Sequence[bpy.types.Collection]) -> WantedColours | None:
    """Return the surface on the cells of a model of a mesh, also if its bricks are judged anew; None of any other."""
    # loaded with the models that it has
    from ..core.build import Build, Judged

    if isinstance(build, Build):
        return build.wanted
    if not isinstance(build, Judged) or len(earlier) != 1 or damage(earlier[0]):
        return None
    # bricks at negative coordinates, which were put there by hand, have moved all of them
    return surface_of(earlier[0]) if read_bricks(earlier[0]).corner.min() >= 0 else None


def _colours_of(build: Finished) -> Sequence[tuple[tuple[int, int, int], int, int, float]]:
    """Return the colours found in textures and what they became; none of a model that is not of a mesh."""
    # loaded with the models that it has
    from ..core.build import Build
    from ..core.colours import colour_shares

    return colour_shares(build.surface) if isinstance(build, Build) else []


def _edits_of(build: Finished) -> tuple[str, str] | None:
    """Return the changes by hand of a model of a mesh, and its bricks without them; None of any other model."""
    # loaded with the models that it has
    from ..core.build import Build

    if not isinstance(build, Build):
        return None
    if not len(build.edits) or build.unedited is None:
        return "", ""
    # pillars that stay are not edited
    pillars = build.bricks.take(np.isin(build.bricks.role, SUPPORTS))
    return edits_text(build.edits), bricks_text(concatenate([build.unedited, pillars]))


def _costs(build: Finished) -> dict[str, str]:
    """Return what model and supports cost by the price file, in words; nothing without one."""
    prices, catalogue = build.prices, build.assembly.catalogue
    if prices is None:
        return {}
    tables = {"cost": build.bricks, "support_cost": build.supports.removed}
    return {name: prices.money(float(prices.each(bricks, catalogue).sum())) for name, bricks in tables.items()}
