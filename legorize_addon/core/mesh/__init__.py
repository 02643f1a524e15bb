"""The textured triangle mesh: checked, repaired, oriented, scaled."""

from __future__ import annotations

from .rays import vertical_hits
from .size import check_any, model_scale, scale_mesh, scale_of_extent
from .triangle_mesh import Repairs, TriangleMesh, checked_vertices, repair
from .upright import TURNS, stands_better, turn_mesh, turn_upright
from .weight_field import WeightField
from .weighted_surface import cell_factors, emphasised, surface_hits, weight_at

__all__ = [
    "TURNS",
    "Repairs",
    "TriangleMesh",
    "WeightField",
    "cell_factors",
    "check_any",
    "checked_vertices",
    "emphasised",
    "model_scale",
    "repair",
    "scale_mesh",
    "scale_of_extent",
    "stands_better",
    "surface_hits",
    "turn_mesh",
    "turn_upright",
    "vertical_hits",
    "weight_at",
]
