"""What was built, in numbers and sentences: report, checks, remarks, tables."""

from __future__ import annotations

from .building_remarks import remarks_on_building, remarks_on_proof, remarks_on_split
from .checks import failed_checks
from .edit_remarks import remarks_on_edits
from .outputs import later_texts, wanted_lists
from .owned_remarks import remarks_on_owned
from .price_remarks import remarks_on_prices
from .remarks import brick_name, layer_of, remarks
from .report import report

__all__ = [
    "brick_name",
    "failed_checks",
    "later_texts",
    "layer_of",
    "remarks",
    "remarks_on_building",
    "remarks_on_edits",
    "remarks_on_owned",
    "remarks_on_prices",
    "remarks_on_proof",
    "remarks_on_split",
    "report",
    "wanted_lists",
]
