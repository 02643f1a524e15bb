"""Bricks in other colours than their own, for a while: what the heat map and the view of colour errors share.

Solid view shows the colours of materials only, and an instance has the
materials of its object. So a tint is a second collection of parts, the same
meshes in its colours, that the bricks' tree turns to; it is there
while the tint is on, and nothing of it stays. The bricks' own colours, in their
data and in their own collection of parts, are never touched.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Floats
from ..core.model import Part, load_catalogue
from ..scene import (
    HEAT_KEY,
    HEAT_MAP,
    HEAT_PARTS,
    bricks_modifier,
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
"""Attribute that chooses the instanced object while a tint is on."""

TINT_KEY: Final = "legorize_tint"
"""Property of the second collection of parts: the name of the tint. Earlier versions had but one."""

FIRST: Final = "heat map"


@dataclass(frozen=True, slots=True, eq=False)
class Tint:
    """What decides the colours.

    Attributes
    ----------
    name : str
        By which it is known in a file.
    attribute : str
        Number of each brick that decides.
    material : str
        Begin of its materials' names.
    base : int
        Number of its first material, by which materials are known in a file.
    colours : (k, 3) uint8 array
        sRGB.
    rows : callable
        Returns the rows of the colours, (n,) int32, of numbers, (n,) float32.
    """

    name: str
    attribute: str
    material: str
    base: int
    colours: NDArray[np.uint8]
    rows: Callable[[Floats], NDArray[np.int32]]


def tint_of(build: bpy.types.Collection) -> str:
    """Return the name of the tint that a build has; empty if it shows its own colours."""
    parts = state_of(build).heat_parts
    return "" if parts is None else str(parts.get(TINT_KEY, FIRST))


def has_numbers(build: bpy.types.Collection, attribute: str) -> bool:
    """Return whether a build knows a number of each of its bricks; builds of earlier versions do not."""
    return all(attribute in points.data.attributes for points in point_objects(build))


def show_tint(build: bpy.types.Collection, tint: Tint, *, visible: bool) -> None:
    """Show a tint of a whole build that has its numbers in place of any other one, or the bricks' own colours."""
    if visible == (tint_of(build) == tint.name):
        return
    hide_tint(build)
    if visible:
        own_parts(state_of(build), point_objects(build))
        _switch_on(build, tint)


def hide_tint(build: bpy.types.Collection) -> None:
    """Show the bricks' own colours."""
    if tint_of(build):
        own_parts(state_of(build), point_objects(build))
        _switch_off(build)


def _switch_on(build: bpy.types.Collection, tint: Tint) -> None:
    state, found = state_of(build), point_objects(build)
    part = np.concatenate([_read(points, "part", np.int32) for points in found])
    number = np.concatenate([_read(points, tint.attribute, np.float32) for points in found])
    kinds, row = np.unique(np.stack([part, tint.rows(number)], axis=1), axis=0, return_inverse=True)
    ends = np.cumsum([len(points.data.vertices) for points in found])[:-1]
    numbers = state.part_numbers
    parts = [_part(numbers[number]) for number in kinds[:, 0]]
    materials = [_material(tint, colour) for colour in kinds[:, 1].tolist()]
    heat_parts = parts_collection(list(zip(parts, materials, strict=True)), detail_of(state.parts), tint.name)
    heat_parts[TINT_KEY] = tint.name
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


def _material(tint: Tint, row: int) -> bpy.types.Material:
    return plastic(f"{tint.material} {row}", tint.colours[row].tolist(), HEAT_KEY, tint.base + row)
