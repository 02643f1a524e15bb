"""How a model is built, on paper: layer maps, pictures of the steps, the booklet."""

from __future__ import annotations

from .layer_maps import PAPERS, layer_files, layer_pages

__all__ = ["PAPERS", "layer_files", "layer_pages"]
