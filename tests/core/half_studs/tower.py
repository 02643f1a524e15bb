"""A block with a tower that stands half a stud beside its studs."""

from __future__ import annotations

from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from tests.core.solids import box, joined

BLOCK = 3
"""Layers of the block: 6 x 6 studs, which the model is as wide as."""


def tower(x: float = 0.5, y: float = 0.0) -> TriangleMesh:
    """Make the block and a tower of 3 x 3 studs and four layers on it, off the studs by a part of one."""
    high = 9.6 * BLOCK
    foot = (8 * (1 + x), 8 * (1 + y), high)
    return joined(box((0, 0, 0), (48, 48, high)), box(foot, (foot[0] + 24, foot[1] + 24, high + 38.4)))


def table(x: float = 0.5) -> TriangleMesh:
    """Make a top of 8 x 8 studs on four legs of two studs' width, one of them off the studs along x."""
    high = 9.6 * BLOCK
    legs = [box((a, b, 0), (a + 16, b + 16, high)) for a, b in ((0, 0), (0, 48), (48, 48))]
    off = 8 * (6 - x)
    return joined(*legs, box((off, 0, 0), (off + 16, 16, high)), box((0, 0, high), (64, 64, high + 9.6)))
