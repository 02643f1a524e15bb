"""From the unordered segments of a cut to closed, oriented, nested loops in colour.

A loop's edges are the paper's trajectory: outer loops run counter-clockwise,
inner ones clockwise, each edge has one brick colour, and every loop knows the
loop that directly holds it.

References
----------
Paper, sections "Colour trajectory" and "Parent-and-son hierarchy".
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats, Ints
from ..colours import SurfaceColours
from ..geometry import split_at_lattice
from ..mesh import TriangleMesh
from ..model import COLOUR_ANY
from .linking import matched_ends, successors
from .loops import loop_areas, loop_ends, ordered_loops
from .nesting import loop_parents
from .simplify import simplify
from .slices import Slices

Codes = NDArray[np.int16]

_SEVERAL: Final = np.iinfo(np.int16).min
"""Marks a triangle that may have several colours."""

_MOST_PIECES: Final = 1 << 21
"""Pieces between texel borders that are processed at once, to bound the memory."""


@dataclass(frozen=True, slots=True, eq=False)
class Trajectories:
    """Closed loops, one after the other, with a colour on every edge.

    Attributes
    ----------
    points : (n, 2) float64 array
        Start of each edge in mm. An edge ends where the next of its loop starts;
        the last edge of a loop ends at the loop's first point.
    colour : (n,) int16 array
        LDraw code of each edge; ``COLOUR_ANY`` where the edge closes a gap of the mesh.
    face : (n,) int32 array
        Triangle that the edge is cut from, -1 where it closes a gap.
    loop_start : (n_loops + 1,) int64 array
        First edge of each loop, and the number of edges.
    loop_slice : (n_loops,) int32 array
        Slice of each loop.
    loop_parent : (n_loops,) int32 array
        The smallest loop of the slice around it, -1 for the outermost.
    gaps : int
        Number of edges that close a gap.
    """

    points: Floats
    colour: Codes
    face: NDArray[np.int32]
    loop_start: Ints
    loop_slice: NDArray[np.int32]
    loop_parent: NDArray[np.int32]
    gaps: int

    @property
    def ends(self) -> Floats:
        """End of each edge in mm, shape (n, 2)."""
        return loop_ends(self.points, self.loop_start)

    @property
    def edge_loop(self) -> Ints:
        """Loop of each edge, shape (n,)."""
        return np.repeat(np.arange(len(self.loop_slice)), np.diff(self.loop_start))

    def areas(self) -> Floats:
        """Signed area of each loop in mm^2, positive where it runs counter-clockwise, shape (n_loops,)."""
        return loop_areas(self.points, self.loop_start)


@dataclass(frozen=True, slots=True, eq=False)
class Outline:
    """Segments put in order along closed loops, gaps closed.

    Attributes
    ----------
    start : (n, 2) float64 array
        Start of each segment in mm; it ends where the next one of its loop starts.
    segment : (n,) int64 array
        Index of each segment in the slices, -1 where it closes a gap.
    face : (n,) int32 array
        Triangle of each segment, -1 where it closes a gap.
    slice : (n,) int32 array
        Slice of each segment.
    loop_start : (n_loops + 1,) int64 array
        First segment of each loop, and n.
    """

    start: Floats
    segment: Ints
    face: NDArray[np.int32]
    slice: NDArray[np.int32]
    loop_start: Ints

    @property
    def ends(self) -> Floats:
        """End of each segment in mm, shape (n, 2)."""
        return loop_ends(self.start, self.loop_start)


def linked(faces: NDArray[np.int32], slices: Slices) -> Outline:
    """Link the segments of a cut to closed loops.

    Parameters
    ----------
    faces : (n_f, 3) int32 array
        Faces of the mesh that was cut.
    slices : Slices

    Returns
    -------
    Outline
    """
    following = successors(faces, slices)
    tail, head = matched_ends(slices, following)
    if len(tail) == 0:
        order, loop_start = ordered_loops(following)
        return Outline(slices.starts(order), order, slices.face.take(order), slices.slice.take(order), loop_start)
    # a gap's edge runs from the end of the segment before it to the start of the one after
    n = len(slices)
    following = np.concatenate([following, head])
    following[tail] = n + np.arange(len(tail))
    order, loop_start = ordered_loops(following)
    return Outline(
        start=np.concatenate([slices.starts(np.arange(n)), slices.ends(tail)])[order],
        segment=np.where(order < n, order, -1),
        face=np.concatenate([slices.face, np.full(len(tail), -1, np.int32)])[order],
        slice=np.concatenate([slices.slice, slices.slice[tail]])[order],
        loop_start=loop_start,
    )


def link_loops(
    mesh: TriangleMesh, slices: Slices, surface: SurfaceColours, *, chord_deviation: float = 0.0
) -> Trajectories:
    """Link the segments of a cut to closed loops and colour their edges from the texture.

    Parameters
    ----------
    mesh : TriangleMesh
        The mesh that was cut.
    slices : Slices
    surface : SurfaceColours
    chord_deviation : float
        Points of a run of one colour are dropped as long as the run stays within
        this distance in mm; 0 keeps all.

    Returns
    -------
    Trajectories
    """
    outline = linked(mesh.faces, slices)
    points, colour, segment = _coloured_edges(outline, slices, surface)
    loop_start = np.searchsorted(segment, outline.loop_start)
    face = outline.face.take(segment)
    if chord_deviation > 0:
        keep = simplify(points, colour, loop_start, chord_deviation)
        points, colour, face = points[keep], colour[keep], face[keep]
        loop_start = np.concatenate([[0], np.cumsum(keep)])[loop_start]
    loop_slice = outline.slice[outline.loop_start[:-1]]
    parents = loop_parents(points, loop_start, loop_slice)
    return Trajectories(points, colour, face, loop_start, loop_slice, parents, int((face < 0).sum()))


def _coloured_edges(outline: Outline, slices: Slices, surface: SurfaceColours) -> tuple[Floats, Codes, Ints]:
    """Split ordered segments where the brick colour of the texels under them changes.

    Returns the start and colour of every edge, and the segment it is part of.
    """
    colour = _face_colours(slices, surface).take(outline.face)
    colour[outline.face < 0] = COLOUR_ANY
    several = np.flatnonzero(colour == _SEVERAL)
    uvs = slices.uvs(outline.segment[several])
    image = slices.mesh.face_image[outline.face[several]]
    first, last = uvs[:, 0], uvs[:, 1]
    colour[several] = surface.at(image, (first + last) / 2)
    varied = np.flatnonzero(surface.varied(image, np.minimum(first, last), np.maximum(first, last)))
    run, share, run_colour = _colour_runs(uvs.take(varied, axis=0), image[varied], surface)
    several = several[varied]

    count = np.ones(len(colour), dtype=np.int64)
    count[several] = np.bincount(run, minlength=len(several))
    segment = np.repeat(np.arange(len(colour)), count)
    points, colour = outline.start.take(segment, axis=0), colour.take(segment)
    split = np.zeros(len(count), dtype=bool)
    split[several] = True
    place = np.flatnonzero(split.take(segment))
    along = (outline.ends - outline.start).take(several, axis=0)
    points[place] += share[:, None] * along.take(run, axis=0)
    colour[place] = run_colour
    return points, colour, segment


def _face_colours(slices: Slices, surface: SurfaceColours) -> Codes:
    """Return the colour of every face that is cut, ``_SEVERAL`` where it may have several, (n_f,)."""
    mesh = slices.mesh
    cut = slices.face[np.flatnonzero(np.diff(slices.face, prepend=-1))]
    a, b, c = np.moveaxis(mesh.uvs.take(cut, axis=0), 1, 0)
    image = mesh.face_image.take(cut)
    varied = surface.varied(image, np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
    code = np.full(max(len(mesh.faces), 1), _SEVERAL, dtype=np.int16)
    code[cut] = np.where(varied, np.int16(_SEVERAL), surface.at(image, (a + b + c) / 3))
    return code


def _colour_runs(uvs: Floats, image: NDArray[np.int32], surface: SurfaceColours) -> tuple[Ints, Floats, Codes]:
    """Cut segments where the colour changes; return segment, start share and colour of the runs."""
    size = np.array([labels.shape[::-1] for labels in surface.labels])[image]
    pieces = np.abs((uvs[:, 1] - uvs[:, 0]) * size).sum(axis=1) + 1
    block = (np.cumsum(pieces) // _MOST_PIECES).astype(np.int64)
    runs = []
    for rows in np.split(np.arange(len(uvs)), np.flatnonzero(np.diff(block)) + 1):
        start, along = uvs[rows, 0], uvs[rows, 1] - uvs[rows, 0]
        segment, share, end = split_at_lattice(start * size[rows], uvs[rows, 1] * size[rows])
        middle = start.take(segment, axis=0) + ((share + end) / 2)[:, None] * along.take(segment, axis=0)
        colour = surface.at(image[rows].take(segment), middle)
        new = np.ones(len(segment), dtype=bool)
        new[1:] = (segment[1:] != segment[:-1]) | (colour[1:] != colour[:-1])
        runs.append((rows[segment[new]], share[new], colour[new]))
    segment, share, colour = (np.concatenate(parts) for parts in zip(*runs, strict=True))
    return segment, share, colour
