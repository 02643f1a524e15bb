"""The bricks of the step shown stand out: all that was there before is pale, supports in a tint of their own.

Solid view shows the colours of materials only. So each object gets a collection
of parts with the pale ones behind its own, which is there as long as this is on;
the tree of the bricks counts on to these by itself.
"""

from __future__ import annotations

import bpy
import numpy as np

from ..core.instructions import TINTS, pale, tint_for, tinted
from ..core.model import Role, load_catalogue
from ..scene import (
    MATERIAL_KEY,
    PALE,
    PALE_KEY,
    PARTS,
    ROLE_KEY,
    bricks_modifier,
    check_whole,
    get_input,
    has_input,
    own_parts,
    plastic,
    point_objects,
    set_input,
    state_of,
)
from .lots import show_lot


def can_highlight(build: bpy.types.Collection) -> bool:
    """Tell whether a build can: those of earlier versions have a tree without."""
    found = point_objects(build)
    return bool(found) and all(has_input(bricks_modifier(points), PALE) for points in found)


def highlighted(build: bpy.types.Collection) -> bool:
    """Tell whether what was there before the step shown is pale."""
    return can_highlight(build) and any(get_input(bricks_modifier(points), PALE) for points in point_objects(build))


def highlight_step(build: bpy.types.Collection, *, visible: bool) -> None:
    """Make what was there before the step shown pale, or show all bricks in their own colours.

    Parameters
    ----------
    build : bpy.types.Collection
        The build; nothing changes for one of an earlier version.
    visible : bool
        Whether the step is to stand out.

    Raises
    ------
    BuildError
        The build is damaged.
    """
    check_whole(build)
    if not can_highlight(build) or visible == highlighted(build):
        return
    show_lot(build, None)
    if visible:
        _switch_on(build)
    else:
        _switch_off(build)


def _switch_on(build: bpy.types.Collection) -> None:
    state, found = state_of(build), point_objects(build)
    own_parts(state, found)
    model = [points for points in found if points.get(ROLE_KEY) != Role.SUPPORT_OUTSIDE]
    colours = [_rgb(each) for points in model for each in get_input(bricks_modifier(points), PARTS).objects]
    tint = TINTS.index(tint_for(np.array(colours)))
    for points in found:
        modifier = bricks_modifier(points)
        used = get_input(modifier, PARTS)
        variants = sorted(used.objects, key=lambda variant: variant.name)
        parts = bpy.data.collections.new(f"{used.name} pale {points.name}")
        state.parts.children.link(parts)
        for variant in variants:
            parts.objects.link(variant)
        for variant in variants:
            parts.objects.link(_paler(variant, None if points in model else tint))
        set_input(modifier, PARTS, parts)
        set_input(modifier, PALE, len(variants))


def _switch_off(build: bpy.types.Collection) -> None:
    state, found = state_of(build), point_objects(build)
    # the parts of a layer, of which those that are pale are left out
    own = {frozenset(each.objects): each for each in state.parts.children if not any(map(_is_pale, each.objects))}
    doomed: list[bpy.types.ID] = []
    for points in found:
        modifier = bricks_modifier(points)
        parts = get_input(modifier, PARTS)
        set_input(modifier, PALE, 0)
        set_input(modifier, PARTS, own[frozenset(each for each in parts.objects if not _is_pale(each))])
        doomed += [parts, *filter(_is_pale, parts.objects)]
    materials = {thing.material_slots[0].material for thing in doomed if isinstance(thing, bpy.types.Object)}
    bpy.data.batch_remove(doomed)
    bpy.data.batch_remove([material for material in materials if material.users == 0])


def _is_pale(variant: bpy.types.Object) -> bool:
    return PALE_KEY in variant


def _rgb(variant: bpy.types.Object) -> tuple[int, int, int]:
    catalogue = load_catalogue()
    return catalogue.colours[catalogue.colour_row(variant.material_slots[0].material[MATERIAL_KEY])].rgb


def _paler(variant: bpy.types.Object, tint: int | None) -> bpy.types.Object:
    """Return a part like another one, in a pale colour; Geometry Nodes counts it after all others by its name.

    Parameters
    ----------
    variant : bpy.types.Object
    tint : int or None
        Which of the tints it has as a support.
    """
    code, rgb = variant.material_slots[0].material[MATERIAL_KEY], _rgb(variant)
    shown = rgb if tint is None else tinted(rgb, TINTS[tint])
    # codes of colours have less than 16 bits
    key = code if tint is None else code + (tint + 1 << 16)
    copy = variant.copy()
    copy.name = f"pale {variant.name}"
    copy[PALE_KEY] = True
    name = f"{'Brick' if tint is None else 'Support'} {code} pale"
    copy.material_slots[0].material = plastic(name, pale(shown), PALE_KEY, key)
    return copy
