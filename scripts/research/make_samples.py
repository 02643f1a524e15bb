"""Make ``assets/sample.glb``, the textured rooster that comes with Legorize.

Run it with any Python that has numpy, scipy and xatlas, for example the one
with the ``bpy`` module::

    python scripts/research/make_samples.py [FILE]

``rooster.py`` says what the rooster looks like; here it is meshed, unwrapped,
painted and packed as one binary glTF file. Everything is own work, dedicated
to the public domain (CC0 1.0). The same source gives the same file.
"""

from __future__ import annotations

import json
import struct
import sys
import zlib
from pathlib import Path
from typing import Any, Final

import numpy as np
import xatlas
from numpy.typing import NDArray
from rooster import BOX, distance, paint
from scipy.ndimage import distance_transform_edt

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

METRE: Final = 100.0
"""One metre in the units of the rooster."""

GRID_STEP: Final = 0.96
IMAGE_SIZE: Final = 1024


def crossings(values: Floats) -> tuple[Floats, Ints]:
    """Find the grid edges that the surface crosses.

    Parameters
    ----------
    values : (n_x, n_y, n_z) float64 array
        Distances at the grid points.

    Returns
    -------
    places : (n, 3) float64 array
        Where each edge is crossed, in grid steps.
    cells : (n, 4, 3) int64 array
        The cells round each edge, counter-clockwise as seen from outside.
    """
    places, cells = [], []
    for axis in range(3):
        first, second, third = np.roll(np.eye(3, dtype=np.int64), -axis, axis=0)
        before, after = np.delete(values, -1, axis), np.delete(values, 0, axis)
        at = np.argwhere((before < 0) != (after < 0))
        start, end = before[tuple(at.T)], after[tuple(at.T)]
        places.append(at + (start / (start - end))[:, None] * first)
        around = at[:, None] - np.array([0 * first, second, second + third, third])
        around[start >= 0] = around[start >= 0, ::-1]
        cells.append(around)
    return np.concatenate(places), np.concatenate(cells)


def surface() -> tuple[Floats, Ints]:
    """Mesh the rooster with naive surface nets: a vertex in each grid cell that the surface passes.

    Returns
    -------
    vertices : (n_v, 3) float64 array
        Points on the surface in cm.
    faces : (n_f, 3) int64 array
        Triangles, counter-clockwise as seen from outside the material.

    References
    ----------
    S. F. F. Gibson, "Constrained elastic surface nets", MICCAI 1998.
    """
    shape = np.ceil((BOX[1] - BOX[0]) / GRID_STEP).astype(int) + 1
    axes = [np.linspace(low, high, count) for low, high, count in zip(*BOX, shape, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    places, cells = crossings(distance(grid.reshape(-1, 3)).reshape(shape))
    quads = np.unique(np.ravel_multi_index(tuple(np.moveaxis(cells, 2, 0)), tuple(shape)), return_inverse=True)[1]
    quads = quads.reshape(-1, 4)
    vertices = settle(
        BOX[0] + mean_by(quads.ravel(), places.repeat(4, axis=0)) * (BOX[1] - BOX[0]) / (shape - 1), quads
    )
    diagonals = np.linalg.norm(vertices[quads[:, :2]] - vertices[quads[:, 2:]], axis=2)
    quads = np.where(diagonals[:, :1] > diagonals[:, 1:], np.roll(quads, 1, axis=1), quads)
    return vertices, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def mean_by(group: Ints, points: Floats) -> Floats:
    """Return the mean of the points of each group, (n_groups, 3)."""
    sums = [np.bincount(group, coordinate) for coordinate in points.T]
    return np.column_stack(sums) / np.bincount(group)[:, None]


def gradient(points: Floats) -> Floats:
    """Return the gradient of the rooster's distance, (n, 3)."""
    step = 1e-3 * np.eye(3)
    return np.column_stack([distance(points + s) - distance(points - s) for s in step]) / 2e-3


def settle(points: Floats, quads: Ints) -> Floats:
    """Even out the vertices of the quads and move them onto the surface; micrometres are rounded away."""
    ends, others = quads.ravel(), np.roll(quads, 1, axis=1).ravel()
    ends, others = np.concatenate([ends, others]), np.concatenate([others, ends])
    for _ in range(3):
        points = project((points + mean_by(ends, points[others])) / 2)
    return np.round(points, 4)


def project(points: Floats) -> Floats:
    """Move points onto the surface by a few damped Newton steps."""
    for _ in range(4):
        slope = gradient(points)
        share = distance(points) / np.maximum((slope**2).sum(axis=1), 0.1)
        points = points - np.clip(share, -0.3, 0.3)[:, None] * slope
    return points


def unwrap(vertices: Floats, normals: Floats, faces: Ints) -> tuple[Ints, Ints, Floats]:
    """Cut the surface into charts with xatlas.

    Returns
    -------
    source : (n,) int64 array
        The vertex that each vertex of the atlas came from.
    corners : (n_f, 3) int64 array
        The triangles in vertices of the atlas.
    uvs : (n, 2) float64 array
        Image coordinates in [0, 1].
    """
    atlas = xatlas.Atlas()
    atlas.add_mesh(vertices.astype(np.float32), faces.astype(np.uint32), normals.astype(np.float32))
    charts, packing = xatlas.ChartOptions(), xatlas.PackOptions()
    charts.max_iterations = 4
    packing.resolution, packing.padding = IMAGE_SIZE, 4
    atlas.generate(charts, packing)
    source, corners, uvs = atlas[0]
    return source.astype(np.int64), corners.astype(np.int64), uvs.astype(np.float64)


def texels(triangles: Floats) -> tuple[Ints, Ints, Floats]:
    """Find the texels whose centres lie in triangles.

    Parameters
    ----------
    triangles : (n_f, 3, 2) float64 array
        Corners in texels, counted from the centre of the first texel.

    Returns
    -------
    face : (n,) int64 array
        A triangle,
    texel : (n, 2) int64 array
        a texel in it (column, row),
    weight : (n, 3) float64 array
        and its barycentric coordinates there.
    """
    low, high = np.ceil(triangles.min(axis=1)).astype(int), np.floor(triangles.max(axis=1)).astype(int)
    size = np.maximum(high - low + 1, 0)
    amount = size.prod(axis=1)
    face = np.repeat(np.arange(len(triangles)), amount)
    step = np.arange(len(face)) - np.repeat(np.cumsum(amount) - amount, amount)
    texel = low[face] + np.column_stack([step % size[face, 0], step // size[face, 0]])
    # the pseudo-inverse bears the slivers of which unwrapping made a line
    inverse = np.linalg.pinv((triangles[:, 1:] - triangles[:, :1]).transpose(0, 2, 1))
    share = np.einsum("nij,nj->ni", inverse[face], texel - triangles[face, 0])
    weight = np.column_stack([1 - share.sum(axis=1), share])
    inside = weight.min(axis=1) > -1e-6
    return face[inside], texel[inside], weight[inside]


def texture(places: Floats, corners: Ints, uvs: Floats) -> NDArray[np.uint8]:
    """Paint every texel by the place on the surface that it shows; bare texels copy the nearest painted one.

    Parameters
    ----------
    places : (n, 3) float64 array
        Where the atlas vertices are, in cm.
    corners : (n_f, 3) int64 array
        The triangles.
    uvs : (n, 2) float64 array
        Image coordinates of the atlas vertices.

    Returns
    -------
    (IMAGE_SIZE, IMAGE_SIZE, 3) uint8 array
        sRGB bytes, row 0 at v = 0.
    """
    face, texel, weight = texels(uvs[corners] * IMAGE_SIZE - 0.5)
    painted = np.zeros((IMAGE_SIZE, IMAGE_SIZE), dtype=bool)
    image = np.zeros((IMAGE_SIZE, IMAGE_SIZE, 3), dtype=np.uint8)
    column, row = texel.T
    painted[row, column] = True
    image[row, column] = paint(np.einsum("ni,nij->nj", weight, places[corners[face]]))
    rows, columns = distance_transform_edt(~painted, return_distances=False, return_indices=True)
    return image[rows, columns]


def png(image: NDArray[np.uint8]) -> bytes:
    """Pack an image as PNG, row 0 at the top."""

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    height, width = image.shape[:2]
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    rows = np.hstack([np.zeros((height, 1), dtype=np.uint8), image.reshape(height, -1)])
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        [chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)), chunk(b"IEND", b"")]
    )


def gltf(places: Floats, normals: Floats, uvs: Floats, corners: Ints, image: NDArray[np.uint8]) -> bytes:
    """Pack the mesh and its image as one binary glTF file.

    References
    ----------
    Khronos Group, "glTF 2.0 Specification", section 4.4 (GLB).
    """
    to_y_up = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])
    numbers = [(places / METRE @ to_y_up).astype("<f4"), (normals @ to_y_up).astype("<f4"), uvs.astype("<f4")]
    blocks = [array.tobytes() for array in [*numbers, corners.astype("<u4")]] + [png(image)]
    blocks = [block + b"\0" * (-len(block) % 4) for block in blocks]
    document = scene() | {
        "accessors": [
            {"bufferView": view, "componentType": 5126, "type": f"VEC{array.shape[1]}", "count": len(array)}
            for view, array in enumerate(numbers)
        ]
        + [{"bufferView": 3, "componentType": 5125, "type": "SCALAR", "count": corners.size}],
        "bufferViews": [
            {"buffer": 0, "byteOffset": sum(map(len, blocks[:view])), "byteLength": len(block)}
            for view, block in enumerate(blocks)
        ],
        "buffers": [{"byteLength": sum(map(len, blocks))}],
    }
    document["accessors"][0] |= {"min": numbers[0].min(axis=0).tolist(), "max": numbers[0].max(axis=0).tolist()}
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(blocks)
    parts = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(body), b"BIN\0") + body
    return struct.pack("<4sII", b"glTF", 2, 12 + len(parts)) + parts


def scene() -> dict[str, Any]:
    """Return the part of the glTF document that names no sizes: one object, one material, one image."""
    attributes = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}
    surface_look = {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 0.5}
    return {
        "asset": {"version": "2.0", "generator": "Legorize make_samples.py", "copyright": "CC0 1.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "Rooster", "mesh": 0}],
        "meshes": [{"name": "Rooster", "primitives": [{"attributes": attributes, "indices": 3, "material": 0}]}],
        "materials": [{"name": "Rooster", "pbrMetallicRoughness": surface_look}],
        "textures": [{"source": 0, "sampler": 0}],
        "samplers": [{"wrapS": 33071, "wrapT": 33071}],
        "images": [{"name": "Rooster", "bufferView": 4, "mimeType": "image/png"}],
    }


def make() -> bytes:
    """Model, unwrap and paint the rooster; return the bytes of its file."""
    vertices, faces = surface()
    slope = gradient(vertices)
    normals = slope / np.linalg.norm(slope, axis=1, keepdims=True)
    source, corners, uvs = unwrap(vertices, normals, faces)
    image = texture(vertices[source], corners, uvs)
    return gltf(vertices[source], normals[source], uvs, corners, image)


def main(arguments: list[str]) -> None:
    """Write the sample to the file named, or to its place in ``assets``."""
    target = Path(arguments[0]) if arguments else Path(__file__).parents[2] / "assets" / "sample.glb"
    unfinished = target.with_suffix(".part")
    unfinished.write_bytes(make())
    unfinished.replace(target)


if __name__ == "__main__":
    main(sys.argv[1:])
