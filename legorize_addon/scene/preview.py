"""A preview in the scene: points in one object, in the place of what it stands for, which is hidden meanwhile.

It is no build: nothing is exported, rendered or counted of it. Its collection
keeps what it hides, so that a preview can be ended in any session.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.model import Bricks, Catalogue
from .brick_points import box_corners, points_mesh
from .instancing import add_bricks_modifier, colour_material
from .part_meshes import parts_collection
from .placing import Place, hang, middle_of, upright
from .root import POINTS_KEY
from .section import add_plane
from .shared_parts import sweep

PREVIEW_KEY: Final = "legorize_preview"
"""Key, on a collection, of what a preview hides."""


def preview_in(scene: bpy.types.Scene) -> bpy.types.Collection | None:
    """Return the preview of a scene; None without one."""
    return next(
        (each for each in scene.collection.children_recursive if hasattr(each.get(PREVIEW_KEY), "to_dict")), None
    )


def previewed(scene: bpy.types.Scene) -> list[bpy.types.Object]:
    """Return the objects that the preview of a scene was made of, without those deleted since."""
    shown = preview_in(scene)
    found = [] if shown is None else _things(shown, "sources")
    return [thing for thing in found if scene in thing.users_scene]


def show_preview(
    scene: bpy.types.Scene,
    layer: bpy.types.ViewLayer,
    table: tuple[Bricks, Catalogue],
    place: tuple[Floats, float],
    sources: Sequence[bpy.types.Object],
    replaces: Sequence[bpy.types.Collection],
) -> bpy.types.Collection:
    """Show bricks for a while where a build of them would stand, in the viewport alone.

    Parameters
    ----------
    scene : bpy.types.Scene
    layer : bpy.types.ViewLayer
        Of the scene: what is selected in it is selected again at the end.
    table : (Bricks, Catalogue)
        What to show, at least one brick.
    place : ((3,) float64 array, float)
        Corner of the grid in mm of the model, and Blender units per model mm.
    sources : sequence of bpy.types.Object
        What they were made of: hidden meanwhile if no build hides them.
    replaces : sequence of bpy.types.Collection
        Builds that are hidden meanwhile; the preview stands where the first one does. After a preview of the same
        objects those that it hides.

    Returns
    -------
    bpy.types.Collection
    """
    (bricks, catalogue), (origin, unit_per_mm) = table, place
    before = preview_in(scene)
    again = before is not None and previewed(scene) == list(sources)
    if before is not None and again:
        # what it hides is replaced still
        replaces = [each for each in _things(before, "hides") if isinstance(each, bpy.types.Collection)]
    stood, ended = Place.after(scene, replaces), _ended(scene)
    kept = ended if again else _hidden(layer, sources, replaces)
    shown = bpy.data.collections.new("Legorize preview")
    stood.collection.children.link(shown)
    shown.hide_render = True
    shown[PREVIEW_KEY] = kept
    _hide(shown)
    corners = box_corners(bricks, catalogue)
    middle = middle_of({"low": corners.min(axis=0), "high": corners.max(axis=0)})
    root, plane = bpy.data.objects.new(shown.name, None), add_plane(shown.name)
    stood.put(root, upright(np.add(origin, middle).tolist(), unit_per_mm))
    points = bpy.data.objects.new(shown.name, _points(shown.name, bricks, catalogue))
    for thing in (root, plane, points):
        thing.hide_select = True
        shown.objects.link(thing)
    hang(plane, root, middle)
    hang(points, root, middle)
    add_bricks_modifier(points, _parts(bricks, catalogue), plane)
    sweep()
    return shown


def end_preview(scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> bool:
    """Remove the preview of a scene, and show and select what it hid as before; return whether there was one."""
    shown = preview_in(scene)
    if shown is None:
        return False
    active, selected = shown[PREVIEW_KEY].get("active"), _things(shown, "selected")
    _ended(scene)
    layer.update()
    for thing in selected:
        if thing.name in layer.objects:
            thing.select_set(True, view_layer=layer)
    if isinstance(active, bpy.types.Object) and active.name in layer.objects:
        layer.objects.active = active
    sweep()
    return True


def _hidden(
    layer: bpy.types.ViewLayer, sources: Sequence[bpy.types.Object], replaces: Sequence[bpy.types.Collection]
) -> dict[str, Any]:
    """Return what a preview will hide, and how that is shown and selected now."""
    hides = replaces or sources
    return {
        "sources": dict(_numbered(sources)),
        "hides": dict(_numbered(hides)),
        "hide_viewport": [int(each.hide_viewport) for each in hides],
        "selected": dict(_numbered([thing for thing in layer.objects if thing.select_get(view_layer=layer)])),
        **({} if layer.objects.active is None else {"active": layer.objects.active}),
    }


def _hide(shown: bpy.types.Collection) -> None:
    for each in _things(shown, "hides"):
        each.hide_viewport = True


def _ended(scene: bpy.types.Scene) -> Mapping[str, Any] | None:
    """Remove the preview of a scene, show what it hid, and return what it kept; None without one."""
    shown = preview_in(scene)
    if shown is None:
        return None
    kept = shown[PREVIEW_KEY].to_dict()
    for key, value in zip(kept["hides"], kept["hide_viewport"], strict=True):
        if isinstance(kept["hides"][key], bpy.types.ID):
            kept["hides"][key].hide_viewport = bool(value)
    things = list(shown.objects)
    meshes = [thing.data for thing in things if thing.data is not None]
    bpy.data.batch_remove([*things, *meshes, shown])
    return kept


def _numbered(things: Sequence[bpy.types.ID]) -> list[tuple[str, bpy.types.ID]]:
    return [(str(number), thing) for number, thing in enumerate(things)]


def _things(shown: bpy.types.Collection, name: str) -> list[Any]:
    """Return datablocks that a preview keeps, without those deleted since."""
    return [thing for thing in shown[PREVIEW_KEY][name].values() if isinstance(thing, bpy.types.ID)]


def _points(name: str, bricks: Bricks, catalogue: Catalogue) -> bpy.types.Mesh:
    variant = np.unique(_kinds(bricks), axis=0, return_inverse=True)[1].reshape(-1)
    mesh = points_mesh(name, bricks, catalogue, variant, np.arange(len(bricks)), {})
    mesh[POINTS_KEY] = True
    return mesh


def _parts(bricks: Bricks, catalogue: Catalogue) -> bpy.types.Collection:
    kinds = np.unique(_kinds(bricks), axis=0).tolist()
    pairs = [
        (catalogue.parts[part], colour_material(catalogue.colours[catalogue.colour_row(code)])) for part, code in kinds
    ]
    return parts_collection(pairs, "low", "preview")


def _kinds(bricks: Bricks) -> np.ndarray[Any, Any]:
    return np.stack([bricks.part, bricks.colour], axis=1)
