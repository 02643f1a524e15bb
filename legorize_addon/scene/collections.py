"""Bricks in the scene: a collection a layer, a point object in it, one more for its supports, and back to the table.

A build is a collection "Legorize <name>" that holds all that re-export needs,
see :mod:`.build_state`. The points are in model mm and carry the
columns of :class:`~legorize_addon.core.model.bricks.Bricks` as named attributes; their
parent, the root, brings them to the place and size of the source objects.
The objects that are instanced stand in a collection of their own, outside of
every scene, see :mod:`.shared_parts`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.building import Steps
from ..core.errors import BuildError
from ..core.model import Bricks, Catalogue, Role
from ..core.units import PLATES_PER_BRICK
from .assembly_columns import Columns, assembly_columns
from .brick_points import MARGIN, NO_MARGIN, box_corners, points_mesh
from .builds import (
    LAYER_KEY,
    OWN_KEY,
    ROLE_KEY,
    all_builds,
    bricks_of,
    builds_of,
    hidden_by,
    layers_of,
    own_objects,
    point_objects,
)
from .builds import builds as builds
from .builds import show_sources as show_sources
from .colour_errors import colour_error_facts
from .figures import figures, n_layers
from .hand_changes import hand_remark
from .hidden_sources import as_before, forget, remember
from .holders import holders
from .instancing import add_bricks_modifier, colour_material
from .kept_steps import read_steps
from .model import Model, Source
from .part_meshes import Detail, parts_collection, parts_in_use
from .placing import Place, hang, middle_of, upright
from .root import POINTS_KEY, Outline, new_root
from .section import Section, add_plane
from .shared_parts import leave_plane, sweep
from .state import BUILD_KEY as BUILD_KEY
from .state import state_of, write_state
from .verdict import judged_rows


def show_build(
    scene: bpy.types.Scene,
    model: Model,
    source: Source,
    *,
    detail: Detail = "high",
    replaces: Sequence[bpy.types.Collection] | None = None,
) -> bpy.types.Collection:
    """Put a brick model into a scene, in place of an earlier one of the same source objects.

    It stands in the collection of the first one that it replaces, moved, turned
    and scaled as that one was.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene that gets the collection.
    model : Model
    source : Source
    detail : {"low", "high"}, optional
        Detail of the part meshes.
    replaces : sequence of bpy.types.Collection, optional
        Builds that it takes the place of; all builds of the source's objects if
        it is left out.

    Returns
    -------
    bpy.types.Collection
        The build.

    Raises
    ------
    BuildError
        There are no bricks, or one of a colour outside the catalogue.
    """
    bricks, catalogue = model.assembly.bricks, model.assembly.catalogue
    if not len(bricks):
        raise BuildError("The model has no bricks: make it larger or choose another object.")
    kinds, variant = np.unique(np.stack([bricks.part, bricks.colour], axis=1), axis=0, return_inverse=True)
    pairs = [(catalogue.parts[part], catalogue.colours[catalogue.colour_row(code)]) for part, code in kinds.tolist()]
    earlier = builds_of(scene, source.objects) if replaces is None else replaces
    place = Place.after(scene, earlier)
    for each in earlier:
        clear_build(scene, each)
    build = bpy.data.collections.new(f"Legorize {source.name}")
    place.collection.children.link(build)
    facts, outline = _table_facts(bricks, catalogue)
    root = _own(build, new_root(build.name, outline))
    place.put(root, upright(np.add(model.origin, facts["middle"]).tolist(), 1 / (model.scale * model.mm_per_unit)))
    plane = _own(build, add_plane(build.name))
    hang(plane, root, facts["middle"])
    parts = parts_collection([(part, colour_material(colour)) for part, colour in pairs], detail, source.name)
    errors, error_facts = colour_error_facts(model)
    objects = _add_layers(build, bricks, variant.reshape(-1), {**_more(model), **errors}, catalogue, plane, parts)
    hidden = [as_before(scene, each) for each in source.objects]
    held = [as_before(scene, each) for each in holders(scene, source.objects)]
    write_state(
        build,
        objects=objects,
        origin=model.origin,
        sources=hidden,
        holders=held,
        section=Section(),
        scale=float(model.scale),
        mm_per_unit=float(model.mm_per_unit),
        root=root,
        plane=plane,
        parts=parts,
        settings={} if source.settings is None else asdict(source.settings),
        notes=list(source.notes),
        **facts,
        **error_facts,
        **figures(model.assembly, model.stability, model.steps),
    )
    remember(scene, [*hidden, *held])
    show_sources(build, visible=False)
    return build


def read_bricks(build: bpy.types.Collection) -> Bricks:
    """Return the table of bricks of a build, row by row as it was shown.

    Parameters
    ----------
    build : bpy.types.Collection
        Collection made by :func:`show_build`, in this or an earlier session.

    Returns
    -------
    Bricks
        The table. A brick whose point was moved is where its point is now.

    Raises
    ------
    BuildError
        No brick is left, or a part of the build is not in the catalogue.
    """
    return bricks_of(build, point_objects(build))


def steps_of(build: bpy.types.Collection) -> Steps:
    """Return the building steps of a build, whose rows are those of :func:`read_bricks`.

    Parameters
    ----------
    build : bpy.types.Collection
        Collection made by :func:`show_build`, in this or an earlier session.

    Raises
    ------
    BuildError
        It was made by an earlier version, or bricks of it were deleted.
    """
    found = read_steps(state_of(build).steps, sum(len(points.data.vertices) for points in point_objects(build)))
    if found is None:
        remark = hand_remark(build)
        if remark:
            raise BuildError(remark)
        raise BuildError(f"{build.name!r} does not know how all of its bricks are built: legorize the object again.")
    return found


def clear_build(scene: bpy.types.Scene, build: bpy.types.Collection) -> None:
    """Remove a build, damaged or not, and all that nothing else uses; show its source objects as they were before.

    Sources of another build, such as a copy or one in another scene, stay hidden.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene of the build; objects that a user put into the build's
        collections move to its collection.
    build : bpy.types.Collection
        Collection made by :func:`show_build`.
    """
    held = {thing for other in all_builds() if other != build for thing in hidden_by(other)}
    freed = [entry for entry in state_of(build).hidden if entry.source not in held]
    for entry in freed:
        entry.restore()
    forget(scene, [entry.source for entry in freed])
    own, layers = own_objects(build), layers_of(build)
    if state_of(build).plane in own:
        leave_plane(scene, state_of(build).plane, own)
    for mesh in {thing.data for thing in own if thing.data is not None}:
        # those of version 0.1.0 are not marked
        mesh[POINTS_KEY] = True
    _move_out(scene, [build, *layers], own)
    bpy.data.batch_remove([*own, *layers, build])
    sweep()


def _move_out(
    scene: bpy.types.Scene, collections: Sequence[bpy.types.Collection], own: Sequence[bpy.types.Object]
) -> None:
    """Bring what a user put into collections, or hung on a build's objects, into the scene's own collection."""
    leaving, going = set(collections), set(own)
    for collection in collections:
        for child in set(collection.children) - leaving:
            scene.collection.children.link(child)
        for guest in set(collection.objects) - going:
            if set(guest.users_collection) <= leaving:
                scene.collection.objects.link(guest)
    for guest in [thing for thing in scene.objects if thing.parent in going and thing not in going]:
        world = guest.matrix_world.copy()
        guest.parent = None
        guest.matrix_world = world


def _own(collection: bpy.types.Collection, thing: bpy.types.Object) -> bpy.types.Object:
    thing[OWN_KEY] = True
    collection.objects.link(thing)
    return thing


def _add_layers(
    build: bpy.types.Collection,
    bricks: Bricks,
    variant: NDArray[np.integer],
    more: Columns,
    catalogue: Catalogue,
    plane: bpy.types.Object,
    parts: bpy.types.Collection,
) -> int:
    """Return how many objects there are."""
    objects = 0
    for layer, groups in _rows_by_layer(bricks):
        collection = bpy.data.collections.new(f"Layer {layer + 1:03d}")
        collection[LAYER_KEY] = layer
        build.children.link(collection)
        used = np.unique(variant[np.concatenate([rows for _, rows in groups])])
        own_parts = parts_in_use(parts, used, collection.name)
        objects += len(groups)
        for role, rows in groups:
            name = f"{collection.name} {'bricks' if role is None else 'supports'}"
            own = {key: values[rows] for key, values in more.items()}
            mesh = points_mesh(name, bricks.take(rows), catalogue, np.searchsorted(used, variant[rows]), rows, own)
            points = _own(collection, bpy.data.objects.new(name, mesh))
            if role is not None:
                points[ROLE_KEY] = int(role)
            mesh[POINTS_KEY] = True
            points.parent, points.matrix_parent_inverse = plane.parent, plane.matrix_parent_inverse
            add_bricks_modifier(points, own_parts, plane)
    return objects


def _table_facts(bricks: Bricks, catalogue: Catalogue) -> tuple[dict[str, Any], Outline]:
    """Return the fields of a state that follow from the table of bricks, and the outline of what stays of them."""
    corners = box_corners(bricks, catalogue)
    extent = {"low": corners.min(axis=0).tolist(), "high": corners.max(axis=0).tolist()}
    taken = np.repeat(bricks.role == Role.SUPPORT_OUTSIDE, 8)
    stays = corners if taken.all() else corners[~taken]
    # other supports do not move the root, and a model that hangs has the same ground
    outline = {"low": [*stays.min(axis=0).tolist()[:2], extent["low"][2]], "high": stays.max(axis=0).tolist()}
    facts = {
        "roles": [Role(role) for role in np.unique(bricks.role).tolist()],
        "part_numbers": [part.number for part in catalogue.parts],
        "layers": n_layers(bricks),
        "top_layer": n_layers(bricks),
        "extent": extent,
        "middle": middle_of(outline),
    }
    return facts, outline


def _more(model: Model) -> Columns:
    """Return what the points know beside the table of bricks."""
    bricks, stability, steps = model.assembly.bricks, model.stability, model.steps
    more = {} if steps is None else assembly_columns(model.assembly, steps)
    if stability is not None:
        margin = np.full(len(bricks), NO_MARGIN)
        margin[judged_rows(stability, bricks)] = stability.margin_by_studs
        more[MARGIN] = margin
    return more


def _rows_by_layer(bricks: Bricks) -> Iterator[tuple[int, list[tuple[Role | None, NDArray[np.intp]]]]]:
    """Yield each layer that has bricks, from the lowest, with the rows of the model in it, and those of its supports.

    Each object costs a fifth of a millisecond whenever a slider moves, however few bricks it has. Supports have one of
    their own because it has other pale parts.
    """
    layer = bricks.corner[:, 2] // PLATES_PER_BRICK
    order = np.argsort(layer, kind="stable")
    for rows in np.split(order, np.flatnonzero(np.diff(layer[order])) + 1):
        taken = bricks.role[rows] == Role.SUPPORT_OUTSIDE
        groups: list[tuple[Role | None, NDArray[np.intp]]] = [
            (None, rows[~taken]),
            (Role.SUPPORT_OUTSIDE, rows[taken]),
        ]
        yield int(layer[rows[0]]), [(role, group) for role, group in groups if len(group)]
