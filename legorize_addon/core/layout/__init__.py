"""Which bricks go where.

==================  =====================================================================
``sheets``          what is laid together: the cells of one height at one level
``shapes``          the parts in all their orientations, and their colours
``placements``      everything that may lie on a sheet
``problem``         the task of laying a sheet: placements and what each costs
``greedy``          the fast tier: the placement with the most expensive cells first
``exchange``        fewer small bricks by exchanging a few against others
``laid``            what lies on a sheet; the table of all bricks
``repair``          joins components that float
``layers``          all sheets, every other one first: :func:`lay`
==================  =====================================================================
"""

from __future__ import annotations

from .layers import FILLER, lay

__all__ = ["FILLER", "lay"]
