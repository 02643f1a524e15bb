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
