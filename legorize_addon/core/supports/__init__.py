"""What stands under a model while it is built, what of it stays, and the pieces that a model is built in."""

from __future__ import annotations

from .assembly_plan import Supports, supported
from .bracing import with_falling_propped
from .pillars import with_floating_carried
from .segmentation import SAVING, Joint, segmented

__all__ = [
    "SAVING",
    "Joint",
    "Supports",
    "segmented",
    "supported",
    "with_falling_propped",
    "with_floating_carried",
]
