"""The textured triangle mesh: checked, repaired, oriented, scaled."""

from __future__ import annotations

from .rays import vertical_hits
from .size import check_any, model_scale, scale_of_extent
from .triangle_mesh import Repairs, TriangleMesh, checked_vertices, repair, scale_mesh
from .upright import TURNS, stands_better, turn_mesh, turn_upright
from .weighted_surface import cell_factors, emphasised, weight_at

__all__ = [
    "TURNS",
    "Repairs",
    "TriangleMesh",
    "cell_factors",
    "check_any",
    "checked_vertices",
    "emphasised",
    "model_scale",
    "repair",
    "scale_mesh",
    "scale_of_extent",
    "stands_better",
    "turn_mesh",
    "turn_upright",
    "vertical_hits",
    "weight_at",
]
