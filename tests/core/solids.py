"""Small meshes with known properties, and measures of meshes."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh

BOX_FACES = np.array(
    [
        *([0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4]),
        *([2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]),
    ],
    dtype=np.int32,
)
"""Outward faces on the corners (x + 2 y + 4 z) of a unit cube."""


def mesh_of(vertices, faces) -> TriangleMesh:
    """Make a mesh in one plain colour, the corners' UVs telling the vertices' x and y."""
    vertices, faces = np.array(vertices, dtype=np.float64), np.array(faces, dtype=np.int32).reshape(-1, 3)
    return TriangleMesh(
        vertices=vertices,
        faces=faces,
        uvs=vertices[faces][..., :2] if len(vertices) else np.zeros((len(faces), 3, 2)),
        face_image=np.zeros(len(faces), np.int32),
        images=(np.full((1, 1, 3), 200, np.uint8),),
        image_clamp=np.zeros(1, bool),
    )


def joined(*meshes: TriangleMesh) -> TriangleMesh:
    """Put several meshes into one, with vertices of their own."""
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in meshes)])
    faces = [mesh.faces + start for mesh, start in zip(meshes, starts, strict=False)]
    return mesh_of(np.concatenate([mesh.vertices for mesh in meshes]), np.concatenate(faces))


def reversed_mesh(mesh: TriangleMesh) -> TriangleMesh:
    """Turn a mesh inside out."""
    return mesh_of(mesh.vertices, mesh.faces[:, ::-1])


def without(mesh: TriangleMesh, *rows: int) -> TriangleMesh:
    """Take faces away."""
    return mesh_of(mesh.vertices, np.delete(mesh.faces, rows, axis=0))


def box(low=(0, 0, 0), high=(1, 1, 1)) -> TriangleMesh:
    """Make an outward box from its corners."""
    unit = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)])
    return mesh_of(np.asarray(low) + unit * np.subtract(high, low), BOX_FACES)


def sheet(n_x=4, n_y=3, height=lambda x, y: 0 * x) -> TriangleMesh:
    """Make an open sheet of n_x by n_y squares over the unit square, seen from above."""
    x, y = np.meshgrid(np.arange(n_x + 1) / n_x, np.arange(n_y + 1) / n_y)
    corner = (np.arange(n_y)[:, None] * (n_x + 1) + np.arange(n_x)).ravel()
    right, up = corner + 1, corner + n_x + 1
    faces = np.concatenate([np.column_stack([corner, right, up]), np.column_stack([right, up + 1, up])])
    return mesh_of(np.column_stack([x.ravel(), y.ravel(), height(x, y).ravel()]), faces)


def sphere(n=8, radius=1.0, centre=(0, 0, 0)) -> TriangleMesh:
    """Make an outward sphere: a cube of n x n squares a side, blown up."""
    sides = []
    for axis in range(3):
        for sign in (-1, 1):
            flat = sheet(n, n)
            square = flat.vertices[:, :2] * 2 - 1
            vertices = np.insert(square, 2, sign, axis=1)[:, np.roll([0, 1, 2], axis)]
            sides.append(mesh_of(vertices, flat.faces[:, ::sign]))
    ball = joined(*sides)
    lengths = np.linalg.norm(ball.vertices, axis=1, keepdims=True)
    return mesh_of(np.asarray(centre) + radius * ball.vertices / lengths, ball.faces)


def moebius(n=24) -> TriangleMesh:
    """Make a strip with half a twist, closed to a ring."""
    turn = np.arange(n) * 2 * np.pi / n
    across = np.array([-0.3, 0.3])[:, None]
    radius = 1 + across * np.cos(turn / 2)
    vertices = np.stack([radius * np.cos(turn), radius * np.sin(turn), across * np.sin(turn / 2)], axis=-1)
    lower, upper = np.arange(n), n + np.arange(n)
    # the ends meet upside down
    lower_next, upper_next = np.append(lower[1:], upper[0]), np.append(upper[1:], lower[0])
    faces = [np.column_stack([lower, lower_next, upper]), np.column_stack([lower_next, upper_next, upper])]
    return mesh_of(vertices.reshape(-1, 3), np.concatenate(faces))


def tube(outer=40.0, inner=30.0, height=48.0, n=64, centre=(0, 0, 0)) -> TriangleMesh:
    """Make an upright pipe of n sides."""
    turn = np.arange(n) * 2 * np.pi / n
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    vertices = np.concatenate([np.insert(r * ring, 2, z, axis=1) for r in (outer, inner) for z in (0, height)])
    here, after = np.arange(n), (np.arange(n) + 1) % n
    # outside up, over the rim, inside down, and back below
    rings = np.array([0, n, 3 * n, 2 * n])
    sides = [
        (low + here, low + after, high + after, high + here)
        for low, high in zip(rings, np.roll(rings, -1), strict=True)
    ]
    faces = [np.column_stack(corners) for a, b, c, d in sides for corners in ((a, b, c), (a, c, d))]
    return mesh_of(np.add(vertices, centre), np.concatenate(faces))


def walls(*paths, height=10.0) -> TriangleMesh:
    """Make an upright wall along every path of points (x, y); it begins and ends where its path does."""
    return joined(*(_wall(np.asarray(path, dtype=np.float64), height) for path in paths))


def _wall(path, height) -> TriangleMesh:
    vertices = np.concatenate([np.insert(path, 2, z, axis=1) for z in (0, height)])
    a, up = np.arange(len(path) - 1), len(path)
    faces = [np.column_stack([a, a + 1, a + 1 + up]), np.column_stack([a, a + 1 + up, a + up])]
    return mesh_of(vertices, np.concatenate(faces))


def volume(mesh: TriangleMesh) -> float:
    """Measure the signed volume, positive where the faces look outwards."""
    return float(np.linalg.det(mesh.vertices[mesh.faces] - mesh.vertices.mean(axis=0)).sum() / 6)


def area(mesh: TriangleMesh) -> float:
    """Measure the area of all faces."""
    a, b, c = np.moveaxis(mesh.vertices[mesh.faces], 1, 0)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)


def surface(mesh: TriangleMesh) -> list[tuple[float, ...]]:
    """List the oriented triangles in an order and a rotation of their own."""
    corners = np.round(mesh.vertices[mesh.faces], 6) + 0.0
    turned = (np.roll(corners, k, axis=1).reshape(-1, 9).tolist() for k in range(3))
    return sorted(min(tuple(way) for way in ways) for ways in zip(*turned, strict=True))
