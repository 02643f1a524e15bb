"""Which way is up: what is turned where, and what a shape says about how it is meant to stand."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import trimesh
from trimesh.creation import box, capsule, cone, cylinder, icosphere

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.mesh.upright import FALLEN, TURNS, stands_better, steadiness, turn_upright


def at(part: trimesh.Trimesh, *place: float) -> trimesh.Trimesh:
    """Move a part."""
    part.apply_translation(place)
    return part


def limb(start: tuple[float, float, float], end: tuple[float, float, float], radius: float) -> trimesh.Trimesh:
    """Return a capsule from one point to another."""
    way = np.subtract(end, start)
    part = capsule(height=float(np.linalg.norm(way)), radius=radius, count=(12, 12))
    part.apply_translation(-part.bounds.mean(axis=0))
    part.apply_transform(trimesh.geometry.align_vectors([0, 0, 1], way))
    return at(part, *(np.add(start, end) / 2))


def figure() -> trimesh.Trimesh:
    """Return a person who stands with the arms down, in shoes, looking along -y."""
    parts = [limb((0, 0, 0.95), (0, 0, 1.4), 0.16), at(icosphere(radius=0.12), 0, 0, 1.65)]
    for side in (1, -1):
        parts += [
            limb((0.1 * side, 0, 0.1), (0.1 * side, 0, 0.85), 0.075),
            at(box((0.1, 0.27, 0.08)), 0.1 * side, -0.06, 0.04),
        ]
        parts.append(limb((0.2 * side, 0, 1.42), (0.3 * side, 0, 0.85), 0.05))
    return trimesh.util.concatenate(parts)


def animal() -> trimesh.Trimesh:
    """Return a body on four legs with a head in front and a tail behind."""
    parts = [
        limb((0, -0.6, 1), (0, 0.6, 1), 0.3),
        limb((0, -0.8, 1.2), (0, -1, 1.7), 0.2),
        limb((0, 0.8, 1), (0, 1.4, 1.2), 0.06),
    ]
    parts += [at(cylinder(0.1, 0.9), x, y, 0.45) for x in (-0.2, 0.2) for y in (-0.5, 0.5)]
    return trimesh.util.concatenate(parts)


def table() -> trimesh.Trimesh:
    """Return a table on four legs."""
    legs = [at(box((0.06, 0.06, 0.75)), x, y, 0.375) for x in (-0.9, 0.9) for y in (-0.4, 0.4)]
    return trimesh.util.concatenate([at(box((2, 1, 0.05)), 0, 0, 0.75), *legs])


def fir() -> trimesh.Trimesh:
    """Return a tree with a pointed crown."""
    return trimesh.util.concatenate([at(cylinder(0.15, 1), 0, 0, 0.5), at(cone(0.6, 1.5), 0, 0, 0.8)])


def tower() -> trimesh.Trimesh:
    """Return a round tower under a pointed roof."""
    return trimesh.util.concatenate([at(cylinder(0.5, 3), 0, 0, 1.5), at(cone(0.7, 1), 0, 0, 3)])


def picture() -> trimesh.Trimesh:
    """Return a thin picture that stands."""
    return at(box((1, 0.04, 1.4)), 0, 0, 0.7)


def candle() -> trimesh.Trimesh:
    """Return a square column ten times as high as wide."""
    return at(box((0.2, 0.2, 2)), 0, 0, 1)


def pillar() -> trimesh.Trimesh:
    """Return a square column six times as high as wide."""
    return at(box((0.3, 0.3, 1.8)), 0, 0, 0.9)


def ball() -> trimesh.Trimesh:
    """Return a ball."""
    return icosphere(radius=1)


def cube() -> trimesh.Trimesh:
    """Return a cube."""
    return box((1, 1, 1))


def along(make: Callable[[], trimesh.Trimesh], axis: str) -> tuple[np.ndarray, np.ndarray]:
    """Return vertices and faces of a shape that stands along an axis."""
    shape = make()
    return np.array(shape.vertices) @ np.array(TURNS[axis]), np.array(shape.faces)


@pytest.mark.parametrize("axis", "xyz")
def test_turns_are_rotations_to_z(axis: str) -> None:
    """Each one brings its axis to z and mirrors nothing."""
    turn = np.array(TURNS[axis])
    np.testing.assert_array_equal(turn @ np.eye(3)["xyz".index(axis)], (0, 0, 1))
    np.testing.assert_array_equal(turn @ turn.T, np.eye(3))
    assert np.linalg.det(turn) == pytest.approx(1)


@pytest.mark.parametrize("make", [figure, animal, fir, tower, table])
@pytest.mark.parametrize(("usual", "other"), [("y", "z"), ("z", "y")])
def test_what_lies_is_stood_up(make: Callable[[], trimesh.Trimesh], usual: str, other: str) -> None:
    """What was written along the other axis is told from its base; along the usual one it is left as it is."""
    assert stands_better(*along(make, other), usual, other)
    assert not stands_better(*along(make, usual), usual, other)


@pytest.mark.parametrize("make", [picture, candle, pillar])
@pytest.mark.parametrize(("usual", "other"), [("y", "z"), ("z", "y")])
def test_columns_and_pictures_are_not_laid_down(make: Callable[[], trimesh.Trimesh], usual: str, other: str) -> None:
    """What is high and narrow stands on though it would lie more firmly."""
    assert steadiness(*along(make, "z")) < steadiness(*along(make, "y"))
    assert not stands_better(*along(make, usual), usual, other)


@pytest.mark.parametrize("make", [picture, ball, cube])
@pytest.mark.parametrize("axis", "yz")
@pytest.mark.parametrize(("usual", "other"), [("y", "z"), ("z", "y")])
def test_what_says_nothing_is_left(make: Callable[[], trimesh.Trimesh], axis: str, usual: str, other: str) -> None:
    """A picture is not laid down, and shapes that stand alike on all sides are not turned."""
    assert not stands_better(*along(make, axis), usual, other)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_steadiness_of_boxes(scale: float) -> None:
    """A box tips at the angle between its height and half its narrower side, in every unit."""
    shape = box((2, 1, 3))
    found = steadiness(np.array(shape.vertices) * scale, np.array(shape.faces))
    assert found == pytest.approx(np.degrees(np.arctan(0.5 / 1.5)))


def test_steadiness_of_what_falls() -> None:
    """A box beside its foot falls; a cone on its tip has no base; a flat edge is no base either."""
    falling = trimesh.util.concatenate([at(box((1, 1, 0.1)), 5, 0, 0.05), at(box((1, 1, 1)), 0, 0, 1)])
    assert steadiness(np.array(falling.vertices), np.array(falling.faces)) < 0
    tip = cone(1, 2)
    assert steadiness(np.array(tip.vertices) * (1, 1, -1), np.array(tip.faces)) == FALLEN
    assert steadiness(np.array([(0.0, 0, 0), (1, 0, 0), (0, 0, 1)]), np.array([(0, 1, 2)])) == FALLEN


def test_steadiness_takes_what_faces_use() -> None:
    """Vertices of no face do not count; a surface without area stands nowhere; many triangles are sampled."""
    shape = box((2, 1, 3))
    vertices, faces = np.array(shape.vertices), np.array(shape.faces)
    alone = steadiness(np.concatenate([vertices, [(0, 0, -50), (9, 9, 9)]]), faces)
    assert alone == steadiness(vertices, faces)
    assert steadiness(vertices * (1, 0, 0), faces) == FALLEN
    assert steadiness(vertices, np.repeat(faces, 300_000, axis=0)) == pytest.approx(alone, abs=0.1)


def mesh(vertices: np.ndarray) -> TriangleMesh:
    """Return a mesh of vertices."""
    n = len(vertices) - 2
    return TriangleMesh(
        vertices=vertices, faces=np.arange(3 * n, dtype=np.int32).reshape(-1, 3) % (n + 2), uvs=np.zeros((n, 3, 2)),
        face_image=np.zeros(n, np.int32), images=(np.zeros((1, 1, 3), np.uint8),), image_clamp=np.array([True]),
    )  # fmt: skip


@pytest.mark.parametrize("axis", "xy")
def test_turned_where_it_lay(axis: str) -> None:
    """The axis points up afterwards, on the same ground and about the same middle; the matrix says how."""
    lying = mesh(np.random.default_rng(0).normal(size=(9, 3)) * (1, 5, 3) + (100, -20, 7))
    standing, turn = turn_upright(lying, axis)
    np.testing.assert_allclose(lying.vertices @ turn[:3, :3].T + turn[:3, 3], standing.vertices)
    np.testing.assert_array_equal(turn[:3, :3], TURNS[axis])
    low, high = lying.vertices.min(axis=0), lying.vertices.max(axis=0)
    new_low, new_high = standing.vertices.min(axis=0), standing.vertices.max(axis=0)
    assert (new_high - new_low)[2] == pytest.approx((high - low)["xyz".index(axis)])
    np.testing.assert_allclose((new_low + new_high)[:2], (low + high)[:2])
    assert new_low[2] == pytest.approx(low[2])


@pytest.mark.parametrize("up", ["auto", "z"])
def test_left_as_it_stands(up: str) -> None:
    """The same mesh comes back if z points up."""
    standing = mesh(np.random.default_rng(0).normal(size=(9, 3)))
    found, turn = turn_upright(standing, up)
    assert found is standing
    np.testing.assert_array_equal(turn, np.eye(4))
