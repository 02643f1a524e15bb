"""What is shown of a build: its lower layers, its part behind a cut, its source while it is read.

Nothing here touches the bricks' data.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import bpy
import numpy as np

from .brick_points import read_positions
from .nodes import set_section
from .scene import BUILD_KEY, LAYER_KEY, layers_of, point_objects


def show_layers(scene: bpy.types.Scene, build: bpy.types.Collection, top: int) -> None:
    """Show the lower layers of a build and hide those above, in the viewport and in renders.

    Parameters
    ----------
    scene : bpy.types.Scene
        Scene whose view layers are changed.
    build : bpy.types.Collection
        The build.
    top : int
        Number of layers to show, from the lowest.
    """
    build[BUILD_KEY]["top_layer"] = top
    hidden = {layer: layer[LAYER_KEY] >= top for layer in layers_of(build)}
    for layer, hide in hidden.items():
        if layer.hide_render != hide:
            layer.hide_render = hide
    # the eye of the outliner: unlike Collection.hide_viewport it makes Blender evaluate nothing again
    for view_layer in scene.view_layers:
        for entry in _layer_collections(view_layer.layer_collection):
            if entry.collection in hidden:
                entry.hide_viewport = hidden[entry.collection]


def cut_away(build: bpy.types.Collection, direction: tuple[int, int, int], share: float) -> None:
    """Hide the bricks beyond an upright plane; the data stay as they are.

    Parameters
    ----------
    build : bpy.types.Collection
        The build.
    direction : tuple of three int
        Unit vector along an axis, towards the hidden side; all zero shows everything.
    share : float
        Share of the model's extent along the axis that is hidden, in [0, 1].
    """
    found = point_objects(build)
    along = read_positions([points.data for points in found]) @ np.array(direction, dtype=np.float64)
    # bricks are hidden whole, by their middle: the margin makes share 0 hide none
    low, high = along.min() - 1.0, along.max() + 1.0
    for points in found:
        set_section(points, direction, high - share * (high - low) if any(direction) else 0.0)


@contextmanager
def readable(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Show objects while they are read: Blender evaluates no modifiers of hidden ones.

    Parameters
    ----------
    objects : sequence of bpy.types.Object
        Hidden again at the end of the context where they were hidden before.
    """
    before = [thing.hide_viewport for thing in objects]
    for thing in objects:
        thing.hide_viewport = False
    try:
        yield
    finally:
        for thing, hidden in zip(objects, before, strict=True):
            thing.hide_viewport = hidden


def _layer_collections(entry: bpy.types.LayerCollection) -> Iterator[bpy.types.LayerCollection]:
    yield entry
    for child in entry.children:
        yield from _layer_collections(child)
