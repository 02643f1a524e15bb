"""The bricks of one part in one colour: selected, and seen through all others, which become glass."""

from __future__ import annotations

from typing import Final

import bpy
import numpy as np

from ..core.arrays import Mask
from ..core.model import load_catalogue
from ..scene import (
    GHOST_KEY,
    MATERIAL_KEY,
    PART_KEY,
    check_whole,
    colour_material,
    own_parts,
    plastic,
    point_objects,
    state_of,
)

COLOUR_KEY: Final = "legorize_colour"
"""Key, on parts that may be shown as glass, of the colour that they have."""

GLASS: Final = 0.06
"""Opacity of what is not shown: ten bricks behind each other still let half of the light through."""

LotKey = tuple[str, int]
"""Number of a part and LDraw code of a colour."""


def show_lot(build: bpy.types.Collection, lot: LotKey | None) -> int:
    """Show and select the bricks of a lot, or show all bricks as they are.

    Parameters
    ----------
    build : bpy.types.Collection
    lot : (str, int) or None
        Part and colour; None for all.

    Returns
    -------
    int
        Bricks of the lot.

    Raises
    ------
    BuildError
        The build is damaged.
    """
    check_whole(build)
    found = point_objects(build)
    if lot is None and shown_lot(build) is None:
        return 0
    own_parts(state_of(build), found)
    catalogue = load_catalogue()
    for variant in state_of(build).parts.objects:
        code = variant.get(COLOUR_KEY)
        if code is None:
            code = variant[COLOUR_KEY] = variant.material_slots[0].material[MATERIAL_KEY]
        mine = lot is None or (variant[PART_KEY], code) == lot
        colour = catalogue.colours[catalogue.colour_row(code)]
        variant.material_slots[0].material = colour_material(colour) if mine else _glass()
        if lot is None:
            del variant[COLOUR_KEY]
    return sum(_select(points, _rows(build, points, lot)) for points in found)


def shown_lot(build: bpy.types.Collection) -> LotKey | None:
    """Return the lot that alone is shown, None where all bricks are."""
    parts = state_of(build).parts
    kept = [
        (variant[PART_KEY], int(variant[COLOUR_KEY]))
        for variant in (parts.objects if parts else ())
        if COLOUR_KEY in variant and variant.material_slots[0].material.get(GHOST_KEY) is None
    ]
    return kept[0] if kept else None


def _rows(build: bpy.types.Collection, points: bpy.types.Object, lot: LotKey | None) -> Mask:
    """Return which points of an object are bricks of a lot, in the order of its vertices."""
    if lot is None:
        return np.zeros(len(points.data.vertices), bool)
    numbers = np.array(state_of(build).part_numbers)
    columns = [np.empty(len(points.data.vertices), np.int32) for _ in range(2)]
    for name, values in zip(("part", "colour"), columns, strict=True):
        points.data.attributes[name].data.foreach_get("value", values)
    part, colour = columns
    found: Mask = (numbers[part] == lot[0]) & (colour == lot[1])
    return found


def _select(points: bpy.types.Object, rows: Mask) -> int:
    """Select some points of an object, as Edit Mode shows them; return how many.

    The object itself is not selected: that would outline all of its bricks.
    """
    points.data.vertices.foreach_set("select", rows)
    points.data.update()
    return int(rows.sum())


def _glass() -> bpy.types.Material:
    """Return the material of bricks that are looked through."""
    material = plastic("Brick glass", (160, 165, 172), GHOST_KEY, 1)
    material.diffuse_color = (*material.diffuse_color[:3], GLASS)
    shader = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    shader.inputs["Alpha"].default_value = GLASS
    return material
