"""What stands under a model while it is built, what of it stays, and the pieces that a model is built in."""

from __future__ import annotations

from .assembly_plan import KINDS, AssemblyPlan, Wish, plan_as_given, plan_assembly, walk_apart
from .boxes import INSIDE_COLOUR, of_the_paper
from .bracing import add_bracing
from .demand import parts_of_supports
from .pillars import LooseError, add_pillars
from .segmentation import SAVING, Joint, pays, segment
from .stacks import SLIM, slim_stacks
from .strengthening import strengthen

__all__ = [
    "INSIDE_COLOUR",
    "KINDS",
    "SAVING",
    "SLIM",
    "AssemblyPlan",
    "Joint",
    "LooseError",
    "Wish",
    "add_bracing",
    "add_pillars",
    "of_the_paper",
    "parts_of_supports",
    "pays",
    "plan_as_given",
    "plan_assembly",
    "segment",
    "slim_stacks",
    "strengthen",
    "walk_apart",
]
