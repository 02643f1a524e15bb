"""Bricks in the scene: a collection a layer, a point object a role, and back to the table.

A build is a collection "Legorize <name>" with a custom property ``legorize``
that holds all that re-export needs. The points are in model mm and carry the
columns of :class:`~legorize_addon.core.model.Bricks` as named attributes; an
empty, their parent, brings them to the place and size of the source objects.
The objects that are instanced stand in a collection of their own, outside of
every scene.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any, Final

import bpy
import numpy as np
from numpy.typing import NDArray

from .assembly import Columns, assembly_columns
from .brick_points import MARGIN, NO_MARGIN, box_corners, points_mesh, read_points
from .core.building.moves import Moves
from .core.catalogue import Catalogue, load_catalogue
from .core.errors import BuildError
from .core.model import Bricks, Floats, Role
from .core.settings import Settings
from .core.units import PLATES_PER_BRICK, STUD
from .figures import figures, n_layers
from .nodes import add_bricks_modifier, brick_trees, colour_material
from .part_meshes import Detail, parts_collection, parts_in_use
from .section import Section, add_plane

if TYPE_CHECKING:
    from .core.stability import Stability

BUILD_KEY: Final = "legorize"
LAYER_KEY: Final = "legorize_layer"
ROLE_KEY: Final = "legorize_role"
OWN_KEY: Final = "legorize_own"


def show_build(
    scene: bpy.types.Scene,
    bricks: Bricks,
    catalogue: Catalogue,
    *,
    origin: Sequence[float],
    scale: float,
    mm_per_unit: float,
    name: str,
    sources: Sequence[bpy.types.Object] = (),
    settings: Settings | None = None,
    notes: Sequence[str] = (),
    stability: Stability | None = None,
    moves: Moves | None = None,
    detail: Detail = "high",
) -> bpy.types.Collection:
    """Put a brick model into a scene, in place of an earlier one of the same source objects.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene that gets the collection.
    bricks : Bricks
        The table of bricks, supports at its end.
    catalogue : Catalogue
        Parts and colours.
    origin : sequence of three float
        Corner of the grid in model mm.
    scale : float
        Model mm per world mm.
    mm_per_unit : float
        World mm per Blender unit.
    name : str
        Name of the source, for the collection.
    sources : sequence of bpy.types.Object, optional
        Objects that the model was made of. They are hidden, not changed, and
        shown again by :func:`clear_build`.
    settings : Settings, optional
        What the model was made with, kept for the file's reader.
    notes : sequence of str, optional
        Remarks to show beside the result.
    stability : Stability, optional
        Whether these bricks stand, row by row, for the panel and the heat map;
        supports that are taken out again may be left out.
    moves : Moves, optional
        The order in which these bricks are built, for the panel and the steps.
    detail : {"low", "high"}, optional
        Detail of the part meshes.

    Returns
    -------
    bpy.types.Collection
        The build.

    Raises
    ------
    BuildError
        There are no bricks, or one of a colour outside the catalogue.
    """
    if not len(bricks):
        raise BuildError("The model has 0 bricks: make it larger or choose another object.")
    kinds, variant = np.unique(np.stack([bricks.part, bricks.colour], axis=1), axis=0, return_inverse=True)
    pairs = [(catalogue.parts[part], catalogue.colours[catalogue.colour_row(code)]) for part, code in kinds.tolist()]
    for earlier in builds_of(scene, sources):
        clear_build(scene, earlier)
    build = bpy.data.collections.new(f"Legorize {name}")
    scene.collection.children.link(build)
    root = _add_root(build, np.asarray(origin, dtype=np.float64), 1.0 / (scale * mm_per_unit))
    plane = _own(build, add_plane(build.name, root))
    parts = parts_collection([(part, colour_material(colour)) for part, colour in pairs], detail, name)
    _add_layers(build, bricks, variant.reshape(-1), _more(bricks, stability, moves, catalogue), catalogue, plane, parts)
    corners = box_corners(bricks, catalogue)
    build[BUILD_KEY] = {
        "origin": [float(value) for value in origin],
        "scale": scale,
        "mm_per_unit": mm_per_unit,
        "root": root,
        "plane": plane,
        "parts": parts,
        "part_numbers": [part.number for part in catalogue.parts],
        "layers": n_layers(bricks),
        "top_layer": n_layers(bricks),
        "extent": {"low": corners.min(axis=0).tolist(), "high": corners.max(axis=0).tolist()},
        "section": asdict(Section()),
        "roles": {Role(role).name: True for role in np.unique(bricks.role).tolist()},
        "sources": {str(i): _hidden_state(source) for i, source in enumerate(sources)},
        "settings": {} if settings is None else asdict(settings),
        "notes": list(notes),
        **figures(bricks, stability, moves, catalogue),
    }
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


def bricks_of(build: bpy.types.Collection, found: Sequence[bpy.types.Object]) -> Bricks:
    """Return the table of the bricks that some point objects of a build hold, as :func:`read_bricks` does."""
    if not found:
        raise BuildError(f"The collection {build.name!r} has 0 bricks to show: legorize the object again.")
    return read_points([points.data for points in found], build[BUILD_KEY]["part_numbers"], load_catalogue())


def clear_build(scene: bpy.types.Scene, build: bpy.types.Collection) -> None:
    """Remove a build and all that nothing else uses; show its source objects as they were before.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene of the build; objects that a user put into the build's
        collections move to its collection.
    build : bpy.types.Collection
        Collection made by :func:`show_build`.
    """
    state = build[BUILD_KEY]
    for entry in state["sources"].values():
        # a build in another scene may have hidden it too
        if entry["object"] is not None and len(_entries_of(entry["object"])) == 1:
            entry["object"].hide_viewport, entry["object"].hide_render = entry["hide_viewport"], entry["hide_render"]
    own = [thing for thing in build.all_objects if OWN_KEY in thing]
    for guest in [thing for thing in build.all_objects if OWN_KEY not in thing and len(thing.users_collection) == 1]:
        scene.collection.objects.link(guest)
    variants = list(state["parts"].all_objects)
    meshes = {thing.data for thing in [*own, *variants] if thing.data is not None}
    materials = {slot.material for thing in variants for slot in thing.material_slots if slot.material is not None}
    bpy.data.batch_remove(
        [*own, *variants, *state["parts"].children_recursive, state["parts"], *layers_of(build), build]
    )
    _remove_unused([*meshes, *materials])
    _remove_unused(brick_trees())


def builds(scene: bpy.types.Scene) -> list[bpy.types.Collection]:
    """Return the builds of a scene."""
    return [collection for collection in scene.collection.children_recursive if BUILD_KEY in collection]


def builds_of(scene: bpy.types.Scene, objects: Sequence[bpy.types.Object]) -> list[bpy.types.Collection]:
    """Return the builds that were made of one of the objects or that contain one of them."""
    wanted = set(objects)
    return [build for build in builds(scene) if wanted and wanted & {*sources_of(build), *build.all_objects}]


def sources_of(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects that a build was made of, without those deleted since."""
    entries = build[BUILD_KEY]["sources"].values()
    return [entry["object"] for entry in entries if entry["object"] is not None]


def layers_of(build: bpy.types.Collection) -> list[bpy.types.Collection]:
    """Return the collections of the layers that have bricks, from the lowest."""
    return sorted((child for child in build.children if LAYER_KEY in child), key=lambda child: child[LAYER_KEY])


def point_objects(build: bpy.types.Collection) -> list[bpy.types.Object]:
    """Return the objects whose points are the bricks of a build."""
    return [thing for thing in build.all_objects if OWN_KEY in thing and thing.type == "MESH"]


def show_sources(build: bpy.types.Collection, *, visible: bool, linked_only: bool = False) -> None:
    """Show or hide the source objects of a build, or only those of other files, in the viewport and in renders."""
    for source in sources_of(build):
        if source.library is not None or not linked_only:
            source.hide_viewport = source.hide_render = not visible


def _add_root(build: bpy.types.Collection, origin: Floats, unit_per_mm: float) -> bpy.types.Object:
    root = _own(build, bpy.data.objects.new(build.name, None))
    root.empty_display_size = STUD
    root.location = origin * unit_per_mm
    root.scale = (unit_per_mm, unit_per_mm, unit_per_mm)
    return root


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
) -> None:
    for layer, groups in _rows_by_layer(bricks):
        collection = bpy.data.collections.new(f"Layer {layer + 1:03d}")
        collection[LAYER_KEY] = layer
        build.children.link(collection)
        used = np.unique(variant[np.concatenate([rows for _, rows in groups])])
        own_parts = parts_in_use(parts, used, collection.name)
        for role, rows in groups:
            name = f"{collection.name} {role.name.lower().replace('_', ' ')}"
            own = {key: values[rows] for key, values in more.items()}
            mesh = points_mesh(name, bricks.take(rows), catalogue, np.searchsorted(used, variant[rows]), rows, own)
            points = _own(collection, bpy.data.objects.new(name, mesh))
            points[ROLE_KEY] = int(role)
            points.parent = plane.parent
            add_bricks_modifier(points, own_parts, plane)


def _more(bricks: Bricks, stability: Stability | None, moves: Moves | None, catalogue: Catalogue) -> Columns:
    """Return what the points know beside the table of bricks."""
    more = {} if moves is None else assembly_columns(bricks, moves, catalogue)
    if stability is not None:
        margin = np.full(len(bricks), NO_MARGIN)
        margin[: len(stability.margin)] = stability.margin
        more[MARGIN] = margin
    return more


def _rows_by_layer(bricks: Bricks) -> Iterator[tuple[int, list[tuple[Role, NDArray[np.intp]]]]]:
    """Yield each layer that has bricks, from the lowest, with the rows of each role in it."""
    layer = bricks.corner[:, 2] // PLATES_PER_BRICK
    order = np.lexsort((bricks.role, layer))
    for rows in np.split(order, np.flatnonzero(np.diff(layer[order])) + 1):
        groups = np.split(rows, np.flatnonzero(np.diff(bricks.role[rows])) + 1)
        yield int(layer[rows[0]]), [(Role(bricks.role[group[0]]), group) for group in groups]


def _hidden_state(source: bpy.types.Object) -> dict[str, Any]:
    """Return how a user had hidden an object, which builds in other scenes may have hidden since."""
    own = {"hide_viewport": source.hide_viewport, "hide_render": source.hide_render}
    [state, *_] = [*_entries_of(source), own]
    return {"object": source, **{key: bool(state[key]) for key in own}}


def _entries_of(source: bpy.types.Object) -> list[Any]:
    """Return what the builds of all scenes keep of a source object."""
    all_builds = [collection for collection in bpy.data.collections if BUILD_KEY in collection]
    entries = [entry for build in all_builds for entry in build[BUILD_KEY]["sources"].values()]
    return [entry for entry in entries if entry["object"] == source]


def _remove_unused(datablocks: Iterable[bpy.types.ID]) -> None:
    bpy.data.batch_remove([datablock for datablock in datablocks if datablock.users == 0])
