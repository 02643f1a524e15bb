"""How near unit bricks and plates come to a mesh, beside cells that are filled where their middle lies inside it.

Nothing is hollowed or laid: what is compared is the solid model of the cells.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from legorize_addon.core.build import Draft
from legorize_addon.core.drafting import draft_model
from legorize_addon.core.geometry import ranges
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.settings import Settings
from legorize_addon.core.slicing.coverage import covered_area
from legorize_addon.core.slicing.slices import slice_mesh
from legorize_addon.core.slicing.trajectories import linked
from legorize_addon.core.units import CELL_AREA, PLATE, PLATES_PER_BRICK, STUD
from scripts.benchmarks.surface import outer_faces, seen_surface
from scripts.benchmarks.tables import Row

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

POINTS: Final = 60_000
"""On the surface, for its distance from the cells."""

PLANES: Final = 8
"""In a plate, for the volume inside the mesh."""

NEAR: Final = 8
"""Pieces of faces that are tried for the nearest one."""

WAYS: Final = {"bricks": "none", "plates": "all"}
"""What the cells are, and the setting for it."""


def accuracy(mesh: TriangleMesh, settings: Settings) -> Row:
    """Compare a mesh with its cells in bricks and in plates, and with those that centre points choose on these grids.

    Parameters
    ----------
    mesh : TriangleMesh
        As read.
    settings : Settings

    Returns
    -------
    dict
        ``bricks_mm``, ``plates_mm``: mean distance from the visible surface to the nearest outer face of a cell;
        ``bricks_iou``, ``plates_iou``: volume that is in the mesh and in the cells, of that in either; the same with
        ``_centres`` for cells whose middle is inside. An open mesh has no inside, and a thin one no middles: what
        cannot be measured is None.
    """
    drafts = {name: draft_model(mesh, replace(settings, plates=plates)) for name, plates in WAYS.items()}
    points = seen_surface(drafts["plates"], POINTS).points
    row = Row()
    for name, draft in drafts.items():
        solid, height = levels(draft), 1 if name == "plates" else PLATES_PER_BRICK
        ways: dict[str, Mask | None] = {name: solid, f"{name}_centres": None}
        inside = None
        if draft.repairs.watertight:
            ways[f"{name}_centres"] = centres_inside(draft, height)
            inside = shares_inside(draft)
        for way, cells in ways.items():
            there = cells is not None and bool(cells.any())
            row[f"{way}_mm"] = mean_distance(points, cells, draft.grid.origin) if there else None
            row[f"{way}_iou"] = overlap(cells, inside) if there and inside is not None else None
    return row


def levels(draft: Draft) -> Mask:
    """Return the solid cells plate by plate, (n_plates, n_y, n_x)."""
    return draft.grid.solid.reshape(-1, *draft.grid.solid.shape[2:])


def centres_inside(draft: Draft, height: int) -> Mask:
    """Choose the cells whose middle is inside the mesh.

    Parameters
    ----------
    draft : Draft
    height : int
        Of a cell in plates: 1 or 3.

    Returns
    -------
    (n_plates, n_y, n_x) bool array
    """
    n_levels, n_y, n_x = levels(draft).shape
    heights = draft.grid.origin[2] + (np.arange(n_levels // height) + 0.5) * height * PLATE
    outline = linked(draft.mesh.faces, slice_mesh(draft.mesh, heights))
    start, end = ((ends - draft.grid.origin[:2]) / STUD - 0.5 for ends in (outline.start, outline.ends))
    low, high = (np.ceil(pick(start[:, 1], end[:, 1])).astype(np.int64) for pick in (np.minimum, np.maximum))
    low, high = np.clip(low, 0, n_y), np.clip(high, 0, n_y)
    edge, line = ranges(low, high - low)
    along = (line - start[edge, 1]) / (end - start)[edge, 1]
    column = np.clip(np.ceil(start[edge, 0] + along * (end - start)[edge, 0]), 0, n_x).astype(np.int64)
    place = (outline.slice[edge].astype(np.int64) * n_y + line) * (n_x + 1) + column
    # the inside is on the left: it begins right of an edge that goes down
    turns = np.bincount(place, np.sign(start - end)[edge, 1], len(heights) * n_y * (n_x + 1))
    winding = np.cumsum(turns.reshape(len(heights), n_y, n_x + 1), axis=2)[:, :, :n_x]
    return np.repeat(winding > 0.5, height, axis=0)


def shares_inside(draft: Draft) -> Floats:
    """Return the share of every cell, a plate high, that is inside the mesh, (n_plates, n_y, n_x)."""
    n_levels, n_y, n_x = levels(draft).shape
    heights = draft.grid.origin[2] + (np.arange(n_levels * PLANES) + 0.5) * PLATE / PLANES
    outline = linked(draft.mesh.faces, slice_mesh(draft.mesh, heights))
    area = covered_area(outline, len(heights), draft.grid.origin[:2], n_y, n_x)
    return area.reshape(n_levels, PLANES, n_y, n_x).mean(axis=1) / CELL_AREA


def overlap(cells: Mask, inside: Floats) -> float:
    """Return the volume in both of that in either."""
    both = inside[cells].sum()
    return float(both / (inside.sum() + cells.sum() - both))


def mean_distance(points: Floats, cells: Mask, origin: Floats) -> float:
    """Measure how far points are from the outer faces of cells.

    Parameters
    ----------
    points : (n, 3) float64 array
        In mm.
    cells : (n_plates, n_y, n_x) bool array
    origin : (3,) float64 array
        Corner of the first one in mm.

    Returns
    -------
    float
        Mean distance in mm.
    """
    middle, half = pieces_of_faces(cells)
    near = cKDTree(middle).query(points - origin, k=min(NEAR, len(middle)))[1].reshape(len(points), -1)
    beyond = np.maximum(np.abs((points - origin)[:, None] - middle[near]) - half[near], 0)
    return float(np.linalg.norm(beyond, axis=2).min(axis=1).mean())


def pieces_of_faces(cells: Mask) -> tuple[Floats, Floats]:
    """Return middle and half size along x, y and z, in mm, of pieces that make up the outer faces, (n, 3) each."""
    size = np.array([STUD, STUD, PLATE])
    places, _ = outer_faces(cells)
    # a third of a stud in each direction on a level face; upright ones are cut along their length alone
    level = np.abs(places[:, 2] - np.round(places[:, 2])) < 0.25
    across = np.abs(places - np.round(places)) < 0.1
    half = np.where(across, 0.0, np.where(level[:, None], [1 / 6, 1 / 6, 0.0], [1 / 6, 1 / 6, 0.5]))
    return places * size, half * size
