"""The heat map: each brick in the colour of what it has left before it fails.

Solid view shows the colours of materials only, and an instance has the
materials of its object. So the map is a second collection of parts, the same
meshes in the colours of the map, that the bricks' tree turns to; it is there
while the map is on, and nothing of it stays. The bricks' own colours, in their
data and in their own collection of parts, are never touched.
"""

from __future__ import annotations

from typing import Final

import bpy
import numpy as np
from bpy.app.translations import pgettext_n as n
from numpy.typing import NDArray

from ..core.arrays import Floats
from ..core.errors import BuildError
from ..core.model import UNSUPPORTED, Part, load_catalogue
from ..scene import (
    HEAT_KEY,
    HEAT_MAP,
    HEAT_PARTS,
    MARGIN,
    NO_MARGIN,
    bricks_modifier,
    check_whole,
    detail_of,
    own_parts,
    parts_collection,
    parts_in_use,
    plastic,
    point_objects,
    set_input,
    state_of,
)

HEAT: Final = "heat"
"""Attribute that chooses the instanced object while the map is on."""

LEGEND: Final = n(
    "Friction left: green much, yellow half, red none, or held by its neighbours alone. Black: loaded beyond its "
    "friction. Magenta: hangs in the air. Grey: a support, not checked"
)

HANGING: Final = (214, 20, 190)
FAILING: Final = (25, 5, 8)
NOT_CHECKED: Final = (150, 150, 150)
RAMP: Final = ((200, 16, 20), (246, 205, 30), (50, 170, 75))
"""From nothing left, through half, to all of the friction, in sRGB bytes like the three above."""

STEPS: Final = 8
"""Colours of the ramp: a material each, and few enough to be told apart."""


def heat_colours() -> NDArray[np.uint8]:
    """Return the colours of the map in sRGB, shape (STEPS + 3, 3): hanging, failing, from red to green, not checked."""
    at = np.linspace(0, 1, STEPS)
    stops = np.linspace(0, 1, len(RAMP))
    ramp = np.stack([np.interp(at, stops, channel) for channel in np.transpose(RAMP)], axis=1)
    return np.vstack([HANGING, FAILING, np.rint(ramp), NOT_CHECKED]).astype(np.uint8)


def heat_of(margin: Floats) -> NDArray[np.int32]:
    """Return the rows of :func:`heat_colours` for margins of shape (n,), shape (n,)."""
    step = 2 + np.clip(np.floor(margin * STEPS), 0, STEPS - 1)
    step = np.where(margin == NO_MARGIN, 2 + STEPS, step)
    return np.where(margin == UNSUPPORTED, 0, np.where(margin < 0, 1, step)).astype(np.int32)


def has_margins(build: bpy.types.Collection) -> bool:
    """Return whether a build knows what its bricks have left; builds of earlier versions do not."""
    return all(MARGIN in points.data.attributes for points in point_objects(build))


def heat_map_shown(build: bpy.types.Collection) -> bool:
    """Tell whether a build shows its heat map."""
    return state_of(build).heat_parts is not None


def show_heat_map(build: bpy.types.Collection, *, visible: bool) -> None:
    """Show the heat map of a build or its own colours, in the viewport and in renders.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    visible : bool
        Whether to show the map.

    Raises
    ------
    BuildError
        The build does not know what its bricks have left, or is damaged.
    """
    check_whole(build)
    if not has_margins(build):
        raise BuildError(f"The stability of {build.name!r} was not checked: legorize the object again.")
    if visible == heat_map_shown(build):
        return
    own_parts(state_of(build), point_objects(build))
    if visible:
        _switch_on(build)
    else:
        _switch_off(build)


def _switch_on(build: bpy.types.Collection) -> None:
    state, found = state_of(build), point_objects(build)
    part = np.concatenate([_read(points, "part", np.int32) for points in found])
    margin = np.concatenate([_read(points, MARGIN, np.float32) for points in found])
    kinds, row = np.unique(np.stack([part, heat_of(margin)], axis=1), axis=0, return_inverse=True)
    ends = np.cumsum([len(points.data.vertices) for points in found])[:-1]
    numbers = state.part_numbers
    parts = [_part(numbers[number]) for number in kinds[:, 0]]
    materials = [_material(heat) for heat in kinds[:, 1].tolist()]
    heat_parts = parts_collection(list(zip(parts, materials, strict=True)), detail_of(state.parts), "heat map")
    state.parts.children.link(heat_parts)
    state.heat_parts = heat_parts
    for points, own_row in zip(found, np.split(row.reshape(-1), ends), strict=True):
        used = np.unique(own_row)
        picked = np.searchsorted(used, own_row).astype(np.int32)
        points.data.attributes.new(HEAT, "INT", "POINT").data.foreach_set("value", picked)
        set_input(bricks_modifier(points), HEAT_PARTS, parts_in_use(heat_parts, used, points.name))
        set_input(bricks_modifier(points), HEAT_MAP, True)


def _switch_off(build: bpy.types.Collection) -> None:
    state = state_of(build)
    heat_parts = state.heat_parts
    for points in point_objects(build):
        set_input(bricks_modifier(points), HEAT_MAP, False)
        points.data.attributes.remove(points.data.attributes[HEAT])
    state.heat_parts = None
    variants = list(heat_parts.objects)
    materials = {variant.material_slots[0].material for variant in variants}
    bpy.data.batch_remove([*variants, *heat_parts.children, heat_parts])
    bpy.data.batch_remove([material for material in materials if material.users == 0])


def _read(points: bpy.types.Object, name: str, kind: type[np.generic]) -> NDArray[np.generic]:
    values = np.empty(len(points.data.vertices), dtype=kind)
    points.data.attributes[name].data.foreach_get("value", values)
    return values


def _part(number: str) -> Part:
    catalogue = load_catalogue()
    return catalogue.parts[catalogue.part_row(number)]


def _material(heat: int) -> bpy.types.Material:
    return plastic(f"Heat {heat}", heat_colours()[heat].tolist(), HEAT_KEY, heat)
