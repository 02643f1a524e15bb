"""Whether what is in place holds by forces at every moment: the static equilibrium of each step."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Ints
from ..model import Bricks, Catalogue, Verdict, contact_graph
from ..progress import Progress, silent
from ..statics import stability
from .moves import Action, Moves


@dataclass(frozen=True, slots=True, eq=False)
class Proof:
    """Verdicts on the steps of a building order.

    Attributes
    ----------
    steps : (n,) int64 array
        Steps at whose end the bricks in place were tested.
    collapsing : int64 array
        Those of them after which something is proven to fall.
    undecided : int64 array
        Those of which neither is proven.
    """

    steps: Ints
    collapsing: Ints
    undecided: Ints

    @property
    def stands(self) -> bool:
        """Whether every step is proven to stand."""
        return len(self.collapsing) == len(self.undecided) == 0


def prove_steps(
    moves: Moves, bricks: Bricks, catalogue: Catalogue, *, clutch: float, progress: Progress = silent
) -> Proof:
    """Test the bricks in place after every step by forces.

    Each piece is tested on its own table; what others have built there is not
    looked at again until it is joined.

    Parameters
    ----------
    moves : Moves
        The order.
    bricks : Bricks
        Model and supports.
    catalogue : Catalogue
    clutch : float
        Pull in N that one contact point bears.
    progress : Progress
        Told before each step; may cancel.

    Returns
    -------
    Proof
    """
    ends = np.flatnonzero(np.diff(moves.step, append=-1))
    assembly = bricks.piece.astype(np.int64)
    placed = np.zeros(len(bricks), dtype=bool)
    verdicts, start = [], 0
    for end in ends.tolist():
        progress("proof", end / len(moves))
        piece = int(moves.piece[end])
        for row in range(start, end + 1):
            if moves.action[row] == Action.JOIN:
                assembly[assembly == piece] = 0
                piece = 0
            else:
                placed[moves.brick[row]] = moves.action[row] == Action.PLACE
        start = end + 1
        there = bricks.take(placed & (assembly == piece))
        found = stability(there, catalogue, contact_graph(there, catalogue), clutch=clutch)
        verdicts.append(found.verdict)
    steps = moves.step[ends].astype(np.int64)
    bad = [[verdict is each for verdict in verdicts] for each in (Verdict.COLLAPSES, Verdict.UNDECIDED)]
    return Proof(steps, steps[bad[0]], steps[bad[1]])
