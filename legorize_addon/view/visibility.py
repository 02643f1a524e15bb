"""What is shown of a build: layers, roles, its part before a cut, pieces apart, the first steps; sources being read.

Nothing here touches the bricks' data.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Final

import bpy
import numpy as np

from ..core.arrays import Floats, Mask
from ..core.errors import BuildError
from ..core.model import Bricks, Role, load_catalogue
from ..scene import (
    FRAMES,
    HIDDEN_ROLES,
    LAYER_KEY,
    ROLE_KEY,
    ROW,
    Section,
    beyond,
    box_corners,
    brick_tree,
    bricks_modifier,
    bricks_of,
    change_tree,
    check_whole,
    get_input,
    has_input,
    layer_collections,
    layers_of,
    line_objects,
    middles,
    place_plane,
    point_objects,
    read_column,
    set_input,
    state_of,
)
from .steps import bricks_there, check_steps, do_steps, steps_done, ways

HIDDEN_KEY: Final = "legorize_hidden"
"""Key, on objects of a hidden role, of how the user had hidden them: in the viewport, in renders."""


def show_layers(scene: bpy.types.Scene, build: bpy.types.Collection, top: int, *, single: bool = False) -> None:
    """Show the lower layers of a build, or one of them, and hide the others, in the viewport and in renders.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene whose view layers are changed.
    build : bpy.types.Collection
        The build.
    top : int
        Number of layers to show, from the lowest.
    single : bool, optional
        Whether to show only the highest of these.
    """
    state_of(build).top_layer, state_of(build).single_layer = top, single
    shown = range(top - 1 if single else 0, top)
    hidden = {layer: layer[LAYER_KEY] not in shown for layer in layers_of(build)}
    # renders look at the whole scene anew. Setting the flags one by one would make the viewport do so too, at once,
    # and the eyes of the outliner, unlike Collection.hide_viewport, do without
    build.children.foreach_set("hide_render", [hidden.get(child, child.hide_render) for child in build.children])
    for view_layer in scene.view_layers:
        for entry in layer_collections(view_layer.layer_collection):
            if entry.collection in hidden:
                entry.hide_viewport = hidden[entry.collection]


def show_role(build: bpy.types.Collection, role: Role, *, visible: bool) -> None:
    """Show or hide the bricks of a role in all layers, in the viewport and in renders.

    Objects that the user had hidden one by one stay hidden, and the eyes of
    the outliner are left to the user.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    role : Role
        One that occurs in it.
    visible : bool
        Whether to show it.
    """
    state_of(build).show_role(role, visible=visible)
    hidden = sum(1 << each for each, shown in roles_shown(build).items() if not shown)
    for points in point_objects(build):
        modifier = bricks_modifier(points)
        # supports are hidden as a whole: an object that shows nothing makes View All zoom out
        if ROLE_KEY not in points and modifier is not None and has_input(modifier, HIDDEN_ROLES):
            if _may_have(points, role):
                set_input(modifier, HIDDEN_ROLES, hidden)
            # what an earlier version hid is shown below
            if HIDDEN_KEY not in points:
                continue
        if points.get(ROLE_KEY) != role or (HIDDEN_KEY in points) != visible:
            continue
        if visible:
            points.hide_viewport, points.hide_render = map(bool, points[HIDDEN_KEY])
            del points[HIDDEN_KEY]
        else:
            points[HIDDEN_KEY] = [points.hide_viewport, points.hide_render]
            points.hide_viewport = points.hide_render = True


def _may_have(points: bpy.types.Object, role: Role) -> bool:
    """Tell whether an object has bricks of a role, as far as that is known."""
    mesh = points.data
    # in Edit Mode nothing can be read, and a user may have removed what tells it
    if mesh.is_editmode or "role" not in mesh.attributes:
        return True
    return bool((read_column(mesh, "role") == role).any())


def roles_shown(build: bpy.types.Collection) -> dict[Role, bool]:
    """Return the roles that occur in a build, in their order, and whether each is shown."""
    return state_of(build).roles


def cut_away(build: bpy.types.Collection, section: Section) -> None:
    """Hide the bricks beyond a plane, in the viewport and in renders.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    section : Section
        The cut.

    Raises
    ------
    BuildError
        The build is damaged.
    """
    check_whole(build)
    state = state_of(build)
    state.section = section
    place_plane(state.plane, section, state.extent)


def section_of(build: bpy.types.Collection) -> Section:
    """Return the cut through a build, as :func:`cut_away` made it."""
    return state_of(build).section


def show_steps(build: bpy.types.Collection, steps: int) -> None:
    """Show what is there after some building steps, in the viewport and in renders.

    The supports that are taken out again are shown while they stand, whatever
    was shown of them before, and are as before when all is shown again.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    steps : int
        Steps that are done; 0 shows all bricks.

    Raises
    ------
    BuildError
        The build does not know its steps.
    """
    check_steps(build)
    stop_animation(build)
    if bool(steps) != bool(steps_done(build)) and Role.SUPPORT_OUTSIDE in roles_shown(build):
        state = state_of(build)
        if steps:
            state.supports_shown = roles_shown(build)[Role.SUPPORT_OUTSIDE]
        show_role(build, Role.SUPPORT_OUTSIDE, visible=bool(steps) or state.supports_shown)
    do_steps(build, steps)


def stop_animation(build: bpy.types.Collection) -> None:
    """Show a build that is put together as the frames go by as a whole in every frame, its supports as before."""
    modifiers = filter(None, map(bricks_modifier, point_objects(build)))
    animated = [modifier for modifier in modifiers if has_input(modifier, FRAMES)]
    for modifier in animated:
        change_tree(modifier, brick_tree())
    if animated and Role.SUPPORT_OUTSIDE in roles_shown(build):
        show_role(build, Role.SUPPORT_OUTSIDE, visible=state_of(build).supports_shown)


def shown_bricks(build: bpy.types.Collection) -> Bricks:
    """Return the table of the bricks that renders show, where they are in the model.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.

    Returns
    -------
    Bricks
        Those whose layer and object are not hidden in renders, that lie before
        the cut, and that are there after the steps shown.

    Raises
    ------
    BuildError
        No brick is left.
    """
    bricks, shown, _ = bricks_in_renders(build)
    return bricks.take(shown)


def shown_corners(build: bpy.types.Collection) -> Floats:
    """Return the corners of the bricks that renders show, where they show them.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.

    Returns
    -------
    (n, 3) float64 array
        In model mm; those of trajectories that are shown are among them.

    Raises
    ------
    BuildError
        No brick is left.
    """
    lines = _line_corners(build)
    if len(lines) and not _shown_points(build):
        return lines
    bricks, shown, found = bricks_in_renders(build)
    way = ways(build, found, steps_done(build))[shown]
    return np.concatenate([box_corners(bricks.take(shown), load_catalogue()) + np.repeat(way, 8, axis=0), lines])


def corners_while_building(build: bpy.types.Collection) -> Floats:
    """Return the corners of all bricks where the whole build shows them, and where they stand before; (n, 3) in mm."""
    found = point_objects(build)
    corners = box_corners(bricks_of(build, found), load_catalogue())
    return np.concatenate([corners + np.repeat(ways(build, found, steps), 8, axis=0) for steps in (0, 1)])


@contextmanager
def readable(context: bpy.types.Context, objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Show objects while they are read: Blender evaluates no modifiers of hidden ones.

    Objects may be hidden themselves, in renders or by the eye, or lie in
    collections that are hidden or unticked.

    Parameters
    ----------
    context : bpy.types.Context
        Whose scene and view layer are to be read.
    objects : sequence of bpy.types.Object
        As they were again at the end of the context.
    """
    layer = context.view_layer
    hidden = [thing for thing in objects if thing.hide_viewport]
    for thing in hidden:
        thing.hide_viewport = False
    closed = [thing for thing in objects if thing.name in layer.objects and thing.hide_get(view_layer=layer)]
    for thing in closed:
        thing.hide_set(False, view_layer=layer)
    shelf = bpy.data.collections.new("Legorize reading")
    context.scene.collection.children.link(shelf)
    try:
        for thing in objects:
            if not thing.visible_get(view_layer=layer):
                shelf.objects.link(thing)
        yield
    finally:
        for thing in closed:
            thing.hide_set(True, view_layer=layer)
        bpy.data.collections.remove(shelf)
        for thing in hidden:
            thing.hide_viewport = True


def bricks_in_renders(build: bpy.types.Collection) -> tuple[Bricks, Mask, list[bpy.types.Object]]:
    """Return the bricks of the objects that renders show, which of them are seen, and the objects."""
    check_whole(build)
    found = _shown_points(build)
    bricks = bricks_of(build, found)
    rows = np.concatenate([read_column(points.data, ROW) for points in found])
    shown = ~np.concatenate([_off(points) for points in found])[np.argsort(rows, kind="stable")]
    shown &= ~beyond(state_of(build).plane, middles(bricks, load_catalogue())) & bricks_there(build, found)
    if not shown.any():
        raise BuildError(f"The section hides all bricks of {build.name!r}: move it.")
    return bricks, shown, found


def _off(points: bpy.types.Object) -> Mask:
    """Tell which bricks of an object are of a role that is hidden in it, (n,)."""
    modifier = bricks_modifier(points)
    # in earlier versions whole objects are hidden
    hidden = get_input(modifier, HIDDEN_ROLES) if has_input(modifier, HIDDEN_ROLES) else 0
    return np.asarray(hidden >> read_column(points.data, "role") & 1 > 0)


def _shown_points(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects of which renders show bricks."""
    return [points for points in _in_shown_layers(build, point_objects(build)) if not _off(points).all()]


def _line_corners(build: bpy.types.Collection) -> Floats:
    """Return the corners of the boxes of the lines that renders show, (n, 3) in model mm."""
    found = _in_shown_layers(build, line_objects(build))
    return np.array([tuple(corner) for thing in found for corner in thing.bound_box], dtype=np.float64).reshape(-1, 3)


def _in_shown_layers(build: bpy.types.Collection, things: Sequence[bpy.types.Object]) -> list[bpy.types.Object]:
    hidden = {thing for layer in layers_of(build) if layer.hide_render for thing in layer.objects}
    return [thing for thing in things if not thing.hide_render and thing not in hidden]
