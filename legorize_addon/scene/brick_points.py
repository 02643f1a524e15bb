"""The table of bricks as the points of meshes, and back.

A point is the middle of its brick's lower face, in model mm; the columns of
:class:`~legorize_addon.core.model.bricks.Bricks` are attributes of the same names.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

import bpy
import numpy as np
from numpy.typing import NDArray

from ..core.arrays import Floats
from ..core.model import CELL_SIZE, Bricks, Catalogue
from ..core.units import PLATE

Rows = NDArray[np.integer]

COLUMNS: Final = ("part", "turn", "colour", "role", "piece", "step")
HALVES: Final = ("half_x", "half_y")
"""Attributes of models that know half studs."""

VARIANT: Final = "variant"
"""Attribute that chooses the instanced object."""

HEIGHT: Final = "height"
"""Attribute with the height of a brick in plates."""

ROW: Final = "row"
"""Attribute with the row of a brick in the table it came from."""

BUILT_AT: Final = "built_at"
"""Attribute with the place of a brick as it was built, in model mm: its point may be moved."""

MARGIN: Final = "margin"
"""Attribute with what a brick has left before it fails, where that was found out."""

NO_MARGIN: Final = float("inf")
"""Margin of what is no part of the finished model, and was not checked."""

KINDS: Final[dict[str, tuple[str, type[np.generic], tuple[int, ...]]]] = {
    "INT": ("value", np.int32, ()),
    "FLOAT": ("value", np.float32, ()),
    "FLOAT_VECTOR": ("vector", np.float32, (3,)),
}
"""Of each kind of attribute in use: where Blender keeps it, as what, and the shape of a value."""


def sizes(part: Rows, turn: Rows, catalogue: Catalogue) -> NDArray[np.int32]:
    """Return the studs that turned parts cover along x and y.

    Parameters
    ----------
    part : (n,) integer array
        Rows of the catalogue.
    turn : (n,) integer array
        Quarter turns.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    (n, 2) int32 array
    """
    along = np.array([(entry.length, entry.width) for entry in catalogue.parts], dtype=np.int32)[part]
    return np.where((turn % 2 == 1)[:, None], along[:, ::-1], along)


def positions(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middles of the bricks' lower faces, about which they turn.

    Parameters
    ----------
    bricks : Bricks
        The table, n rows.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    (n, 3) float64 array
        Points in model mm.
    """
    return (bricks.corner + bricks.shift + _half(sizes(bricks.part, bricks.turn, catalogue))) * CELL_SIZE


def middles(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the middles of the bricks' bodies in model mm, shape (n, 3) float64."""
    return positions(bricks, catalogue) + np.outer(heights(bricks, catalogue), (0.0, 0.0, PLATE / 2))


def heights(bricks: Bricks, catalogue: Catalogue) -> NDArray[np.int32]:
    """Return the heights of the bricks in plates, shape (n,) int32."""
    return catalogue.height[bricks.part].astype(np.int32)


def box_corners(bricks: Bricks, catalogue: Catalogue) -> Floats:
    """Return the corners of the bricks' bounding boxes, studs left out.

    Parameters
    ----------
    bricks : Bricks
        The table, n rows.
    catalogue : Catalogue
        Parts and colours.

    Returns
    -------
    (8 n, 3) float64 array
        Eight points a brick in model mm.
    """
    size = np.column_stack([sizes(bricks.part, bricks.turn, catalogue), heights(bricks, catalogue)])
    unit = np.stack(np.meshgrid([0, 1], [0, 1], [0, 1]), axis=-1).reshape(-1, 3)
    return (((bricks.corner + bricks.shift)[:, None] + unit * size[:, None]) * CELL_SIZE).reshape(-1, 3)


def points_mesh(
    name: str, bricks: Bricks, catalogue: Catalogue, variant: Rows, row: Rows, more: Mapping[str, NDArray[np.generic]]
) -> bpy.types.Mesh:
    """Return a new mesh with one point a brick.

    Parameters
    ----------
    name : str
        Name of the mesh.
    bricks : Bricks
        The table, n rows.
    catalogue : Catalogue
        Parts and colours.
    variant : (n,) integer array
        Row of each brick's part and colour among the instanced objects.
    row : (n,) integer array
        Row of each brick in the whole model's table.
    more : mapping of str to array
        Further attributes: (n,) whole numbers or floats, (n, 3) vectors.

    Returns
    -------
    bpy.types.Mesh
    """
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(bricks))
    mesh.vertices.foreach_set("co", positions(bricks, catalogue).astype(np.float32).ravel())
    columns = {column: getattr(bricks, column) for column in COLUMNS}
    columns |= {VARIANT: variant, ROW: row, HEIGHT: heights(bricks, catalogue)}
    columns |= {BUILT_AT: positions(bricks, catalogue), **more}
    if bricks.half is not None:
        columns |= dict(zip(HALVES, bricks.half.T, strict=True))
    for key, values in columns.items():
        _write(mesh, key, values)
    return mesh


def _write(mesh: bpy.types.Mesh, name: str, values: NDArray[np.generic]) -> None:
    number = "FLOAT" if np.issubdtype(values.dtype, np.floating) else "INT"
    kind = "FLOAT_VECTOR" if values.ndim == 2 else number
    field, dtype, _ = KINDS[kind]
    mesh.attributes.new(name, kind, "POINT").data.foreach_set(field, values.astype(dtype).ravel())


def read_points(meshes: Sequence[bpy.types.Mesh], part_numbers: Sequence[str], catalogue: Catalogue) -> Bricks:
    """Return the table of bricks that meshes of points hold, in its first order.

    Parameters
    ----------
    meshes : sequence of bpy.types.Mesh
        Made by :func:`points_mesh`.
    part_numbers : sequence of str
        LDraw numbers of the parts, by the rows that the meshes mean.
    catalogue : Catalogue
        Parts and colours of today.

    Returns
    -------
    Bricks
        The table. A brick whose point was moved is where its point is now.

    Raises
    ------
    BuildError
        A part number is not in the catalogue.
    """
    part, turn, colour, role, piece, step = read_columns(meshes, COLUMNS).values()
    order = _order(meshes)
    part = np.array([catalogue.part_row(number) for number in part_numbers], dtype=np.int16)[part]
    position = read_positions(meshes)[order]
    known = all(name in mesh.attributes for mesh in meshes for name in HALVES)
    half = np.stack(list(read_columns(meshes, HALVES).values()), axis=1).astype(np.uint8) if known else None
    beyond = np.zeros((len(part), 3)) if half is None else np.insert(half / 2, 2, 0.0, axis=1)
    return Bricks(
        part=part,
        corner=np.rint(position / CELL_SIZE - beyond - _half(sizes(part, turn, catalogue))).astype(np.int32),
        turn=turn.astype(np.uint8),
        colour=colour.astype(np.int16),
        role=role.astype(np.uint8),
        piece=piece.astype(np.int16),
        step=step,
        half=half,
    )


def read_positions(meshes: Sequence[bpy.types.Mesh]) -> Floats:
    """Return the points of several meshes in mm, shape (n, 3) float64."""
    found = [np.empty(3 * len(mesh.vertices), dtype=np.float32) for mesh in meshes]
    for mesh, values in zip(meshes, found, strict=True):
        mesh.vertices.foreach_get("co", values)
    return np.concatenate(found).reshape(-1, 3).astype(np.float64)


def read_columns(meshes: Sequence[bpy.types.Mesh], names: Sequence[str]) -> dict[str, NDArray[np.generic]]:
    """Return attributes of the points of several meshes, in the first order of the table."""
    order = _order(meshes)
    return {name: np.concatenate([read_column(mesh, name) for mesh in meshes])[order] for name in names}


def _order(meshes: Sequence[bpy.types.Mesh]) -> NDArray[np.intp]:
    return np.argsort(np.concatenate([read_column(mesh, ROW) for mesh in meshes]), kind="stable")


def _half(size: NDArray[np.int32]) -> Floats:
    return np.insert(size / 2, 2, 0.0, axis=1)


def read_column(mesh: bpy.types.Mesh, name: str) -> NDArray[np.generic]:
    """Return an attribute of the points of a mesh."""
    attribute = mesh.attributes[name]
    field, dtype, shape = KINDS[attribute.data_type]
    values = np.empty((len(mesh.vertices), *shape), dtype=dtype)
    attribute.data.foreach_get(field, values.ravel())
    return values
