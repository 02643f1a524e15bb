"""How a model is built, on paper and on the screen: the booklet of its steps, layer maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..on_demand import on_demand
from .shades import TINTS, pale, tint_for, tinted

if TYPE_CHECKING:
    from .booklet import Booklet, Unfinished
    from .canvas import Group, Item, Page, Paint, Path, Text, lines, rectangle
    from .layer_maps import layer_files, layer_pages
    from .legend import lettered
    from .lettering import Lettering, Title
    from .paper import PAPERS
else:
    # a scene needs the colours alone
    __getattr__ = on_demand(
        __name__,
        booklet=("Booklet", "Unfinished"),
        canvas=("Group", "Item", "Page", "Paint", "Path", "Text", "lines", "rectangle"),
        layer_maps=("layer_files", "layer_pages"),
        legend=("lettered",),
        lettering=("Lettering", "Title"),
        paper=("PAPERS",),
    )

__all__ = [
    "PAPERS",
    "TINTS",
    "Booklet",
    "Group",
    "Item",
    "Lettering",
    "Page",
    "Paint",
    "Path",
    "Text",
    "Title",
    "Unfinished",
    "layer_files",
    "layer_pages",
    "lettered",
    "lines",
    "pale",
    "rectangle",
    "tint_for",
    "tinted",
]
