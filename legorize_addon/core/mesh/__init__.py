"""The textured triangle mesh at the door: checked, repaired, oriented, scaled."""

from __future__ import annotations

from .rays import vertical_hits
from .size import check_any, model_scale, scale_of_extent
from .triangle_mesh import Repairs, TriangleMesh, checked_vertices, repair, scaled
from .upright import TURNS, stands_better, turned, turned_upright

__all__ = [
    "TURNS",
    "Repairs",
    "TriangleMesh",
    "check_any",
    "checked_vertices",
    "model_scale",
    "repair",
    "scale_of_extent",
    "scaled",
    "stands_better",
    "turned",
    "turned_upright",
    "vertical_hits",
]
