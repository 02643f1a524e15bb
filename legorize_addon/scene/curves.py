"""Coloured lines in the layers of a build: one curve a layer, which goes with the layer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import bpy
import numpy as np

from .builds import LAYER_KEY, LINES_KEY, OWN_KEY, layers_of
from .instancing import LINE_KEY, plastic
from .placing import hang
from .state import state_of

if TYPE_CHECKING:
    from ..core.method import Lines

RADIUS: Final = 0.45
"""mm of a line in the model: a stud is 8 mm wide, and three lines lie in the height of a brick."""


def add_lines(build: bpy.types.Collection, lines: Lines) -> None:
    """Put lines into the layers of a build; they are removed with it.

    Parameters
    ----------
    build : bpy.types.Collection
        Collection made by :func:`~.collections.show_build`.
    lines : Lines
    """
    collections = {collection[LAYER_KEY]: collection for collection in layers_of(build)}
    first = np.cumsum(lines.count) - lines.count
    for layer in np.unique(lines.layer).tolist():
        # layers without bricks, as thin tips are, get a collection too
        collection = collections.get(layer) or _new_layer(build, layer)
        curve = bpy.data.curves.new(f"{collection.name} trajectories", "CURVE")
        curve[LINES_KEY] = layer
        curve.dimensions = "3D"
        curve.bevel_depth, curve.bevel_resolution = RADIUS, 1
        rows = np.flatnonzero(lines.layer == layer)
        used = np.unique(lines.paint[rows]).tolist()
        for name, (red, green, blue) in (lines.paints[paint] for paint in used):
            curve.materials.append(
                plastic(f"Trajectory {name}", (red, green, blue), LINE_KEY, red << 16 | green << 8 | blue)
            )
        for row in rows.tolist():
            points = lines.points[first[row] : first[row] + lines.count[row]]
            spline = curve.splines.new("POLY")
            spline.points.add(len(points) - 1)
            spline.points.foreach_set("co", np.column_stack([points, np.ones(len(points))]).ravel())
            spline.use_cyclic_u = lines.closed
            spline.material_index = used.index(lines.paint[row])
        _link(collection, bpy.data.objects.new(curve.name, curve), build)


def _new_layer(build: bpy.types.Collection, layer: int) -> bpy.types.Collection:
    collection = bpy.data.collections.new(f"Layer {layer + 1:03d}")
    collection[LAYER_KEY] = layer
    build.children.link(collection)
    return collection


def _link(collection: bpy.types.Collection, thing: bpy.types.Object, build: bpy.types.Collection) -> None:
    thing[OWN_KEY] = True
    hang(thing, state_of(build).root, state_of(build).middle)
    collection.objects.link(thing)
