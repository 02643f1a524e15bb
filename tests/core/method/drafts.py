"""A model as far as there is no brick yet: three tubes in each other, in several colours."""

from __future__ import annotations

from functools import cache

import numpy as np

from legorize_addon.core.build import Draft
from legorize_addon.core.drafting import draft_model
from legorize_addon.core.mesh.triangle_mesh import TriangleMesh
from legorize_addon.core.settings import Settings
from tests.core.solids import joined, mesh_of
from tests.core.textured import painted

LEVELS = 4
"""Loops around each other in every slice."""

SIDES = (160.0, 112.0, 80.0, 32.0)
"""Of the loops in mm, from the outermost one: walls of 24 mm and of 24 mm, with a gap between them."""

HEIGHT = 48.0


def tube(outer: float, inner: float) -> TriangleMesh:
    """Return an upright square tube, closed at its ends by rings."""
    square = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) / 2
    rings = [np.column_stack([side * square, np.full(4, z)]) for side in (outer, inner) for z in (0.0, HEIGHT)]
    low, high, low_in, high_in = (4 * ring for ring in range(4))
    quads = []
    for one, two in ((0, 1), (1, 2), (2, 3), (3, 0)):
        quads.append((low + one, low + two, high + two, high + one))
        quads.append((low_in + two, low_in + one, high_in + one, high_in + two))
        quads.append((high + one, high + two, high_in + two, high_in + one))
        quads.append((low + two, low + one, low_in + one, low_in + two))
    return mesh_of(np.concatenate(rings), [corners for a, b, c, d in quads for corners in ((a, b, c), (a, c, d))])


def nested() -> TriangleMesh:
    """Return two square tubes in each other, open inside: red where x is below 0, else blue."""
    mesh = joined(tube(*SIDES[:2]), tube(*SIDES[2:]))
    return painted(mesh, np.where(mesh.vertices[mesh.faces][..., 0].mean(axis=1) > 1e-6, 1, 4))


@cache
def draft() -> Draft:
    """Return the tubes, in their own size, in bricks."""
    return draft_model(nested(), Settings(width=20, plates="none"))
