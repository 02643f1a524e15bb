"""Models of the five kinds that the paper shows: a character, an off-road vehicle, a relief mosaic, a fox, a tiger.

They are made of coloured ellipsoids, boxes and wheels, each a closed surface of
its own; they overlap, as models of games and animations do. Own work, dedicated
to the public domain (CC0 1.0). Lengths are in mm; z is up and -y the front.

References
----------
Paper, section "Results": a character in three sizes, an off-road vehicle with
its inside, a mosaic, a fennec fox with three kinds of support, a tiger.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Rgb = tuple[int, int, int]
Paint = Rgb | Callable[[Floats], NDArray[np.uint8]]
"""One colour, or what gives (n, 3) bytes for points."""

WHITE, BLACK, RED, BLUE, SKIN = (244, 244, 244), (27, 42, 52), (180, 0, 0), (30, 90, 168), (228, 190, 150)
BROWN, ORANGE, TAN, CREAM, YELLOW = (95, 49, 9), (214, 121, 35), (170, 125, 85), (222, 198, 156), (250, 200, 10)
GREEN, GREY, DARK, GLASS = (0, 133, 43), (150, 152, 156), (80, 84, 88), (70, 155, 195)


@dataclass(frozen=True, slots=True, eq=False)
class Shell:
    """A closed surface with a colour on each face.

    Attributes
    ----------
    vertices : (n_v, 3) float64 array
    faces : (n_f, 3) int64 array
        Counter-clockwise as seen from outside.
    rgb : (n_f, 3) uint8 array
    """

    vertices: Floats
    faces: Ints
    rgb: NDArray[np.uint8]


def shell(vertices: Floats, faces: Ints, paint: Paint) -> Shell:
    """Return a surface with its paint."""
    middle = vertices[faces].mean(axis=1)
    rgb = paint(middle) if callable(paint) else np.tile(np.array(paint, np.uint8), (len(faces), 1))
    return Shell(vertices, faces, rgb)


def ball(centre: Sequence[float], radii: Sequence[float], paint: Paint, n: int = 10) -> Shell:
    """Return an ellipsoid: a cube of n x n squares a side, blown up."""
    u, v = np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quad = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    vertices, faces = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            flat = np.stack([np.full(u.size, sign), u.ravel(), v.ravel()], axis=1)[:, np.roll([0, 1, 2], axis)]
            start = len(vertices) * u.size
            side = quad if sign > 0 else quad[:, ::-1]
            faces.append(np.concatenate([side[:, [0, 1, 2]], side[:, [0, 2, 3]]]) + start)
            vertices.append(flat / np.linalg.norm(flat, axis=1, keepdims=True))
    points = np.concatenate(vertices) * radii + centre
    return shell(points, np.concatenate(faces), paint)


def block(low: Sequence[float], high: Sequence[float], paint: Paint) -> Shell:
    """Return a box by two corners."""
    unit = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)])
    quads = np.array([(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return shell(np.asarray(low) + unit * np.subtract(high, low), faces, paint)


def wheel(centre: Sequence[float], radius: float, width: float, paint: Paint, n: int = 24) -> Shell:
    """Return a disc that stands upright, its axis along x."""
    angle = 2 * np.pi * np.arange(n) / n
    ring = np.stack([np.zeros(n), radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    sides = [ring + np.asarray(centre) + (width * s / 2, 0, 0) for s in (-1, 1)]
    hubs = np.asarray(centre) + np.array([(-width / 2, 0, 0), (width / 2, 0, 0)])
    i, j = np.arange(n), (np.arange(n) + 1) % n
    faces = [
        np.stack([i, i + n, j + n], axis=1), np.stack([i, j + n, j], axis=1),
        np.stack([np.full(n, 2 * n), i, j], axis=1), np.stack([np.full(n, 2 * n + 1), j + n, i + n], axis=1),
    ]  # fmt: skip
    # outward, whichever way round the ring runs
    return shell(np.concatenate([*sides, hubs]), np.concatenate(faces)[:, ::-1], paint)


def limb(start: Sequence[float], end: Sequence[float], radii: Sequence[float], paint: Paint, n: int = 5) -> list[Shell]:
    """Return a row of balls from one place to another, as thick as is said at both ends."""
    shares = np.linspace(0, 1, n)[:, None]
    places = (1 - shares) * np.asarray(start) + shares * np.asarray(end)
    sizes = (1 - shares[:, 0]) * radii[0] + shares[:, 0] * radii[1]
    return [ball(place, (size,) * 3, paint, 6) for place, size in zip(places.tolist(), sizes.tolist(), strict=True)]


def mesh_of(shells: Sequence[Shell]) -> TriangleMesh:
    """Return surfaces as one textured mesh: an image has one texel for each colour."""
    starts = np.cumsum([0, *(len(each.vertices) for each in shells)])
    faces = np.concatenate([each.faces + start for each, start in zip(shells, starts.tolist(), strict=False)])
    colours, texel = np.unique(np.concatenate([each.rgb for each in shells]), axis=0, return_inverse=True)
    across = (texel.reshape(-1) + 0.5) / len(colours)
    uvs = np.repeat(np.stack([across, np.full(len(across), 0.5)], axis=1)[:, None], 3, axis=1)
    return TriangleMesh(
        vertices=np.concatenate([each.vertices for each in shells]),
        faces=faces.astype(np.int32),
        uvs=uvs,
        face_image=np.zeros(len(faces), np.int32),
        images=(colours[None].astype(np.uint8),),
        image_clamp=np.ones(1, bool),
    )


def pairs(make: Callable[[float], Sequence[Shell]]) -> list[Shell]:
    """Return what stands on both sides: made for -1 and for 1."""
    return [each for side in (-1.0, 1.0) for each in make(side)]


def character() -> TriangleMesh:
    """Return a gardener: hat, beard, overalls with buttons, gloves, boots."""

    def half(s: float) -> list[Shell]:
        """Return one side."""
        return [
            ball((s * 17, -4, 8), (14, 20, 10), BLACK), *limb((s * 16, 0, 14), (s * 15, 0, 38), (13, 15), BLUE),
            *limb((s * 30, 0, 74), (s * 52, -4, 52), (11, 9), WHITE), ball((s * 58, -6, 46), (11, 11, 11), BROWN),
            ball((s * 31, 2, 112), (6, 8, 9), SKIN), ball((s * 11, -29, 118), (5, 4, 9), WHITE, 6),
            ball((s * 10, -33, 117), (3, 3, 6), BLACK, 6), ball((s * 11, -30, 99), (13, 6, 5), ORANGE, 6),
            ball((s * 13, -24, 70), (5, 4, 5), RED, 6), block((s * 18 - 5, -22, 60), (s * 18 + 5, 20, 84), BLUE),
        ]  # fmt: skip

    return mesh_of([
        *pairs(half), ball((0, 0, 52), (32, 26, 28), BLUE), ball((0, 0, 74), (31, 23, 20), WHITE),
        ball((0, 0, 108), (32, 30, 28), SKIN), ball((0, 10, 112), (31, 26, 26), ORANGE),
        ball((0, -34, 107), (9, 8, 8), SKIN, 8), ball((0, 2, 134), (34, 32, 18), YELLOW),
        ball((0, 0, 130), (44, 44, 4), YELLOW),
        ball((0, -28, 138), (9, 5, 9), GREEN, 6),
    ])  # fmt: skip


def off_road() -> TriangleMesh:
    """Return an open off-road vehicle: seats, wheel and roll bar can be seen, the bonnet is hollow."""

    def half(s: float) -> list[Shell]:
        """Return one side."""
        return [
            *(wheel((s * 34, y, 20), 20, 16, BLACK) for y in (-55, 55)),
            *(wheel((s * 34, y, 20), 9, 18, GREY, 12) for y in (-55, 55)),
            block((s * 32 - 5, -36, 28), (s * 32 + 5, 36, 52), GREEN),
            block((s * 32 - 8, -82, 40), (s * 32 + 8, -30, 48), GREEN),
            block((s * 32 - 8, 30, 40), (s * 32 + 8, 84, 48), GREEN),
            block((s * 15 - 10, 6, 34), (s * 15 + 10, 26, 46), TAN),
            block((s * 15 - 10, 22, 44), (s * 15 + 10, 30, 70), TAN),
            block((s * 28 - 4, 34, 44), (s * 28 + 4, 42, 92), DARK),
            block((s * 28 - 4, -32, 52), (s * 28 + 4, -24, 84), GREEN),
            ball((s * 22, -84, 50), (8, 5, 8), YELLOW, 6),
        ]  # fmt: skip

    return mesh_of([
        *pairs(half), block((-24, -80, 26), (24, 80, 34), DARK), block((-28, -84, 34), (28, -76, 58), GREY),
        block((-28, -80, 52), (28, -30, 60), GREEN),
        *pairs(lambda s: [block((s * 25 - 4, -80, 30), (s * 25 + 4, -30, 58), GREEN)]),
        block((-28, -34, 34), (28, -26, 60), DARK), block((-28, -31, 76), (28, -24, 84), GREEN),
        block((-24, -30, 58), (24, -26, 78), GLASS),
        *pairs(lambda s: [block((s * 28 - 4, 34, 30), (s * 28 + 4, 80, 58), GREEN)]),
        block((-28, 76, 30), (28, 84, 58), GREEN), block((-32, 34, 88), (32, 42, 96), DARK),
        block((-20, -22, 52), (-8, -16, 64), BLACK),
        block((-16, 84, 30), (16, 96, 62), BLACK),
    ])  # fmt: skip


AROUND: Final = ((0, 0), *((dy, dx) for dy in (-1, 0, 1) for dx in (-1, 0, 1) if dy or dx))
"""A cell and its neighbours, as steps."""


def relief() -> TriangleMesh:
    """Return a picture that stands upright: a flower before a sky, each part of it raised as far as it is near."""
    n, size, deep = 96, 2.0, 8.0
    x, z = np.meshgrid((np.arange(n) + 0.5) / n * 2 - 1, (np.arange(n) + 0.5) / n * 2 - 1)
    rgb, rise = flower(x, z)
    # a slope has the colour of what it leads up to
    around = np.stack([np.roll(rise, step, axis=(0, 1)) for step in AROUND])
    best = around.argmax(axis=0)
    rgb = np.choose(best[..., None], [np.roll(rgb, step, axis=(0, 1)) for step in AROUND])
    # a corner is as near as the nearest cell around it
    padded = np.pad(deep + 4 * rise, 1, mode="edge")
    near = np.max([padded[i : i + n + 1, j : j + n + 1] for i in (0, 1) for j in (0, 1)], axis=0)
    u, v = np.meshgrid(np.arange(n + 1) * size, np.arange(n + 1) * size)
    front = np.stack([u, -near, v], axis=-1).reshape(-1, 3)
    back = np.stack([u, np.zeros_like(u), v], axis=-1).reshape(-1, 3)
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    quad = np.stack([corner, corner + 1, corner + n + 2, corner + n + 1], axis=1)
    row = np.arange(n + 1)
    rim = np.concatenate([row, (n + 1) * row[1:] + n, n * (n + 1) + row[-2::-1], (n + 1) * row[-2:0:-1]])
    after, far = np.roll(rim, -1), len(front)
    wall = np.stack([rim, rim + far, after + far, after], axis=1)
    quads = np.concatenate([quad, quad[:, ::-1] + far, wall])
    colour = np.concatenate([rgb.reshape(-1, 3), np.tile(np.array(GLASS, np.uint8), (n * n + len(rim), 1))])
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return mesh_of([Shell(np.concatenate([front, back]), faces, np.concatenate([colour, colour]))])


def flower(x: Floats, z: Floats) -> tuple[NDArray[np.uint8], Floats]:
    """Return the colours of a picture, (n, n, 3), and how far each cell is raised; x and z go from -1 to 1."""
    away, angle = np.hypot(x, z - 0.25), np.arctan2(z - 0.25, x)
    leaves = [((x - s * 0.28) / 0.26) ** 2 + ((z + low - s * 0.4 * (x - s * 0.28)) / 0.1) ** 2 < 1
              for s, low in ((1, 0.42), (-1, 0.52))]  # fmt: skip
    layers = (
        ((x + 0.6) ** 2 + (z - 0.72) ** 2 < 0.03, WHITE, 1),
        (z < -0.78 + 0.05 * np.sin(6 * x), BROWN, 2),
        (((abs(x - 0.08 * np.sin(3 * z)) < 0.06) & (z < 0)) | leaves[0] | leaves[1], GREEN, 3),
        (away < 0.38 + 0.16 * np.cos(7 * angle), RED, 4),
        (away < 0.18, YELLOW, 6),
    )
    rgb, rise = np.tile(np.array(GLASS, np.uint8), (*x.shape, 1)), np.zeros(x.shape)
    for mask, colour, step in layers:
        rgb[mask], rise[mask] = colour, step
    return rgb, rise


def fox() -> TriangleMesh:
    """Return a desert fox on four thin legs, with large ears and a tail that stands out."""

    def half(s: float) -> list[Shell]:
        """Return one side."""
        return [
            *limb((s * 12, -34, 46), (s * 12, -36, 6), (8, 6), CREAM, 7),
            *limb((s * 12, 34, 46), (s * 12, 36, 6), (9, 6), CREAM, 7),
            *limb((s * 16, -50, 96), (s * 30, -46, 128), (9, 4), ORANGE),
            *limb((s * 17, -54, 96), (s * 28, -51, 118), (5, 2), WHITE),
            ball((s * 12, -72, 88), (3, 3, 4), BLACK, 6),
        ]  # fmt: skip

    def coat(points: Floats) -> NDArray[np.uint8]:
        """Return a light belly."""
        return np.where((points[:, 2:] < 46), np.array(CREAM), np.array(ORANGE)).astype(np.uint8)

    return mesh_of([
        *pairs(half), ball((0, 0, 56), (19, 46, 18), coat), ball((0, -40, 68), (14, 16, 18), ORANGE),
        ball((0, -56, 84), (21, 20, 17), ORANGE),
        ball((0, -76, 77), (9, 13, 8), CREAM), ball((0, -89, 79), (4, 4, 4), BLACK, 6),
        *limb((0, 44, 62), (0, 84, 84), (8, 12), ORANGE),
        *limb((0, 86, 86), (0, 102, 94), (11, 7), WHITE, 3),
    ])  # fmt: skip


def tiger() -> TriangleMesh:
    """Return a striding tiger with stripes, a white belly and a raised tail."""

    def stripes(points: Floats) -> NDArray[np.uint8]:
        """Return dark bands across the back that fade out on a white belly."""
        x, y, z = points.T
        band = np.sin(y / 5.2 + 0.9 * np.abs(x) / 10) > 0.35
        coat = np.where((z < 40)[:, None], np.array(WHITE), np.array(ORANGE))
        return np.where((band & (z > 46))[:, None], np.array(BLACK), coat).astype(np.uint8)

    def half(s: float) -> list[Shell]:
        """Return one side."""
        step = 9 * s
        return [
            *limb((s * 16, -44, 48), (s * 16, -48 + step, 8), (13, 9), ORANGE),
            ball((s * 16, -53 + step, 6), (10, 14, 7), WHITE, 6),
            *limb((s * 17, 44, 50), (s * 16, 48 - step, 8), (15, 9), ORANGE),
            ball((s * 16, 43 - step, 6), (10, 14, 7), WHITE, 6),
            ball((s * 17, -64, 96), (8, 5, 8), ORANGE, 6), ball((s * 17, -68, 96), (4, 3, 4), BLACK, 6),
            ball((s * 10, -88, 82), (4, 3, 4), BLACK, 6),
            ball((s * 12, -85, 67), (10, 9, 8), WHITE, 6),
        ]  # fmt: skip

    return mesh_of([
        *pairs(half), ball((0, 0, 58), (25, 60, 23), stripes, 20), ball((0, -70, 76), (24, 21, 21), stripes, 14),
        ball((0, -92, 72), (6, 5, 5), RED, 6), *limb((0, 58, 66), (0, 92, 78), (7, 6), ORANGE),
        *limb((0, 94, 80), (0, 104, 108), (6, 6), BLACK, 5),
    ])  # fmt: skip


KINDS: Final = MappingProxyType(
    {"character": character, "off_road": off_road, "relief": relief, "fox": fox, "tiger": tiger}
)
"""What makes each model."""
