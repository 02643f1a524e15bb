"""How a model is built, on paper and on the screen: the booklet of its steps, layer maps."""

from __future__ import annotations

from .booklet import Booklet
from .layer_maps import layer_files, layer_pages
from .paper import PAPERS

__all__ = ["PAPERS", "Booklet", "layer_files", "layer_pages"]
