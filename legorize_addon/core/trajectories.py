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
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components
from scipy.spatial import cKDTree

from .colours import SurfaceColours
from .mesh import TriangleMesh
from .model import COLOUR_ANY, Floats, Ints, Mask
from .nesting import loop_parents
from .pieces import split_at_integers
from .simplify import simplified
from .slicing import Slices

_GAPS: Final = (2.0, 8.0)
"""Open ends this near to each other, in mm, are joined before a chain is closed on itself."""


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
    colour: NDArray[np.int16]
    face: NDArray[np.int32]
    loop_start: Ints
    loop_slice: NDArray[np.int32]
    loop_parent: NDArray[np.int32]
    gaps: int

    @property
    def following(self) -> Ints:
        """Index of the edge after each edge in its loop, shape (n,)."""
        return following_in_loops(self.loop_start)

    @property
    def ends(self) -> Floats:
        """End of each edge in mm, shape (n, 2)."""
        return self.points[self.following]

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
    uvs : (n, 2, 2) float64 array
        Image coordinates at start and end, of no meaning where a gap is closed.
    face : (n,) int32 array
        Triangle of each segment, -1 where it closes a gap.
    slice : (n,) int32 array
        Slice of each segment.
    loop_start : (n_loops + 1,) int64 array
        First segment of each loop, and n.
    """

    start: Floats
    uvs: Floats
    face: NDArray[np.int32]
    slice: NDArray[np.int32]
    loop_start: Ints

    @property
    def ends(self) -> Floats:
        """End of each segment in mm, shape (n, 2)."""
        return self.start[following_in_loops(self.loop_start)]


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
    following = np.concatenate([following, head])
    following[tail] = len(slices) + np.arange(len(tail))
    order, loop_start = ordered_loops(following)
    # a gap's edge runs from the end of the segment before it to the start of the one after
    return Outline(
        start=np.concatenate([slices.segments[:, 0], slices.segments[tail, 1]])[order],
        uvs=np.concatenate([slices.uvs, np.zeros((len(tail), 2, 2))])[order],
        face=np.concatenate([slices.face, np.full(len(tail), -1, np.int32)])[order],
        slice=np.concatenate([slices.slice, slices.slice[tail]])[order],
        loop_start=loop_start,
    )


def following_in_loops(loop_start: Ints) -> Ints:
    """Return the index after each one, cyclic within every loop, shape (loop_start[-1],)."""
    after = np.arange(1, int(loop_start[-1]) + 1)
    after[loop_start[1:] - 1] = loop_start[:-1]
    return after


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
    loop_start = outline.loop_start
    points, colour, parent = _coloured_edges(outline, mesh, surface)
    loop_edge = np.searchsorted(parent, loop_start)
    loop_slice = outline.slice[loop_start[:-1]]
    keep = simplified(points, colour, loop_edge, chord_deviation)
    points, colour, face = points[keep], colour[keep], outline.face[parent[keep]]
    loop_edge = np.concatenate([[0], np.cumsum(keep)])[loop_edge]
    parents = loop_parents(points, loop_edge, loop_slice)
    return Trajectories(points, colour, face, loop_edge, loop_slice, parents, int((face < 0).sum()))


def successors(faces: NDArray[np.int32], slices: Slices) -> Ints:
    """Return the segment after each segment, -1 where the mesh has no neighbour.

    Two triangles that share an edge are cut by the same planes there, so the
    neighbour's segment in the same plane follows; no coordinates are compared.
    Where more than two triangles share an edge, those that pass it upwards and
    those that pass it downwards are paired in the order of their numbers.

    Parameters
    ----------
    faces : (n_f, 3) int32 array
    slices : Slices

    Returns
    -------
    (n,) int64 array
    """
    twin = _twins(faces, np.unique(slices.face))
    over = twin[3 * slices.face.astype(np.int64) + slices.exit]
    neighbour = over // 3
    following = slices.first[neighbour] + slices.slice
    following[over < 0] = -1
    return following


def _twins(faces: NDArray[np.int32], active: Ints) -> Ints:
    """Return the opposite half-edge of every half-edge of the active faces, -1 for none, (3 n_f,)."""
    half = (3 * active[:, None] + np.arange(3)).ravel()
    start, end = faces[active].ravel(), faces[active][:, [1, 2, 0]].ravel()
    low, high = np.minimum(start, end).astype(np.int64), np.maximum(start, end)
    edge = low * (int(faces.max()) + 1) + high
    forward = start < end
    twin = np.full(faces.size, -1, dtype=np.int64)
    a, b = _paired(edge[forward], edge[~forward])
    a, b = half[forward][a], half[~forward][b]
    twin[a], twin[b] = b, a
    return twin


def _paired(left: Ints, right: Ints) -> tuple[Ints, Ints]:
    """Pair equal keys of two arrays one to one, in order; return the indices into both."""
    left_order, right_order = np.argsort(left, kind="stable"), np.argsort(right, kind="stable")
    left_key, right_key = _numbered(left[left_order]), _numbered(right[right_order])
    both = np.searchsorted(right_key, left_key)
    hit = np.zeros(len(left), dtype=bool)
    inside = both < len(right)
    hit[inside] = right_key[both[inside]] == left_key[inside]
    return left_order[hit], right_order[both[hit]]


def _numbered(key: Ints) -> Ints:
    """Make sorted keys different by counting the equal ones, at most 1024 of each."""
    first = np.searchsorted(key, key)
    return key * 1024 + np.minimum(np.arange(len(key)) - first, 1023)


def matched_ends(slices: Slices, following: Ints) -> tuple[Ints, Ints]:
    """Choose which open chain goes on where another one breaks off.

    Nearest pairs within one slice are joined first, up to 2 and then 8 mm; what
    is left closes on itself.

    Parameters
    ----------
    slices : Slices
    following : (n,) int64 array
        Segment after each, -1 for an open end.

    Returns
    -------
    tail, head : (k,) int64 arrays
        The last segment before a gap and the first one after it.
    """
    tail = np.flatnonzero(following < 0)
    preceded = np.zeros(len(slices), dtype=bool)
    preceded[following[following >= 0]] = True
    head = np.flatnonzero(~preceded)
    if len(tail) == 0:
        return tail, head
    match = np.full(len(tail), -1, dtype=np.int64)
    for gap in _GAPS:
        _match_nearest(slices, tail, head, match, gap)
    _close_on_itself(following, tail, head, match)
    return tail, head[match]


def _match_nearest(slices: Slices, tail: Ints, head: Ints, match: Ints, gap: float) -> None:
    """Join mutually nearest open ends of the same slice, again and again until none is within the gap."""
    apart = 4 * gap
    ends = np.column_stack([slices.segments[tail, 1], slices.slice[tail] * apart])
    starts = np.column_stack([slices.segments[head, 0], slices.slice[head] * apart])
    while True:
        open_tail = np.flatnonzero(match < 0)
        open_head = np.setdiff1d(np.arange(len(head)), match)
        if len(open_tail) == 0:
            return
        forth, near = cKDTree(starts[open_head]).query(ends[open_tail], distance_upper_bound=gap)
        _, back = cKDTree(ends[open_tail]).query(starts[open_head], distance_upper_bound=gap)
        within = np.flatnonzero(np.isfinite(forth))
        mutual = within[back[near[within]] == within]
        if len(mutual) == 0:
            return
        match[open_tail[mutual]] = open_head[near[mutual]]


def _close_on_itself(following: Ints, tail: Ints, head: Ints, match: Ints) -> None:
    """Join the end of every chain that is still open to its own start."""
    joined = following.copy()
    done = match >= 0
    joined[tail[done]] = head[match[done]]
    linked = np.flatnonzero(joined >= 0)
    graph = csr_array((np.ones(len(linked)), (linked, joined[linked])), shape=(len(joined), len(joined)))
    _, chain = connected_components(graph, directed=False)
    free_tail, free_head = np.flatnonzero(~done), np.setdiff1d(np.arange(len(head)), match)
    a, b = _paired(chain[tail[free_tail]].astype(np.int64), chain[head[free_head]].astype(np.int64))
    match[free_tail[a]] = free_head[b]


def ordered_loops(following: Ints) -> tuple[Ints, Ints]:
    """Put the cycles of a permutation one after the other.

    Parameters
    ----------
    following : (n,) int64 array
        A permutation.

    Returns
    -------
    order : (n,) int64 array
        Elements in cyclic order, cycle after cycle; each starts at its lowest
        element and the cycles are sorted by it.
    loop_start : (n_loops + 1,) int64 array
        Where each cycle starts in ``order``, and n.
    """
    n = len(following)
    if n == 0:
        return np.zeros(0, dtype=np.int64), np.zeros(1, dtype=np.int64)
    graph = csr_array((np.ones(n, dtype=np.int8), following, np.arange(n + 1)), shape=(n, n))
    _, label = connected_components(graph, directed=False)
    _, first = np.unique(label, return_index=True)
    first = np.sort(first)
    # open every cycle before its first element and hang it behind the one before:
    # then the whole is one chain, which a breadth-first walk follows in compiled code
    last = np.empty(n, dtype=np.int64)
    last[following] = np.arange(n)
    chain = following.copy()
    chain[last[first]] = np.append(first[1:], -1)
    kept = chain >= 0
    links = csr_array(
        (np.ones(n - 1, dtype=np.int8), chain[kept], np.concatenate([[0], np.cumsum(kept)])), shape=(n, n)
    )
    order = breadth_first_order(links, int(first[0]), return_predecessors=False).astype(np.int64)
    size = np.bincount(label)[label[first]]
    return order, np.concatenate([[0], np.cumsum(size)])


def loop_areas(points: Floats, loop_start: Ints) -> Floats:
    """Return the signed areas of closed polygons, (n_loops,), positive where counter-clockwise."""
    if len(points) == 0:
        return np.zeros(len(loop_start) - 1)
    after = following_in_loops(loop_start)
    # around the first point of each loop, so that far-away loops lose no digits
    base = np.repeat(points[loop_start[:-1]], np.diff(loop_start), axis=0)
    here, there = points - base, points[after] - base
    cross = here[:, 0] * there[:, 1] - here[:, 1] * there[:, 0]
    area: Floats = np.add.reduceat(cross, loop_start[:-1]) / 2
    return area


def _coloured_edges(
    outline: Outline, mesh: TriangleMesh, surface: SurfaceColours
) -> tuple[Floats, NDArray[np.int16], Ints]:
    """Split ordered segments where the brick colour of the texels under them changes.

    Returns the start and colour of every edge, and the segment it is part of.
    """
    start, uvs, face = outline.start, outline.uvs, outline.face
    image = mesh.face_image[np.maximum(face, 0)]
    varied = surface.varied(image, uvs.min(axis=1), uvs.max(axis=1)) & (face >= 0)
    segment, share, middle = _texel_pieces(uvs, image, varied, surface)
    colour = surface.at(image[segment], middle)
    colour[face[segment] < 0] = COLOUR_ANY
    new_run = np.ones(len(segment), dtype=bool)
    new_run[1:] = (segment[1:] != segment[:-1]) | (colour[1:] != colour[:-1])
    segment, share, colour = segment[new_run], share[new_run], colour[new_run]
    points = start[segment] + share[:, None] * (outline.ends[segment] - start[segment])
    return points, colour, segment


def _texel_pieces(
    uvs: Floats, image: NDArray[np.int32], varied: Mask, surface: SurfaceColours
) -> tuple[Ints, Floats, Floats]:
    """Cut the varied segments at every texel border; return segment, start share and middle uv of the pieces."""
    size = np.array([labels.shape[::-1] for labels in surface.labels])[image]
    # segments in one colour are left whole: a zero size puts them into one texel
    first = uvs[:, 0] * size * varied[:, None]
    last = uvs[:, 1] * size * varied[:, None]
    segment, low, high = split_at_integers(first[:, 0], last[:, 0])
    rise = last[segment, 1] - first[segment, 1]
    piece, low2, high2 = split_at_integers(
        first[segment, 1] + low * rise, first[segment, 1] + high * rise
    )
    segment, low, width = segment[piece], low[piece], (high - low)[piece]
    low, high = low + low2 * width, low + high2 * width
    middle = uvs[segment, 0] + ((low + high) / 2)[:, None] * (uvs[segment, 1] - uvs[segment, 0])
    return segment, low, middle
