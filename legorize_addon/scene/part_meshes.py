"""The mesh of each part: body, studs and tubes, drawn from numbers, without a logo.

A mesh is made once for each part and level of detail and shared by all bricks,
whatever their colour. It is in mm; its origin is the middle of the bounding
box's lower face, so that a quarter turn about z keeps the box on the grid.

Every shape here is a loft: rings of points above one another, joined by
quadrilaterals, with an n-gon as the lid. Bodies that fall along their length
are in :mod:`.slope_bodies`, those with slanted sides in :mod:`.wedge_bodies`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.model import Catalogue, Part, columns, depths, outline
from ..core.units import PLATE, STUD
from .lofts import BEVEL, GAP, ROOF, WALL, Detail, Floats, Loft
from .rounding import corner_normals
from .slope_bodies import level, slope_body
from .wedge_bodies import wedge_body

Ring = tuple[float, float]
"""An inset (bodies) or radius (studs, tubes) and a height, in mm."""

STUD_RADIUS: Final = 2.4
STUD_HEIGHT: Final = 1.7
TUBE_RADIUS: Final = 3.25
TUBE_HOLE: Final = 2.4
PIN_RADIUS: Final = 1.6
GROOVE: Final = 0.4
SIDES: Final[dict[Detail, int]] = {"low": 8, "high": 16}
MESH_KEY: Final = "legorize_mesh"
PART_KEY: Final = "legorize_part"


def part_loft(part: Part, detail: Detail) -> Loft:
    """Return the faces of a part.

    Parameters
    ----------
    part : Part
        The part of the catalogue.
    detail : {"low", "high"}
        Low: a closed box with 8-sided studs. High: bevelled edges, 16-sided
        studs, hollow from below, with tubes.

    Returns
    -------
    Loft
        All faces, with the origin in the middle of the bounding box's lower face. A
        baseplate fills the upper half of its box, and is closed from below.
    """
    height = part.height * PLATE
    rings = _stud_rings(height, "low" if part.use == "base" else detail)
    middle = np.array([part.length, part.width, 0.0]) * STUD / 2
    lofts = [_body(part, height, detail)]
    lofts += [_round(rings, centre, detail, lid=True) for centre in _stud_centres(part)]
    if detail == "high" and part.sockets:
        lofts += [_tube(part, _roof(part, height, centre), centre) for centre in _tube_centres(part)]
    whole = _join(lofts)
    return Loft(whole.vertices - middle, whole.corners, whole.starts, whole.smooth)


def part_mesh(part: Part, detail: Detail) -> bpy.types.Mesh:
    """Return the shared mesh of a part, made at the first call in a file.

    Parameters
    ----------
    part : Part
        The part of the catalogue.
    detail : {"low", "high"}
        As for :func:`part_loft`.

    Returns
    -------
    bpy.types.Mesh
        Mesh in mm with one empty material slot.
    """
    key = f"{part.number} {detail}"
    for mesh in bpy.data.meshes:
        if mesh.get(MESH_KEY) == key:
            return mesh
    loft, normals = _drawn(part, detail)
    mesh = _to_mesh(loft, f"Brick {key}")
    if normals:
        mesh.polygons.foreach_set("use_smooth", np.ones(len(loft.starts), dtype=bool))
        mesh.normals_split_custom_set(normals)
    mesh[MESH_KEY] = key
    return mesh


@cache
def _drawn(part: Part, detail: Detail) -> tuple[Loft, list[list[float]]]:
    """Return the faces of a part and the normals of their corners, none in low detail: every update needs them anew."""
    loft = part_loft(part, detail)
    return loft, corner_normals(loft).tolist() if detail == "high" else []


def parts_collection(
    kinds: Sequence[tuple[Part, bpy.types.Material]], detail: Detail, name: str
) -> bpy.types.Collection:
    """Return a new collection outside of all scenes with one object a part and material.

    Parameters
    ----------
    kinds : sequence of (Part, bpy.types.Material)
        What is in use; the rows are the variants that points count to.
    detail : {"low", "high"}
        As for :func:`part_loft`.
    name : str
        Name of the source, for the collection.

    Returns
    -------
    bpy.types.Collection
        Its objects share the meshes and carry the material themselves.
    """
    collection = bpy.data.collections.new(f"Legorize parts {name}")
    for row, (part, material) in enumerate(kinds):
        # Geometry Nodes counts a collection's objects by name: the row comes first
        variant = bpy.data.objects.new(f"{row:04d} {part.number} {material.name}", part_mesh(part, detail))
        variant[PART_KEY] = part.number
        variant.material_slots[0].link = "OBJECT"
        variant.material_slots[0].material = material
        collection.objects.link(variant)
    return collection


def parts_in_use(parts: bpy.types.Collection, rows: NDArray[np.integer], name: str) -> bpy.types.Collection:
    """Return a new collection, inside that of all parts, with those that one layer needs.

    Geometry Nodes looks at every part of a collection for every object, and
    compares each with all others: few of few make sections quick.

    Parameters
    ----------
    parts : bpy.types.Collection
        Made by :func:`parts_collection`.
    rows : (n,) integer array
        The variants to take, ascending.
    name : str
        Name of the layer, for the collection.

    Returns
    -------
    bpy.types.Collection
    """
    collection = bpy.data.collections.new(f"{parts.name} {name}")
    parts.children.link(collection)
    variants = parts.objects.values()
    for row in rows.tolist():
        collection.objects.link(variants[row])
    return collection


def set_detail(parts: bpy.types.Collection, catalogue: Catalogue, detail: Detail) -> None:
    """Exchange the meshes of a collection made by :func:`parts_collection`, and of those inside it.

    Parameters
    ----------
    parts : bpy.types.Collection
        The collection.
    catalogue : Catalogue
        The parts.
    detail : {"low", "high"}
        As for :func:`part_loft`.
    """
    for variant in parts.all_objects:
        variant.data = part_mesh(catalogue.parts[catalogue.part_row(variant[PART_KEY])], detail)


def detail_of(parts: bpy.types.Collection) -> Detail:
    """Return the detail of the meshes of a collection made by :func:`parts_collection`."""
    return "low" if parts.objects[0].data[MESH_KEY].endswith("low") else "high"


def _to_mesh(loft: Loft, name: str) -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(loft.vertices))
    mesh.loops.add(len(loft.corners))
    mesh.polygons.add(len(loft.starts))
    mesh.vertices.foreach_set("co", loft.vertices.astype(np.float32).ravel())
    mesh.loops.foreach_set("vertex_index", loft.corners)
    mesh.polygons.foreach_set("loop_start", loft.starts)
    mesh.polygons.foreach_set("use_smooth", loft.smooth)
    mesh.update(calc_edges=True)
    mesh.materials.append(None)
    return mesh


def _body(part: Part, height: float, detail: Detail) -> Loft:
    if part.sloped:
        return slope_body(part, detail)
    if part.wedge:
        return wedge_body(part, detail)
    corners = outline(part) * STUD
    if detail == "low" or not part.sockets:
        low = 0.0 if part.sockets else height / 2
        return _loft([_inset(corners, GAP, 0.0, z) for z in (low, height - GAP)], floor=True, lid=True)
    # tiles have a groove around their lower edge, to lift them off by
    edge = [(GAP + BEVEL, 0.0), (GAP, BEVEL)] if part.studs else [(GROOVE, 0.0), (GROOVE, GROOVE), (GAP, GROOVE)]
    rings: list[Ring] = [
        (WALL, height - ROOF),
        (WALL, 0.0),
        *edge,
        (GAP, height - GAP - BEVEL),
        (GAP + BEVEL, height - GAP),
    ]
    return _loft([_inset(corners, inset, BEVEL, z) for inset, z in rings], floor=True, lid=True)


def _round(rings: Sequence[Ring], centre: Floats, detail: Detail, *, floor: bool = False, lid: bool = False) -> Loft:
    angles = (np.arange(SIDES[detail]) + 0.5) * (2 * math.pi / SIDES[detail])
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = [np.insert(centre + radius * circle, 2, z, axis=1) for radius, z in rings]
    return _loft(points, floor=floor, lid=lid, smooth=True)


def _stud_rings(height: float, detail: Detail) -> list[Ring]:
    top = height + STUD_HEIGHT
    if detail == "low":
        return [(STUD_RADIUS, height - GAP), (STUD_RADIUS, top)]
    return [(STUD_RADIUS, height - GAP), (STUD_RADIUS, top - BEVEL), (STUD_RADIUS - BEVEL, top)]


def _tube(part: Part, roof: float, centre: Floats) -> Loft:
    """Return the tube between four studs of a wide part, or the pin between two of a narrow one, up to the roof."""
    if part.width == 1:
        return _round([(PIN_RADIUS, 0.0), (PIN_RADIUS, roof)], centre, "high", floor=True)
    rings = [(TUBE_HOLE, roof), (TUBE_HOLE, 0.0), (TUBE_RADIUS, 0.0), (TUBE_RADIUS, roof)]
    return _round(rings, centre, "high")


def _roof(part: Part, height: float, centre: Floats) -> float:
    """Return how high the hollow of a part is at a tube."""
    radius = PIN_RADIUS if part.width == 1 else TUBE_RADIUS
    return (level(part, centre[0] + radius) if part.sloped else height) - ROOF


def _stud_centres(part: Part) -> Floats:
    """Return the middles of the studs in mm from the box's corner, shape (n, 2); none for a tile."""
    if part.jumper:
        return np.array([[part.length, part.width]]) * STUD / 2
    found = columns(part, 0)
    return (found.xy[found.stud] + 0.5) * STUD


def _tube_centres(part: Part) -> Floats:
    """Return the middles of the tubes (wide parts) or pins (narrow ones) in mm, shape (n, 2)."""
    if part.jumper and part.width == 1:
        # what lies on a jumper's stud has no room for a pin
        return np.zeros((0, 2))
    across = np.arange(1, part.width) if part.width > 1 else np.array([0.5])
    y, x = (each.ravel() for each in np.meshgrid(across, np.arange(1, part.length), indexing="ij"))
    centres = np.stack([x, y], axis=1)
    if part.wedge:
        # only where one has room between the sides
        return centres[depths(outline(part) * STUD, centres * STUD) >= TUBE_RADIUS + WALL] * STUD
    if part.sloped:
        # only between squares that stand on the same level, and clutch
        found = columns(part, 0)
        level_of = np.full((part.length, part.width), -1)
        level_of[tuple(found.xy[found.socket & (found.low == 0)].T)] = 0
        row = np.maximum(x - 1, 0).astype(int), np.maximum(np.ceil(y) - 1, 0).astype(int)
        centres = centres[(level_of[row] == 0) & (level_of[row[0] + 1, row[1]] == 0)]
    # the tube of a corner part would stand in its missing cell
    return centres[: 0 if part.corner else None] * STUD


def _inset(outline: Floats, inset: float, chamfer: float, z: float) -> Floats:
    """Move a right-angled outline inwards and cut its corners off; shape (n, 3) or (2 n, 3)."""
    ahead = np.roll(outline, -1, axis=0) - outline
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
    behind = np.roll(ahead, 1, axis=0)
    inwards = np.stack([-ahead[:, 1] - behind[:, 1], ahead[:, 0] + behind[:, 0]], axis=1)
    points = outline + inset * inwards
    if chamfer:
        points = np.stack([points - chamfer * behind, points + chamfer * ahead], axis=1).reshape(-1, 2)
    return np.insert(points, 2, z, axis=1)


def _loft(rings: Sequence[Floats], *, floor: bool, lid: bool, smooth: bool = False) -> Loft:
    """Join rings of equally many points, each (n, 3), from the first to the last."""
    n, steps = len(rings[0]), len(rings) - 1
    first = np.arange(n)
    second = np.roll(first, -1)
    ring = np.stack([first, second, second + n, first + n], axis=1)
    quads = (ring[None] + n * np.arange(steps)[:, None, None]).reshape(-1)
    lids = [first[::-1]] * floor + [first + n * steps] * lid
    starts = np.concatenate([np.arange(n * steps) * 4, n * steps * 4 + n * np.arange(len(lids))])
    return Loft(
        np.concatenate(rings),
        np.concatenate([quads, *lids]).astype(np.int32),
        starts.astype(np.int32),
        np.arange(len(starts)) < n * steps * smooth,
    )


def _join(lofts: Sequence[Loft]) -> Loft:
    vertex = np.cumsum([0] + [len(loft.vertices) for loft in lofts[:-1]])
    corner = np.cumsum([0] + [len(loft.corners) for loft in lofts[:-1]])
    return Loft(
        np.concatenate([loft.vertices for loft in lofts]),
        np.concatenate([loft.corners + shift for loft, shift in zip(lofts, vertex, strict=True)]).astype(np.int32),
        np.concatenate([loft.starts + shift for loft, shift in zip(lofts, corner, strict=True)]).astype(np.int32),
        np.concatenate([loft.smooth for loft in lofts]),
    )
