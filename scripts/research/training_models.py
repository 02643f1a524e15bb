"""Models made by chance, for training and for judging what was trained: five kinds, any number of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.model.bricks import Bricks
from legorize_addon.core.model.unit_grid import UnitGrid
from legorize_addon.core.pipeline import legorize
from legorize_addon.core.settings import Settings

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Body = tuple[Floats, Ints, Ints]
"""Vertices (n_v, 3), triangles (n_f, 3) and the colour of each, a row in ``COLOURS``."""

COLOURS: Final = np.array([(180, 0, 0), (244, 244, 244), (30, 90, 168), (250, 200, 10)], dtype=np.uint8)
"""sRGB bytes of colours in which nearly all parts are made: red, white, blue, yellow."""

_AROUND: Final = 40
"""Corners of whatever is round."""


def ball(centre: Sequence[float], radii: Sequence[float], colour: int) -> Body:
    """Return an ellipsoid."""
    angle = np.linspace(0, np.pi, _AROUND // 2 + 1)
    vertices, faces, _ = turned(np.stack([np.sin(angle), -np.cos(angle)], axis=1), colour)
    return vertices * radii + centre, faces, np.full(len(faces), colour)


def barrel(low: Sequence[float], radius: float, length: float, axis: int, colour: int) -> Body:
    """Return a cylinder from the middle of one end along an axis."""
    vertices, faces, of_face = turned(np.array([(0, 0), (radius, 0), (radius, length), (0, length)]), colour)
    return np.roll(vertices, axis + 1, axis=1) + low, faces, of_face


def turned(profile: Floats, colour: int) -> Body:
    """Turn a profile (radius, height), given upwards from the axis to the axis, about the z axis."""
    angle = np.arange(_AROUND) * 2 * np.pi / _AROUND
    round_ = np.stack([np.cos(angle), np.sin(angle), np.ones(_AROUND)], axis=1)
    vertices = (round_ * profile[:, None, [0, 0, 1]]).reshape(-1, 3)
    # the rings at the ends shrink to a point each
    faces = strip(len(profile), _AROUND, closed=False)
    ends = (vertices[:_AROUND].mean(axis=0), vertices[-_AROUND:].mean(axis=0))
    vertices = np.concatenate([ends[0][None], vertices[_AROUND:-_AROUND], ends[1][None]])
    faces = np.clip(faces - _AROUND + 1, 0, len(vertices) - 1)
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    return vertices, faces, np.full(len(faces), colour)


def strip(n: int, m: int, *, closed: bool) -> Ints:
    """Return the triangles between n rings of m vertices, the last ring joined to the first one if closed."""
    row = np.arange(n * m).reshape(n, m)
    one, other = (row, np.roll(row, -1, axis=0)) if closed else (row[:-1], row[1:])
    a, b, c, d = (each.ravel() for each in (one, np.roll(one, -1, 1), np.roll(other, -1, 1), other))
    return np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def block(low: Sequence[float], high: Sequence[float], colour: int) -> Body:
    """Return a box."""
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    quads = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    faces = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return np.where(corners > 0, high, low), faces, np.full(len(faces), colour)


def blob(rng: np.random.Generator, colours: Ints) -> list[Body]:
    """Return a bumpy ball in patches of colour."""
    vertices, faces, _ = ball((0, 0, 0), (1, 1, 1), 0)
    waves = np.sin(vertices @ rng.normal(0, 2.5, (3, 4)) + rng.uniform(0, 6, 4)).sum(axis=1)
    middles = vertices[faces].mean(axis=1)
    places = rng.normal(size=(3 * len(colours), 3))
    patch = (middles @ (places / np.linalg.norm(places, axis=1, keepdims=True)).T).argmax(axis=1)
    return [(vertices * (10 + 0.8 * waves[:, None]) * rng.uniform(0.7, 1.3, 3), faces, np.resize(colours, 99)[patch])]


def ring(rng: np.random.Generator, colours: Ints) -> list[Body]:
    """Return a ring that lies flat, in sectors, on a round foot."""
    n, m = 3 * _AROUND, _AROUND
    along, around = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    thick = rng.uniform(2.5, 4.5)
    reach = 10 + thick * np.cos(around)
    points = np.stack([reach * np.cos(along), reach * np.sin(along), thick * np.sin(around)], axis=-1).reshape(-1, 3)
    faces = strip(n, m, closed=True)[:, ::-1]
    sector = (np.resize(faces[:, 0] // m, len(faces)) * len(colours)) // n
    return [(points * [1, rng.uniform(0.6, 1), 1], faces, colours[sector]), barrel((0, 0, -thick), 9, 2, 2, colours[0])]


def tower(rng: np.random.Generator, colours: Ints) -> list[Body]:
    """Return blocks on blocks, the upper ones smaller and turned out of the middle."""
    bodies, half, middle, z = [], rng.uniform(7, 11, 2), np.zeros(2), 0.0
    for number in range(int(rng.integers(3, 7))):
        top = z + rng.uniform(3, 7)
        bodies.append(block((*(middle - half), z), (*(middle + half), top), colours[number % len(colours)]))
        smaller = half * rng.uniform(0.6, 0.9, 2)
        middle, half, z = middle + rng.uniform(-1, 1, 2) * (half - smaller), smaller, top
    return bodies


def car(rng: np.random.Generator, colours: Ints) -> list[Body]:
    """Return a body, a cabin, four wheels and a bed or a boot."""
    length, width, wheel = rng.uniform(9, 12), rng.uniform(4, 6), rng.uniform(1.8, 2.6)
    waist, roof, front, back = wheel + rng.uniform(3, 5), wheel + rng.uniform(7, 10), *rng.uniform(0.1, 0.7, 2) * length
    one, two, three = np.resize(colours, 3)
    wheels = [
        barrel((side * width - (0.5 if side > 0 else 1.5), way * 0.6 * length, wheel), wheel, 2, 0, three)
        for side in (-1, 1)
        for way in (-1, 1)
    ]
    cabin = block((-0.9 * width, -back, waist - 1), (0.9 * width, front, roof), two)
    return [block((-width, -length, wheel), (width, length, waist), one), cabin, *wheels]


def character(rng: np.random.Generator, colours: Ints) -> list[Body]:
    """Return a figure with legs, arms, a round head and a hat."""
    one, two, three, four = np.resize(colours, 4)
    leg, body, head = rng.uniform(5, 8), rng.uniform(7, 10), rng.uniform(3, 4.5)
    wide, neck = rng.uniform(3.5, 5), leg + body
    legs = [barrel((side * wide * 0.5, 0, 0), 0.4 * wide, leg + 2, 2, two) for side in (-1, 1)]
    arms = [ball((side * (wide + 1), 0, neck - 0.5 * body), (1.5, 1.6, 0.5 * body), three) for side in (-1, 1)]
    trunk = ball((0, 0, leg + 0.5 * body), (wide, 0.75 * wide, 0.55 * body), one)
    hat = [barrel((0, 0, neck + 1.2 * head), radius * head, high, 2, four) for radius, high in ((1.3, 1.2), (0.8, 3.5))]
    return [*legs, *arms, trunk, ball((0, 0, neck + 0.7 * head), (head, head, head), three), *hat]


KINDS: Final[Mapping[str, Callable[[np.random.Generator, Ints], list[Body]]]] = MappingProxyType(
    {"blob": blob, "ring": ring, "tower": tower, "car": car, "character": character}
)
"""What models there are."""


def made(kind: str, seed: int) -> TriangleMesh:
    """Make a model in one to four colours.

    Parameters
    ----------
    kind : str
        Key of ``KINDS``.
    seed : int
        The same seed gives the same model.

    Returns
    -------
    TriangleMesh
        Closed bodies that may lie in each other.
    """
    rng = np.random.default_rng([sorted(KINDS).index(kind), seed])
    colours = rng.permutation(len(COLOURS))[: rng.integers(1, len(COLOURS) + 1)]
    bodies = KINDS[kind](rng, colours)
    first = np.cumsum([0, *(len(vertices) for vertices, _, _ in bodies)])
    faces = np.concatenate([faces + start for (_, faces, _), start in zip(bodies, first, strict=False)])
    return TriangleMesh(
        # round numbers, which are the same on every machine
        vertices=np.round(10 * np.concatenate([vertices for vertices, _, _ in bodies]), 3),
        faces=faces.astype(np.int32),
        uvs=np.zeros((len(faces), 3, 2)),
        face_image=np.concatenate([of_face for _, _, of_face in bodies]).astype(np.int32),
        images=tuple(colour.reshape(1, 1, 3) for colour in COLOURS),
        image_clamp=np.zeros(len(COLOURS), dtype=bool),
    )


UNSEEN: Final = 100
"""Seeds from here on are never trained on."""

WIDTHS: Final = (24, 28, 32, 36, 40)
"""Studs along the longer side, in turn."""


def built(kind: str, seed: int) -> tuple[UnitGrid, Bricks]:
    """Return a model made by chance: hollowed, and laid by the fast tier without what is to be learned."""
    build = legorize(made(kind, seed), Settings(width=WIDTHS[seed % len(WIDTHS)], layout="fast", learned=False))
    return build.hollow, build.bricks
