"""Texts as outlines, by Blender's own fonts, which have letters of nearly all scripts."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

import bpy
import numpy as np

from ..core.arrays import Floats
from ..core.instructions import Lettering, Title

_NOBODYS: Final = "\uffff"
"""What no font has a letter for: it is drawn as a box, as all that is missing."""

_CLOSE: Final = 0.01
"""Sizes of a letter by which two boxes may differ."""

_SMOOTH: Final = 4
"""Straight lines to each curve of a letter: a letter of 15 mm is off by less than 0.05 mm."""


def title_for(text: str) -> Title:
    """Return the name of a model, with outlines if PDF readers do not have all of its letters."""
    title = Title(text)
    return title if title.fits else Title(text, outlines_of(text))


def outlines_of(text: str) -> Lettering:
    """Return the outlines of a line of text.

    Parameters
    ----------
    text : str

    Returns
    -------
    Lettering
        In Blender's own font, where it lacks a letter in those that come with Blender.
    """
    box = _size(_NOBODYS)
    missing = "".join(letter for letter in dict.fromkeys(text) if not letter.isspace() and _alike(_size(letter), box))
    with _curves(text) as mesh:
        points = np.empty(3 * len(mesh.vertices), dtype=np.float32)
        ends = np.empty(2 * len(mesh.edges), dtype=np.int32)
        mesh.vertices.foreach_get("co", points)
        mesh.edges.foreach_get("vertices", ends)
    place = points.reshape(-1, 3)[:, :2].astype(np.float64) * (1.0, -1.0)
    # the corners of an outline follow each other, and it is closed by one edge more
    joined = np.zeros(len(place), dtype=bool)
    low, high = np.sort(ends.reshape(-1, 2), axis=1).T
    joined[high[high - low == 1]] = True
    starts = np.flatnonzero(~joined)
    count = np.diff(np.append(starts, len(place)))
    return Lettering(place, count, float(place[:, 0].max(initial=0.0)), missing)


def _size(letter: str) -> Floats:
    """Return the lower left and the upper right corner of a letter, (4,); zeros if nothing is drawn."""
    with _curves(letter) as mesh:
        place = np.array([tuple(vertex.co)[:2] for vertex in mesh.vertices]).reshape(-1, 2)
    if not len(place):
        return np.zeros(4)
    return np.concatenate([place.min(axis=0), place.max(axis=0)])


def _alike(one: Floats, other: Floats) -> bool:
    return bool(np.abs(one - other).max() < _CLOSE)


@contextmanager
def _curves(text: str) -> Iterator[bpy.types.Mesh]:
    """Draw a text as lines, for a moment."""
    curve = bpy.data.curves.new("Lettering", "FONT")
    thing = bpy.data.objects.new("Lettering", curve)
    curve.body, curve.size, curve.fill_mode, curve.resolution_u = text, 1.0, "NONE", _SMOOTH
    try:
        yield thing.to_mesh()
    finally:
        thing.to_mesh_clear()
        bpy.data.objects.remove(thing)
        bpy.data.curves.remove(curve)
