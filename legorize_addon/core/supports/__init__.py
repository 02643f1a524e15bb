"""What stands under a model while it is built.

==================  =====================================================================
``carrying``        how deep each brick hangs, as more and more are held
``need``            which bricks need a support, and where it touches them
``room``            where supports may stand, and can be pulled out of again
``posts``           what stays: under what floats, and in closed hollows
``props``           what stays under parts that would tear off or tip over in the finished model
``boxes``           supports before they are bricks
``tree``            trees: branches that meet on their way down
``columns``         straight columns
``beams``           the paper's beams on pillars
``links``           the bricks that join beams side by side
``plan``            supports of one kind under one piece, until all stands and bears
``whole``           all pieces, and the order in which they are built: :func:`supported`
==================  =====================================================================
"""

from __future__ import annotations

from .posts import with_floating_carried
from .props import with_falling_propped
from .whole import Supports, supported

__all__ = ["Supports", "supported", "with_falling_propped", "with_floating_carried"]
