"""The textured triangle mesh: checked, repaired, oriented, scaled."""

from __future__ import annotations

from .rays import vertical_hits
from .size import check_any, model_scale, scale_of_extent
from .triangle_mesh import Repairs, TriangleMesh, checked_vertices, repair, scale_mesh
from .upright import TURNS, stands_better, turn_mesh, turn_upright

__all__ = [
    "TURNS",
    "Repairs",
    "TriangleMesh",
    "check_any",
    "checked_vertices",
    "model_scale",
    "repair",
    "scale_mesh",
    "scale_of_extent",
    "stands_better",
    "turn_mesh",
    "turn_upright",
    "vertical_hits",
]
