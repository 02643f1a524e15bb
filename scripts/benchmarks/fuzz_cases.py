"""Small random bodies and random settings, a pair for each number: what nobody would think of trying."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import Field, fields, replace
from typing import Any, Final

import numpy as np

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.settings import Settings, choices, setting_type
from legorize_addon.core.units import BRICK, STUD

Body = tuple[np.ndarray, np.ndarray]
"""Vertices and faces."""

_SIZES: Final = (3, 24)
"""Studs or bricks."""

_WIDEST: Final = 100
"""Studs."""

_USUAL: Final = 0.65
"""Share of the settings that stay as they are by default."""

_CORNERS: Final = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], dtype=np.float64)
_BOX: Final = np.array(
    [
        *([0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4]),
        *([2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]),
    ]
)


def case(seed: int, number: int) -> tuple[str, TriangleMesh, Settings]:
    """Make up a case.

    Parameters
    ----------
    seed, number : int
        The same two give the same case.

    Returns
    -------
    name : str
        What the body is and what was done to it.
    mesh : TriangleMesh
    settings : Settings
    """
    rng = np.random.default_rng([seed, number])
    kind = str(rng.choice(sorted(BODIES)))
    vertices, faces = BODIES[kind](rng)
    name = [kind]
    for change, share in ((noisy, 0.15), (inverted, 0.1), (opened, 0.15), (tilted, 0.3), (stretched, 0.1)):
        if rng.random() < share:
            vertices, faces = change(rng, vertices, faces)
            name.append(change.__name__)
    mesh = _textured(rng, vertices, faces)
    return " ".join(name), mesh, _small(mesh, _settings(rng))


def box(rng: np.random.Generator) -> Body:
    """Return a box."""
    return _CORNERS * rng.uniform(1, 10, 3), _BOX


def blob(rng: np.random.Generator) -> Body:
    """Return boxes that overlap, touch, or pass each other closely, on a coarse lattice."""
    low = rng.integers(0, 6, (int(rng.integers(2, 9)), 3))
    size = rng.integers(1, 5, low.shape)
    return several([(_CORNERS * high + corner, _BOX) for corner, high in zip(low, size, strict=True)])


def staircase(rng: np.random.Generator) -> Body:
    """Return boxes that meet at edges or corners alone."""
    step = rng.integers(0, 2, (int(rng.integers(2, 7)), 3))
    return several([(_CORNERS + corner, _BOX) for corner in np.cumsum(step, axis=0)])


def ball(rng: np.random.Generator) -> Body:
    """Return a ball or an egg."""
    return _turned(np.sin(np.linspace(0, np.pi, 9)), -np.cos(np.linspace(0, np.pi, 9)) * rng.uniform(0.3, 2), 12)


def cone(rng: np.random.Generator) -> Body:
    """Return a cone that stands on its base or its tip."""
    return _turned(np.array([0.0, 1, 0]), rng.permutation([0.0, 0, rng.uniform(0.5, 5)]), int(rng.integers(3, 16)))


def torus(rng: np.random.Generator) -> Body:
    """Return a ring, lying or standing."""
    n, m = 16, 8
    turn, around = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    radius = 3 + rng.uniform(0.3, 2.9) * np.cos(around)
    points = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sin(around)], axis=-1).reshape(-1, 3)
    return points[:, rng.permutation(3)], _lattice(n, m)


def spikes(rng: np.random.Generator) -> Body:
    """Return thin pyramids that stick out of a small box."""
    tips = rng.normal(size=(int(rng.integers(2, 8)), 3)) * 6
    thorns = [
        (np.vstack([rng.uniform(0, 1.2, (3, 3)), tip]), np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
        for tip in tips
    ]
    return several([(_CORNERS, _BOX), *thorns])


def wall(rng: np.random.Generator) -> Body:
    """Return thin walls, legs and roofs."""
    sizes = [rng.permutation([rng.uniform(0.05, 0.6), rng.uniform(2, 8), rng.uniform(2, 8)]) for _ in range(3)]
    return several([(_CORNERS * size + rng.uniform(0, 3, 3), _BOX) for size in sizes[: int(rng.integers(1, 4))]])


def slab(rng: np.random.Generator) -> Body:
    """Return a flat box that leans."""
    vertices = (_CORNERS - 0.5) * [8, rng.uniform(1, 8), rng.uniform(0.1, 1.5)]
    return vertices @ _turn(rng).T, _BOX


def scattered(rng: np.random.Generator) -> Body:
    """Return bodies that lie apart."""
    made = [BODIES[str(rng.choice(["box", "ball", "cone", "torus"]))](rng) for _ in range(int(rng.integers(2, 5)))]
    return several([(vertices + rng.uniform(-8, 8, 3), faces) for vertices, faces in made])


def sheet(rng: np.random.Generator) -> Body:
    """Return an open sheet of hills."""
    n = int(rng.integers(2, 8))
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    corner = (np.arange(n)[:, None] * (n + 1) + np.arange(n)).ravel()
    faces = np.concatenate(
        [np.stack([corner, corner + 1, corner + n + 1], 1), np.stack([corner + 1, corner + n + 2, corner + n + 1], 1)]
    )
    return np.stack([x, y, rng.uniform(0, rng.choice([0, 1, 4]) + 1e-9, x.shape)], axis=-1).reshape(-1, 3), faces


def crossing(rng: np.random.Generator) -> Body:
    """Return a body whose surface runs through itself."""
    vertices, faces = ball(rng)
    return vertices * np.sin(3 * vertices[:, 2:] + 1), faces


def soup(rng: np.random.Generator) -> Body:
    """Return loose triangles."""
    n = int(rng.integers(4, 30))
    corners = rng.uniform(0, 6, (n, 1, 3)) + rng.normal(size=(n, 3, 3))
    return corners.reshape(-1, 3), np.arange(3 * n).reshape(-1, 3)


def hat(rng: np.random.Generator) -> Body:
    """Return two bodies with a narrow gap between them."""
    gap = rng.uniform(0.01, 0.8) * rng.permutation([0, 0, 1])
    return several([(_CORNERS * 3, _BOX), ((_CORNERS + rng.permutation([0, 0, 1])) * 3 + gap, _BOX)])


BODIES: Final[dict[str, Callable[[np.random.Generator], Body]]] = {
    made.__name__: made
    for made in (*(box, blob, staircase, ball, cone, torus, spikes, wall, slab, scattered, sheet, crossing, soup, hat),)
}


def several(bodies: list[Body]) -> Body:
    """Return bodies as one."""
    starts = np.cumsum([0, *(len(vertices) for vertices, _ in bodies)])
    faces = [faces + start for (_, faces), start in zip(bodies, starts, strict=False)]
    return np.concatenate([vertices for vertices, _ in bodies]), np.concatenate(faces)


def noisy(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> Body:
    """Shake the vertices."""
    return vertices + rng.normal(size=vertices.shape) * rng.choice([1e-7, 1e-3, 0.1]) * np.ptp(vertices), faces


def inverted(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> Body:
    """Turn all faces, or some."""
    turned = rng.random(len(faces)) < rng.choice([1.0, 0.5])
    return vertices, np.where(turned[:, None], faces[:, ::-1], faces)


def opened(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> Body:
    """Take some faces away, but not all."""
    kept = rng.random(len(faces)) < rng.uniform(0.5, 1)
    kept[:3] = True
    return vertices, faces[kept]


def tilted(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> Body:
    """Turn the body in space."""
    return vertices @ _turn(rng).T, faces


def stretched(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> Body:
    """Stretch or flatten it along the axes."""
    return vertices * 10 ** rng.uniform(-0.5, 0.5, 3), faces


def _turned(radius: np.ndarray, height: np.ndarray, n: int) -> Body:
    turn = np.arange(n) * 2 * np.pi / n
    rings = [
        np.stack([r * np.cos(turn), r * np.sin(turn), np.full(n, z)], axis=1)
        for r, z in zip(radius, height, strict=True)
    ]
    faces = _lattice(len(rings), n)
    return np.concatenate(rings), faces[faces.max(axis=1) - faces.min(axis=1) < 2 * n]


def _lattice(n: int, m: int) -> np.ndarray:
    here = np.arange(n * m).reshape(n, m)
    right, up = np.roll(here, -1, axis=1), np.roll(here, -1, axis=0)
    across = np.roll(right, -1, axis=0)
    squares = [part.ravel() for part in (here, right, across, up)]
    return np.concatenate(
        [np.stack([squares[0], squares[1], squares[2]], 1), np.stack([squares[0], squares[2], squares[3]], 1)]
    )


def _turn(rng: np.random.Generator) -> np.ndarray:
    turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
    return turn * np.sign(np.linalg.det(turn))


def _textured(rng: np.random.Generator, vertices: np.ndarray, faces: np.ndarray) -> TriangleMesh:
    """Return the body with a random, chequered or plain image in some of its image coordinates."""
    image = (
        rng.integers(0, 256, (int(rng.integers(1, 33)), int(rng.integers(1, 33)), 3)),
        np.where((np.indices((16, 16)).sum(axis=0) % 2)[..., None], rng.integers(0, 256, 3), rng.integers(0, 256, 3)),
        rng.integers(0, 256, (1, 1, 3)),
    )[int(rng.integers(3))]
    span = np.maximum(np.ptp(vertices, axis=0), 1e-9)
    flat = ((vertices - vertices.min(axis=0)) / span)[:, rng.permutation(3)[:2]] * rng.choice([1.0, 5.0, 100.0])
    return TriangleMesh(
        vertices=vertices * 10 ** rng.uniform(-1, 2),
        faces=faces.astype(np.int32),
        uvs=flat[faces] + rng.choice([0.0, 1.0]) * rng.normal(size=(len(faces), 3, 2)),
        face_image=np.zeros(len(faces), np.int32),
        images=(image.astype(np.uint8),),
        image_clamp=rng.random(1) < 0.5,
    )


def _small(mesh: TriangleMesh, settings: Settings) -> Settings:
    """Size a body by its width if by its height it would get as wide as a hall."""
    x, y, z = np.ptp(mesh.vertices, axis=0)
    wide = settings.size_by == "height" and max(x, y) * settings.height * BRICK > _WIDEST * z * STUD
    return replace(settings, size_by="width") if wide else settings


def _settings(rng: np.random.Generator) -> Settings:
    """Return random settings; the body has from 3 to 24 studs or bricks."""
    # each setting draws by its name, so that a new one leaves the cases as they are
    base = int(rng.integers(2**31))
    chosen: dict[str, Any] = {}
    for entry in fields(Settings):
        own = np.random.default_rng([base, *entry.name.encode()])
        if own.random() > _USUAL:
            chosen[entry.name] = _value(own, entry)
    low, high = _SIZES
    chosen |= {
        "width": int(rng.integers(low, high + 1)),
        "height": int(rng.integers(low, high + 1)),
        "learned_from": "",
    }
    chosen["size_by"] = str(rng.choice(["width", "width", "height"]))
    # no body has a price file
    chosen["goal"] = "fewest"
    chosen["shell"] = int(rng.choice([1, 1, 2, 3]))
    chosen["palette"] = str(rng.choice(["", "", "", "4", "0, 15", "1, 2, 4, 14, 15, 71"]))
    # only pictures can be backed, and most bodies are none
    chosen["backing"] = int(rng.choice([0, 0, 0, 0, 0, 0, 0, 0, 0, 2]))
    # forces after every step take long
    chosen["prove_steps"] = bool(rng.random() < 0.03)
    if not chosen.get("hollow", True):
        chosen |= {"open_bottom": False, "hollow_rule": "both"}
    if chosen.get("one_to_one") or chosen.get("cell_colour") == "longest":
        chosen["dithering"] = "none"
    if chosen.get("layout") == "learned":
        chosen["surface"] = "studs"
    if chosen.get("layout") == "learned" or chosen.get("plates") == "none":
        chosen["half_studs"] = False
    if chosen.get("surface") == "tiles" and (chosen.get("tops") == "studs" or chosen.get("plates") == "none"):
        chosen |= {"tops": "smooth", "plates": "pays"}
    return Settings(**chosen)


def _value(rng: np.random.Generator, entry: Field[Any]) -> Any:
    """Return a value of a setting within its limits, both limits among the likely ones."""
    kind, words = setting_type(entry), choices(entry)
    if words:
        return str(rng.choice(words))
    if kind is bool:
        return bool(rng.random() < 0.5)
    if kind is str:
        return entry.default
    low, high = entry.metadata["low"], entry.metadata["high"]
    share = rng.choice([0.0, 1.0, rng.random()])
    return kind(min(max(kind(low + share * (high - low)), low), high))
