"""Changes by hand that survive: told by cells of the grid, made in windows of a layout, and looked up in its bricks."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..on_demand import on_demand
from .edit import Edit, check_edit, edit_of
from .edits_file import NO_EDITS, Edits, edits_text, read_edits
from .rules import rules_of

if TYPE_CHECKING:
    from .apply import apply_edits
    from .outcomes import Outcome, outcomes_of, ruled
else:
    # the layout, and the graphs of scipy
    __getattr__ = on_demand(__name__, apply=("apply_edits",), outcomes=("Outcome", "outcomes_of", "ruled"))

__all__ = [
    "NO_EDITS",
    "Edit",
    "Edits",
    "Outcome",
    "apply_edits",
    "check_edit",
    "edit_of",
    "edits_text",
    "outcomes_of",
    "read_edits",
    "ruled",
    "rules_of",
]
