"""Which bricks go where.

==================  =====================================================================
``sheets``          what is laid together: the cells of one height at one level
``shapes``          the parts in all their orientations, and their colours
``placements``      everything that may lie on a sheet
``planes``          where a shape fits on a sheet
``problem``         the task of laying a sheet: placements and what each costs
``live``            the placements that can still be laid
``greedy``          the fast tier: the placement with the most expensive cells first
``linear``          the standard tier: linear programmes, made whole by dives
``programme``       the linear programme and its dual
``dominance``       placements that no programme needs
``pricing``         placements that a good layout hardly needs, by what cells are worth at a guess
``bond``            running bond in the middle of wide areas
``blocks``          wide sheets in blocks
``exact``           the exact tier: branch and bound for what the programmes leave open
``bound``           how few bricks there could be: a proven lower bound
``exchange``        fewer small bricks by exchanging a few against others
``svm``             which exchanges the fast tier tries: learned from samples
``sample_file``     their text: read within limits, and checked line by line
``svm_training``    the samples and the training
``learning``        files of samples: the one chosen, and learning more from a user's own models
``table``           what lies on a sheet; the table of all bricks
``repair``          joins components that float, by exchanges (``islands``: which ones could be joined)
``windows``         joins what is left of them, by small windows laid anew
``straps``          joins what is loose even then, by plates across the seams, once all is laid
``contacts``        where such plates may lie (``cutting``: the bricks that are cut for them)
``features``        the paper's four energies of a layer
``layers``          all sheets in the order of the tier: :func:`lay`
==================  =====================================================================
"""

from __future__ import annotations

from .bound import bound
from .layers import FILLER, Tier, lay

__all__ = ["FILLER", "Tier", "bound", "lay"]
