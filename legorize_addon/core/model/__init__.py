"""What all stages share: the catalogue, the unit grid, the table of bricks, the graph of their contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..on_demand import on_demand
from .brick_columns import Touching, agree, brick_columns, every_plate
from .bricks import NOBODY, SUPPORTS, Bricks, Role, concatenate
from .catalogue import ASSETS, Catalogue, Colour, load_catalogue
from .images import part_images
from .parts import MISSING_CELL, Part, Use, footprint, outline
from .polygons import depths, sides
from .profiles import columns, filled, jumper_turn, lines, solid, turned
from .squares import Rows
from .unit_grid import CELL_SIZE, COLOUR_ANY, COLOUR_EMPTY, Fill, UnitGrid, ground_of
from .verdict import UNSUPPORTED, Verdict

if TYPE_CHECKING:
    from .assembly import Assembly
    from .contacts import (
        ContactGraph,
        centres,
        clutches,
        collisions_between_grids,
        column_facts,
        components,
        contact_graph,
        middles,
        stacked,
        stud_columns,
        stud_middles,
    )
else:
    # the graphs of scipy
    __getattr__ = on_demand(
        __name__,
        assembly=("Assembly",),
        contacts=(
            "ContactGraph",
            "centres",
            "clutches",
            "collisions_between_grids",
            "column_facts",
            "components",
            "contact_graph",
            "middles",
            "stacked",
            "stud_columns",
            "stud_middles",
        ),
    )

__all__ = [
    "ASSETS",
    "CELL_SIZE",
    "COLOUR_ANY",
    "COLOUR_EMPTY",
    "MISSING_CELL",
    "NOBODY",
    "SUPPORTS",
    "UNSUPPORTED",
    "Assembly",
    "Bricks",
    "Catalogue",
    "Colour",
    "ContactGraph",
    "Fill",
    "Part",
    "Role",
    "Rows",
    "Touching",
    "UnitGrid",
    "Use",
    "Verdict",
    "agree",
    "brick_columns",
    "centres",
    "clutches",
    "collisions_between_grids",
    "column_facts",
    "columns",
    "components",
    "concatenate",
    "contact_graph",
    "depths",
    "every_plate",
    "filled",
    "footprint",
    "ground_of",
    "jumper_turn",
    "lines",
    "load_catalogue",
    "middles",
    "outline",
    "part_images",
    "sides",
    "solid",
    "stacked",
    "stud_columns",
    "stud_middles",
    "turned",
]
