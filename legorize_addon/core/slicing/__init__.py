"""The mesh cut by horizontal planes: slices, and the closed, nested, coloured loops in them."""

from __future__ import annotations

from .coverage import Pieces, covered_area, covered_area_shares, cut_at_grid
from .fine_cut import ACROSS, UP, fine_shares
from .grid_search import LEEWAY, best_grid
from .lattice import ALPHA, Grid, fit_grid
from .layer_differences import Marks, differing_layers
from .levels import Levels, levels_of
from .slices import Slices, adaptive_heights, slice_mesh
from .trajectories import Trajectories, link_loops, linked

__all__ = [
    "ACROSS",
    "ALPHA",
    "LEEWAY",
    "UP",
    "Grid",
    "Levels",
    "Marks",
    "Pieces",
    "Slices",
    "Trajectories",
    "adaptive_heights",
    "best_grid",
    "covered_area",
    "covered_area_shares",
    "cut_at_grid",
    "differing_layers",
    "fine_shares",
    "fit_grid",
    "levels_of",
    "link_loops",
    "linked",
    "slice_mesh",
]
