"""Skins that cover others."""

from __future__ import annotations

import numpy as np

from legorize_addon.core.arrays import Floats
from legorize_addon.core.unit_bricks.occlusion import occluded
from legorize_addon.core.unit_bricks.surface_samples import SurfaceSamples


def _sheet(height: float, normal: tuple[float, float, float], side: int = 6) -> tuple[Floats, Floats]:
    """Return points of a level sheet, nine to a stud, at a height in bricks, and their normals."""
    line = (np.arange(3 * side) + 0.5) / 3
    y, x = (part.ravel() for part in np.meshgrid(line, line, indexing="ij"))
    return np.column_stack([np.full(len(x), height), y, x]), np.tile(normal, (len(x), 1))


def _samples(*sheets: tuple[Floats, Floats]) -> SurfaceSamples:
    place, normal = (np.concatenate(parts) for parts in zip(*sheets, strict=True))
    return SurfaceSamples(
        place,
        np.zeros_like(place),
        np.floor(place).astype(np.int64),
        normal,
        np.ones(len(place)),
        np.zeros(len(place), dtype=np.int16),
    )


UP, DOWN = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)


def test_body_under_a_cloak() -> None:
    """Of two sheets a quarter of a stud apart that face up the lower one is covered, and only it."""
    gap = 0.25 / 1.2
    covered = occluded(_samples(_sheet(2.0, UP), _sheet(2.0 + gap, UP)))
    n = len(covered) // 2
    assert covered[:n].all()
    assert not covered[n:].any()


def test_covered_whichever_way_it_faces() -> None:
    """The same sheets facing down: now the upper one is covered; turned upright: the one behind."""
    gap = 0.25 / 1.2
    covered = occluded(_samples(_sheet(2.0, DOWN), _sheet(2.0 + gap, DOWN)))
    n = len(covered) // 2
    assert not covered[:n].any()
    assert covered[n:].all()
    upright = []
    for x in (3.0, 3.25):
        place, _ = _sheet(0.0, UP)
        upright.append((place[:, [1, 2, 0]] / [1.2, 1, 1] + [0, 0, x], np.tile((0.0, 0.0, 1.0), (len(place), 1))))
    covered = occluded(_samples(*upright))
    assert covered[:n].all()
    assert not covered[n:].any()


def test_two_sides_of_a_wall() -> None:
    """The sides of a thin plate face apart and cover nothing, nor does a sheet farther off than a stud."""
    assert not occluded(_samples(_sheet(2.0, DOWN), _sheet(2.2, UP))).any()
    assert not occluded(_samples(_sheet(2.0, UP), _sheet(3.0, UP))).any()


def test_one_skin_alone() -> None:
    """Neither a slope nor a ball of ten studs covers itself."""
    place, _ = _sheet(0.0, UP)
    place[:, 0] = place[:, 2] / 1.2
    assert not occluded(_samples((place, np.tile((1 / 1.2, 0.0, -1.0), (len(place), 1))))).any()
    golden = np.arange(4000) + 0.5
    height = 1 - golden / 2000
    turn = golden * np.pi * (3 - np.sqrt(5))
    around = np.sqrt(1 - height**2)
    normal = np.column_stack([height, around * np.sin(turn), around * np.cos(turn)]) / [1.2, 1, 1]
    assert not occluded(_samples((normal * 5, normal))).any()


def test_no_samples() -> None:
    """Nothing covers nothing."""
    assert occluded(_samples(_sheet(0.0, UP, side=0))).shape == (0,)
